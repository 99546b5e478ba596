// What drawing costs: little text can ask for much.
#pragma once

#include <cstddef>
#include <cstdint>

#include "input/svg/svg_node.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon::svg {

/// Counted as bytes that are read: <use> reads again, rules compare again, and clipping repeats outlines.
class Work {
 public:
  void spend(const Node& node);                                          ///< Throws Refused: too much.
  void spendOnCuts(const FilledPath& path, std::int64_t bytesPerPoint);  ///< Throws Refused: too much.
  void spendOnRules(std::size_t bytes);                                  ///< Throws Refused: too much.

 private:
  void check(const char* problem, const char* wayOut = "") const;

  std::int64_t spent_ = 0;
};

}  // namespace sillon::svg
