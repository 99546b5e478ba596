// All that a person chooses, as one struct. Every field but the studio's is a row of the table of settings.
#pragma once

#include <string>

#include "sillon/base/types.hpp"
#include "sillon/settings/input_params.hpp"
#include "sillon/settings/picture_params.hpp"
#include "sillon/settings/print_params.hpp"
#include "sillon/settings/printer.hpp"
#include "sillon/settings/toolpath_params.hpp"

namespace sillon {

/// Everything needed to repeat a plate. File names are as written, relative to the project file.
struct Project {
  std::string shapeFile;                      ///< SVG, or a mask picture; empty: builtin
  BuiltinShape builtin = BuiltinShape::None;  ///< None without a shape file: a rectangle like the direction picture
  Vec2 builtinSize;           ///< [mm]; zero width: kDefaultWidth; zero height follows the direction picture
  double builtinRadius = 3;   ///< of rounded corners [mm]
  double pageWidth = 0;       ///< scales the shape to this page width [mm]; 0: as drawn
  bool unitlessIsMm = false;  ///< scene files: SVG lengths without unit mean mm
  bool ignorePaint = false;   ///< scene files: outlines count whatever their paint, see SvgOptions
  bool keepThin = false;      ///< places of half a bead to one are widened to one, see keepThinPlaces
  std::string directionFile;  ///< empty: `angle`
  DirectionEncoding encoding = DirectionEncoding::Angle;
  double angle = 0;      ///< [degrees]
  std::string modeFile;  ///< empty: `mode`
  DirectionMode mode = DirectionMode::Constrained;
  PictureParams pictures;  ///< if there are any, directions are solved for and directionFile must be empty
  ToolpathParams toolpath;
  PrintParams print;
  std::string printerProfile;   ///< whose values `printer` began with; empty: none
  std::string filamentProfile;  ///< laid over them; empty: none
  Printer printer;
  std::string studio;  ///< what the studio keeps of its own in a project, a JSON object; empty: nothing
};

}  // namespace sillon
