#include "field/fields.hpp"

#include <array>
#include <cmath>

#include "base/fast_math.hpp"
#include "base/parallel_for.hpp"
#include "base/simd.hpp"

namespace sillon {
namespace {

/// Reach of a cell's wave in each direction [half cells].
constexpr int kNodeReach = 4;

/// Cells per vector: rows are as long as a multiple of this, with no wave after their end.
constexpr std::size_t kLanes = 4;

using Weights = std::array<float, kNodeReach + 1>;

// Weights exp(-(k tau/4)² / 2 sigma²), divided by the sum over the nodes of the same parity, so that the whole stencil
// sums to one. Cells outside the shape are left out of the sum without renormalising: that scales the field along the
// border but moves no zero.
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

// Powers e^{i k angle} for k from 0 to kNodeReach, for each cell of a row.
struct Powers {
  std::array<std::vector<float>, kNodeReach + 1> cos;
  std::array<std::vector<float>, kNodeReach + 1> sin;

  explicit Powers(std::size_t cells) {
    for (std::vector<float>& v : cos) v.resize(cells);
    for (std::vector<float>& v : sin) v.resize(cells);
    std::fill(cos[0].begin(), cos[0].end(), 1.0f);
  }

  // One sine and cosine per cell; each further power is a complex product.
  void fill(const std::vector<float>& angle) {
    for (std::size_t x = 0; x < angle.size(); x += kLanes) {
      const SinCos4 first = sillon::sinCos(load4(&angle[x]));
      F4 c = first.cos;
      F4 s = first.sin;
      for (std::size_t k = 1;; ++k) {
        store4(&cos[k][x], c);
        store4(&sin[k][x], s);
        if (k == kNodeReach) break;
        const F4 next = c * first.cos - s * first.sin;
        s = c * first.sin + s * first.cos;
        c = next;
      }
    }
  }
};

// The waves of one row of cells (Eq. 6) at the nodes around them: q and the powers e^{i k pi/4 d_x}, e^{i k pi/4 d_y},
// k = 0..4, by which a wave advances k nodes.
struct CellRow {
  std::size_t cells;   ///< cells of the row
  std::size_t padded;  ///< cells with those after the row's end, a multiple of kLanes
  std::vector<float> qr, qi, angleX, angleY;
  Powers alongX, alongY;

  explicit CellRow(std::size_t nx)
      : cells(nx), padded((nx + kLanes - 1) / kLanes * kLanes), alongX(padded), alongY(padded) {
    for (auto* v : {&qr, &qi, &angleX, &angleY}) v->resize(padded);
  }

  void fill(const SineField& field, int y) {
    const std::size_t first = field.grid.index(0, y);
    for (std::size_t x = 0; x < cells; ++x) {
      qr[x] = field.phase[first + x].x;
      qi[x] = field.phase[first + x].y;
      angleX[x] = 0.25f * kPi * field.wave[first + x].x;
      angleY[x] = 0.25f * kPi * field.wave[first + x].y;
    }
    alongX.fill(angleX);
    alongY.fill(angleY);
  }
};

// Sums of one row of nodes, split by parity of the column: node 2m is even[m + 2], node 2x + 1 is odd[x + 2].
struct NodeRow {
  std::vector<float> even, odd;
  explicit NodeRow(std::size_t padded) : even(padded + 6), odd(padded + 6) {}
};

// A row's waves, advanced to the row of nodes to which they are added.
struct WaveRow {
  std::vector<float> re, im;
  explicit WaveRow(std::size_t padded) : re(padded), im(padded) {}
};

// Adds the waves of one row of cells to the row of nodes `b` half cells above it (Eq. 13). \param waves  memory for the
// advanced waves.
void addRow(const CellRow& cells, const Weights& weights, int b, WaveRow& waves, NodeRow& out) {
  const std::size_t up = std::abs(b);
  const F4 weightY = splat(weights[up]);
  const F4 sign = splat(b < 0 ? -1.0f : 1.0f);
  const F4 weight0 = splat(weights[0]);
  const float* const cy = cells.alongY.cos[up].data();
  const float* const sy = cells.alongY.sin[up].data();
  float* const re = waves.re.data();
  float* const im = waves.im.data();
  float* const centre = out.odd.data() + 2;
  for (std::size_t x = 0; x < cells.padded; x += kLanes) {
    const F4 qr = load4(&cells.qr[x]);
    const F4 qi = load4(&cells.qi[x]);
    const F4 c = load4(cy + x);
    const F4 s = sign * load4(sy + x);
    // Advance each wave by b nodes along y; its imaginary part is the sine, its value.
    const F4 i = weightY * (qr * s + qi * c);
    store4(re + x, weightY * (qr * c - qi * s));
    store4(im + x, i);
    store4(centre + x, load4(centre + x) + weight0 * i);
  }
  for (std::size_t a = 1; a <= kNodeReach; ++a) {
    const float* const cx = cells.alongX.cos[a].data();
    const float* const sx = cells.alongX.sin[a].data();
    // Column 2x + 1 + a: odd row entry x + a/2, or even row entry x + (a + 1)/2; likewise to the left.
    float* const right = a % 2 == 0 ? out.odd.data() + 2 + a / 2 : out.even.data() + 2 + (a + 1) / 2;
    float* const left = a % 2 == 0 ? out.odd.data() + 2 - a / 2 : out.even.data() + 2 - (a - 1) / 2;
    const F4 weight = splat(weights[a]);
    // One after the other: where both are added in one go, loads wait for stores to nearly the same place.
    for (std::size_t x = 0; x < cells.padded; x += kLanes) {
      const F4 wave = load4(im + x) * load4(cx + x) + load4(re + x) * load4(sx + x);
      store4(right + x, load4(right + x) + weight * wave);
    }
    for (std::size_t x = 0; x < cells.padded; x += kLanes) {
      const F4 wave = load4(im + x) * load4(cx + x) - load4(re + x) * load4(sx + x);
      store4(left + x, load4(left + x) + weight * wave);
    }
  }
}

// Mixes in the border: a ramp from 0 at a depth of tau/2 to 1 at the border, so that all contours close inside.
float borderRamp(float value, float distance, float spacing) {
  if (distance >= 0) return 1;
  return distance >= -0.5f * spacing ? 2 * distance / spacing + 1 : value;
}

}  // namespace

Result<std::vector<float>> evaluateSineField(const SineField& field, const std::vector<float>& nodeDistance,
                                             const ToolpathParams& params, const RunContext& run) {
  const Grid& grid = field.grid;
  const std::size_t nx = grid.nx;
  const std::size_t columns = 2 * nx + 1;
  const int nodeRows = 2 * grid.ny + 1;
  // Nodes are tau/4 apart, cells tau/2: sigma = tau/3 on this lattice raises alignment by 0.004, and lowers overlap by
  // a third, against tau/6 on tau/2.
  std::vector<float> values(columns * nodeRows);
  const float spacing = static_cast<float>(field.spacing);
  const Weights weight = weights(params.kernelRadius / 3);
  // A band of cell rows owns the node rows 2y and 2y + 1 of its rows; sums run in order of the cell rows, so that bands
  // of any height give the same result.
  const int grain = std::max(8, grid.ny / (4 * run.threads()));
  parallelFor(run, grid.ny + 1, grain, [&](int begin, int end) {
    const int firstNode = 2 * begin;
    const int lastNode = std::min(2 * end - 1, nodeRows - 1);
    CellRow cells(nx);
    WaveRow waves(cells.padded);
    constexpr int kOpen = 2 * kNodeReach + 1;  // node rows still receiving
    std::vector<NodeRow> rows(kOpen, NodeRow(cells.padded));
    // Eq. 13: the nodes' sums of the weighted waves of the cells around them. The sum of the weights is in `weights`.
    const auto flush = [&](int j) {
      NodeRow& row = rows[j % kOpen];
      const std::size_t first = j * columns;
      for (std::size_t x = 0; x <= nx; ++x) {
        values[first + 2 * x] = borderRamp(row.even[x + 2], nodeDistance[first + 2 * x], spacing);
        if (x < nx) values[first + 2 * x + 1] = borderRamp(row.odd[x + 2], nodeDistance[first + 2 * x + 1], spacing);
      }
      std::fill(row.even.begin(), row.even.end(), 0.0f);
      std::fill(row.odd.begin(), row.odd.end(), 0.0f);
    };
    // Cell rows beyond the band's ends reach into it, too; two bands compute them both.
    int flushed = firstNode;
    const int firstCell = std::max(0, begin - 3);
    const int lastCell = std::min(grid.ny - 1, end + 2);
    for (int y = firstCell; y <= lastCell && !run.cancelled(); ++y) {
      // Node rows below the reach of this cell row are complete.
      for (; flushed < std::min(2 * y + 1 - kNodeReach, lastNode + 1); ++flushed) flush(flushed);
      cells.fill(field, y);
      for (int b = -kNodeReach; b <= kNodeReach; ++b) {
        const int j = 2 * y + 1 + b;
        if (j >= firstNode && j <= lastNode) addRow(cells, weight, b, waves, rows[j % kOpen]);
      }
    }
    for (; flushed <= lastNode; ++flushed) flush(flushed);
  });
  if (run.cancelled()) return cancelledRun();
  return values;
}

}  // namespace sillon
