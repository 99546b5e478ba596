#include "sillon/field/sine_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/cancelled.hpp"
#include "base/fast_math.hpp"
#include "base/parallel_for.hpp"

namespace sillon {
namespace {

constexpr int kReach = 4;  ///< nodes reached by a cell in each direction, in half cells

using Weights = std::array<float, kReach + 1>;

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
  std::array<double, kReach + 1> bell{};
  for (std::size_t k = 0; k <= kReach; ++k) {
    bell[k] = 1;
    for (std::size_t n = 0; n < k * k; ++n) bell[k] /= inverse;
  }
  const double even = bell[0] + 2 * (bell[2] + bell[4]);
  const double odd = 2 * (bell[1] + bell[3]);
  Weights weights{};
  for (std::size_t k = 0; k <= kReach; ++k) weights[k] = static_cast<float>(bell[k] / (k % 2 == 0 ? even : odd));
  return weights;
}

// The waves of one row of cells (Eq. 6) at the nodes around them: q and the powers e^{i k pi/4 d_x}, e^{i k pi/4 d_y},
// k = 0..4, by which a wave advances k nodes.
struct CellRow {
  std::vector<float> qr, qi;
  std::array<std::vector<float>, kReach + 1> cx, sx, cy, sy;

  explicit CellRow(std::size_t nx) : qr(nx), qi(nx) {
    for (auto* powers : {&cx, &sx, &cy, &sy}) {
      for (std::vector<float>& v : *powers) v.resize(nx);
    }
  }

  void fill(const SineField& field, int y) {
    const std::size_t nx = qr.size();
    const std::size_t first = field.grid.index(0, y);
    for (std::size_t x = 0; x < nx; ++x) {
      qr[x] = field.phase[first + x].x;
      qi[x] = field.phase[first + x].y;
      const SinCos ex = sinCos(0.25f * kPi * field.wave[first + x].x);
      const SinCos ey = sinCos(0.25f * kPi * field.wave[first + x].y);
      cx[0][x] = cy[0][x] = 1;
      sx[0][x] = sy[0][x] = 0;
      cx[1][x] = ex.cos;
      sx[1][x] = ex.sin;
      cy[1][x] = ey.cos;
      sy[1][x] = ey.sin;
    }
    for (std::size_t k = 2; k <= kReach; ++k) {
      for (std::size_t x = 0; x < nx; ++x) {
        cx[k][x] = cx[k - 1][x] * cx[1][x] - sx[k - 1][x] * sx[1][x];
        sx[k][x] = cx[k - 1][x] * sx[1][x] + sx[k - 1][x] * cx[1][x];
        cy[k][x] = cy[k - 1][x] * cy[1][x] - sy[k - 1][x] * sy[1][x];
        sy[k][x] = cy[k - 1][x] * sy[1][x] + sy[k - 1][x] * cy[1][x];
      }
    }
  }
};

// Sums of one row of nodes, split by parity of the column: node 2m in even[m + 2], node 2x + 1 in odd[x + 2].
struct NodeRow {
  std::vector<float> even, odd;
  explicit NodeRow(std::size_t nx) : even(nx + 6), odd(nx + 6) {}
};

// Adds the waves of a cell row to a node row `b` half cells above it.
void addRow(const CellRow& cells, const Weights& weight, int b, std::vector<float>& vr, std::vector<float>& vi,
            NodeRow& out) {
  const std::size_t nx = cells.qr.size();
  const std::size_t k = static_cast<std::size_t>(std::abs(b));
  const float sign = b < 0 ? -1.0f : 1.0f;
  const float* c = cells.cy[k].data();
  const float* s = cells.sy[k].data();
  for (std::size_t x = 0; x < nx; ++x) {
    const float si = sign * s[x];
    vr[x] = weight[k] * (cells.qr[x] * c[x] - cells.qi[x] * si);
    vi[x] = weight[k] * (cells.qr[x] * si + cells.qi[x] * c[x]);
  }
  const float* r = vr.data();
  const float* i = vi.data();
  float* centre = out.odd.data() + 2;
  for (std::size_t x = 0; x < nx; ++x) centre[x] += weight[0] * i[x];
  for (std::size_t a = 1; a <= kReach; ++a) {
    const float* ca = cells.cx[a].data();
    const float* sa = cells.sx[a].data();
    // Column 2x + 1 + a: odd row entry x + a/2, or even row entry x + (a + 1)/2; likewise to the left.
    float* right = a % 2 == 0 ? out.odd.data() + 2 + a / 2 : out.even.data() + 2 + (a + 1) / 2;
    float* left = a % 2 == 0 ? out.odd.data() + 2 - a / 2 : out.even.data() + 2 - (a - 1) / 2;
    for (std::size_t x = 0; x < nx; ++x) right[x] += weight[a] * (i[x] * ca[x] + r[x] * sa[x]);
    for (std::size_t x = 0; x < nx; ++x) left[x] += weight[a] * (i[x] * ca[x] - r[x] * sa[x]);
  }
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
    std::vector<float> vr(nx);
    std::vector<float> vi(nx);
    constexpr int kOpen = 2 * kReach + 1;  // node rows still receiving
    std::vector<NodeRow> rows(kOpen, NodeRow(nx));
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
      for (; flushed < std::min(2 * y + 1 - kReach, lastNode + 1); ++flushed) flush(flushed);
      cells.fill(field, y);
      for (int b = -kReach; b <= kReach; ++b) {
        const int j = 2 * y + 1 + b;
        if (j >= firstNode && j <= lastNode)
          addRow(cells, weight, b, vr, vi, rows[static_cast<std::size_t>(j % kOpen)]);
      }
    }
    for (; flushed <= lastNode; ++flushed) flush(flushed);
  });
  if (run.cancelled()) return cancelledRun();
  return values;
}

}  // namespace sillon
