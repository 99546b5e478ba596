// Joins unpainted outlines as CAD programs write them: pieces whose ends meet, and holes as outlines of their own.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "input/svg/svg_path.hpp"
#include "input/svg/svg_reader.hpp"

namespace sillon::svg {
namespace {

constexpr double kGap = 0.05;                       // distance up to which two ends meet, an eighth of a bead [mm]
constexpr double kSame = 1e-3;                      // distance below which two points are meant to be one [mm]
constexpr std::size_t kSamples = 8;                 // points of an outline that must lie inside another one
constexpr std::int64_t kMostTests = 1'000'000'000;  // tests of ends, and of points against edges: some seconds

[[noreturn]] void refuseTooMany() { refuseTooLarge("SvgLoosePieces"); }

/// Indices sorted by a value.
using Order = std::vector<std::pair<double, std::size_t>>;

bool meet(Vec2 a, Vec2 b) { return length(a - b) <= kGap; }

// Joins pieces to rings by walking from end to end.
class Joiner {
 public:
  explicit Joiner(const std::vector<LoosePiece>& pieces) : pieces_(pieces), taken_(pieces.size()) {
    for (std::size_t end = 0; end < 2 * pieces.size(); ++end) ends_.emplace_back(placeOf(end).x, end);
    std::sort(ends_.begin(), ends_.end());
  }

  // Returns the pieces of a ring that begins with `first`; empty if they do not close.
  std::vector<std::size_t> ringFrom(std::size_t first, Ring& ring) {
    if (taken_[first] != 0) return {};
    taken_[first] = 1;
    ring = pieces_[first].points;
    std::vector<std::size_t> walked{first};
    while (true) {
      const std::size_t next = nearest(ring.back());
      const double open = length(ring.front() - ring.back());
      const bool nearer = next != kNoRing && length(placeOf(next) - ring.back()) < open;
      if (open <= kGap && walked.size() > 1 && !nearer) break;
      if (next == kNoRing) return {};
      taken_[next / 2] = 1;
      const Ring& points = pieces_[next / 2].points;
      const bool fromLast = next % 2 != 0;
      const Vec2 far = fromLast ? points.front() : points.back();
      const bool twice = points.size() == 2 && ring.size() > 1 && length(far - ring[ring.size() - 2]) < kSame;
      if (twice) continue;  // a line drawn twice leads back to its beginning
      if (fromLast) {
        ring.insert(ring.end(), points.rbegin() + 1, points.rend());
      } else {
        ring.insert(ring.end(), points.begin() + 1, points.end());
      }
      walked.push_back(next / 2);
    }
    ring.pop_back();
    return ring.size() > 2 ? walked : std::vector<std::size_t>{};
  }

 private:
  // Returns the place of an end. The ends of piece k have the numbers 2 k and 2 k + 1.
  [[nodiscard]] Vec2 placeOf(std::size_t end) const {
    const Ring& points = pieces_[end / 2].points;
    return end % 2 == 0 ? points.front() : points.back();
  }

  std::size_t nearest(Vec2 at) {
    auto end = std::lower_bound(ends_.begin(), ends_.end(), std::pair(at.x - kGap, std::size_t{0}));
    std::size_t best = kNoRing;
    for (; end != ends_.end() && end->first <= at.x + kGap; ++end) {
      const Vec2 place = placeOf(end->second);
      if (++tests_ > kMostTests) refuseTooMany();
      if (taken_[end->second / 2] != 0 || !meet(place, at)) continue;
      if (best == kNoRing || length(place - at) < length(placeOf(best) - at)) best = end->second;
    }
    return best;
  }

  const std::vector<LoosePiece>& pieces_;
  std::vector<char> taken_;
  Order ends_;
  std::int64_t tests_ = 0;
};

// Tells whether a point lies inside a path, by its fill rule.
bool isInside(Vec2 p, const FilledPath& path) {
  int winding = 0, crossings = 0;
  for (const Ring& ring : path.rings) {
    Vec2 a = ring.back();
    for (const Vec2 b : ring) {
      if ((a.y > p.y) != (b.y > p.y) && (cross(b - a, p - a) > 0) == (b.y > a.y)) {
        winding += b.y > a.y ? 1 : -1;
        ++crossings;
      }
      a = b;
    }
  }
  return path.fillRule == FillRule::NonZero ? winding != 0 : crossings % 2 != 0;
}

struct Nested {
  std::size_t layer;
  Bounds box;
  std::size_t points = 0;
  std::size_t root = 0;  // index in the list of the outline around it, or its own
};

// Tells whether a path lies inside another one, by samples of its first ring.
bool lies(const FilledPath& path, const Bounds& box, const FilledPath& in, const Bounds& around) {
  if (!around.holds(box.min) || !around.holds(box.max) || (meet(box.min, around.min) && meet(box.max, around.max))) {
    return false;
  }
  const Ring& ring = path.rings[0];
  const std::size_t step = std::max<std::size_t>(1, ring.size() / kSamples);
  for (std::size_t k = 0; k < ring.size(); k += step) {
    if (!isInside(ring[k], in)) return false;
  }
  return true;
}

}  // namespace

void joinLoose(const std::vector<LoosePiece>& pieces, std::vector<PaintLayer>& layers) {
  Joiner joiner(pieces);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    Ring ring;
    const std::vector<std::size_t> walked = joiner.ringFrom(k, ring);
    if (walked.empty()) continue;
    for (const std::size_t piece : walked) {
      if (pieces[piece].ring != kNoRing) layers[pieces[piece].layer].path.rings[pieces[piece].ring].clear();
    }
    layers.push_back({{{std::move(ring)}, FillRule::EvenOdd}});
  }
  for (PaintLayer& layer : layers) std::erase_if(layer.path.rings, [](const Ring& ring) { return ring.empty(); });
  std::erase_if(layers, [](const PaintLayer& layer) { return layer.path.rings.empty(); });
}

void alternateNested(std::vector<PaintLayer>& layers) {
  Order largest;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const Vec2 size = boxOf(layers[k].path.rings).size();
    largest.emplace_back(-size.x * size.y, k);
  }
  std::sort(largest.begin(), largest.end());
  std::vector<Nested> all;
  for (const auto& [area, k] : largest) {
    all.push_back({k, boxOf(layers[k].path.rings)});
    for (const Ring& ring : layers[k].path.rings) all.back().points += ring.size();
  }
  std::int64_t tests = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].root = k;
    const FilledPath& path = layers[all[k].layer].path;
    for (std::size_t other = 0; other < k; ++other) {
      const Nested& around = all[other];
      if (around.root != other) continue;  // the outline around both decides, by even-odd
      const bool near = around.box.holds(all[k].box.min) && around.box.holds(all[k].box.max);
      tests += near ? static_cast<std::int64_t>(kSamples * around.points) : 1;
      if (tests > kMostTests) refuseTooMany();
      if (!near || !lies(path, all[k].box, layers[around.layer].path, around.box)) continue;
      all[k].root = other;
      break;
    }
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].root == k) continue;
    FilledPath& whole = layers[all[all[k].root].layer].path;
    std::vector<Ring>& rings = layers[all[k].layer].path.rings;
    whole.fillRule = FillRule::EvenOdd;
    std::move(rings.begin(), rings.end(), std::back_inserter(whole.rings));
    rings.clear();
  }
  std::erase_if(layers, [](const PaintLayer& layer) { return layer.path.rings.empty(); });
}

}  // namespace sillon::svg
