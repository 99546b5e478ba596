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
#include "geometry/covered_paths.hpp"

namespace sillon {
namespace {

constexpr double kTouch = 1e-7;  ///< points nearer than this coincide [mm]
/// An edge that passes a point within this goes through it [mm]: what should lie on one line comes on a grid of 1 nm.
constexpr double kNear = 2e-6;
constexpr int kMaxRounds = 5;                    ///< of splitting; two do for nearly all drawings
constexpr int kMaxGridRounds = 50;               ///< of splitting on a grid; five do for nearly all drawings
constexpr double kPerGrid = 1000;                ///< points of the grid that files hold [1/mm]
constexpr std::size_t kMaxPieces = 4'000'000;    ///< beyond any drawing that a spacing of 0.05 mm could show
constexpr std::uint64_t kMaxWork = 800'000'000;  ///< pair tests; a few seconds, reached by hostile drawings only

enum class Points { AsGiven, OnGrid };  // mm as they are, or whole steps of the grid

struct Edge {
  Vec2 a;
  Vec2 b;
  int path;
};

/// \param without  where not empty, 1 for paths that are left out.
std::vector<Edge> edgesOf(const std::vector<FilledPath>& paths, const std::vector<char>& without = {}) {
  std::vector<Edge> edges;
  for (std::size_t path = 0; path < paths.size(); ++path) {
    if (!without.empty() && without[path] != 0) continue;
    for (const Ring& ring : paths[path].rings) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vec2 a = ring[k];
        const Vec2 b = ring[k + 1 < ring.size() ? k + 1 : 0];
        if (!(a == b)) edges.push_back({a, b, static_cast<int>(path)});
      }
    }
  }
  return edges;
}

Vec2 rounded(Vec2 p) { return {std::round(p.x) + 0.0, std::round(p.y) + 0.0}; }

// In steps of the grid: sums and products of these are exact.
std::vector<Edge> gridEdges(const std::vector<Edge>& edges) {
  std::vector<Edge> out;
  for (const Edge& edge : edges) {
    const Edge to{rounded(edge.a * kPerGrid), rounded(edge.b * kPerGrid), edge.path};
    if (!(to.a == to.b)) out.push_back(to);
  }
  return out;
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
  /// \param rule  null: inside is where any path is filled.
  explicit WindingState(const std::vector<FilledPath>& paths, const InsideRule* rule = nullptr)
      : paths_(paths), rule_(rule), winding_(paths.size(), 0), filled_(rule ? paths.size() : 0, 0) {}

  void cross(int path, int direction) {
    const auto k = static_cast<std::size_t>(path);
    int& winding = winding_[k];
    const FillRule rule = paths_[k].fillRule;
    inside_ -= filled(rule, winding) ? 1 : 0;
    winding += direction;
    inside_ += filled(rule, winding) ? 1 : 0;
    if (rule_) filled_[k] = filled(rule, winding) ? 1 : 0;
    touched_.push_back(path);
  }
  [[nodiscard]] bool inside() const { return rule_ ? (*rule_)(filled_) : inside_ > 0; }
  void reset() {
    for (const int path : touched_) {
      winding_[static_cast<std::size_t>(path)] = 0;
      if (rule_) filled_[static_cast<std::size_t>(path)] = 0;
    }
    touched_.clear();
    inside_ = 0;
  }

 private:
  const std::vector<FilledPath>& paths_;
  const InsideRule* rule_;
  std::vector<int> winding_;
  std::vector<char> filled_;
  std::vector<int> touched_;
  int inside_ = 0;
};

/// Whether a piece runs upwards, or level to the right.
bool runsUp(const Edge& piece) { return piece.a.y != piece.b.y ? piece.a.y < piece.b.y : piece.a.x < piece.b.x; }

// Tells what lies beside a steep piece by casting a ray to the left from its middle, through pieces bucketed by rows.
// The piece itself and those on the same ends are crossed by count, not by place: whatever else is near lies exactly on
// one side or the other.
class SideQuery {
 public:
  SideQuery(const std::vector<FilledPath>& paths, const InsideRule* rule, const std::vector<Edge>& pieces,
            const std::vector<std::size_t>& groupOf, const Bounds& box)
      : pieces_(pieces), groupOf_(groupOf), winding_(paths, rule), bottom_(box.min.y) {
    double climb = 0;
    for (const Edge& piece : pieces) climb += std::abs(piece.b.y - piece.a.y);
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
      const Edge& other = pieces_[static_cast<std::size_t>(k)];
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

  const std::vector<Edge>& pieces_;
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
void splitAtEnd(const Edge& edge, int index, Vec2 end, Points points, std::vector<Split>& splits) {
  const Vec2 along = edge.b - edge.a;
  const double size = length(along);
  const double t = dot(end - edge.a, along) / (size * size);
  if (t * size <= kTouch || (1 - t) * size <= kTouch) return;
  const double off = std::abs(cross(along, end - edge.a));
  if (points == Points::OnGrid ? off < 0.5 * (std::abs(along.x) + std::abs(along.y)) : off <= kNear * size)
    splits.push_back({index, t, end});
}

void splitPair(const std::vector<Edge>& edges, int i, int j, Points points, std::vector<Split>& splits) {
  const Edge& e = edges[static_cast<std::size_t>(i)];
  const Edge& f = edges[static_cast<std::size_t>(j)];
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

Bounds boxOf(const Edge& edge) {
  Bounds box;
  box.add(edge.a);
  box.add(edge.b);
  return box;
}

// All places where edges meet away from their own ends. False: too much work, with what was done before.
bool findSplits(const std::vector<Edge>& edges, const Bounds& box, Points points, std::vector<Split>& splits,
                std::uint64_t& work) {
  const double reach = points == Points::OnGrid ? 1 : kNear;
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
void unifyCrossings(const std::vector<Edge>& edges, std::vector<Split>& splits) {
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
  for (const Edge& edge : edges) known.emplace(cellOf(edge.a), edge.a);
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
std::vector<Edge> piecesOf(const std::vector<Edge>& edges, const std::vector<Split>& splits) {
  std::vector<Edge> pieces;
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
std::vector<std::size_t> groupedByEnds(const std::vector<Edge>& pieces) {
  using Key = std::array<double, 4>;
  const auto keyOf = [&](std::size_t k) {
    const Edge& p = pieces[k];
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

std::vector<Edge> mirroredPieces(const std::vector<Edge>& pieces) {
  std::vector<Edge> out;
  out.reserve(pieces.size());
  for (const Edge& piece : pieces) out.push_back({mirrored(piece.a), mirrored(piece.b), piece.path});
  return out;
}

Bounds mirroredBox(const Bounds& box) {
  Bounds out;
  out.add(mirrored(box.min));
  out.add(mirrored(box.max));
  return out;
}

/// The pieces with inside on exactly one side, on their left. No pieces if nothing is inside.
/// \param rule  null: inside is where any path is filled.
Result<Outline> borderOf(const std::vector<FilledPath>& paths, const InsideRule* rule, Points points) {
  const Error tooLarge{
      ErrorCode::TooLarge,
      "the outline has too many edges or meets itself too often; at most 4 million pieces can be read; "
      "merge its paths in a drawing program, or draw it as a PNG"};
  const bool grid = points == Points::OnGrid;
  std::vector<Edge> edges = edgesOf(paths, rule ? std::vector<char>{} : coveredPaths(paths));
  if (grid) edges = gridEdges(edges);
  Outline outline;
  for (const Edge& edge : edges) outline.bounds.add(edge.a);
  if (edges.empty()) return outline;
  if (edges.size() > kMaxPieces) return tooLarge;

  // What goes through a point within kNear, or through the grid's nearest to a crossing, is bent by that much and may
  // cross what it did not before.
  std::vector<Edge> pieces = edges;
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
  const std::vector<Edge> turned = mirroredPieces(pieces);
  SideQuery steep(paths, rule, pieces, groupOf, outline.bounds);
  SideQuery flat(paths, rule, turned, groupOf, mirroredBox(outline.bounds));
  const auto isFlat = [&](const Edge& piece) {
    return std::abs(piece.b.x - piece.a.x) > std::abs(piece.b.y - piece.a.y);
  };
  std::uint64_t work = rule ? pieces.size() * paths.size() : 0;
  for (const Edge& piece : pieces) {
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

/// Joins segments end to end. Where several go on from a point any will do: winding is the same.
class Chains {
 public:
  explicit Chains(const std::vector<BorderSegment>& segments) : segments_(segments), used_(segments.size(), 0) {
    byStart_.reserve(segments.size());
    for (std::size_t k = 0; k < segments.size(); ++k) byStart_.emplace_back(cellOf(segments[k].a), k);
    std::sort(byStart_.begin(), byStart_.end());
    skip_.resize(byStart_.size(), 0);
  }

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
  static constexpr double kGap = 1e-5;  // between ends that belong together [mm]

  static Cell cellOf(Vec2 p) {
    return {static_cast<std::int64_t>(std::floor(p.x / kGap)), static_cast<std::int64_t>(std::floor(p.y / kGap))};
  }

  /// The first entry from `at` on whose segment is unused; what is passed over is passed at once next time.
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

  /// The nearest unused segment that begins at p; their number if there is none.
  std::size_t following(Vec2 p) {
    const Cell cell = cellOf(p);
    std::size_t best = segments_.size();
    double nearest = kGap;
    for (std::int64_t x = cell.first - 1; x <= cell.first + 1; ++x) {
      const auto first =
          std::lower_bound(byStart_.begin(), byStart_.end(), std::pair<Cell, std::size_t>{{x, cell.second - 1}, 0});
      for (std::size_t at = unusedFrom(static_cast<std::size_t>(first - byStart_.begin()));
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

Result<FilledPath> combined(const std::vector<FilledPath>& paths, const InsideRule& rule) {
  const Result<Outline> outline = borderOf(paths, &rule, Points::AsGiven);
  if (!outline) return outline.error();
  return FilledPath{Chains(outline.value().segments).rings(), FillRule::NonZero};
}

std::vector<std::vector<Interval>> insideIntervals(const Shape& shape, double firstY, double step, int rows) {
  struct Crossing {
    double x;
    int path;
    int direction;
  };
  std::vector<std::vector<Crossing>> crossings(static_cast<std::size_t>(std::max(rows, 0)));
  for (const Edge& edge : edgesOf(shape.paths)) {
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
  WindingState winding(shape.paths);
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
