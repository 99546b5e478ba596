#include "sillon/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "sort_key.hpp"

namespace sillon {
namespace {

constexpr double kTouch = 1e-7;                  ///< points nearer than this coincide [mm]
constexpr double kSideStep = 2e-6;               ///< how far from a piece its two sides are probed [mm]
constexpr std::size_t kMaxPieces = 4'000'000;    ///< beyond any drawing that a spacing of 0.05 mm could show
constexpr std::uint64_t kMaxWork = 800'000'000;  ///< pair tests; a few seconds, reached by hostile drawings only

struct Edge {
  Vec2 a;
  Vec2 b;
  int path;
};

std::vector<Edge> edgesOf(const Shape& shape) {
  std::vector<Edge> edges;
  for (std::size_t path = 0; path < shape.paths.size(); ++path) {
    for (const Ring& ring : shape.paths[path].rings) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vec2 a = ring[k];
        const Vec2 b = ring[k + 1 < ring.size() ? k + 1 : 0];
        if (!(a == b)) edges.push_back({a, b, static_cast<int>(path)});
      }
    }
  }
  return edges;
}

bool filled(FillRule rule, int winding) { return rule == FillRule::NonZero ? winding != 0 : (winding & 1) != 0; }

// Half-open in y, so that a vertex on the line counts once. +1 upwards, -1 downwards, 0 none.
int crossesRow(const Edge& edge, double y) {
  const bool below = edge.a.y <= y;
  return below == (edge.b.y <= y) ? 0 : (below ? 1 : -1);
}

double crossingX(const Edge& edge, double y) {
  return edge.a.x + (y - edge.a.y) / (edge.b.y - edge.a.y) * (edge.b.x - edge.a.x);
}

// Winding numbers of all paths along one line, and how many paths are filled there.
class WindingState {
 public:
  explicit WindingState(const Shape& shape) : shape_(shape), winding_(shape.paths.size(), 0) {}

  void cross(int path, int direction) {
    int& winding = winding_[static_cast<std::size_t>(path)];
    const FillRule rule = shape_.paths[static_cast<std::size_t>(path)].fillRule;
    inside_ -= filled(rule, winding) ? 1 : 0;
    winding += direction;
    inside_ += filled(rule, winding) ? 1 : 0;
    touched_.push_back(path);
  }
  [[nodiscard]] bool inside() const { return inside_ > 0; }
  void reset() {
    for (const int path : touched_) winding_[static_cast<std::size_t>(path)] = 0;
    touched_.clear();
    inside_ = 0;
  }

 private:
  const Shape& shape_;
  std::vector<int> winding_;
  std::vector<int> touched_;
  int inside_ = 0;
};

// Tells whether points are inside by casting a ray to the left through edges bucketed by rows.
class InsideQuery {
 public:
  InsideQuery(const Shape& shape, const std::vector<Edge>& edges, const Bounds& box)
      : edges_(edges), winding_(shape), bottom_(box.min.y) {
    double climb = 0;
    for (const Edge& edge : edges) climb += std::abs(edge.b.y - edge.a.y);
    const double height = std::max(box.size().y, 1e-9);
    row_ = std::max(height / 65536, climb / (4.0 * static_cast<double>(edges.size())));
    buckets_.resize(static_cast<std::size_t>(height / row_) + 1);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const std::size_t last = bucketOf(std::max(edges[k].a.y, edges[k].b.y));
      for (std::size_t b = bucketOf(std::min(edges[k].a.y, edges[k].b.y)); b <= last; ++b) {
        buckets_[b].push_back(static_cast<int>(k));
      }
    }
  }

  [[nodiscard]] std::size_t cost(double y) const { return buckets_[bucketOf(y)].size(); }

  bool inside(Vec2 p) {
    winding_.reset();
    for (const int k : buckets_[bucketOf(p.y)]) {
      const Edge& edge = edges_[static_cast<std::size_t>(k)];
      const int direction = crossesRow(edge, p.y);
      if (direction != 0 && crossingX(edge, p.y) < p.x) winding_.cross(edge.path, direction);
    }
    return winding_.inside();
  }

 private:
  [[nodiscard]] std::size_t bucketOf(double y) const {
    const double row = std::clamp((y - bottom_) / row_, 0.0, static_cast<double>(buckets_.size() - 1));
    return static_cast<std::size_t>(row);
  }

  const std::vector<Edge>& edges_;
  WindingState winding_;
  double bottom_;
  double row_ = 1;
  std::vector<std::vector<int>> buckets_;
};

struct Split {
  int edge;
  double t;  ///< position along the edge, in (0, 1)
  Vec2 at;
};

// Where an end of another edge lies on this one.
void splitAtEnd(const Edge& edge, int index, Vec2 end, std::vector<Split>& splits) {
  const Vec2 along = edge.b - edge.a;
  const double size = length(along);
  const double t = dot(end - edge.a, along) / (size * size);
  if (t * size <= kTouch || (1 - t) * size <= kTouch) return;
  if (std::abs(cross(along, end - edge.a)) <= kTouch * size) splits.push_back({index, t, end});
}

void splitPair(const std::vector<Edge>& edges, int i, int j, std::vector<Split>& splits) {
  const Edge& e = edges[static_cast<std::size_t>(i)];
  const Edge& f = edges[static_cast<std::size_t>(j)];
  const std::size_t before = splits.size();
  splitAtEnd(e, i, f.a, splits);
  splitAtEnd(e, i, f.b, splits);
  splitAtEnd(f, j, e.a, splits);
  splitAtEnd(f, j, e.b, splits);
  if (splits.size() != before) return;
  const Vec2 u = e.b - e.a;
  const Vec2 v = f.b - f.a;
  const double fa = cross(u, f.a - e.a);
  const double fb = cross(u, f.b - e.a);
  const double ea = cross(v, e.a - f.a);
  const double eb = cross(v, e.b - f.a);
  if ((fa > 0) == (fb > 0) || (ea > 0) == (eb > 0)) return;
  const double t = ea / (ea - eb);
  if (t <= 0 || t >= 1) return;
  const Vec2 at = e.a + u * t;
  splits.push_back({i, t, at});
  splits.push_back({j, fa / (fa - fb), at});
}

// All places where edges meet away from their own ends. False: too much work.
bool findSplits(const std::vector<Edge>& edges, const Bounds& box, std::vector<Split>& splits) {
  double total = 0;
  for (const Edge& edge : edges) total += length(edge.b - edge.a);
  const Vec2 size = box.size();
  const double cell = std::max(total / static_cast<double>(edges.size()), std::max(size.x, size.y) / 1e6);
  struct Entry {
    std::uint64_t key;
    int edge;
  };
  std::vector<Entry> entries;
  const auto cellOf = [&](double value, double low) {
    return static_cast<std::int64_t>(std::floor((value - low) / cell));
  };
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Edge& edge = edges[k];
    const std::int64_t firstRow = cellOf(std::min(edge.a.y, edge.b.y) - kTouch, box.min.y);
    const std::int64_t lastRow = cellOf(std::max(edge.a.y, edge.b.y) + kTouch, box.min.y);
    for (std::int64_t row = firstRow; row <= lastRow; ++row) {
      double low = std::min(edge.a.x, edge.b.x);
      double high = std::max(edge.a.x, edge.b.x);
      if (firstRow != lastRow) {  // only the columns the edge passes within this row
        const double y0 = box.min.y + static_cast<double>(row) * cell - kTouch;
        const double y1 = y0 + cell + 2 * kTouch;
        const double slope = (edge.b.x - edge.a.x) / (edge.b.y - edge.a.y);
        const double x0 = edge.a.x + (y0 - edge.a.y) * slope;
        const double x1 = edge.a.x + (y1 - edge.a.y) * slope;
        low = std::max(low, std::min(x0, x1));
        high = std::min(high, std::max(x0, x1));
      }
      const std::int64_t last = cellOf(high + kTouch, box.min.x);
      for (std::int64_t column = cellOf(low - kTouch, box.min.x); column <= last; ++column) {
        entries.push_back({(static_cast<std::uint64_t>(row + 1) << 32) | static_cast<std::uint32_t>(column + 1),
                           static_cast<int>(k)});
      }
      if (entries.size() > 4 * kMaxPieces) return false;
    }
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.key != b.key ? a.key < b.key : a.edge < b.edge; });
  std::uint64_t work = 0;
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    while (end < entries.size() && entries[end].key == entries[begin].key) ++end;
    const std::uint64_t count = end - begin;
    work += count * count / 2;
    if (work > kMaxWork) return false;
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = i + 1; j < end; ++j) splitPair(edges, entries[i].edge, entries[j].edge, splits);
    }
    if (splits.size() > 2 * kMaxPieces) return false;
  }
  std::sort(splits.begin(), splits.end(), [](const Split& a, const Split& b) {
    return a.edge != b.edge ? a.edge < b.edge : (a.t != b.t ? a.t < b.t : a.at.x < b.at.x);
  });
  return true;
}

std::vector<BorderSegment> piecesOf(const std::vector<Edge>& edges, const std::vector<Split>& splits) {
  std::vector<BorderSegment> pieces;
  pieces.reserve(edges.size() + splits.size());
  std::size_t next = 0;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    Vec2 from = edges[k].a;
    const auto addTo = [&](Vec2 to) {
      if (length(to - from) > kTouch) {
        pieces.push_back({from, to});
        from = to;
      }
    };
    for (; next < splits.size() && splits[next].edge == static_cast<int>(k); ++next) addTo(splits[next].at);
    addTo(edges[k].b);
  }
  return pieces;
}

// Pieces drawn twice would count twice: keep the first of each pair of ends.
void dropDuplicates(std::vector<BorderSegment>& segments) {
  const auto keyOf = [](const BorderSegment& s) {
    const auto snap = [](double v) { return static_cast<std::int64_t>(std::llround(v * 1e5)); };
    return SortKey::first_type{snap(s.a.x), snap(s.a.y), snap(s.b.x), snap(s.b.y)};
  };
  std::vector<SortKey> order;
  order.reserve(segments.size());
  for (std::size_t k = 0; k < segments.size(); ++k) order.emplace_back(keyOf(segments[k]), k);
  std::sort(order.begin(), order.end());
  std::vector<char> keep(segments.size(), 1);
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (order[k].first == order[k - 1].first) keep[order[k].second] = 0;
  }
  std::size_t out = 0;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    if (keep[k]) segments[out++] = segments[k];
  }
  segments.resize(out);
}

}  // namespace

Result<Outline> resolveOutline(const Shape& shape) {
  const Error tooLarge{
      ErrorCode::TooLarge,
      "the outline has too many edges or meets itself too often; at most 4 million pieces can be read"};
  const std::vector<Edge> edges = edgesOf(shape);
  Outline outline;
  for (const Edge& edge : edges) outline.bounds.add(edge.a);
  if (edges.empty()) return Error{ErrorCode::EmptyShape, "the shape has no outline; it needs at least one closed path"};
  if (edges.size() > kMaxPieces) return tooLarge;

  std::vector<Split> splits;
  if (!findSplits(edges, outline.bounds, splits)) return tooLarge;
  const std::vector<BorderSegment> pieces = piecesOf(edges, splits);
  if (pieces.size() > kMaxPieces) return tooLarge;

  InsideQuery query(shape, edges, outline.bounds);
  std::uint64_t work = 0;
  for (const BorderSegment& piece : pieces) work += query.cost(0.5 * (piece.a.y + piece.b.y));
  if (work > kMaxWork) return tooLarge;
  for (const BorderSegment& piece : pieces) {
    const Vec2 along = piece.b - piece.a;
    const Vec2 left = Vec2{-along.y, along.x} * (kSideStep / length(along));
    const Vec2 middle = (piece.a + piece.b) * 0.5;
    const bool insideLeft = query.inside(middle + left);
    if (insideLeft == query.inside(middle - left)) continue;
    outline.segments.push_back(insideLeft ? piece : BorderSegment{piece.b, piece.a});
  }
  dropDuplicates(outline.segments);
  for (const BorderSegment& s : outline.segments) {
    outline.area += 0.5 * cross(s.a - outline.bounds.min, s.b - outline.bounds.min);
  }
  if (!(outline.area > 0)) {
    return Error{ErrorCode::EmptyShape, "the shape encloses no area; it needs at least one closed path with an inside"};
  }
  return outline;
}

std::vector<std::vector<Interval>> insideIntervals(const Shape& shape, double firstY, double step, int rows) {
  struct Crossing {
    double x;
    int path;
    int direction;
  };
  std::vector<std::vector<Crossing>> crossings(static_cast<std::size_t>(std::max(rows, 0)));
  for (const Edge& edge : edgesOf(shape)) {
    const double low = std::ceil((std::min(edge.a.y, edge.b.y) - firstY) / step) - 1;
    const double high = std::floor((std::max(edge.a.y, edge.b.y) - firstY) / step) + 1;
    const int first = static_cast<int>(std::clamp(low, 0.0, static_cast<double>(rows)));
    const int last = static_cast<int>(std::clamp(high, -1.0, static_cast<double>(rows - 1)));
    for (int row = first; row <= last; ++row) {
      const double y = firstY + row * step;
      const int direction = crossesRow(edge, y);
      if (direction != 0)
        crossings[static_cast<std::size_t>(row)].push_back({crossingX(edge, y), edge.path, direction});
    }
  }
  std::vector<std::vector<Interval>> intervals(crossings.size());
  WindingState winding(shape);
  for (std::size_t row = 0; row < crossings.size(); ++row) {
    std::vector<Crossing>& line = crossings[row];
    std::sort(line.begin(), line.end(), [](const Crossing& a, const Crossing& b) {
      return a.x != b.x ? a.x < b.x : (a.path != b.path ? a.path < b.path : a.direction < b.direction);
    });
    winding.reset();
    double begin = 0;
    for (const Crossing& crossing : line) {
      const bool before = winding.inside();
      winding.cross(crossing.path, crossing.direction);
      if (!before && winding.inside()) begin = crossing.x;
      if (before && !winding.inside() && crossing.x > begin) intervals[row].push_back({begin, crossing.x});
    }
  }
  return intervals;
}

}  // namespace sillon
