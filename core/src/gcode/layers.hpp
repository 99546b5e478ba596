// Layers of a file, and writing them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "gcode/file_comments.hpp"
#include "gcode/job.hpp"
#include "gcode/motion.hpp"
#include "gcode/nozzle.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// The layers of a file, bottom first, copy by copy.

/// One layer of one copy.
struct FileLayer {
  int index = 0;
  int copy = 0;
  double top = 0;      // [mm]
  double height = 0;   // [mm]
  bool first = false;  // upon the bed itself: slower, hotter, without fan
  bool oriented = false;
  bool onBed = false;            // oriented, below the base
  bool rim = false;              // on top of the oriented layers, along the border
  int turn = 0;                  // among its kind
  NextTo across = NextTo::Base;  // a base layer that runs across the beads next to it
};

FileLayer layerAt(const PrintParams& params, int copy, int index);

/// Layers that take the same time: the first of the first copy, those of others, base layers both ways, oriented layers
/// above and below the base, base layers across these, and those of the rim.
inline constexpr std::size_t kLayerKinds = 9;
/// \return 0..kLayerKinds - 1
std::size_t kindOf(const FileLayer& layer);

// Writes the layers of a job, one after the other.

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
  void rim(const FileLayer& layer);
  void patches(const FileLayer& layer);
  void lay(const BeadPath& path, std::size_t start, const MotionLimits& limits, const FileLayer& layer, bool oriented);
  [[nodiscard]] MotionLimits pacedLimits(const FileLayer& layer, double flow) const;
  [[nodiscard]] MotionLimits layerLimits(const FileLayer& layer, double flow) const;
  void evenFlow(MotionLimits& limits, double spacing) const;
  [[nodiscard]] double firstAcceleration() const;

  const GcodeJob& job_;
  const Printer& printer_;
  const PrintParams& params_;
  MotionPlans& plans_;
  Nozzle& nozzle_;
  Paces pace_;
  const BeadPath* rimEnd_ = nullptr;  // loop of the rim that the nozzle stands at
  OrientedLength oriented_;
};

}  // namespace sillon
