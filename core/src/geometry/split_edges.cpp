// Splits the edges of an outline where they cross or touch, so that the pieces meet only at their ends.
#include "geometry/outline_steps.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace sillon {
namespace {

/// An edge passes through a point that lies within this distance of it [mm]. Drawings are rounded to 1 nm, so points of
/// one line may lie 2 nm off it.
constexpr double kNear = 2e-6;
constexpr int kMaxRounds = 5;       ///< rounds of splitting; two suffice for nearly all drawings
constexpr int kMaxGridRounds = 50;  ///< rounds on a grid; five suffice for nearly all drawings
/// Limit on pieces; beads 0.05 mm apart could not show a drawing with more.
constexpr std::size_t kMaxPieces = 4'000'000;
constexpr std::size_t kMaxSplits = 2 * kMaxPieces;   ///< limit on splits of one round
constexpr std::size_t kMaxEntries = 4 * kMaxPieces;  ///< limit on edges in cells, each counted in every cell
/// Limit on tests of edge pairs; they take about ten seconds, and the strokes of a world map stay below it.
constexpr std::uint64_t kMaxPairs = 800'000'000;

struct EdgeSplit {
  int edge;
  double t;  ///< position along the edge, in (0, 1)
  Vec2 at;
};

// Adds a split where an end of another edge lies on this edge. On the grid, the test is whether the edge passes through
// the pixel of that end, so that crossings stay crossings and the splitting terminates (iterated snap rounding;
// Halperin and Packer 2002).
void splitAtEnd(const PathEdge& edge, int index, Vec2 end, Points points, std::vector<EdgeSplit>& splits) {
  const Vec2 along = edge.b - edge.a;
  const double size = length(along);
  const double t = dot(end - edge.a, along) / (size * size);
  if (t * size <= kTouch || (1 - t) * size <= kTouch) return;
  const double off = std::abs(cross(along, end - edge.a));
  if (points == Points::OnGrid ? off < 0.5 * (std::abs(along.x) + std::abs(along.y)) : off <= kNear * size)
    splits.push_back({index, t, end});
}

// Adds the splits of two edges: at each other's ends if these touch, otherwise at their crossing.
void splitPair(const std::vector<PathEdge>& edges, int i, int j, Points points, std::vector<EdgeSplit>& splits) {
  const PathEdge& e = edges[i];
  const PathEdge& f = edges[j];
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
  // Rounding errors make collinear pieces seem to cross, at a different place on each. Such crossings are dropped.
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

// Edges of one round of splitting.
struct Edges {
  std::vector<PathEdge> all;
  std::vector<char> fresh;  ///< 0: unchanged since the last round, and tested against all such edges
};

// A square raster over the edges, to find neighbours.
struct EdgeRaster {
  Vec2 low;
  double size;
  double reach;  ///< margin within which an edge counts as in a cell [unit of the edges]

  /// Calls visit(key) for each cell that an edge passes.
  template <class Visit>
  void forCells(const PathEdge& edge, const Visit& visit) const {
    const std::int64_t firstRow = at(std::min(edge.a.y, edge.b.y) - reach, low.y);
    const std::int64_t lastRow = at(std::max(edge.a.y, edge.b.y) + reach, low.y);
    for (std::int64_t row = firstRow; row <= lastRow; ++row) {
      double left = std::min(edge.a.x, edge.b.x);
      double right = std::max(edge.a.x, edge.b.x);
      // Visits only the columns that the edge passes within this row; a level edge passes all of its own.
      if (firstRow != lastRow && edge.a.y != edge.b.y) {
        const double y0 = low.y + static_cast<double>(row) * size - reach;
        const double y1 = y0 + size + 2 * reach;
        const double slope = (edge.b.x - edge.a.x) / (edge.b.y - edge.a.y);
        const double x0 = edge.a.x + (y0 - edge.a.y) * slope;
        const double x1 = edge.a.x + (y1 - edge.a.y) * slope;
        left = std::max(left, std::min(x0, x1));
        right = std::min(right, std::max(x0, x1));
      }
      const std::int64_t last = at(right + reach, low.x);
      // The margin makes -1 the lowest index, so 1 is added to keep keys positive.
      for (std::int64_t column = at(left - reach, low.x); column <= last; ++column)
        visit((static_cast<std::uint64_t>(row + 1) << 32) | static_cast<std::uint32_t>(column + 1));
    }
  }

 private:
  [[nodiscard]] std::int64_t at(double value, double from) const {
    return static_cast<std::int64_t>(std::floor((value - from) / size));
  }
};

// Finds all places where edges meet away from their own ends. Returns false if it takes too much work, together with
// earlier rounds.
bool findSplits(const Edges& edges, const Bounds& box, Points points, std::vector<EdgeSplit>& splits,
                std::uint64_t& work) {
  const double reach = points == Points::OnGrid ? 1 : kNear;
  double total = 0;
  for (const PathEdge& edge : edges.all) total += length(edge.b - edge.a);
  const Vec2 size = box.size();
  // At most a million cells on a side keep an index within 32 bits.
  const EdgeRaster cells{
      box.min, std::max(total / static_cast<double>(edges.all.size()), std::max(size.x, size.y) / 1e6), reach};
  struct Entry {
    std::uint64_t key;
    int edge;
  };
  std::vector<Entry> entries;
  // Cells without a fresh edge are skipped; after the first rounds these are nearly all. The table that marks busy
  // cells has 64 to 128 entries per edge, and at most 2^20, because most calls have few edges and a large table would
  // cost more than the test.
  const int bits = std::min(static_cast<int>(std::bit_width(edges.all.size())) + 6, 20);
  std::vector<char> busy(std::size_t{1} << bits);
  const auto digestOf = [&](std::uint64_t key) { return toSize((key * 0x9E3779B97F4A7C15U) >> (64 - bits)); };
  for (const bool fresh : {true, false}) {
    for (std::size_t k = 0; k < edges.all.size(); ++k) {
      if ((edges.fresh[k] != 0) != fresh) continue;
      cells.forCells(edges.all[k], [&](std::uint64_t key) {
        if (fresh) busy[digestOf(key)] = 1;
        if (busy[digestOf(key)] != 0) entries.push_back({key, static_cast<int>(k)});
      });
      if (entries.size() > kMaxEntries) return false;
    }
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.key != b.key ? a.key < b.key : a.edge < b.edge; });
  std::vector<Bounds> boxes;  // boxes of the edges in a cell; few edges come near each other
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    while (end < entries.size() && entries[end].key == entries[begin].key) ++end;
    const std::uint64_t count = end - begin;
    work += count * count / 2;
    if (work > kMaxPairs) return false;
    boxes.clear();
    for (std::size_t k = begin; k < end; ++k) boxes.push_back(boxOf(edges.all[entries[k].edge]));
    for (std::size_t i = begin; i < end; ++i) {
      const bool fresh = edges.fresh[entries[i].edge] != 0;
      const Vec2 low = boxes[i - begin].min - Vec2{reach, reach};
      const Vec2 high = boxes[i - begin].max + Vec2{reach, reach};
      for (std::size_t j = i + 1; j < end; ++j) {
        const Bounds& other = boxes[j - begin];
        if (!fresh && edges.fresh[entries[j].edge] == 0) continue;
        if (other.min.x > high.x || other.max.x < low.x || other.min.y > high.y || other.max.y < low.y) continue;
        splitPair(edges.all, entries[i].edge, entries[j].edge, points, splits);
      }
    }
    if (splits.size() > kMaxSplits) return false;
  }
  std::sort(splits.begin(), splits.end(), [](const EdgeSplit& a, const EdgeSplit& b) {
    return a.edge != b.edge ? a.edge < b.edge : (a.t != b.t ? a.t < b.t : a.at.x < b.at.x);
  });
  return true;
}

// Unifies coincident crossings, and crossings that lie on a point of an edge: pieces that cover each other must have
// equal ends.
//
// They stand in a hash table by cells. With std::unordered_map, a map's strokes took an eighth longer to read.
class KnownPoints {
 public:
  explicit KnownPoints(const std::vector<PathEdge>& edges) {
    // One point of the drawing per cell suffices, because drawings are rounded to 1 nm. More would make a drawing slow
    // to read that has all its points in one place.
    for (const PathEdge& edge : edges) {
      if (slots_[slotOf(cellOf(edge.a))] < 0) add(edge.a);
    }
  }

  // Moves each split to the known point nearest to it, if that is within kTouch, and adds the others as known points.
  void unify(std::vector<EdgeSplit>& splits) {
    for (EdgeSplit& split : splits) {
      const PointCell cell = cellOf(split.at);
      const Vec2* best = nullptr;
      for (std::int64_t x = cell.x - 1; x <= cell.x + 1; ++x) {
        for (std::int64_t y = cell.y - 1; y <= cell.y + 1; ++y) {
          for (std::size_t slot = slotOf({x, y}); slots_[slot] >= 0; slot = next(slot)) {
            const Vec2& point = points_[slots_[slot]];
            const double apart = length(point - split.at);
            if (apart <= kTouch && (best == nullptr || apart < length(*best - split.at))) best = &point;
          }
        }
      }
      if (best != nullptr) {
        split.at = *best;
      } else {
        add(split.at);
      }
    }
  }

 private:
  struct PointCell {
    std::int64_t x, y;
  };

  static PointCell cellOf(Vec2 p) {
    constexpr double kCell = 2 * kTouch;
    return {static_cast<std::int64_t>(std::floor(p.x / kCell)), static_cast<std::int64_t>(std::floor(p.y / kCell))};
  }

  /// Returns the slot of the first point in a cell, or the free slot where it would be stored. Further points of the
  /// cell lie between it and the next free slot.
  [[nodiscard]] std::size_t slotOf(PointCell cell) const {
    const auto mixed = (static_cast<std::uint64_t>(cell.x) * 0x9E3779B97F4A7C15U + static_cast<std::uint64_t>(cell.y)) *
                       0xC2B2AE3D27D4EB4FU;
    for (std::size_t at = toSize(mixed >> 32) & (slots_.size() - 1);; at = next(at)) {
      if (slots_[at] < 0) return at;
      const PointCell other = cellOf(points_[slots_[at]]);
      if (other.x == cell.x && other.y == cell.y) return at;
    }
  }

  [[nodiscard]] std::size_t next(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }

  void add(Vec2 p) {
    points_.push_back(p);
    if (2 * points_.size() <= slots_.size()) return store(points_.size() - 1);
    slots_.assign(2 * slots_.size(), -1);
    for (std::size_t k = 0; k < points_.size(); ++k) store(k);
  }

  void store(std::size_t index) {
    std::size_t slot = slotOf(cellOf(points_[index]));
    while (slots_[slot] >= 0) slot = next(slot);
    slots_[slot] = static_cast<int>(index);
  }

  std::vector<Vec2> points_;
  std::vector<int> slots_ = std::vector<int>(64, -1);  ///< indices of points, -1 if free; at most half are taken
};

/// Splits edges at the given places. Every ring stays closed.
Edges piecesOf(const std::vector<PathEdge>& edges, const std::vector<EdgeSplit>& splits) {
  Edges pieces;
  pieces.all.reserve(edges.size() + splits.size());
  pieces.fresh.reserve(edges.size() + splits.size());
  std::size_t next = 0;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    Vec2 from = edges[k].a;
    const auto addTo = [&](Vec2 to) {
      if (from == to) return;
      pieces.all.push_back({from, to, edges[k].path});
      pieces.fresh.push_back(from == edges[k].a && to == edges[k].b ? 0 : 1);
      from = to;
    };
    for (; next < splits.size() && splits[next].edge == static_cast<int>(k); ++next) addTo(splits[next].at);
    addTo(edges[k].b);
  }
  return pieces;
}

}  // namespace

std::optional<std::vector<PathEdge>> splitEdges(const std::vector<PathEdge>& edges, const Bounds& box, Points points) {
  if (edges.size() > kMaxPieces) return std::nullopt;
  const bool grid = points == Points::OnGrid;
  Edges pieces{edges, std::vector<char>(edges.size(), 1)};
  std::optional<KnownPoints> known;
  if (!grid) known.emplace(edges);
  // An edge that is moved to a point within kNear, or to the grid point nearest to a crossing, bends by that much and
  // may cross edges that it did not cross before; so splitting is repeated.
  std::uint64_t work = 0;
  for (int round = 0; round < (grid ? kMaxGridRounds : kMaxRounds); ++round) {
    std::vector<EdgeSplit> splits;
    if (!findSplits(pieces, box, points, splits, work)) return std::nullopt;
    if (known) {
      known->unify(splits);
    } else {
      for (EdgeSplit& split : splits) split.at = onGrid(split.at);
    }
    const std::size_t before = pieces.all.size();
    pieces = piecesOf(pieces.all, splits);
    if (pieces.all.size() > kMaxPieces) return std::nullopt;
    if (pieces.all.size() == before) return std::move(pieces.all);
  }
  // Pieces in mm may still cross by a few nm here, which callers accept. On the grid they must not.
  if (grid) return std::nullopt;
  return std::move(pieces.all);
}

}  // namespace sillon
