// From a project and the files it names to what the pipeline eats.
#pragma once

#include <functional>
#include <string>
#include <variant>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/project/project.hpp"

namespace sillon {

/// An input as it comes: a file's bytes, or a picture decoded elsewhere.
using InputFile = std::variant<std::string, Image>;

/// Hands over the file that a project names. \param what  "shape", "direction picture", "mode picture": for messages.
using ReadInput = std::function<Result<InputFile>(const std::string& name, const std::string& what)>;

/// What a project says of directions, for shapes that come from elsewhere.
struct PlateField {
  DirectionMap directions;
  ModeMap modes;
};

/// Reads and decodes directions and modes. \return as readPlateInput.
Result<PlateField> readPlateField(const Project& project, const ReadInput& read);

/// Reads and decodes shape, directions and modes. A shape file is SVG if it begins like one or is called .svg, else a
/// mask picture.
/// With `keepThin` the shape's thin places are widened to one bead.
/// \return what `read` returned, or the errors of readSvg, decodeImage, the maps and keepThinPlaces, with the file's
/// name.
Result<PlateInput> readPlateInput(const Project& project, const ReadInput& read, const RunContext& run = RunContext());

}  // namespace sillon
