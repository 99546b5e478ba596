// What a reader of G-code has to say: a code with values, and the English sentence made from them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sillon/base/sentence.hpp"

namespace sillon {

/// One rule that was broken, however often.
struct GcodeFinding {
  std::string code;       ///< one of findingSentences(), such as too-hot
  std::string rule;       ///< what it belongs to: commands, grammar, homing, heating, modes, bounds, height, extrusion,
                          ///< flow, speed, rate, retraction, cycle, coverage, noise, settings, totals, layers, end
  bool error = false;     ///< the print or the machine is at risk; else worth knowing
  std::int64_t line = 0;  ///< the first, from 1; 0: the file as a whole
  std::int64_t count = 0;                                   ///< lines that break it in this way
  std::vector<std::pair<std::string, std::string>> values;  ///< of the first, by name, as the sentence shows them
  std::string message;                                      ///< about the first
};

/// The sentence of each code.
std::span<const Sentence> findingSentences();

}  // namespace sillon
