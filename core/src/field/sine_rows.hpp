// The two loops over rows of cells that evaluating the sine field is made of. They take four cells at a time.
#pragma once

#include <cstddef>

namespace sillon {

/// Nodes reached by a cell in each direction, in half cells.
inline constexpr int kNodeReach = 4;

/// Cells are taken in whole vectors: rows are as long as a multiple of this, with no wave after their end.
inline constexpr std::size_t kRowMultiple = 4;

/// e^{i k angle} for k from 1 to kNodeReach.
struct PowerRow {
  const float* angle;
  float* cos[kNodeReach + 1];  ///< out; [0] is left as it is
  float* sin[kNodeReach + 1];
};
void fillPowers(const PowerRow& row, std::size_t cells);

/// A row of cells, and the row of nodes to which its waves are added.
struct NodeSums {
  const float* qr;  ///< phases
  const float* qi;
  const float* cy;  ///< the powers that bring them to the nodes' row
  const float* sy;
  float sign;              ///< of sy
  float weightY;           ///< of that row
  const float* weightX;    ///< by columns away
  const float* const* cx;  ///< powers by columns away
  const float* const* sx;
  float* r;  ///< room for the waves in the nodes' row
  float* i;
  float* even;  ///< in and out: node 2m is even[m + 2], node 2x + 1 is odd[x + 2]; both 6 longer than the row of cells
  float* odd;
};
/// Eq. 13 for the waves of one row of cells and one row of nodes.
void addToNodes(const NodeSums& sums, std::size_t cells);

}  // namespace sillon
