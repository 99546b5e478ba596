#include "geometry/piece_sides.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace sillon {
namespace {

constexpr std::uint64_t kMaxMet = 4'000'000'000;  ///< pieces that rays meet; some ten seconds

/// Whether a piece runs upwards, or level to the right.
bool runsUp(const PathEdge& piece) { return piece.a.y != piece.b.y ? piece.a.y < piece.b.y : piece.a.x < piece.b.x; }

// Pieces with the same ends.
struct Groups {
  std::vector<std::size_t> first;                ///< of each piece, the first one of its group
  std::vector<std::vector<std::size_t>> others;  ///< of each group's first piece
};

// Of each piece, the first one with the same ends; and of each of those, the others, in the order of the pieces.
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

// Tells what lies beside steep pieces by casting a ray to the left from the middle of each, row of buckets by row. The
// piece itself and those on the same ends are crossed by count, not by place: whatever else is near lies exactly on one
// side or the other.
class SideRays {
 public:
  /// \param groups     as groupedByEnds gives them: of each, the first piece is asked for
  /// \param diagonals  whether those count as steep
  SideRays(const std::vector<PathEdge>& pieces, const Bounds& box, const Groups& groups, bool diagonals)
      : pieces_(pieces), groups_(groups), diagonals_(diagonals), bottom_(box.min.y) {
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

  /// Whether a ray is cast from a piece.
  [[nodiscard]] bool isAsked(std::size_t piece) const {
    const Vec2 along = pieces_[piece].b - pieces_[piece].a;
    const double lean = std::abs(along.y) - std::abs(along.x);
    return groups_.first[piece] == piece && (lean > 0 || (diagonals_ && lean == 0));
  }

  /// How many pieces all rays meet at most.
  [[nodiscard]] std::uint64_t cost() const {
    std::uint64_t met = 0;
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      if (isAsked(k)) met += buckets_[bucketOf(middleOf(k).y)].size();
    }
    return met;
  }

  /// \param sides  of all pieces; those of the asked ones are set, seen upwards
  void answer(const std::vector<FilledPath>& paths, const InsideRule* rule, std::vector<Sides>& sides) const {
    WindingState winding(paths, rule);
    std::vector<Span> spans;
    for (std::size_t bucket = 0; bucket < buckets_.size(); ++bucket) {
      spansOf(buckets_[bucket], spans);
      for (const int index : buckets_[bucket]) {
        const auto piece = static_cast<std::size_t>(index);
        const Vec2 p = middleOf(piece);
        if (!isAsked(piece) || bucketOf(p.y) != bucket) continue;
        winding.reset();
        for (const Span& span : spans) {
          if (p.y < span.low || p.y >= span.high || p.x <= span.left) continue;
          const auto k = static_cast<std::size_t>(span.piece);
          if (groups_.first[k] != piece && (span.right < p.x || crossingX(pieces_[k], p.y) < p.x)) cross(k, winding);
        }
        Sides& found = sides[piece];
        found.left = winding.inside();
        cross(piece, winding);
        for (const std::size_t k : groups_.others[piece]) cross(k, winding);
        found.right = winding.inside();
      }
    }
  }

 private:
  // A piece as rays see it. Pieces that lie in a bucket are scattered in memory, and a ray meets hundreds: read from
  // there, all rays of a map's strokes took three times as long.
  struct Span {
    double low, high;    ///< of y; a ray at `high` passes over it, as in crossesRow
    double left, right;  ///< of x
    int piece;
  };

  void spansOf(const std::vector<int>& bucket, std::vector<Span>& spans) const {
    spans.clear();
    for (const int k : bucket) {
      const PathEdge& piece = pieces_[static_cast<std::size_t>(k)];
      const auto [low, high] = std::minmax(piece.a.y, piece.b.y);
      const auto [left, right] = std::minmax(piece.a.x, piece.b.x);
      spans.push_back({low, high, left, right, k});
    }
  }

  void cross(std::size_t piece, WindingState& winding) const {
    winding.cross(pieces_[piece].path, runsUp(pieces_[piece]) ? 1 : -1);
  }

  [[nodiscard]] Vec2 middleOf(std::size_t piece) const { return (pieces_[piece].a + pieces_[piece].b) * 0.5; }

  [[nodiscard]] std::size_t bucketOf(double y) const {
    const double row = std::clamp((y - bottom_) / row_, 0.0, static_cast<double>(buckets_.size() - 1));
    return static_cast<std::size_t>(row);
  }

  const std::vector<PathEdge>& pieces_;
  const Groups& groups_;
  bool diagonals_;
  double bottom_;
  double row_ = 1;
  std::vector<std::vector<int>> buckets_;
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
  // Rays run across a piece: along it, the last digit of a coordinate would decide.
  const std::vector<PathEdge> turned = mirroredPieces(pieces);
  const SideRays acrossSteep(pieces, box, groups, true);
  const SideRays acrossFlat(turned, mirroredBox(box), groups, false);
  const std::uint64_t rules = rule ? 5 * pieces.size() * paths.size() : 0;  // a rule looks at all paths
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
