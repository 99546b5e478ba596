// Combines several paths to rings around their common area.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "geometry/outline.hpp"
#include "geometry/outline_steps.hpp"

namespace sillon {
namespace {

/// Joins segments end to end. If several begin at a point, any of them will do: the winding is the same.
class Chains {
 public:
  explicit Chains(const std::vector<BorderSegment>& segments) : segments_(segments), used_(segments.size(), 0) {
    byStart_.reserve(segments.size());
    for (std::size_t k = 0; k < segments.size(); ++k) byStart_.emplace_back(cellOf(segments[k].a), k);
    std::sort(byStart_.begin(), byStart_.end());
    skip_.resize(byStart_.size(), 0);
  }

  /// Joins all segments to rings and rounds their points to 1 nm.
  std::vector<Ring> rings() {
    std::vector<Ring> rings;
    for (std::size_t first = 0; first < segments_.size(); ++first) {
      if (used_[first] != 0) continue;
      Ring ring;
      for (std::size_t k = first; k < segments_.size(); k = following(segments_[k].b)) {
        used_[k] = 1;
        const Vec2 p{std::round(segments_[k].a.x * 1e6) / 1e6 + 0.0, std::round(segments_[k].a.y * 1e6) / 1e6 + 0.0};
        if (ring.empty() || !(ring.back() == p)) ring.push_back(p);
      }
      while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
      if (ring.size() >= 3) rings.push_back(std::move(ring));
    }
    return rings;
  }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  static constexpr double kGap = 1e-5;  // largest distance between ends that belong together [mm]

  static Cell cellOf(Vec2 p) {
    return {static_cast<std::int64_t>(std::floor(p.x / kGap)), static_cast<std::int64_t>(std::floor(p.y / kGap))};
  }

  /// Returns the first entry from `at` on whose segment is unused. Used entries are recorded in skip_, so that the next
  /// search jumps over them at once.
  std::size_t unusedFrom(std::size_t at) {
    std::size_t end = at;
    while (end < byStart_.size() && used_[byStart_[end].second] != 0) end = std::max(end + 1, skip_[end]);
    while (at < end) {
      const std::size_t next = std::max(at + 1, skip_[at]);
      skip_[at] = end;
      at = next;
    }
    return end;
  }

  /// Returns the nearest unused segment that begins at p, or the number of segments if there is none.
  std::size_t following(Vec2 p) {
    const Cell cell = cellOf(p);
    std::size_t best = segments_.size();
    double nearest = kGap;
    for (std::int64_t x = cell.first - 1; x <= cell.first + 1; ++x) {
      const auto first =
          std::lower_bound(byStart_.begin(), byStart_.end(), std::pair<Cell, std::size_t>{{x, cell.second - 1}, 0});
      for (std::size_t at = unusedFrom(first - byStart_.begin());
           at < byStart_.size() && byStart_[at].first <= Cell{x, cell.second + 1}; at = unusedFrom(at + 1)) {
        const double distance = length(segments_[byStart_[at].second].a - p);
        if (distance == 0) return byStart_[at].second;
        if (distance >= nearest) continue;
        best = byStart_[at].second;
        nearest = distance;
      }
    }
    return best;
  }

  const std::vector<BorderSegment>& segments_;
  std::vector<char> used_;
  std::vector<std::pair<Cell, std::size_t>> byStart_;
  std::vector<std::size_t> skip_;
};

}  // namespace

Result<FilledPath> combined(const std::vector<FilledPath>& paths, const InsideRule& rule) {
  const Result<Outline> outline = borderOf(paths, &rule, Points::AsGiven);
  if (!outline) return outline.error();
  return FilledPath{Chains(outline.value().segments).rings(), FillRule::NonZero};
}

Result<Shape> unitedOnGrid(const Shape& shape) {
  const Result<Outline> outline = outlineOnGrid(shape);
  if (!outline) return outline.error();
  Shape united = shape;
  united.paths = {{Chains(outline.value().segments).rings(), FillRule::NonZero}};
  return united;
}

}  // namespace sillon
