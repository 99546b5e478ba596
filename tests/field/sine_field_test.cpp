#include "field/fields.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "geometry/signed_distance.hpp"
#include "support/scenes.hpp"

using namespace sillon;

namespace {

constexpr int kReach = 4;  // nodes

SineField randomWaves(int nx, int ny, scenes::Random& random) {
  SineField field;
  field.grid = Grid{{0, 0}, 0.2, nx, ny};
  field.spacing = 0.4;
  for (int k = 0; k < nx * ny; ++k) {
    const double angle = random.in(0, 3);
    const double phase = random.in(-3, 3);
    field.wave.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))});
    field.phase.push_back({static_cast<float>(std::cos(phase)), static_cast<float>(std::sin(phase))});
  }
  return field;
}

// The Gaussian of a cell `k` nodes away, over the sum for nodes of the same parity.
double weightOf(int k, double sigma) {
  const auto bell = [&](int n) { return std::exp(-(n * 0.25) * (n * 0.25) / (2 * sigma * sigma)); };
  const bool even = k % 2 == 0;
  return bell(k) / (even ? bell(0) + 2 * (bell(2) + bell(4)) : 2 * (bell(1) + bell(3)));
}

}  // namespace

TEST_CASE("deep inside, each node has the weighted waves of the cells within reach, for rows of any length") {
  scenes::Random random(6);
  const ToolpathParams params;
  for (const int nx : {5, 8, 11, 18}) {
    CAPTURE(nx);
    const SineField field = randomWaves(nx, 13, random);
    const Grid nodes = nodeLattice(field.grid);
    const auto values = evaluateSineField(field, std::vector<float>(nodes.size(), -10.0f), params, RunContext(2));
    REQUIRE(values.ok());
    // Eq. 13 for each pair of cell and node by itself.
    std::vector<double> expected(nodes.size(), 0.0);
    for (int y = 0; y < field.grid.ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        const std::size_t cell = field.grid.index(x, y);
        const std::complex<double> q(field.phase[cell].x, field.phase[cell].y);
        for (int b = -kReach; b <= kReach; ++b) {
          for (int a = -kReach; a <= kReach; ++a) {
            const int column = 2 * x + 1 + a;
            const int row = 2 * y + 1 + b;
            if (column < 0 || row < 0 || column >= nodes.nx || row >= nodes.ny) continue;
            const double turn =
                0.25 * std::numbers::pi *
                (a * static_cast<double>(field.wave[cell].x) + b * static_cast<double>(field.wave[cell].y));
            expected[nodes.index(column, row)] += weightOf(std::abs(a), params.kernelRadius / 3) *
                                                  weightOf(std::abs(b), params.kernelRadius / 3) *
                                                  (q * std::polar(1.0, turn)).imag();
          }
        }
      }
    }
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      CAPTURE(n);
      CHECK(std::abs(static_cast<double>(values.value()[n]) - expected[n]) < 2e-5);
    }
  }
}
