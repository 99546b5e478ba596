#include "sillon/geometry/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/decimal_text.hpp"
#include "geometry/border_of.hpp"
#include "geometry/covered_paths.hpp"
#include "geometry/winding.hpp"

namespace sillon {
namespace {

constexpr double kTouch = 1e-7;  ///< points nearer than this coincide [mm]
/// An edge that passes a point within this goes through it [mm]: what should lie on one line comes on a grid of 1 nm.
constexpr double kNear = 2e-6;
constexpr int kMaxRounds = 5;                    ///< of splitting; two do for nearly all drawings
constexpr int kMaxGridRounds = 50;               ///< of splitting on a grid; five do for nearly all drawings
constexpr double kPerGrid = 1000;                ///< points of the grid that files hold [1/mm]
constexpr std::size_t kMaxPieces = 4'000'000;    ///< beyond any drawing that a spacing of 0.05 mm could show
constexpr std::uint64_t kMaxWork = 800'000'000;  ///< pair tests; some ten seconds: strokes of a world map

Vec2 rounded(Vec2 p) { return {std::round(p.x) + 0.0, std::round(p.y) + 0.0}; }

// In steps of the grid: sums and products of these are exact.
std::vector<PathEdge> gridEdges(const std::vector<PathEdge>& edges) {
  std::vector<PathEdge> out;
  for (const PathEdge& edge : edges) {
    const PathEdge to{rounded(edge.a * kPerGrid), rounded(edge.b * kPerGrid), edge.path};
    if (!(to.a == to.b)) out.push_back(to);
  }
  return out;
}

/// Whether a piece runs upwards, or level to the right.
bool runsUp(const PathEdge& piece) { return piece.a.y != piece.b.y ? piece.a.y < piece.b.y : piece.a.x < piece.b.x; }

// Tells what lies beside a steep piece by casting a ray to the left from its middle, through pieces bucketed by rows.
// The piece itself and those on the same ends are crossed by count, not by place: whatever else is near lies exactly on
// one side or the other.
class SideQuery {
 public:
  SideQuery(const std::vector<FilledPath>& paths, const InsideRule* rule, const std::vector<PathEdge>& pieces,
            const std::vector<std::size_t>& groupOf, const Bounds& box)
      : pieces_(pieces), groupOf_(groupOf), winding_(paths, rule), bottom_(box.min.y) {
    double climb = 0;
    for (const PathEdge& piece : pieces) climb += std::abs(piece.b.y - piece.a.y);
    const double height = std::max(box.size().y, 1e-9);
    row_ = std::max(height / 65536, climb / (4.0 * static_cast<double>(pieces.size())));
    buckets_.resize(static_cast<std::size_t>(height / row_) + 1);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const std::size_t last = bucketOf(std::max(pieces[k].a.y, pieces[k].b.y));
      for (std::size_t b = bucketOf(std::min(pieces[k].a.y, pieces[k].b.y)); b <= last; ++b) {
        buckets_[b].push_back(static_cast<int>(k));
      }
    }
  }

  [[nodiscard]] std::size_t cost(double y) const { return buckets_[bucketOf(y)].size(); }

  /// Whether it is inside on the left and on the right, seen upwards.
  std::pair<bool, bool> sides(std::size_t piece, const std::vector<std::size_t>& doubles) {
    const Vec2 p = (pieces_[piece].a + pieces_[piece].b) * 0.5;
    winding_.reset();
    for (const int k : buckets_[bucketOf(p.y)]) {
      const PathEdge& other = pieces_[static_cast<std::size_t>(k)];
      const int direction = crossesRow(other, p.y);
      if (direction == 0 || groupOf_[static_cast<std::size_t>(k)] == piece) continue;
      if (crossingX(other, p.y) < p.x) winding_.cross(other.path, direction);
    }
    const bool left = winding_.inside();
    winding_.cross(pieces_[piece].path, runsUp(pieces_[piece]) ? 1 : -1);
    for (const std::size_t k : doubles) winding_.cross(pieces_[k].path, runsUp(pieces_[k]) ? 1 : -1);
    return {left, winding_.inside()};
  }

 private:
  [[nodiscard]] std::size_t bucketOf(double y) const {
    const double row = std::clamp((y - bottom_) / row_, 0.0, static_cast<double>(buckets_.size() - 1));
    return static_cast<std::size_t>(row);
  }

  const std::vector<PathEdge>& pieces_;
  const std::vector<std::size_t>& groupOf_;
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

// Where an end of another edge lies on this one. On the grid: where this one passes through the end's pixel, so that
// what crosses stays crossed and splitting comes to an end (iterated snap rounding; Halperin and Packer 2002).
void splitAtEnd(const PathEdge& edge, int index, Vec2 end, Points points, std::vector<Split>& splits) {
  const Vec2 along = edge.b - edge.a;
  const double size = length(along);
  const double t = dot(end - edge.a, along) / (size * size);
  if (t * size <= kTouch || (1 - t) * size <= kTouch) return;
  const double off = std::abs(cross(along, end - edge.a));
  if (points == Points::OnGrid ? off < 0.5 * (std::abs(along.x) + std::abs(along.y)) : off <= kNear * size)
    splits.push_back({index, t, end});
}

void splitPair(const std::vector<PathEdge>& edges, int i, int j, Points points, std::vector<Split>& splits) {
  const PathEdge& e = edges[static_cast<std::size_t>(i)];
  const PathEdge& f = edges[static_cast<std::size_t>(j)];
  const std::size_t before = splits.size();
  splitAtEnd(e, i, f.a, points, splits);
  splitAtEnd(e, i, f.b, points, splits);
  splitAtEnd(f, j, e.a, points, splits);
  splitAtEnd(f, j, e.b, points, splits);
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
  const double s = fa / (fa - fb);
  const Vec2 at = e.a + u * t;
  // Pieces of one line: their last digits seem to cross, anywhere and each somewhere else.
  if (length(f.a + v * s - at) > kNear) return;
  splits.push_back({i, t, at});
  splits.push_back({j, s, at});
}

Bounds boxOf(const PathEdge& edge) {
  Bounds box;
  box.add(edge.a);
  box.add(edge.b);
  return box;
}

// All places where edges meet away from their own ends. False: too much work, with what was done before.
bool findSplits(const std::vector<PathEdge>& edges, const Bounds& box, Points points, std::vector<Split>& splits,
                std::uint64_t& work) {
  const double reach = points == Points::OnGrid ? 1 : kNear;
  double total = 0;
  for (const PathEdge& edge : edges) total += length(edge.b - edge.a);
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
    const PathEdge& edge = edges[k];
    const std::int64_t firstRow = cellOf(std::min(edge.a.y, edge.b.y) - reach, box.min.y);
    const std::int64_t lastRow = cellOf(std::max(edge.a.y, edge.b.y) + reach, box.min.y);
    for (std::int64_t row = firstRow; row <= lastRow; ++row) {
      double low = std::min(edge.a.x, edge.b.x);
      double high = std::max(edge.a.x, edge.b.x);
      // Only the columns that the edge passes within this row; a level one passes all of its own.
      if (firstRow != lastRow && edge.a.y != edge.b.y) {
        const double y0 = box.min.y + static_cast<double>(row) * cell - reach;
        const double y1 = y0 + cell + 2 * reach;
        const double slope = (edge.b.x - edge.a.x) / (edge.b.y - edge.a.y);
        const double x0 = edge.a.x + (y0 - edge.a.y) * slope;
        const double x1 = edge.a.x + (y1 - edge.a.y) * slope;
        low = std::max(low, std::min(x0, x1));
        high = std::min(high, std::max(x0, x1));
      }
      const std::int64_t last = cellOf(high + reach, box.min.x);
      for (std::int64_t column = cellOf(low - reach, box.min.x); column <= last; ++column) {
        entries.push_back({(static_cast<std::uint64_t>(row + 1) << 32) | static_cast<std::uint32_t>(column + 1),
                           static_cast<int>(k)});
      }
      if (entries.size() > 4 * kMaxPieces) return false;
    }
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.key != b.key ? a.key < b.key : a.edge < b.edge; });
  std::vector<Bounds> boxes;  // of the edges in a cell: few of them come near each other
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    while (end < entries.size() && entries[end].key == entries[begin].key) ++end;
    const std::uint64_t count = end - begin;
    work += count * count / 2;
    if (work > kMaxWork) return false;
    boxes.clear();
    for (std::size_t k = begin; k < end; ++k) boxes.push_back(boxOf(edges[static_cast<std::size_t>(entries[k].edge)]));
    for (std::size_t i = begin; i < end; ++i) {
      const Vec2 low = boxes[i - begin].min - Vec2{reach, reach};
      const Vec2 high = boxes[i - begin].max + Vec2{reach, reach};
      for (std::size_t j = i + 1; j < end; ++j) {
        const Bounds& other = boxes[j - begin];
        if (other.min.x > high.x || other.max.x < low.x || other.min.y > high.y || other.max.y < low.y) continue;
        splitPair(edges, entries[i].edge, entries[j].edge, points, splits);
      }
    }
    if (splits.size() > 2 * kMaxPieces) return false;
  }
  std::sort(splits.begin(), splits.end(), [](const Split& a, const Split& b) {
    return a.edge != b.edge ? a.edge < b.edge : (a.t != b.t ? a.t < b.t : a.at.x < b.at.x);
  });
  return true;
}

/// Gives crossings that coincide the same digits, and those of points where they lie on one: pieces that cover each
/// other must have the same ends.
void unifyCrossings(const std::vector<PathEdge>& edges, std::vector<Split>& splits) {
  if (splits.empty()) return;
  constexpr double kCell = 2 * kTouch;
  struct Hash {
    std::size_t operator()(const std::pair<std::int64_t, std::int64_t>& cell) const {
      return std::hash<std::int64_t>{}(
          static_cast<std::int64_t>(static_cast<std::uint64_t>(cell.first) * 0x9E3779B97F4A7C15U) ^ cell.second);
    }
  };
  std::unordered_map<std::pair<std::int64_t, std::int64_t>, Vec2, Hash> known;  // points are further apart than cells
  known.reserve(edges.size() + splits.size() / 2);
  const auto cellOf = [](Vec2 p) {
    return std::pair{static_cast<std::int64_t>(std::floor(p.x / kCell)),
                     static_cast<std::int64_t>(std::floor(p.y / kCell))};
  };
  for (const PathEdge& edge : edges) known.emplace(cellOf(edge.a), edge.a);
  for (Split& split : splits) {
    const auto [column, row] = cellOf(split.at);
    std::optional<Vec2> best;
    for (std::int64_t x = column - 1; x <= column + 1; ++x) {
      for (std::int64_t y = row - 1; y <= row + 1; ++y) {
        const auto found = known.find({x, y});
        if (found == known.end() || length(found->second - split.at) > kTouch) continue;
        if (!best || length(found->second - split.at) < length(*best - split.at)) best = found->second;
      }
    }
    if (best) {
      split.at = *best;
    } else {
      known.emplace(std::pair{column, row}, split.at);
    }
  }
}

/// The edges in pieces that meet at their ends only. Every ring stays closed.
std::vector<PathEdge> piecesOf(const std::vector<PathEdge>& edges, const std::vector<Split>& splits) {
  std::vector<PathEdge> pieces;
  pieces.reserve(edges.size() + splits.size());
  std::size_t next = 0;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    Vec2 from = edges[k].a;
    const auto addTo = [&](Vec2 to) {
      if (from == to) return;
      pieces.push_back({from, to, edges[k].path});
      from = to;
    };
    for (; next < splits.size() && splits[next].edge == static_cast<int>(k); ++next) addTo(splits[next].at);
    addTo(edges[k].b);
  }
  return pieces;
}

/// Pieces with the same ends, next to each other, each group in the order of the pieces.
std::vector<std::size_t> groupedByEnds(const std::vector<PathEdge>& pieces) {
  using Key = std::array<double, 4>;
  const auto keyOf = [&](std::size_t k) {
    const PathEdge& p = pieces[k];
    return runsUp(p) ? Key{p.a.x, p.a.y, p.b.x, p.b.y} : Key{p.b.x, p.b.y, p.a.x, p.a.y};
  };
  std::vector<std::pair<Key, std::size_t>> keys;
  keys.reserve(pieces.size());
  for (std::size_t k = 0; k < pieces.size(); ++k) keys.emplace_back(keyOf(k), k);
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> groupOf(pieces.size());  // its first piece
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const bool same = k > 0 && keys[k].first == keys[k - 1].first;
    groupOf[keys[k].second] = same ? groupOf[keys[k - 1].second] : keys[k].second;
  }
  return groupOf;
}

Vec2 mirrored(Vec2 p) { return {p.y, p.x}; }

std::vector<PathEdge> mirroredPieces(const std::vector<PathEdge>& pieces) {
  std::vector<PathEdge> out;
  out.reserve(pieces.size());
  for (const PathEdge& piece : pieces) out.push_back({mirrored(piece.a), mirrored(piece.b), piece.path});
  return out;
}

Bounds mirroredBox(const Bounds& box) {
  Bounds out;
  out.add(mirrored(box.min));
  out.add(mirrored(box.max));
  return out;
}

}  // namespace

Result<Outline> borderOf(const std::vector<FilledPath>& paths, const InsideRule* rule, Points points) {
  const Error tooLarge{
      ErrorCode::TooLarge,
      "the outline has too many edges or meets itself too often; at most 4 million pieces can be read; "
      "merge its paths in a drawing program, or draw it as a PNG"};
  const bool grid = points == Points::OnGrid;
  std::vector<PathEdge> edges = edgesOf(paths, rule ? std::vector<char>{} : coveredPaths(paths));
  if (grid) edges = gridEdges(edges);
  Outline outline;
  for (const PathEdge& edge : edges) outline.bounds.add(edge.a);
  if (edges.empty()) return outline;
  if (edges.size() > kMaxPieces) return tooLarge;

  // What goes through a point within kNear, or through the grid's nearest to a crossing, is bent by that much and may
  // cross what it did not before.
  std::vector<PathEdge> pieces = edges;
  std::uint64_t splitting = 0;
  bool settled = false;
  for (int round = 0; round < (grid ? kMaxGridRounds : kMaxRounds) && !settled; ++round) {
    std::vector<Split> splits;
    if (!findSplits(pieces, outline.bounds, points, splits, splitting)) return tooLarge;
    if (grid) {
      for (Split& split : splits) split.at = rounded(split.at);
    } else {
      unifyCrossings(pieces, splits);
    }
    const std::size_t before = pieces.size();
    pieces = piecesOf(pieces, splits);
    if (pieces.size() > kMaxPieces) return tooLarge;
    settled = pieces.size() == before;
  }
  if (grid && !settled) return tooLarge;

  const std::vector<std::size_t> groupOf = groupedByEnds(pieces);
  std::vector<std::vector<std::size_t>> doubles(pieces.size());  // of a group's first piece: the others
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (groupOf[k] != k) doubles[groupOf[k]].push_back(k);
  }
  // Rays run across a piece: along it, the last digit of a coordinate would decide.
  const std::vector<PathEdge> turned = mirroredPieces(pieces);
  SideQuery steep(paths, rule, pieces, groupOf, outline.bounds);
  SideQuery flat(paths, rule, turned, groupOf, mirroredBox(outline.bounds));
  const auto isFlat = [&](const PathEdge& piece) {
    return std::abs(piece.b.x - piece.a.x) > std::abs(piece.b.y - piece.a.y);
  };
  std::uint64_t work = rule ? pieces.size() * paths.size() : 0;
  for (const PathEdge& piece : pieces) {
    const Vec2 middle = 0.5 * (piece.a + piece.b);
    work += isFlat(piece) ? flat.cost(middle.x) : steep.cost(middle.y);
  }
  if (work > kMaxWork) return tooLarge;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (groupOf[k] != k) continue;
    const bool mirror = isFlat(pieces[k]);
    auto [left, right] = (mirror ? flat : steep).sides(k, doubles[k]);
    if (left == right || length(pieces[k].b - pieces[k].a) <= kTouch) continue;
    if (mirror) std::swap(left, right);
    const bool upwards = runsUp(mirror ? turned[k] : pieces[k]);
    const BorderSegment forwards{pieces[k].a, pieces[k].b}, backwards{pieces[k].b, pieces[k].a};
    outline.segments.push_back(left == upwards ? forwards : backwards);
  }
  if (grid) {
    for (BorderSegment& s : outline.segments)
      s = {{s.a.x / kPerGrid, s.a.y / kPerGrid}, {s.b.x / kPerGrid, s.b.y / kPerGrid}};
    Bounds box;
    box.add({outline.bounds.min.x / kPerGrid, outline.bounds.min.y / kPerGrid});
    box.add({outline.bounds.max.x / kPerGrid, outline.bounds.max.y / kPerGrid});
    outline.bounds = box;
  }
  for (const BorderSegment& s : outline.segments) {
    outline.area += 0.5 * cross(s.a - outline.bounds.min, s.b - outline.bounds.min);
  }
  return outline;
}

namespace {

/// A point beyond kMaxCoordinate, or that is no number.
const Vec2* farPoint(const std::vector<Vec2>& points) {
  for (const Vec2& p : points) {
    if (!(std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate)) return &p;
  }
  return nullptr;
}

const Vec2* farPoint(const Shape& shape) {
  const Vec2* far = farPoint(shape.middles);
  for (const FilledPath& path : shape.paths) {
    for (const Ring& ring : path.rings) far = far != nullptr ? far : farPoint(ring);
  }
  return far;
}

Result<Outline> outlineOf(const Shape& shape, Points points) {
  if (const Vec2* far = farPoint(shape)) {
    return Error{ErrorCode::InvalidArgument, "the shape has a point at " + shownNumber(far->x) + ", " +
                                                 shownNumber(far->y) +
                                                 " mm; both coordinates must be -1000000 to 1000000 mm"};
  }
  Result<Outline> outline = borderOf(shape.paths, nullptr, points);
  if (!outline) return outline;
  if (outline.value().bounds.empty()) {
    return Error{ErrorCode::EmptyShape, "the shape has no outline; it needs at least one closed path"};
  }
  if (!(outline.value().area > 0)) {
    return Error{ErrorCode::EmptyShape, "the shape encloses no area; it needs at least one closed path with an inside"};
  }
  return outline;
}

}  // namespace

Result<Outline> resolveOutline(const Shape& shape) { return outlineOf(shape, Points::AsGiven); }

Result<Outline> outlineOnGrid(const Shape& shape) { return outlineOf(shape, Points::OnGrid); }

}  // namespace sillon
