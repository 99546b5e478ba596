// The heights at which zones turn a slicer's lines.
#pragma once

#include <cstddef>
#include <vector>

#include "sillon/export/zones.hpp"

namespace sillon {

/// Layers that follow each other and whose tops need angles of one kind.
struct Slab {
  double bottom = 0;    ///< [mm]
  double top = 0;       ///< [mm]
  bool turned = false;  ///< the slicer adds 90 degrees on the layer of the top
};

struct Slabs {
  std::vector<Slab> list;
  bool complete = true;  ///< false: some that are needed are missing, as there may be no more
};

/// From the bottom up: the layers below each level top, as deep as the solid layers of usual settings, and each layer
/// of slopes that are gentle enough to show lines. What lies between them is left to the slicer. The highest and lowest
/// slab go on beyond the body.
/// \param most  slabs, at least 1; where there would be more, slopes go without, then the highest top decides for all.
Slabs slabsOf(const Mesh& body, const ZoneLayers& layers, std::size_t most);

}  // namespace sillon
