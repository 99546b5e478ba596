// How high what a file has printed stands, place by place.
#pragma once

#include <vector>

#include "gcode_reader/machine.hpp"

namespace sillon {

/// Heights of the nozzle while it laid beads, on cells of 1 mm. All [mm].
class LaidHeights {
 public:
  /// Raises what a bead passes over; places further than 5 m from the origin are left out.
  void add(const MachineMove& bead);

  /// How far a move comes below what stands under it, at most; 0 where it does not.
  [[nodiscard]] double depthOf(const MachineMove& move) const;

  /// Of all beads; 0 before the first.
  [[nodiscard]] double top() const { return top_; }

 private:
  std::vector<std::vector<float>> tiles_;  // rows of tiles of 64 x 64 cells, without any where nothing lies
  double top_ = 0;
};

}  // namespace sillon
