// Project files, and the inputs they name.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Project files (JSON, versioned) and the published scene files, which are read as they are.

inline constexpr int kProjectVersion = 1;
/// Most bytes of a project file; strokes take most of them.
inline constexpr std::size_t kMaxProjectBytes = std::size_t{16} << 20;

/// Reads a project or a published scene. docs/reference/project.md lists keys, units, ranges and
/// defaults.
/// \param json  at most kMaxProjectBytes, nested at most 64 deep.
/// \return InvalidFile (no JSON, unknown or repeated key, wrong type) or InvalidArgument (out of
/// range); the message names the key.
Result<Project> readProject(std::string_view json);

/// Writes a project as JSON. All fields are there except `print.date` and `print.notes`, which
/// belong to a run; readProject reads it back equal if invalidSettings finds nothing. The studio's
/// own section is kept as it came.
std::string writeProject(const Project& project);

// The way from a project and the files that it names to the inputs of the pipeline.

/// Reads and decodes the shape, and the directions and modes of the lowest layer where that fills
/// the page; the layers above lie on them. A shape file is SVG if it begins like one or is called
/// .svg, otherwise a mask picture. With `keepThin`, thin places of the shape are widened to one
/// bead.
/// \return the error that `read` returned, or the errors of readSvg, decodeImage, the maps and
/// keepThinPlaces, with the file's name.
Result<PlateInput> readPlateInput(const Project& project, const ReadInput& read,
                                  const RunContext& run = RunContext());

/// A picture, or a drawing as it is seen.
struct PaintedFile {
  Image picture;         ///< pixels; for a drawing RGBA, clear where nothing is painted
  DrawingFacts drawing;  ///< facts about a drawing; none for a picture
};

/// Reads a picture, or paints a drawing in its colours, 1024 pixels along its longer side.
/// \return the errors of readSvg and decodeImage.
Result<PaintedFile> readPainted(const ReadInput& read, const std::string& name,
                                const std::string& what);

/// Does the same as the first readPlateInput, for another surface than the project's own shape.
Result<PlateInput> readPlateInput(const Project& project, Shape shape, const ReadInput& read);

}  // namespace sillon
