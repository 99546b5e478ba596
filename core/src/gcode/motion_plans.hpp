// Keeps the longest motion that was planned.
#pragma once

#include <cstddef>
#include <utility>

#include "gcode/motion.hpp"

namespace sillon {

/// Planned for the estimate, the longest motion is written without being planned again, which takes a third of the time
/// of writing.
class MotionPlans {
 public:
  /// \return valid until the next call.
  const Motion& of(const BeadPath& path, std::size_t start, const MotionLimits& limits) {
    if (path_ == &path && start_ == start && limits_ == limits) return longest_;
    Motion motion = planMotion(path, start, limits);
    if (motion.points.size() <= longest_.points.size()) return other_ = std::move(motion);
    path_ = &path;
    start_ = start;
    limits_ = limits;
    return longest_ = std::move(motion);
  }

 private:
  const BeadPath* path_ = nullptr;
  std::size_t start_ = 0;
  MotionLimits limits_;
  Motion longest_;
  Motion other_;
};

}  // namespace sillon
