#include "sillon/field/sine_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/cancelled.hpp"
#include "base/fast_math.hpp"
#include "base/parallel_for.hpp"
#include "field/sine_rows.hpp"

namespace sillon {
namespace {

using Weights = std::array<float, kNodeReach + 1>;

// exp(-(k tau/4)² / 2 sigma²), divided by the sum over the nodes of the same parity, so that the whole stencil sums to
// one. Cells outside the shape are left out of the sum without renormalising: that scales the field along the border
// but moves no zero.
Weights weights(double sigma) {
  const double exponent = 1 / (32 * sigma * sigma);
  double inverse = 0;  // e^exponent by its series, alike on all machines
  double term = 1;
  for (int n = 1; n <= 40; ++n) {
    inverse += term;
    term *= exponent / n;
  }
  std::array<double, kNodeReach + 1> bell{};
  for (std::size_t k = 0; k <= kNodeReach; ++k) {
    bell[k] = 1;
    for (std::size_t n = 0; n < k * k; ++n) bell[k] /= inverse;
  }
  const double even = bell[0] + 2 * (bell[2] + bell[4]);
  const double odd = 2 * (bell[1] + bell[3]);
  Weights weights{};
  for (std::size_t k = 0; k <= kNodeReach; ++k) weights[k] = static_cast<float>(bell[k] / (k % 2 == 0 ? even : odd));
  return weights;
}

using Powers = std::array<std::vector<float>, kNodeReach + 1>;

// The waves of one row of cells (Eq. 6) at the nodes around them: q and the powers e^{i k pi/4 d_x}, e^{i k pi/4 d_y},
// k = 0..4, by which a wave advances k nodes.
struct CellRow {
  std::size_t cells;   ///< without those after the row's end
  std::size_t padded;  ///< with them
  std::vector<float> qr, qi, angleX, angleY;
  Powers cx, sx, cy, sy;

  explicit CellRow(std::size_t nx) : cells(nx), padded((nx + kRowMultiple - 1) / kRowMultiple * kRowMultiple) {
    for (auto* v : {&qr, &qi, &angleX, &angleY}) v->resize(padded);
    for (auto* powers : {&cx, &sx, &cy, &sy}) {
      for (std::vector<float>& v : *powers) v.resize(padded);
    }
    std::fill(cx[0].begin(), cx[0].end(), 1.0f);
    std::fill(cy[0].begin(), cy[0].end(), 1.0f);
  }

  void fill(const SineField& field, int y) {
    const std::size_t first = field.grid.index(0, y);
    for (std::size_t x = 0; x < cells; ++x) {
      qr[x] = field.phase[first + x].x;
      qi[x] = field.phase[first + x].y;
      angleX[x] = 0.25f * kPi * field.wave[first + x].x;
      angleY[x] = 0.25f * kPi * field.wave[first + x].y;
    }
    power(angleX, cx, sx);
    power(angleY, cy, sy);
  }

 private:
  void power(const std::vector<float>& angle, Powers& cos, Powers& sin) const {
    PowerRow row{angle.data(), {}, {}};
    for (std::size_t k = 0; k <= kNodeReach; ++k) {
      row.cos[k] = cos[k].data();
      row.sin[k] = sin[k].data();
    }
    fillPowers(row, padded);
  }
};

// Sums of one row of nodes, split by parity of the column: see NodeSums.
struct NodeRow {
  std::vector<float> even, odd;
  explicit NodeRow(std::size_t padded) : even(padded + 6), odd(padded + 6) {}
};

// Adds the waves of a cell row to a node row `b` half cells above it. \param r, i  room for as many cells
void addRow(const CellRow& cells, const Weights& weight, int b, std::vector<float>& r, std::vector<float>& i,
            NodeRow& out) {
  const std::size_t k = static_cast<std::size_t>(std::abs(b));
  std::array<const float*, kNodeReach + 1> cx{};
  std::array<const float*, kNodeReach + 1> sx{};
  for (std::size_t a = 0; a <= kNodeReach; ++a) {
    cx[a] = cells.cx[a].data();
    sx[a] = cells.sx[a].data();
  }
  addToNodes({.qr = cells.qr.data(),
              .qi = cells.qi.data(),
              .cy = cells.cy[k].data(),
              .sy = cells.sy[k].data(),
              .sign = b < 0 ? -1.0f : 1.0f,
              .weightY = weight[k],
              .weightX = weight.data(),
              .cx = cx.data(),
              .sx = sx.data(),
              .r = r.data(),
              .i = i.data(),
              .even = out.even.data(),
              .odd = out.odd.data()},
             cells.padded);
}

float borderRamp(float value, float distance, float spacing) {
  if (distance >= 0) return 1;
  return distance >= -0.5f * spacing ? 2 * distance / spacing + 1 : value;
}

}  // namespace

Result<std::vector<float>> evaluateSineField(const SineField& field, const std::vector<float>& nodeDistance,
                                             const ToolpathParams& params, const RunContext& run) {
  const Grid& grid = field.grid;
  const std::size_t nx = static_cast<std::size_t>(grid.nx);
  const std::size_t columns = 2 * nx + 1;
  const int nodeRows = 2 * grid.ny + 1;
  std::vector<float> values(columns * static_cast<std::size_t>(nodeRows));
  const float spacing = static_cast<float>(field.spacing);
  const Weights weight = weights(params.kernelRadius / 3);
  // A band of cell rows owns the node rows 2y and 2y + 1 of its rows; sums run in order of the cell rows, so bands of
  // any height give the same result.
  const int grain = std::max(8, grid.ny / (4 * run.threads()));
  parallelFor(run, grid.ny + 1, grain, [&](int begin, int end) {
    const int firstNode = 2 * begin;
    const int lastNode = std::min(2 * end - 1, nodeRows - 1);
    CellRow cells(nx);
    std::vector<float> r(cells.padded);
    std::vector<float> i(cells.padded);
    constexpr int kOpen = 2 * kNodeReach + 1;  // node rows still receiving
    std::vector<NodeRow> rows(kOpen, NodeRow(cells.padded));
    // Eq. 13: the nodes' sums of the weighted waves of the cells around them. The sum of the weights is in `weights`.
    const auto flush = [&](int j) {
      NodeRow& row = rows[static_cast<std::size_t>(j % kOpen)];
      const std::size_t first = static_cast<std::size_t>(j) * columns;
      for (std::size_t x = 0; x <= nx; ++x) {
        values[first + 2 * x] = borderRamp(row.even[x + 2], nodeDistance[first + 2 * x], spacing);
        if (x < nx) values[first + 2 * x + 1] = borderRamp(row.odd[x + 2], nodeDistance[first + 2 * x + 1], spacing);
      }
      std::fill(row.even.begin(), row.even.end(), 0.0f);
      std::fill(row.odd.begin(), row.odd.end(), 0.0f);
    };
    int flushed = firstNode;
    const int firstCell = std::max(0, begin - 3);
    const int lastCell = std::min(grid.ny - 1, end + 2);
    for (int y = firstCell; y <= lastCell && !run.cancelled(); ++y) {
      // Node rows below the reach of this cell row are complete.
      for (; flushed < std::min(2 * y + 1 - kNodeReach, lastNode + 1); ++flushed) flush(flushed);
      cells.fill(field, y);
      for (int b = -kNodeReach; b <= kNodeReach; ++b) {
        const int j = 2 * y + 1 + b;
        if (j >= firstNode && j <= lastNode) addRow(cells, weight, b, r, i, rows[static_cast<std::size_t>(j % kOpen)]);
      }
    }
    for (; flushed <= lastNode; ++flushed) flush(flushed);
  });
  if (run.cancelled()) return cancelledRun();
  return values;
}

}  // namespace sillon
