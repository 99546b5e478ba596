// The layers of a file, bottom first, copy by copy.
#pragma once

#include <cstddef>

#include "gcode/job.hpp"

namespace sillon {

/// One layer of one copy.
struct FileLayer {
  int index = 0;
  int copy = 0;
  double top = 0;      // [mm]
  double height = 0;   // [mm]
  bool first = false;  // upon the bed itself: slower, hotter, without fan
  bool oriented = false;
  bool onBed = false;            // oriented, below the base
  int turn = 0;                  // among its kind
  NextTo across = NextTo::Base;  // a base layer that runs across the beads next to it
};

FileLayer layerAt(const PrintParams& params, int copy, int index);

/// Layers that take the same time: the first of the first copy, those of others, base layers both ways, oriented layers
/// above and below the base, base layers across these.
inline constexpr std::size_t kLayerKinds = 8;
/// \return 0..kLayerKinds - 1
std::size_t kindOf(const FileLayer& layer);

}  // namespace sillon
