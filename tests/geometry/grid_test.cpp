#include "geometry/signed_distance.hpp"

#include <doctest/doctest.h>

namespace {

TEST_CASE("the cell of a point is the one it lies in, and the nearest one from outside") {
  const sillon::Grid grid{{-1, 2}, 0.5, 4, 3};  // from (-1, 2) to (1, 3.5)
  for (int y = 0; y < grid.ny; ++y) {
    for (int x = 0; x < grid.nx; ++x) CHECK(grid.cellAt(grid.centre(x, y)) == grid.index(x, y));
  }
  CHECK(grid.cellAt({-0.5, 2.5}) == grid.index(1, 1));  // a corner belongs to the cell above and right of it
  CHECK(grid.cellAt({-0.501, 2.499}) == grid.index(0, 0));
  CHECK(grid.cellAt({-9, 2.75}) == grid.index(0, 1));
  CHECK(grid.cellAt({0.25, 99}) == grid.index(2, 2));
  CHECK(grid.cellAt({1e300, -1e300}) == grid.index(3, 0));  // no whole number holds it
}

}  // namespace
