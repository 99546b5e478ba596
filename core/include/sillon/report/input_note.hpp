// Notes on a plate's input: what was taken for granted of it, and what was left out.
#pragma once

#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

struct InputNote {
  /// DrawingInPixels, NoSize, TextLeftOut, ImagesLeftOut, SeveralColours or LinesAsShape
  const char* code;
  std::vector<NamedValue> values;  ///< `n` of what is left out
  std::string message;             ///< one English sentence without a full stop
};

/// \param drawing  of the shape that was read.
std::vector<InputNote> inputNotes(const Project& project, const DrawingFacts& drawing);

}  // namespace sillon
