#include "geometry/closed_curves.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/free_memory.hpp"
#include "base/parallel_for.hpp"

namespace sillon {
namespace {

// [µm]; pages are at most 100 m wide.
struct PointUm32 {
  std::int32_t x;
  std::int32_t y;
  friend bool operator==(const PointUm32&, const PointUm32&) = default;
};

// As llround, which costs a call: the product is exact in double.
std::int32_t toMicrometres(float v) {
  const double scaled = static_cast<double>(v) * 1000;
  return static_cast<std::int32_t>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
}

PointUm32 rounded(Vec2f p) { return {toMicrometres(p.x), toMicrometres(p.y)}; }

int side(PointUm32 a, PointUm32 b, PointUm32 c) {
  const auto apart = [](std::int32_t from, std::int32_t to) { return static_cast<std::int64_t>(to) - from; };
  const std::int64_t v = apart(a.x, b.x) * apart(a.y, c.y) - apart(a.y, b.y) * apart(a.x, c.x);
  return v > 0 ? 1 : (v < 0 ? -1 : 0);
}

bool between(std::int32_t a, std::int32_t b, std::int32_t v) { return v >= std::min(a, b) && v <= std::max(a, b); }

bool onSegment(PointUm32 a, PointUm32 b, PointUm32 p) { return between(a.x, b.x, p.x) && between(a.y, b.y, p.y); }

bool sharePoint(PointUm32 a, PointUm32 b, PointUm32 c, PointUm32 d) {
  const int abc = side(a, b, c);
  const int abd = side(a, b, d);
  if (abc * abd > 0) return false;  // cd lies on one side of ab
  const int cda = side(c, d, a);
  const int cdb = side(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && onSegment(a, b, c)) || (abd == 0 && onSegment(a, b, d)) || (cda == 0 && onSegment(c, d, a)) ||
         (cdb == 0 && onSegment(c, d, b));
}

struct Segment {
  PointUm32 a;
  PointUm32 b;
  int id;        ///< of its first point
  int previous;  ///< id of the segment before it on its curve, among those that do not vanish
};

std::vector<Segment> segmentsOf(const ClosedCurves& curves, const std::vector<char>& among, const RunContext& run) {
  const std::vector<std::int32_t> curveOf = curveOfPoints(curves);
  const int count = static_cast<int>(curves.points.size());
  constexpr int kGrain = 1 << 14;
  std::vector<std::vector<Segment>> found(static_cast<std::size_t>(count / kGrain) + 1);
  parallelFor(run, count, kGrain, [&](int begin, int end) {
    std::vector<Segment>& out = found[static_cast<std::size_t>(begin / kGrain)];
    const auto at = [&](int k) { return rounded(curves.points[static_cast<std::size_t>(k)]); };
    for (int k = begin; k < end; ++k) {
      const int c = curveOf[static_cast<std::size_t>(k)];
      const int next = nextOf(curves, c, k);
      if (!among.empty() && !among[static_cast<std::size_t>(k)] && !among[static_cast<std::size_t>(next)]) continue;
      const PointUm32 a = at(k);
      const PointUm32 b = at(next);
      if (a == b) continue;
      int previous = k;
      do {
        previous = previousOf(curves, c, previous);
      } while (previous != k && at(previous) == at(nextOf(curves, c, previous)));
      out.push_back({a, b, k, previous});
    }
  });
  std::size_t total = 0;
  for (const std::vector<Segment>& part : found) total += part.size();
  std::vector<Segment> segments;
  segments.reserve(total);
  for (std::vector<Segment>& part : found) {
    segments.insert(segments.end(), part.begin(), part.end());
    release(part);
  }
  return segments;
}

// Square cells over all segments, so that only those in a common cell need be compared.
struct CellRaster {
  PointUm32 low{};
  double cell = 1;     ///< side: about two mean segments, and not many more cells than segments
  double perCell = 1;  ///< divisions took a third of sorting
  int nx = 0;
  int ny = 0;

  explicit CellRaster(const std::vector<Segment>& segments) {
    low = segments.front().a;
    PointUm32 high = low;
    double total = 0;
    for (const Segment& s : segments) {
      low = {std::min({low.x, s.a.x, s.b.x}), std::min({low.y, s.a.y, s.b.y})};
      high = {std::max({high.x, s.a.x, s.b.x}), std::max({high.y, s.a.y, s.b.y})};
      const Vec2 d{static_cast<double>(s.b.x - s.a.x), static_cast<double>(s.b.y - s.a.y)};
      total += std::sqrt(dot(d, d));
    }
    const double area = (static_cast<double>(high.x - low.x) + 1) * (static_cast<double>(high.y - low.y) + 1);
    const double count = static_cast<double>(segments.size());
    const double mean = total / count;
    cell = std::max(1.0, std::floor(std::max(2 * mean, std::sqrt(area / (4.0 * count)))));
    perCell = 1 / cell;
    nx = cellOf(high.x, low.x) + 1;
    ny = cellOf(high.y, low.y) + 1;
  }

  [[nodiscard]] int cellOf(double v, std::int32_t from) const {
    return static_cast<int>((v - static_cast<double>(from)) * perCell);
  }

  /// Calls visit(index) for the cells a segment passes, row by row: exact within a row by the slope, widened by a
  /// cell's rounding.
  template <class Visit>
  void forCells(const Segment& s, const Visit& visit) const {
    const int y0 = cellOf(std::min(s.a.y, s.b.y), low.y);
    const int y1 = cellOf(std::max(s.a.y, s.b.y), low.y);
    for (int y = y0; y <= y1; ++y) {
      double x0 = static_cast<double>(std::min(s.a.x, s.b.x));
      double x1 = static_cast<double>(std::max(s.a.x, s.b.x));
      if (y0 != y1) {
        const double slope = static_cast<double>(s.b.x - s.a.x) / static_cast<double>(s.b.y - s.a.y);
        const double bottom = static_cast<double>(low.y) + y * cell;
        const double u = static_cast<double>(s.a.x) + (bottom - static_cast<double>(s.a.y)) * slope;
        const double v = u + cell * slope;
        x0 = std::max(x0, std::min(u, v) - 1);
        x1 = std::min(x1, std::max(u, v) + 1);
      }
      const int c0 = std::max(0, cellOf(x0, low.x));
      const int c1 = std::min(nx - 1, cellOf(x1, low.x));
      for (int x = c0; x <= c1; ++x)
        visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x));
    }
  }
};

// Cell k holds the segments entries[begin[k]] .. entries[begin[k + 1] - 1].
struct CellEntries {
  std::vector<int> begin;
  std::vector<int> entries;
};

// Counting sort by shares of the segments; within a cell they stay in order, whatever the number of shares.
CellEntries sortIntoCells(const std::vector<Segment>& segments, const CellRaster& raster, const RunContext& run) {
  const std::size_t cells = static_cast<std::size_t>(raster.nx) * static_cast<std::size_t>(raster.ny);
  const int count = static_cast<int>(segments.size());
  const int shares = std::clamp(std::min(run.threads(), count / (1 << 14)), 1, 8);
  const int grain = (count + shares - 1) / shares;
  std::vector<std::vector<int>> next(static_cast<std::size_t>(shares), std::vector<int>(cells, 0));
  // visit(place in the share's row of `next`, segment)
  const auto forShares = [&](const auto& visit) {
    parallelFor(run, count, grain, [&](int from, int to) {
      std::vector<int>& share = next[static_cast<std::size_t>(from / grain)];
      for (int k = from; k < to; ++k) {
        raster.forCells(segments[static_cast<std::size_t>(k)], [&](std::size_t at) { visit(share[at], k); });
      }
    });
  };
  forShares([](int& size, int) { ++size; });
  CellEntries out{std::vector<int>(cells + 1), {}};
  int sum = 0;
  for (std::size_t at = 0; at < cells; ++at) {
    out.begin[at] = sum;
    for (std::vector<int>& share : next) {
      const int size = share[at];
      share[at] = sum;
      sum += size;
    }
  }
  out.begin[cells] = sum;
  out.entries.resize(static_cast<std::size_t>(sum));
  forShares([&](int& place, int k) { out.entries[static_cast<std::size_t>(place++)] = k; });
  return out;
}

// As resampled(), but points marked in `keep`, and the segments between them, stay as they are.
ClosedCurves resampledBetween(const ClosedCurves& curves, const std::vector<char>& keep, double step) {
  ClosedCurves out;
  for (int c = 0; c < curves.count(); ++c) {
    out.begin.push_back(static_cast<int>(out.points.size()));
    const int first = curves.begin[static_cast<std::size_t>(c)];
    const int n = curves.size(c);
    double since = step;  // arc length since the last point put out
    for (int k = 0; k < n; ++k) {
      const std::size_t i = static_cast<std::size_t>(first + k);
      const std::size_t j = static_cast<std::size_t>(first + (k + 1) % n);
      if (keep[i] || since >= 0.99 * step) {
        out.points.push_back(curves.points[i]);
        since = 0;
      }
      const Vec2f along = curves.points[j] - curves.points[i];
      const double size = static_cast<double>(length(along));
      if (keep[i] || keep[j]) {
        since += size;
        continue;
      }
      // Between free points only: equal steps along the segment.
      double at = step - since;
      for (; at < size - 0.1 * step; at += step) {
        out.points.push_back(curves.points[i] + along * static_cast<float>(at / size));
      }
      since = size - (at - step);
    }
    if (static_cast<int>(out.points.size()) - out.begin.back() < kMinPoints) {
      out.points.resize(static_cast<std::size_t>(out.begin.back()));
      for (int k = 0; k < n; ++k) out.points.push_back(curves.points[static_cast<std::size_t>(first + k)]);
    }
  }
  out.begin.push_back(static_cast<int>(out.points.size()));
  return out;
}

}  // namespace

bool segmentsMeet(Vec2f a, Vec2f b, Vec2f c, Vec2f d) {
  return sharePoint(rounded(a), rounded(b), rounded(c), rounded(d));
}

ClosedCurves resampled(const ClosedCurves& curves, float step, const RunContext& run) {
  // Arc length at every point and at the end of its curve, summed in blocks of fixed size: equal for any thread count.
  constexpr int kBlock = 4096;
  ClosedCurves out;
  std::vector<double> along;
  for (int c = 0; c < curves.count(); ++c) {
    const Vec2f* p = curves.points.data() + curves.begin[static_cast<std::size_t>(c)];
    const int n = curves.size(c);
    along.resize(static_cast<std::size_t>(n) + 1);
    along[0] = 0;
    parallelFor(run, n, kBlock, [&](int begin, int end) {
      double sum = 0;
      for (int k = begin; k < end; ++k) {
        sum += static_cast<double>(length(p[k + 1 < n ? k + 1 : 0] - p[k]));
        along[static_cast<std::size_t>(k) + 1] = sum;
      }
    });
    for (int begin = kBlock; begin < n; begin += kBlock) {
      const double before = along[static_cast<std::size_t>(begin)];
      const int end = std::min(begin + kBlock, n);
      for (int k = begin; k < end; ++k) along[static_cast<std::size_t>(k) + 1] += before;
    }
    const double total = along.back();
    const int count = std::max(kMinPoints, static_cast<int>(total / static_cast<double>(step) + 0.5));
    const std::size_t first = out.points.size();
    out.begin.push_back(static_cast<int>(first));
    out.points.resize(first + static_cast<std::size_t>(count));
    parallelFor(run, count, kBlock, [&](int begin, int end) {
      const auto found = std::upper_bound(along.begin() + 1, along.end(), total * begin / count);
      int k = std::min(n - 1, static_cast<int>(found - along.begin()) - 1);
      for (int s = begin; s < end; ++s) {
        const double at = total * s / count;
        while (k + 1 < n && along[static_cast<std::size_t>(k) + 1] <= at) ++k;
        const double size = along[static_cast<std::size_t>(k) + 1] - along[static_cast<std::size_t>(k)];
        const float t = size > 0 ? static_cast<float>((at - along[static_cast<std::size_t>(k)]) / size) : 0.0f;
        out.points[first + static_cast<std::size_t>(s)] = p[k] + (p[k + 1 < n ? k + 1 : 0] - p[k]) * t;
      }
    });
  }
  out.begin.push_back(static_cast<int>(out.points.size()));
  return out;
}

ClosedCurves resampledSimply(const ClosedCurves& curves, float step, const RunContext& run) {
  ClosedCurves out = resampled(curves, step, run);
  auto crossings = findCrossings(out, run);
  if (crossings.empty()) return out;

  std::vector<char> keep(curves.points.size(), 0);  // original points that stay
  constexpr int kAttempts = 6;
  for (int attempt = 0; attempt < kAttempts && !crossings.empty(); ++attempt) {
    const std::vector<std::int32_t> curveOf = curveOfPoints(out);
    const double reach = static_cast<double>(step) * (2 << attempt);
    for (const auto& [a, b] : crossings) {
      for (const int segment : {a, b}) {
        // The nearest original points along the curve; a search over the whole curve is fine, as crossings are rare.
        const std::size_t c = static_cast<std::size_t>(curveOf[static_cast<std::size_t>(segment)]);
        const Vec2f p = out.points[static_cast<std::size_t>(segment)];
        for (int k = curves.begin[c]; k < curves.begin[c + 1]; ++k) {
          if (static_cast<double>(length(curves.points[static_cast<std::size_t>(k)] - p)) < reach)
            keep[static_cast<std::size_t>(k)] = 1;
        }
      }
    }
    out = resampledBetween(curves, keep, static_cast<double>(step));
    crossings = findCrossings(out, run);
  }
  return crossings.empty() ? out : curves;
}

std::vector<std::int32_t> curveOfPoints(const ClosedCurves& curves) {
  std::vector<std::int32_t> curve(curves.points.size());
  for (int c = 0; c < curves.count(); ++c) {
    std::fill(curve.begin() + curves.begin[static_cast<std::size_t>(c)],
              curve.begin() + curves.begin[static_cast<std::size_t>(c) + 1], c);
  }
  return curve;
}

std::vector<std::pair<int, int>> findCrossings(const ClosedCurves& curves, const RunContext& run,
                                               const std::vector<char>& among) {
  const std::vector<Segment> segments = segmentsOf(curves, among, run);
  if (segments.empty()) return {};
  const CellRaster raster(segments);
  const CellEntries cells = sortIntoCells(segments, raster, run);
  if (run.cancelled()) return {};

  std::vector<std::pair<int, int>> crossings;
  std::mutex mutex;
  parallelFor(run, raster.ny, rowGrain(run, raster.ny, 20.0 * raster.nx), [&](int beginRow, int endRow) {
    std::vector<std::pair<int, int>> found;
    const std::size_t nx = static_cast<std::size_t>(raster.nx);
    for (std::size_t at = static_cast<std::size_t>(beginRow) * nx; at < static_cast<std::size_t>(endRow) * nx; ++at) {
      for (int i = cells.begin[at]; i < cells.begin[at + 1]; ++i) {
        const Segment& s = segments[static_cast<std::size_t>(cells.entries[static_cast<std::size_t>(i)])];
        for (int j = i + 1; j < cells.begin[at + 1]; ++j) {
          const Segment& t = segments[static_cast<std::size_t>(cells.entries[static_cast<std::size_t>(j)])];
          if (t.previous == s.id || s.previous == t.id || !sharePoint(s.a, s.b, t.a, t.b)) continue;
          found.emplace_back(std::min(s.id, t.id), std::max(s.id, t.id));
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
