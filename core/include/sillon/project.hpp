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
inline constexpr double kDefaultWidth = 80;  ///< page width [mm] of built-in shapes and masks that name none

enum class BuiltinShape { None, Rectangle, RoundedRectangle, Disc };

/// Everything needed to repeat a plate. File names are as written, relative to the project file.
struct Project {
  std::string shapeFile;                      ///< SVG, or a mask picture; empty: builtin
  BuiltinShape builtin = BuiltinShape::None;  ///< None without a shape file: a rectangle like the direction picture
  Vec2 builtinSize;           ///< [mm]; zero width: kDefaultWidth; zero height follows the direction picture
  double builtinRadius = 3;   ///< of rounded corners [mm]
  double pageWidth = 0;       ///< scales the shape to this page width [mm]; 0: as drawn
  bool unitlessIsMm = false;  ///< scene files: SVG lengths without unit mean mm
  std::string directionFile;  ///< empty: `angle`
  DirectionEncoding encoding = DirectionEncoding::Angle;
  double angle = 0;      ///< [degrees]
  std::string modeFile;  ///< empty: `mode`
  DirectionMode mode = DirectionMode::Constrained;
  ToolpathParams toolpath;
  PrintParams print;
  std::string printerPreset;   ///< whose values `printer` began with; empty: none
  std::string filamentPreset;  ///< laid over them; empty: none
  Printer printer;
};

/// Reads a project or a published scene. Keys, units, ranges and defaults: docs/project.md.
/// \param json  at most 1 MiB, nested at most 64 deep.
/// \return InvalidFile (no JSON, unknown or repeated key, wrong type) or InvalidArgument (out of range); the message
/// names the key.
Result<Project> readProject(std::string_view json);

/// The checks readProject ends with, for forms and command lines. Empty string: all in range.
std::string invalidProject(const Project& project);

/// The project as JSON with every field but `print.date` and `print.notes`, which belong to a run; readable by
/// readProject, and equal when read back if invalidProject finds nothing.
std::string writeProject(const Project& project);

}  // namespace sillon
