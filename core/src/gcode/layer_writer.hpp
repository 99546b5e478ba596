// Writes the layers of a job, one after the other.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "gcode/file_comments.hpp"
#include "gcode/file_layer.hpp"
#include "gcode/job.hpp"
#include "gcode/motion_plans.hpp"
#include "gcode/nozzle.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

/// Share of its speed that each kind of layer runs at.
using Paces = std::array<double, kLayerKinds>;

/// Oriented beads so far, and how much of their length was slowed, by what [mm].
struct OrientedLength {
  double all = 0;
  double flowSlowed = 0;
  double segmentSlowed = 0;
  double curveSlowed = 0;
};

class LayerWriter {
 public:
  LayerWriter(const GcodeJob& job, const Printer& printer, const PrintParams& params, MotionPlans& plans,
              Nozzle& nozzle)
      : job_(job), printer_(printer), params_(params), plans_(plans), nozzle_(nozzle) {
    pace_.fill(1);
  }

  /// \param pace  counts for layers that follow.
  void setPace(const Paces& pace) { pace_ = pace; }
  void write(const FileLayer& layer);
  [[nodiscard]] const OrientedLength& oriented() const { return oriented_; }

 private:
  void announce(const FileLayer& layer);
  void setMachine(const FileLayer& layer);
  void paths(const std::vector<BeadPath>& paths, const Role& role, double flow, const FileLayer& layer);
  void patches(const FileLayer& layer);
  void lay(const BeadPath& path, std::size_t start, const MotionLimits& limits, double height, double top,
           bool oriented);
  [[nodiscard]] MotionLimits layerLimits(const FileLayer& layer, double flow) const;
  void evenFlow(MotionLimits& limits, double spacing) const;
  [[nodiscard]] double firstAcceleration() const;

  const GcodeJob& job_;
  const Printer& printer_;
  const PrintParams& params_;
  MotionPlans& plans_;
  Nozzle& nozzle_;
  Paces pace_;
  OrientedLength oriented_;
};

}  // namespace sillon
