#include "look/preview_parts.hpp"

#include "base/simd.hpp"

namespace sillon {
namespace {

constexpr float kBeyond = 0.49f;  // distance of a sample's middle from its edge, a hundredth less for rounding

// A segment of the path.
struct PathSegment {
  Vec2f along;  // unit
  float length;
};

/// Direction at the joint of two pieces: their mean, so that curves look round. A piece keeps its own direction at
/// sharp turns and where it is long against its width: a straight bead is straight up to its end, and a short neighbour
/// begins with its direction.
Vec2f jointTangent(const PathSegment& own, const PathSegment& other, float width) {
  constexpr float kLong = 4;  // [widths]
  if (dot(own.along, other.along) < 0.5f || own.length > kLong * width) return own.along;
  return other.length > kLong * width ? other.along : unit(own.along + other.along);
}

}  // namespace

// Turns segments of the toolpath into beads in samples, rows down.
std::vector<ShadedBead> beadsOf(const Toolpath& toolpath, Vec2 page, double scale, bool colours) {
  std::vector<ShadedBead> beads;
  std::size_t total = 0;
  for (const Cycle& cycle : toolpath.cycles) total += cycle.points.size();
  beads.reserve(total);
  std::vector<PathSegment> pieces;
  for (const Cycle& cycle : toolpath.cycles) {
    const std::size_t count = cycle.points.size();
    const auto around = [&](std::size_t k) { return k < count ? k : (k - count) % count; };  // mostly no division
    const auto at = [&](std::size_t k) { return cycle.points[around(k)]; };
    const auto sampleAt = [&](std::size_t k) {
      return Vec2f{static_cast<float>(at(k).x * scale), static_cast<float>((page.y - at(k).y) * scale)};
    };
    const auto radiusAt = [&](std::size_t k) { return static_cast<float>(cycle.widths[around(k)] * scale / 2); };
    // Directions of all segments first, as joints need two of them.
    pieces.clear();
    for (std::size_t k = 0; k < count; ++k) {
      const Vec2f step = at(k + 1) - at(k);
      pieces.push_back({unit(step), length(step)});
    }
    for (std::size_t k = 0; k < count; ++k) {
      ShadedBead& bead = beads.emplace_back();
      bead.a = sampleAt(k);
      bead.b = sampleAt(k + 1);
      bead.radiusA = radiusAt(k);
      bead.radiusB = radiusAt(k + 1);
      bead.tangentA = jointTangent(pieces[k], pieces[k > 0 ? k - 1 : count - 1], cycle.widths[k]);
      bead.tangentB = jointTangent(pieces[k], pieces[around(k + 1)], cycle.widths[around(k + 1)]);
      if (!colours) continue;
      // Colours change the short way round the cycle from one end to the other.
      const double colourA = directionColourPlace(bead.tangentA.x, bead.tangentA.y);
      const double turned = (directionColourPlace(bead.tangentB.x, bead.tangentB.y) - colourA) / kDirectionColours;
      bead.colourA = static_cast<float>(colourA);
      bead.colourDelta = static_cast<float>((turned - std::floor(turned + 0.5)) * kDirectionColours);
    }
  }
  return beads;
}

// A counting sort: the first pass counts the beads of each band, the second one writes their indices.
Bands sortIntoBands(const std::vector<ShadedBead>& beads, int height, int rows) {
  const int bands = (height + rows - 1) / rows;
  Bands sorted{rows, std::vector<std::size_t>(bands + 1, 0), {}};
  // Calls body(band) for each band that a bead may touch; one sample of reach is added for rounding.
  const auto forEachBand = [&](const ShadedBead& bead, const auto& body) {
    const float reach = std::max(bead.radiusA, bead.radiusB) + 1;
    const float top = std::min(bead.a.y, bead.b.y) - reach;
    const float bottom = std::max(bead.a.y, bead.b.y) + reach;
    if (bottom < 0 || top >= static_cast<float>(height)) return;
    const int first = static_cast<int>(std::max(top, 0.0f)) / rows;
    const int last = static_cast<int>(std::min(bottom, static_cast<float>(height - 1))) / rows;
    for (int band = first; band <= last; ++band) body(band);
  };
  for (const ShadedBead& bead : beads) forEachBand(bead, [&](std::size_t band) { ++sorted.begin[band + 1]; });
  for (std::size_t band = 0; band + 1 < sorted.begin.size(); ++band) sorted.begin[band + 1] += sorted.begin[band];
  sorted.beads.resize(sorted.begin.back());
  std::vector<std::size_t> next = sorted.begin;
  for (std::size_t k = 0; k < beads.size(); ++k) {
    forEachBand(beads[k], [&](std::size_t band) { sorted.beads[next[band]++] = static_cast<std::uint32_t>(k); });
  }
  return sorted;
}

// Visits the samples within reach of a capsule, four in a row at a time; each keeps the bead with the smaller offset in
// radii.
void rasterise(const ShadedBead& bead, std::uint32_t index, int firstRow, int rows, int width, Hits& hits) {
  const Vec2f d = bead.b - bead.a;
  const float squared = dot(d, d);
  const float perSquared = squared > 0 ? 1 / squared : 0;
  const float reach = std::max(bead.radiusA, bead.radiusB);
  const float top = std::min(bead.a.y, bead.b.y) - reach;
  const float bottom = std::max(bead.a.y, bead.b.y) + reach;
  // Only rows and columns whose middles are within reach: few on small pictures.
  const int rowBegin = std::max(firstRow, static_cast<int>(std::max(top + kBeyond, 0.0f)));
  const int rowEnd = std::min(firstRow + rows, static_cast<int>(std::clamp(bottom + 1 - kBeyond, 0.0f, 1e6f)));
  const I4 own = splatInt(static_cast<std::int32_t>(index));
  for (int row = rowBegin; row < rowEnd; ++row) {
    const float y = static_cast<float>(row) + 0.5f;
    // Only the part of the axis within reach of this row can colour it, which keeps long slanted beads cheap.
    float t0 = 0;
    float t1 = 1;
    if (std::abs(d.y) > reach) {
      const float u = (y - reach - bead.a.y) / d.y;
      const float v = (y + reach - bead.a.y) / d.y;
      t0 = std::clamp(std::min(u, v), 0.0f, 1.0f);
      t1 = std::clamp(std::max(u, v), 0.0f, 1.0f);
    }
    const float x0 = bead.a.x + t0 * d.x;
    const float x1 = bead.a.x + t1 * d.x;
    const float left = std::min(x0, x1) - reach;
    const float right = std::max(x0, x1) + reach;
    const int begin = static_cast<int>(std::clamp(left + kBeyond, 0.0f, static_cast<float>(width)));
    const int end = static_cast<int>(std::clamp(right + 1 - kBeyond, 0.0f, static_cast<float>(width)));
    const std::size_t line = indexOf(0, row - firstRow, width);
    const F4 fromY = splat(y - bead.a.y);
    for (int column = begin; column < end; column += 4) {
      const F4 fromX = splat(static_cast<float>(column)) + F4{0.5f, 1.5f, 2.5f, 3.5f} - splat(bead.a.x);
      // Distance from the axis against the radius there, both at the nearest place of the axis.
      const F4 along = (fromX * splat(d.x) + fromY * splat(d.y)) * splat(perSquared);
      const F4 t = min4(max4(along, splat(0)), splat(1));
      const F4 offX = fromX - splat(d.x) * t;
      const F4 offY = fromY - splat(d.y) * t;
      const F4 radius = splat(bead.radiusA) + splat(bead.radiusB - bead.radiusA) * t;
      const F4 offset2 = offX * offX + offY * offY;
      const F4 radius2 = radius * radius;
      // Write the bead where it is nearer than the one held. No division is needed to compare.
      const std::size_t at = line + column;
      const F4 held = load4(&hits.squaredOffset[at]);
      const I4 nearer = (offset2 < held * radius2) & (I4{0, 1, 2, 3} < splatInt(end - column));
      store4(&hits.squaredOffset[at], select4(nearer, offset2 / radius2, held));
      const I4 heldBead = loadInt4(&hits.bead[at]);
      storeInt4(&hits.bead[at], heldBead + (nearer & (own - heldBead)));
    }
  }
}

}  // namespace sillon
