#include "toolpath/path.hpp"

#include <algorithm>
#include <cstddef>

#include "geometry/bead_room.hpp"

namespace sillon {
namespace {

constexpr float kLine = -2;  ///< value along thin lines: with -0.5, the ways there and back lay on top of each other
constexpr float kFilled = -0.5f;          ///< value of other places that are filled
constexpr std::size_t kShortestLine = 8;  ///< shortest line filled [nodes]: shorter ones are necks, and paths across
constexpr std::size_t kDotCells = 6;      ///< most cells of a dot in which no place was filled
constexpr int kReach = 3;                 ///< distance [nodes] within which another contour fills the place already
constexpr std::size_t kSmallest =
    4;  ///< nodes of a place worth a contour: a smaller one adds two U-turns and covers nothing

// Tells whether a contour runs near to a node: it does where a value is negative.
bool contourNear(const Grid& nodes, const std::vector<float>& values, int x, int y) {
  for (int b = std::max(0, y - kReach); b <= std::min(nodes.ny - 1, y + kReach); ++b) {
    for (int a = std::max(0, x - kReach); a <= std::min(nodes.nx - 1, x + kReach); ++a) {
      if (values[nodes.index(a, b)] < 0) return true;
    }
  }
  return false;
}

// Groups nodes into connected places by flood fill over the four neighbours. `found` ascends, and so do the first nodes
// of places.
std::vector<std::vector<std::size_t>> placesOf(const std::vector<std::size_t>& found, const Grid& nodes) {
  std::vector<std::vector<std::size_t>> places;
  std::vector<char> seen(found.size(), 0);
  std::vector<std::size_t> place;  // indices into `found`
  const std::size_t nx = nodes.nx;
  for (std::size_t first = 0; first < found.size(); ++first) {
    if (seen[first] != 0) continue;
    seen[first] = 1;
    place.assign(1, first);
    for (std::size_t k = 0; k < place.size(); ++k) {
      const std::size_t i = found[place[k]];  // never on the lattice's frame, which lies outside the shape
      for (const std::size_t j : {i - 1, i + 1, i - nx, i + nx}) {
        const auto next = std::lower_bound(found.begin(), found.end(), j);
        if (next == found.end() || *next != j) continue;
        const std::size_t at = next - found.begin();
        if (seen[at] != 0) continue;
        seen[at] = 1;
        place.push_back(at);
      }
    }
    for (std::size_t& k : place) k = found[k];
    places.push_back(place);
  }
  return places;
}

}  // namespace

void fillThinFeatures(const Grid& nodes, const std::vector<float>& distance, const BorderIndex& border, double spacing,
                      std::vector<float>& values) {
  // A bead has room at depths of half a spacing. Nodes up to `missed` less deep may lie beside such a place, which the
  // lattice has no node in.
  const auto deep = static_cast<float>(-0.5 * spacing);
  const float missed = deep + missedDepth(nodes.cell);
  const auto band = static_cast<float>(-spacing);
  const auto widest = static_cast<float>(-kWidestThin * spacing);
  const std::size_t nx = nodes.nx;
  const auto fill = [&](const std::vector<std::size_t>& found, std::size_t smallest, float value) {
    for (const std::vector<std::size_t>& place : placesOf(found, nodes)) {
      if (place.size() < smallest) continue;
      for (const std::size_t i : place) values[i] = value;
    }
  };

  // Deepest of a node and its four neighbours.
  const auto deepestNear = [&](std::size_t i) {
    return std::min({distance[i], distance[i - 1], distance[i + 1], distance[i - nx], distance[i + nx]});
  };

  // 1. Lines hardly wider than a bead are filled all along: waves end in them anywhere, and leave gaps where they begin
  // anew.
  std::vector<std::size_t> found;
  for (int y = 1; y < nodes.ny - 1; ++y) {
    for (int x = 1; x < nodes.nx - 1; ++x) {
      const std::size_t i = nodes.index(x, y);
      if (distance[i] <= missed && deepestNear(i) > widest &&
          isNextToThinMiddle(border, nodes.centre(x, y), -static_cast<double>(distance[i]), spacing, nodes.cell))
        found.push_back(i);
    }
  }
  fill(found, kShortestLine, kLine);

  // 2. Other places near the border that have room for a bead and no contour nearby, such as arms at whose mouth a
  // contour ends. They are filled if they are large enough to be worth two U-turns.
  found.clear();
  for (int y = 1; y < nodes.ny - 1; ++y) {
    for (int x = 1; x < nodes.nx - 1; ++x) {
      const std::size_t i = nodes.index(x, y);
      if (distance[i] > missed || distance[i] <= band || values[i] < 0 || contourNear(nodes, values, x, y)) continue;
      // The node itself is deep enough, or lies beside a place that is, as the exact distance tells.
      if (distance[i] <= deep || (deepestNear(i) > deep && hasBeadRoom(border, nodes.centre(x, y), spacing)))
        found.push_back(i);
    }
  }
  fill(found, kSmallest, kFilled);
}

void keepThinParts(const Parts& parts, const SignedDistanceField& sdf, const BorderIndex& border, double spacing,
                   std::vector<float>& values) {
  const Grid& grid = parts.grid;
  const Grid nodes = nodeLattice(grid);
  // Parts with a negative value have a contour.
  std::vector<char> kept(parts.count, 0);
  for (int y = 0; y < nodes.ny; ++y) {
    for (int x = 0; x < nodes.nx; ++x) {
      if (values[nodes.index(x, y)] >= 0) continue;
      const std::int32_t label = parts.label[grid.index(std::min(x / 2, grid.nx - 1), std::min(y / 2, grid.ny - 1))];
      if (label >= 0 && label < parts.count) kept[label] = 1;
    }
  }
  // The other parts are dots, and places close beside other parts. A dot gets one circle: several contours in it would
  // be joined with kinks.
  const auto deep = static_cast<float>(-0.5 * spacing);
  const float missed = deep + missedDepth(grid.cell);
  std::vector<std::vector<std::size_t>> roomy(parts.count);
  for (int y = 0; y < grid.ny; ++y) {
    for (int x = 0; x < grid.nx; ++x) {
      const std::size_t i = grid.index(x, y);
      const std::int32_t label = parts.label[i];
      if (label < 0 || label >= parts.count || kept[label] || sdf.distance[i] > missed) continue;
      if (sdf.distance[i] > deep && !hasBeadRoom(border, grid.centre(x, y), spacing)) continue;
      roomy[label].push_back(i);
    }
  }
  // In a dot only the deepest cell is filled. The centre of cell (x, y) is the node (2 x + 1, 2 y + 1).
  const std::size_t nx = grid.nx;
  for (std::vector<std::size_t>& cells : roomy) {
    if (cells.size() <= kDotCells) {
      const auto deepest = std::min_element(
          cells.begin(), cells.end(), [&](std::size_t i, std::size_t j) { return sdf.distance[i] < sdf.distance[j]; });
      if (deepest != cells.end()) cells = {*deepest};
    }
    for (const std::size_t i : cells)
      values[nodes.index(2 * static_cast<int>(i % nx) + 1, 2 * static_cast<int>(i / nx) + 1)] = kFilled;
  }
}

}  // namespace sillon
