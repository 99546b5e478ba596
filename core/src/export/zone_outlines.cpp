#include "export/zone_parts.hpp"

#include <array>
#include <map>
#include <utility>

namespace sillon {
namespace {

constexpr double kStraight = 0.75;  // [cells], distance of a straight line from the steps it replaces

// Separates cells that meet in a corner only, which would make rings touch themselves: a cell beside the corner changes
// its zone.
void partCorners(std::vector<std::int32_t>& zone, int columns, int rows) {
  const auto at = [&](int x, int y) -> std::int32_t& { return zone[indexOf(x, y, columns)]; };
  bool changed = true;
  for (int round = 0; changed && round < 100; ++round) {
    changed = false;
    for (int y = 0; y + 1 < rows; ++y) {
      for (int x = 0; x + 1 < columns; ++x) {
        const bool rising = at(x, y) == at(x + 1, y + 1) && at(x, y) != at(x + 1, y) && at(x, y) != at(x, y + 1);
        const bool falling =
            at(x + 1, y) == at(x, y + 1) && at(x, y) != at(x + 1, y) && at(x + 1, y + 1) != at(x + 1, y);
        if (!rising && !falling) continue;
        if (rising) {
          at(x + 1, y) = at(x, y);
        } else {
          at(x, y) = at(x + 1, y);
        }
        changed = true;
      }
    }
  }
}

// A node of the lattice between the cells.
struct Corner {
  int x = 0;
  int y = 0;
  friend bool operator==(const Corner&, const Corner&) = default;
};

// A stretch of border between two junctions, where three zones meet, or a whole ring; zones left and right of it.
struct Chain {
  std::vector<Corner> corners;
  std::int32_t left = -1;
  std::int32_t right = -1;
};

// Traces the borders between zones.
class Tracer {
 public:
  Tracer(const std::vector<std::int32_t>& zone, int columns, int rows) : zone_(zone), columns_(columns), rows_(rows) {
    used_.assign(cellCount(columns + 1, rows + 1), {});
  }

  std::vector<Chain> chains() {
    std::vector<Chain> all;
    for (const bool junctions : {true, false}) {
      for (int y = 0; y <= rows_; ++y) {
        for (int x = 0; x <= columns_; ++x) {
          if (junctions && degree({x, y}) < 3) continue;
          for (int way = 0; way < 4; ++way) {
            if (isBorder({x, y}, way) && !isUsed({x, y}, way)) all.push_back(follow({x, y}, way));
          }
        }
      }
    }
    return all;
  }

 private:
  // Directions of a way: 0 east, 1 north, 2 west, 3 south.
  static Corner step(Corner c, int way) {
    constexpr std::array<int, 4> kX{1, 0, -1, 0};
    constexpr std::array<int, 4> kY{0, 1, 0, -1};
    return {c.x + kX[way], c.y + kY[way]};
  }
  [[nodiscard]] std::int32_t cell(int x, int y) const {
    if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return -1;
    return zone_[indexOf(x, y, columns_)];
  }
  [[nodiscard]] std::int32_t leftOf(Corner c, int way) const {
    constexpr std::array<int, 4> kX{0, -1, -1, 0};
    constexpr std::array<int, 4> kY{0, 0, -1, -1};
    return cell(c.x + kX[way], c.y + kY[way]);
  }
  [[nodiscard]] std::int32_t rightOf(Corner c, int way) const { return leftOf(c, (way + 3) % 4); }
  [[nodiscard]] bool isBorder(Corner c, int way) const {
    const Corner to = step(c, way);
    if (to.x < 0 || to.y < 0 || to.x > columns_ || to.y > rows_) return false;
    return leftOf(c, way) != rightOf(c, way);
  }
  [[nodiscard]] int degree(Corner c) const {
    int sum = 0;
    for (int way = 0; way < 4; ++way) sum += isBorder(c, way) ? 1 : 0;
    return sum;
  }
  std::array<bool, 4>& marks(Corner c) { return used_[indexOf(c.x, c.y, columns_ + 1)]; }
  bool isUsed(Corner c, int way) { return marks(c)[way]; }

  Chain follow(Corner from, int way) {
    Chain chain;
    chain.left = leftOf(from, way);
    chain.right = rightOf(from, way);
    chain.corners.push_back(from);
    Corner at = from;
    for (;;) {
      marks(at)[way] = true;
      at = step(at, way);
      marks(at)[(way + 2) % 4] = true;
      chain.corners.push_back(at);
      if (at == from || degree(at) != 2) return chain;
      for (const int turn : {0, 1, 3}) {
        if (!isBorder(at, (way + turn) % 4)) continue;
        way = (way + turn) % 4;
        break;
      }
    }
  }

  const std::vector<std::int32_t>& zone_;
  int columns_;
  int rows_;
  std::vector<std::array<bool, 4>> used_;
};

// Simplifies a chain by the Douglas-Peucker algorithm: keeps the corner furthest from the straight line, and repeats on
// both sides of it.
void keepCorners(const std::vector<Corner>& corners, std::size_t first, std::size_t last, std::vector<char>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    const Vec2 p{static_cast<double>(corners[a].x), static_cast<double>(corners[a].y)};
    const Vec2 d = Vec2{static_cast<double>(corners[b].x), static_cast<double>(corners[b].y)} - p;
    const double size = length(d);
    double most = 0;
    std::size_t furthest = a;
    for (std::size_t k = a + 1; k < b; ++k) {
      const Vec2 q = Vec2{static_cast<double>(corners[k].x), static_cast<double>(corners[k].y)} - p;
      const double off = size > 0 ? std::abs(cross(d, q)) / size : length(q);
      if (off > most) {
        most = off;
        furthest = k;
      }
    }
    if (most <= kStraight) continue;
    kept[furthest] = 1;
    open.emplace_back(a, furthest);
    open.emplace_back(furthest, b);
  }
}

// Simplifies a chain and keeps its ends.
void straighten(Chain& chain) {
  std::vector<Corner>& corners = chain.corners;
  std::vector<char> kept(corners.size(), 0);
  kept.front() = kept.back() = 1;
  std::size_t middle = corners.size() - 1;
  if (corners.front() == corners.back()) {  // a ring gets two anchors, far from each other
    double most = -1;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const double away = std::hypot(corners[k].x - corners[0].x, corners[k].y - corners[0].y);
      if (away > most) {
        most = away;
        middle = k;
      }
    }
    kept[middle] = 1;
    keepCorners(corners, 0, middle, kept);
    keepCorners(corners, middle, corners.size() - 1, kept);
  } else {
    keepCorners(corners, 0, corners.size() - 1, kept);
  }
  std::vector<Corner> straight;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (kept[k] != 0) straight.push_back(corners[k]);
  }
  corners = std::move(straight);
}

}  // namespace

std::vector<std::vector<Ring>> zoneOutlines(std::vector<std::int32_t> zone, int count, const Grid& grid) {
  partCorners(zone, grid.nx, grid.ny);
  std::vector<Chain> chains = Tracer(zone, grid.nx, grid.ny).chains();
  for (Chain& chain : chains) straighten(chain);
  std::vector<std::vector<Ring>> rings(count);
  for (int k = 0; k < count; ++k) {
    // Chains with the zone on their left, by their start. At most one starts at each junction, because at most three
    // zones meet there.
    std::map<std::pair<int, int>, std::vector<Corner>> from;
    std::vector<std::vector<Corner>> closed;
    for (const Chain& chain : chains) {
      if (chain.left != k && chain.right != k) continue;
      std::vector<Corner> corners = chain.corners;
      if (chain.right == k) std::reverse(corners.begin(), corners.end());
      if (corners.front() == corners.back()) {
        closed.push_back(std::move(corners));
      } else {
        from[{corners.front().y, corners.front().x}] = std::move(corners);
      }
    }
    while (!from.empty()) {
      std::vector<Corner> ring;
      auto next = from.begin();
      while (next != from.end()) {
        const std::vector<Corner> corners = std::move(next->second);
        from.erase(next);
        ring.insert(ring.end(), corners.begin(), corners.end() - 1);
        if (corners.back() == ring.front()) {
          ring.push_back(ring.front());
          closed.push_back(std::move(ring));
          break;
        }
        next = from.find({corners.back().y, corners.back().x});
      }
    }
    for (const std::vector<Corner>& ring : closed) {
      if (ring.size() < 4) continue;
      Ring& out = rings[k].emplace_back();
      for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
        out.push_back(grid.origin + grid.cell * Vec2{static_cast<double>(ring[i].x), static_cast<double>(ring[i].y)});
      }
    }
  }
  return rings;
}

}  // namespace sillon
