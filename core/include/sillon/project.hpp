// Project files (JSON, versioned) and the published scene files, which are read as they are.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sillon/direction_map.hpp"
#include "sillon/gcode.hpp"
#include "sillon/params.hpp"
#include "sillon/result.hpp"

namespace sillon {

inline constexpr int kProjectVersion = 1;

enum class BuiltinShape { None, Rectangle, RoundedRectangle, Disc };

/// Everything needed to repeat a plate. File names are as written, relative to the project file.
struct Project {
  std::string shapeFile;                 ///< SVG, or a mask picture; empty: builtin
  BuiltinShape builtin = BuiltinShape::None;
  Vec2 builtinSize;                      ///< [mm]; a zero height follows the direction picture
  double builtinRadius = 3;              ///< of rounded corners [mm]
  double pageWidth = 0;                  ///< scales the shape to this page width [mm]; 0: as drawn
  bool unitlessIsMm = false;             ///< scene files: SVG lengths without unit mean mm
  std::string directionFile;             ///< empty: `angle`
  DirectionEncoding encoding = DirectionEncoding::Angle;
  double angle = 0;                      ///< [degrees]
  std::string modeFile;                  ///< empty: `mode`
  DirectionMode mode = DirectionMode::Constrained;
  ToolpathParams toolpath;
  PrintParams print;
  Printer printer;
};

/// Reads a project or a published scene. Unknown keys, wrong types and values out of range are errors that name the key.
Result<Project> readProject(std::string_view json);

/// The project as JSON with every field, readable by readProject.
std::string writeProject(const Project& project);

}  // namespace sillon
