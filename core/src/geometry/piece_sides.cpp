#include "geometry/outline_steps.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/sort_key.hpp"
#include "geometry/outline.hpp"

namespace sillon {
namespace {

constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();
constexpr std::uint64_t kMaxMet = 4'000'000'000;  ///< limit on pieces that rays meet; takes some ten seconds

/// Tells whether a piece runs upwards, or level to the right.
bool runsUp(const PathEdge& piece) { return piece.a.y != piece.b.y ? piece.a.y < piece.b.y : piece.a.x < piece.b.x; }

// Groups of pieces with the same ends.
struct Groups {
  std::vector<std::size_t> first;                ///< first[k]: first piece with the ends of piece k
  std::vector<std::vector<std::size_t>> others;  ///< others[k]: further pieces of the group whose first piece is k
};

// Groups pieces with the same ends; within a group they keep their order.
Groups groupedByEnds(const std::vector<PathEdge>& pieces) {
  using Key = std::array<double, 4>;
  const auto keyOf = [&](std::size_t k) {
    const PathEdge& p = pieces[k];
    return runsUp(p) ? Key{p.a.x, p.a.y, p.b.x, p.b.y} : Key{p.b.x, p.b.y, p.a.x, p.a.y};
  };
  std::vector<std::pair<Key, std::size_t>> keys;
  keys.reserve(pieces.size());
  for (std::size_t k = 0; k < pieces.size(); ++k) keys.emplace_back(keyOf(k), k);
  std::sort(keys.begin(), keys.end());
  Groups groups{std::vector<std::size_t>(pieces.size()), std::vector<std::vector<std::size_t>>(pieces.size())};
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const std::size_t piece = keys[k].second;
    const bool same = k > 0 && keys[k].first == keys[k - 1].first;
    groups.first[piece] = same ? groups.first[keys[k - 1].second] : piece;
    if (same) groups.others[groups.first[piece]].push_back(piece);
  }
  return groups;
}

// Finds the sides of steep pieces by casting a ray to the left from the middle of each, one row of buckets after the
// other. The ray crosses the piece itself, and those with the same ends, by their number instead of their place; any
// other piece nearby lies exactly on one side.
class SideRays {
 public:
  /// \param groups     result of groupedByEnds(); a ray is cast for the first piece of each group
  /// \param diagonals  true if diagonal pieces count as steep
  SideRays(const std::vector<PathEdge>& pieces, const Bounds& box, const Groups& groups, bool diagonals)
      : pieces_(pieces), groups_(groups), diagonals_(diagonals), bottom_(box.min.y) {
    double climb = 0;
    for (const PathEdge& piece : pieces) climb += std::abs(piece.b.y - piece.a.y);
    // The number of rows balances two costs: sorting the pieces that cross a whole row, and testing rays against pieces
    // that end in it. It is limited so that a piece lies in at most some 16 rows on average.
    const double height = std::max(box.size().y, 1e-9);
    const double count = static_cast<double>(pieces.size());
    const double stacked = std::max(climb / height, 1e-3);  // average number of pieces that a row meets
    const double rows = std::clamp(count * std::min(std::sqrt(0.2 / stacked), 16 / stacked), 1.0, 65536.0);
    row_ = height / rows;
    buckets_.resize(toSize(rows) + 1);
    ends_.resize(buckets_.size());
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const std::size_t first = bucketOf(std::min(pieces[k].a.y, pieces[k].b.y));
      const std::size_t last = bucketOf(std::max(pieces[k].a.y, pieces[k].b.y));
      for (std::size_t b = first; b <= last; ++b) buckets_[b].push_back(static_cast<int>(k));
      ++ends_[first];
      ++ends_[last];
    }
  }

  /// Tells whether a ray is cast from a piece.
  [[nodiscard]] bool isAsked(std::size_t piece) const {
    const Vec2 along = pieces_[piece].b - pieces_[piece].a;
    const double lean = std::abs(along.y) - std::abs(along.x);
    return groups_.first[piece] == piece && (lean > 0 || (diagonals_ && lean == 0));
  }

  /// Estimates the work: an upper bound of pieces that rays meet one by one, plus the cost of sorting the others.
  [[nodiscard]] std::uint64_t cost() const {
    std::uint64_t met = 0;
    for (const std::vector<int>& bucket : buckets_) met += 8 * bucket.size();
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      if (isAsked(k)) met += ends_[bucketOf(middleOf(k).y)];
    }
    return met;
  }

  /// Casts all rays. \param sides  sides of all pieces; those with a ray are set, seen upwards
  void answer(const std::vector<FilledPath>& paths, const InsideRule* rule, std::vector<Sides>& sides) const {
    WindingState winding(paths, rule);
    PieceRow row;
    std::vector<std::size_t> rank(pieces_.size(), kNowhere);  // rank of a piece in row.across
    std::vector<std::pair<int, int>> extra;                   // pieces, and how often a ray crosses each
    for (std::size_t bucket = 0; bucket < buckets_.size(); ++bucket) {
      fill(row, bucket);
      for (std::size_t k = 0; k < row.across.size(); ++k) rank[row.across[k].piece] = k;
      winding.reset();
      std::size_t crossed = 0;
      for (const Ray& ray : row.rays) {
        while (crossed < ray.before) cross(row.across[crossed++].piece, 1, winding);
        // Pieces with the same ends are no obstacle: they are crossed by their number.
        extra.clear();
        const auto own = [&](std::size_t k) {
          if (rank[k] != kNowhere && rank[k] < ray.before) extra.emplace_back(static_cast<int>(k), -1);
        };
        own(ray.piece);
        for (const std::size_t k : groups_.others[ray.piece]) own(k);
        for (const RaySpan& span : row.ending) {
          if (ray.p.y < span.low || ray.p.y >= span.high || !isLeft(span, ray.p)) continue;
          if (groups_.first[span.piece] != ray.piece) extra.emplace_back(span.piece, 1);
        }
        for (const auto& [piece, times] : extra) cross(piece, times, winding);
        Sides& found = sides[ray.piece];
        found.left = winding.inside();
        crossGroup(ray.piece, 1, winding);
        found.right = winding.inside();
        crossGroup(ray.piece, -1, winding);
        for (const auto& [piece, times] : extra) cross(piece, -times, winding);
      }
      for (const RaySpan& span : row.across) rank[span.piece] = kNowhere;
    }
  }

 private:
  // A piece as rays see it. The pieces of a bucket are scattered in memory, and a ray meets hundreds of them; without
  // this copy, all rays of a map's strokes took three times as long.
  struct RaySpan {
    /// Range of y. A ray at `high` passes over the piece, as in crossesRow().
    double low;
    double high;
    /// Range of x.
    double left;
    double right;
    int piece;
    double at = 0;  ///< x at the middle of the row
  };

  struct Ray {
    std::size_t piece;
    Vec2 p;                  ///< middle of the piece
    std::size_t before = 0;  ///< number of pieces across the row that lie left of it
  };

  // Pieces of a row. They meet at their ends only, so that those across all rays of the row have one order, and a ray
  // finds its place among them by bisection.
  struct PieceRow {
    std::vector<Ray> rays;        ///< sorted by `before`
    std::vector<RaySpan> across;  ///< pieces across all rays, from left to right
    std::vector<RaySpan> ending;  ///< pieces that end within the row
  };

  /// Collects the rays of a row, and sorts the pieces across all of them from left to right.
  void fill(PieceRow& row, std::size_t bucket) const {
    row.rays.clear();
    row.across.clear();
    row.ending.clear();
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const int index : buckets_[bucket]) {
      const std::size_t piece = index;
      const Vec2 p = middleOf(piece);
      if (!isAsked(piece) || bucketOf(p.y) != bucket) continue;
      row.rays.push_back({piece, p});
      low = std::min(low, p.y);
      high = std::max(high, p.y);
    }
    if (row.rays.empty()) return;
    for (const int k : buckets_[bucket]) {
      const PathEdge& piece = pieces_[k];
      const auto [bottom, top] = std::minmax(piece.a.y, piece.b.y);
      const auto [left, right] = std::minmax(piece.a.x, piece.b.x);
      const bool across = bottom <= low && top > high;
      (across ? row.across : row.ending)
          .push_back({bottom, top, left, right, k, across ? crossingX(piece, (low + high) / 2) : 0});
    }
    sortBy(row.across, [](const RaySpan& span) { return span.at; });
    for (Ray& ray : row.rays) {
      const auto end = std::partition_point(row.across.begin(), row.across.end(),
                                            [&](const RaySpan& span) { return isLeft(span, ray.p); });
      ray.before = end - row.across.begin();
    }
    sortBy(row.rays, [](const Ray& ray) { return ray.before; });
  }

  [[nodiscard]] bool isLeft(const RaySpan& span, Vec2 p) const {
    if (p.x <= span.left) return false;
    return span.right < p.x || crossingX(pieces_[span.piece], p.y) < p.x;
  }

  void cross(int piece, int times, WindingState& winding) const {
    const PathEdge& edge = pieces_[piece];
    winding.cross(edge.path, runsUp(edge) ? times : -times);
  }

  void crossGroup(std::size_t first, int times, WindingState& winding) const {
    cross(static_cast<int>(first), times, winding);
    for (const std::size_t k : groups_.others[first]) cross(static_cast<int>(k), times, winding);
  }

  [[nodiscard]] Vec2 middleOf(std::size_t piece) const { return (pieces_[piece].a + pieces_[piece].b) * 0.5; }

  [[nodiscard]] std::size_t bucketOf(double y) const {
    const double row = std::clamp((y - bottom_) / row_, 0.0, static_cast<double>(buckets_.size() - 1));
    return toSize(row);
  }

  const std::vector<PathEdge>& pieces_;
  const Groups& groups_;
  bool diagonals_;
  double bottom_;
  double row_ = 1;
  std::vector<std::vector<int>> buckets_;
  std::vector<std::uint32_t> ends_;  // number of pieces' ends in each bucket
};

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

std::optional<std::vector<Sides>> sidesOf(const std::vector<PathEdge>& pieces, const Bounds& box,
                                          const std::vector<FilledPath>& paths, const InsideRule* rule) {
  const Groups groups = groupedByEnds(pieces);
  // Rays cross a piece as steeply as possible; along it, the last digit of a coordinate would decide.
  const std::vector<PathEdge> turned = mirroredPieces(pieces);
  const SideRays acrossSteep(pieces, box, groups, true);
  const SideRays acrossFlat(turned, mirroredBox(box), groups, false);
  const std::uint64_t rules = rule ? 5 * pieces.size() * paths.size() : 0;  // a rule tests all paths
  if (acrossSteep.cost() + acrossFlat.cost() + rules > kMaxMet) return std::nullopt;
  std::vector<Sides> sides(pieces.size());
  acrossSteep.answer(paths, rule, sides);
  acrossFlat.answer(paths, rule, sides);
  for (std::size_t k = 0; k < pieces.size(); ++k) {  // a mirror swaps left and right, and so does running down
    const bool flat = acrossFlat.isAsked(k);
    if (flat == runsUp(flat ? turned[k] : pieces[k])) std::swap(sides[k].left, sides[k].right);
  }
  return sides;
}

}  // namespace sillon
