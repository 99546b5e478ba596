#include "sillon/toolpath/thin_features.hpp"

#include <algorithm>
#include <cstddef>

namespace sillon {
namespace {

constexpr int kReach = 3;  ///< nodes: a contour that is nearer fills the place
constexpr std::size_t kSmallest =
    4;  ///< nodes of a place worth a contour: a smaller one adds two hairpins and covers nothing

bool contourNear(const Grid& nodes, const std::vector<float>& values, int x, int y) {
  for (int b = std::max(0, y - kReach); b <= std::min(nodes.ny - 1, y + kReach); ++b) {
    for (int a = std::max(0, x - kReach); a <= std::min(nodes.nx - 1, x + kReach); ++a) {
      if (values[nodes.index(a, b)] < 0) return true;
    }
  }
  return false;
}

}  // namespace

void fillThinFeatures(const Grid& nodes, const std::vector<float>& distance, double spacing,
                      std::vector<float>& values) {
  const float deep = static_cast<float>(-0.5 * spacing);
  const float band = static_cast<float>(-spacing);
  std::vector<std::size_t> empty;  // in order, so that places are found again by a search
  for (int y = 0; y < nodes.ny; ++y) {
    for (int x = 0; x < nodes.nx; ++x) {
      const std::size_t i = nodes.index(x, y);
      if (distance[i] <= deep && distance[i] > band && values[i] >= 0 && !contourNear(nodes, values, x, y))
        empty.push_back(i);
    }
  }
  std::vector<char> seen(empty.size(), 0);
  std::vector<std::size_t> place;  // indices into `empty`
  const std::size_t nx = static_cast<std::size_t>(nodes.nx);
  for (std::size_t first = 0; first < empty.size(); ++first) {
    if (seen[first] != 0) continue;
    seen[first] = 1;
    place.assign(1, first);
    for (std::size_t k = 0; k < place.size(); ++k) {
      const std::size_t i = empty[place[k]];  // never on the lattice's frame, which lies outside the shape
      for (const std::size_t j : {i - 1, i + 1, i - nx, i + nx}) {
        const auto found = std::lower_bound(empty.begin(), empty.end(), j);
        if (found == empty.end() || *found != j) continue;
        const std::size_t at = static_cast<std::size_t>(found - empty.begin());
        if (seen[at] != 0) continue;
        seen[at] = 1;
        place.push_back(at);
      }
    }
    if (place.size() < kSmallest) continue;
    for (const std::size_t k : place) values[empty[k]] = -0.5f;
  }
}

void fillMiddles(const Grid& nodes, const std::vector<Vec2>& middles, std::vector<float>& values) {
  std::vector<std::size_t> empty;
  for (const Vec2 p : middles) {
    const int x = std::clamp(static_cast<int>((p.x - nodes.origin.x) / nodes.cell), 0, nodes.nx - 1);
    const int y = std::clamp(static_cast<int>((p.y - nodes.origin.y) / nodes.cell), 0, nodes.ny - 1);
    if (values[nodes.index(x, y)] >= 0 && !contourNear(nodes, values, x, y)) empty.push_back(nodes.index(x, y));
  }
  for (const std::size_t i : empty) values[i] = -0.5f;
}

void keepThinParts(const Parts& parts, const SignedDistanceField& sdf, double spacing, std::vector<float>& values) {
  const Grid& grid = parts.grid;
  const Grid nodes = nodeLattice(grid);
  std::vector<char> kept(static_cast<std::size_t>(parts.count), 0);
  for (int y = 0; y < nodes.ny; ++y) {
    for (int x = 0; x < nodes.nx; ++x) {
      if (values[nodes.index(x, y)] >= 0) continue;
      const std::int32_t label = parts.label[grid.index(std::min(x / 2, grid.nx - 1), std::min(y / 2, grid.ny - 1))];
      if (label >= 0 && label < parts.count) kept[static_cast<std::size_t>(label)] = 1;
    }
  }
  const float depth = static_cast<float>(-0.5 * spacing);
  for (int y = 0; y < grid.ny; ++y) {
    for (int x = 0; x < grid.nx; ++x) {
      const std::size_t i = grid.index(x, y);
      const std::int32_t label = parts.label[i];
      if (label < 0 || label >= parts.count || kept[static_cast<std::size_t>(label)] || sdf.distance[i] > depth)
        continue;
      values[nodes.index(2 * x + 1, 2 * y + 1)] = -0.5f;
    }
  }
}

}  // namespace sillon
