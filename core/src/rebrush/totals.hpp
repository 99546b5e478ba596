// What a file tells of its own duration: comments and progress commands.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sillon/rebrush/edits.hpp"

namespace sillon {

/// Somewhere the print takes longer, or shorter.
struct TimeChange {
  std::size_t at = 0;  ///< behind it [bytes of the file as it was]
  double seconds = 0;
  bool firstLayer = false;
};

/// Changes the times of the file: "estimated printing time", "model printing time", "total estimated time", TIME,
/// TIME_ELAPSED, and P, R, Q, S of M73. Everything else keeps its bytes. \param edits  what else becomes of the file,
/// in its order, whole lines; receives the lines that change. \param changes  in the order of the file, none within an
/// edit. \return the number of lines that have changed.
std::int64_t changeTotals(std::string_view gcode, const std::vector<TimeChange>& changes, std::vector<Edit>& edits);

}  // namespace sillon
