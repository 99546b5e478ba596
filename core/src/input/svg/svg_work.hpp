// Limits the cost of a drawing: a short text can ask for much work.
#pragma once

#include <cstddef>
#include <cstdint>

#include "input/svg/svg_node.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon::svg {

/// Counts work in bytes that are read: <use> reads elements again, rules are compared again, and clipping repeats
/// outlines. Each method throws Refused if the total becomes too large.
class Work {
 public:
  void spend(const Node& node);
  void spendOnCuts(const FilledPath& path, std::int64_t bytesPerPoint);
  void spendOnRules(std::size_t bytes);

 private:
  void check(Reason reason) const;

  std::int64_t spent_ = 0;
};

}  // namespace sillon::svg
