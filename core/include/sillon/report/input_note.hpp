// Notes on a plate's input: what was taken for granted of it, and what was left out.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/sentence.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

struct InputNote {
  const char* code;  ///< one of inputNoteSentences()
  std::vector<NamedValue> values;
  std::string message;  ///< one English sentence without a full stop
};

/// The sentence of each code.
std::span<const Sentence> inputNoteSentences();

/// \param drawing  of the shape that was read.
std::vector<InputNote> inputNotes(const Project& project, const DrawingFacts& drawing);

/// \param drawing  of a layer, or of its mask. \param layer  number, from 1; a value of each note.
std::vector<InputNote> layerNotes(const DrawingFacts& drawing, std::size_t layer);

/// A list with the `code`, `values` and `message` of each.
std::string notesJson(const std::vector<InputNote>& notes);

}  // namespace sillon
