#include "geometry/closed_curves.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <mutex>

#include "base/parallel_for.hpp"

namespace sillon {
namespace {

// A point in µm; pages are at most 100 m wide, so that 32 bits suffice.
struct PointUm32 {
  std::int32_t x;
  std::int32_t y;
  friend bool operator==(const PointUm32&, const PointUm32&) = default;
};

// Rounds like llround, but compilers can vectorise it; the product is exact in double.
std::int32_t toMicrometres(float v) {
  const double scaled = static_cast<double>(v) * 1000;
  return static_cast<std::int32_t>(scaled + std::copysign(0.5, scaled));
}

PointUm32 rounded(Vec2f p) { return {toMicrometres(p.x), toMicrometres(p.y)}; }

int side(PointUm32 a, PointUm32 b, PointUm32 c) {
  const auto apart = [](std::int32_t from, std::int32_t to) { return static_cast<std::int64_t>(to) - from; };
  const std::int64_t v = apart(a.x, b.x) * apart(a.y, c.y) - apart(a.y, b.y) * apart(a.x, c.x);
  return v > 0 ? 1 : (v < 0 ? -1 : 0);
}

bool onOneSide(PointUm32 a, PointUm32 b, PointUm32 c, PointUm32 d) { return side(a, b, c) * side(a, b, d) > 0; }

bool between(std::int32_t a, std::int32_t b, std::int32_t v) { return v >= std::min(a, b) && v <= std::max(a, b); }

bool onSegment(PointUm32 a, PointUm32 b, PointUm32 p) { return between(a.x, b.x, p.x) && between(a.y, b.y, p.y); }

// Tells whether the segments ab and cd share a point; exact.
bool sharePoint(PointUm32 a, PointUm32 b, PointUm32 c, PointUm32 d) {
  const int abc = side(a, b, c);
  const int abd = side(a, b, d);
  if (abc * abd > 0) return false;
  const int cda = side(c, d, a);
  const int cdb = side(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && onSegment(a, b, c)) || (abd == 0 && onSegment(a, b, d)) || (cda == 0 && onSegment(c, d, a)) ||
         (cdb == 0 && onSegment(c, d, b));
}

/// Rounded points of all curves. Each curve repeats its first point at its end, so that segment k is at[k] to at[k +
/// 1].
struct CurveCorners {
  std::vector<int> begin;  ///< offsets of the curves in `at`, and the end
  std::vector<PointUm32> at;

  CurveCorners(const ClosedCurves& curves, const RunContext& run) {
    for (const int first : curves.begin) begin.push_back(first + static_cast<int>(begin.size()));
    if (begin.empty()) return;
    at.resize(begin.back());
    constexpr int kGrain = 1 << 14;
    parallelFor(run, begin.back(), kGrain, [&](int from, int to) {
      for (int c = curveOf(from); from < to; ++c) {
        const int last = begin[c + 1] - 1;
        const Vec2f* const points = curves.points.data() + (from - c);
        PointUm32* const out = at.data() + from;
        const int count = std::min(to, last) - from;
        for (int k = 0; k < count; ++k) out[k] = rounded(points[k]);
        const std::size_t first = curves.begin[c];
        if (to > last && curves.size(c) > 0) out[count] = rounded(curves.points[first]);
        from = last + 1;
      }
    });
  }

  [[nodiscard]] PointUm32 operator[](int k) const { return at[k]; }
  [[nodiscard]] int curveOf(int k) const {
    return static_cast<int>(std::upper_bound(begin.begin(), begin.end(), k) - begin.begin()) - 1;
  }
  /// Returns the curve's point at which a segment begins.
  [[nodiscard]] int pointOf(int segment) const { return segment - curveOf(segment); }

  /// Tells whether `second` follows `first` along their curve, with only vanishing segments between them.
  [[nodiscard]] bool consecutive(int first, int second) const {
    const std::size_t c = curveOf(second);
    int before = second;
    do {
      before = before == begin[c] ? begin[c + 1] - 2 : before - 1;
    } while (before != second && (*this)[before] == (*this)[before + 1]);
    return before == first;
  }
};

// Returns the segments to be tested in ascending order, without vanishing ones.
std::vector<int> segmentsOf(const ClosedCurves& curves, const CurveCorners& corners, const std::vector<char>& among) {
  std::vector<int> segments;
  if (among.empty()) segments.reserve(curves.points.size());
  for (int c = 0; c < curves.count(); ++c) {
    const int first = curves.begin[c];
    const int last = curves.begin[c + 1];
    for (int k = first; k < last; ++k) {
      const int next = k + 1 < last ? k + 1 : first;
      if (!among.empty() && !among[k] && !among[next]) continue;
      if (corners[k + c] != corners[k + c + 1]) segments.push_back(k + c);
    }
  }
  return segments;
}

// Raster of square cells over all segments, so that only segments in a common cell need be compared.
struct CellRaster {
  PointUm32 low{};
  double cell = 1;     ///< side of a cell [µm]: about two mean segments, but with not many more cells than segments
  double perCell = 1;  ///< 1 / cell, because divisions took a third of the time for sorting
  int nx = 0;
  int ny = 0;

  CellRaster(const CurveCorners& corners, const std::vector<int>& segments) {
    low = corners[segments.front()];
    PointUm32 high = low;
    std::int64_t longerSides = 0;
    for (const int s : segments) {
      const PointUm32 a = corners[s], b = corners[s + 1];
      low = {std::min({low.x, a.x, b.x}), std::min({low.y, a.y, b.y})};
      high = {std::max({high.x, a.x, b.x}), std::max({high.y, a.y, b.y})};
      longerSides += std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
    }
    const double area = (static_cast<double>(high.x - low.x) + 1) * (static_cast<double>(high.y - low.y) + 1);
    const double count = static_cast<double>(segments.size());
    const double mean = static_cast<double>(longerSides) / count;
    cell = std::max(1.0, std::floor(std::max(2 * mean, std::sqrt(area / (4.0 * count)))));
    perCell = 1 / cell;
    nx = cellOf(high.x, low.x) + 1;
    ny = cellOf(high.y, low.y) + 1;
  }

  [[nodiscard]] int cellOf(double v, std::int32_t from) const {
    return static_cast<int>((v - static_cast<double>(from)) * perCell);
  }

  [[nodiscard]] int indexOf(int x, int y) const { return y * nx + x; }

  /// Calls visit(index) for the cells that a segment passes, row by row. Within a row the range follows from the slope,
  /// widened for rounding.
  template <class Visit>
  void forCells(PointUm32 a, PointUm32 b, const Visit& visit) const {
    if (a.y > b.y) std::swap(a, b);
    const int y0 = cellOf(a.y, low.y);
    const int y1 = cellOf(b.y, low.y);
    if (y0 == y1) {
      const int x0 = cellOf(std::min(a.x, b.x), low.x);
      const int x1 = cellOf(std::max(a.x, b.x), low.x);
      for (int x = x0; x <= x1; ++x) visit(indexOf(x, y0));
      return;
    }
    const double left = std::min(a.x, b.x);
    const double right = std::max(a.x, b.x);
    const double slope = static_cast<double>(b.x - a.x) / static_cast<double>(b.y - a.y);
    for (int y = y0; y <= y1; ++y) {
      const double u = a.x + (static_cast<double>(low.y) + y * cell - a.y) * slope;  // x at the row's lower end
      const double v = u + cell * slope;
      const int x0 = std::max(0, cellOf(std::max(left, std::min(u, v) - 1), low.x));
      const int x1 = std::min(nx - 1, cellOf(std::min(right, std::max(u, v) + 1), low.x));
      for (int x = x0; x <= x1; ++x) visit(indexOf(x, y));
    }
  }
};

// Segments by cell: cell k holds entries[begin[k]] .. entries[begin[k + 1] - 1].
struct CellEntries {
  std::vector<int> begin;
  std::vector<int> entries;
};

// Sorts segments into cells by counting, in parallel shares; within a cell they stay in order, whatever the number of
// shares.
CellEntries sortIntoCells(const CurveCorners& corners, const std::vector<int>& segments, const CellRaster& raster,
                          const RunContext& run) {
  const std::size_t cells = cellCount(raster.nx, raster.ny);
  const int count = static_cast<int>(segments.size());
  const int shares = std::clamp(std::min(run.threads(), count / (1 << 14)), 1, 8);
  const int grain = (count + shares - 1) / shares;
  struct Pair {
    std::int32_t cell;
    std::int32_t segment;
  };
  struct CellShare {
    std::vector<Pair> pairs;
    std::vector<int> next;  ///< for each cell the number of its segments, later the position of the next one
  };
  std::vector<CellShare> all(shares);
  parallelFor(run, count, grain, [&](int from, int to) {
    CellShare& share = all[from / grain];
    share.next.assign(cells, 0);
    share.pairs.reserve(2 * (to - from));
    for (int k = from; k < to; ++k) {
      const int s = segments[k];
      raster.forCells(corners[s], corners[s + 1], [&](std::int32_t cell) {
        ++share.next[cell];
        share.pairs.push_back({cell, s});
      });
    }
  });
  if (run.cancelled()) return {};
  CellEntries out{std::vector<int>(cells + 1), {}};
  int sum = 0;
  for (std::size_t at = 0; at < cells; ++at) {
    out.begin[at] = sum;
    for (CellShare& share : all) {
      const int size = share.next[at];
      share.next[at] = sum;
      sum += size;
    }
  }
  out.begin[cells] = sum;
  out.entries.resize(sum);
  parallelForEach(run, shares, 1, [&](int k) {
    CellShare& share = all[k];
    for (const Pair& pair : share.pairs) {
      out.entries[share.next[pair.cell]++] = pair.segment;
    }
  });
  return out;
}

}  // namespace

bool segmentsMeet(Vec2f a, Vec2f b, Vec2f c, Vec2f d) {
  return sharePoint(rounded(a), rounded(b), rounded(c), rounded(d));
}

std::vector<std::pair<int, int>> findCrossings(const ClosedCurves& curves, const RunContext& run,
                                               const std::vector<char>& among) {
  const CurveCorners corners(curves, run);
  const std::vector<int> segments = segmentsOf(curves, corners, among);
  if (segments.empty()) return {};
  const CellRaster raster(corners, segments);
  const CellEntries cells = sortIntoCells(corners, segments, raster, run);
  if (run.cancelled()) return {};

  std::vector<std::pair<int, int>> crossings;
  std::mutex mutex;
  parallelFor(run, raster.ny, rowGrain(run, raster.ny, 20.0 * raster.nx), [&](int beginRow, int endRow) {
    std::vector<std::pair<int, int>> found;
    const int* const entries = cells.entries.data();
    for (int cell = raster.indexOf(0, beginRow); cell < raster.indexOf(0, endRow); ++cell) {
      const int end = cells.begin[cell + 1];
      for (int i = cells.begin[cell]; i < end; ++i) {
        const int s = entries[i];
        const PointUm32 a = corners[s], b = corners[s + 1];
        for (int j = i + 1; j < end; ++j) {
          const int t = entries[j];
          const PointUm32 c = corners[t], d = corners[t + 1];
          if (t == s + 1 || onOneSide(a, b, c, d) || !sharePoint(a, b, c, d)) continue;
          if (corners.consecutive(s, t) || corners.consecutive(t, s)) continue;
          found.emplace_back(corners.pointOf(s), corners.pointOf(t));
        }
      }
    }
    if (found.empty()) return;
    const std::lock_guard lock(mutex);
    crossings.insert(crossings.end(), found.begin(), found.end());
  });
  std::sort(crossings.begin(), crossings.end());
  crossings.erase(std::unique(crossings.begin(), crossings.end()), crossings.end());
  return crossings;
}

}  // namespace sillon
