// Beads as capsules on the samples of a preview, in bands of rows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sillon/base/types.hpp"

namespace sillon {

/// One bead segment in samples, y down, with what shading needs at both ends.
struct Bead {
  Vec2f a;
  Vec2f b;
  float radiusA = 0;
  float radiusB = 0;
  // unit, y up
  Vec2f tangentA;
  Vec2f tangentB;
  // place among the direction colours; change towards b, the short way round
  float colourA = 0;
  float colourDelta = 0;
};

inline Vec2f unit(Vec2f v) {
  const float size = length(v);
  return size > 0 ? v * (1 / size) : Vec2f{1, 0};
}

/// \param scale  samples per mm. \param colours  whether those of their directions are wanted too.
std::vector<Bead> beadsOf(const Toolpath& toolpath, Vec2 page, double scale, bool colours);

/// Beads by the bands of rows they touch, in order of index, so that ties fall the same way everywhere.
struct Bands {
  int rows = 0;                    // sample rows per band
  std::vector<std::size_t> begin;  // per band, and one more
  std::vector<std::uint32_t> beads;
};

/// \param height  of all samples. \param rows  of a band.
Bands sortIntoBands(const std::vector<Bead>& beads, int height, int rows);

/// What samples see: each the bead whose axis is nearest in relation to its width.
struct Hits {
  std::vector<float>
      squaredOffset;  ///< (distance / radius)²; 1: nothing. Four at a time may be written, so it is padded
  std::vector<std::uint32_t> bead;

  /// Nothing at all.
  void clear(int width, int rows) {
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(rows) + 4;
    squaredOffset.assign(count, 1);
    bead.assign(count, 0);
  }
};

/// Share of the way from a to b nearest to p.
inline float shareAlong(const Bead& bead, Vec2f p) {
  const Vec2f d = bead.b - bead.a;
  const float squared = dot(d, d);
  return squared > 0 ? std::clamp(dot(p - bead.a, d) / squared, 0.0f, 1.0f) : 0.0f;
}

/// Rasterises one capsule with linearly varying width: what it hides is replaced. \param hits  width * rows samples
/// from sample row `firstRow` on.
void rasterise(const Bead& bead, std::uint32_t index, int firstRow, int rows, int width, Hits& hits);

}  // namespace sillon
