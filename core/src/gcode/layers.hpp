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
  double top = 0;      // height of its top [mm]
  double height = 0;   // thickness [mm]
  bool first = false;  // on the bed itself: slower, hotter, without fan
  bool oriented = false;
  bool onBed = false;            // oriented and below the base
  bool rim = false;              // on top of the oriented layers, along the borders
  int turn = 0;                  // number of the layer among its kind
  NextTo across = NextTo::Base;  // the beads that a base layer runs across, if it does
};

FileLayer layerAt(const PrintParams& params, int copy, int index);

/// Number of kinds of layers; layers of one kind take the same time. The kinds: first layer of the first copy, first
/// layers of the other copies, base layers in either direction, oriented layers above and below the base, base layers
/// across either of these, and rim layers.
inline constexpr std::size_t kLayerKinds = 9;
/// Kind of a layer, 0..kLayerKinds - 1.
std::size_t kindOf(const FileLayer& layer);

// Writes the layers of a job, one after the other.

/// Share of its full speed at which each kind of layer runs.
using Paces = std::array<double, kLayerKinds>;

/// Length of the oriented beads written so far, and the parts of it that each limit slowed [mm].
struct OrientedLength {
  double all = 0;
  double flowSlowed = 0;
  double segmentSlowed = 0;
  double curveSlowed = 0;
};

/// Writes the layers of a job; it has to get them in printing order.
class LayerWriter {
 public:
  LayerWriter(const GcodeJob& job, const Printer& printer, const PrintParams& params, MotionPlans& plans,
              Nozzle& nozzle)
      : job_(job), printer_(printer), params_(params), plans_(plans), nozzle_(nozzle) {
    pace_.fill(1);
  }

  /// Sets the speeds of the layers that follow.
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
  const BeadPath* rimEnd_ = nullptr;  // loop of the rim at which the nozzle stands
  OrientedLength oriented_;
};

}  // namespace sillon
