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

/// One note on a plate's input.
struct InputNote {
  const char* code;  ///< one of inputNoteSentences()
  std::vector<NamedValue> values;
  std::string message;  ///< one English sentence without a full stop
};

/// Returns the sentence of each code.
std::span<const Sentence> inputNoteSentences();

/// Makes the notes on a project's shape.
/// \param drawing  facts about the shape that was read.
std::vector<InputNote> inputNotes(const Project& project, const DrawingFacts& drawing);

/// Makes the notes on the drawing of a layer.
/// \param drawing  facts about the layer's drawing, or its mask.
/// \param layer  number, from 1; a value of each note.
std::vector<InputNote> layerNotes(const DrawingFacts& drawing, std::size_t layer);

/// Returns notes as a JSON list of objects with `code`, `values` and `message`.
std::string notesJson(const std::vector<InputNote>& notes);

}  // namespace sillon
