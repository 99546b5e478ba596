#include "field/sine_rows.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "support/scenes.hpp"

using namespace sillon;

namespace {

constexpr std::size_t kCells = 5 * kRowMultiple;
using Rows = std::vector<std::vector<float>>;

struct Powers {
  Rows cos = Rows(kNodeReach + 1, std::vector<float>(kCells, 1.0f));
  Rows sin = Rows(kNodeReach + 1, std::vector<float>(kCells, 0.0f));

  explicit Powers(const std::vector<float>& angle) {
    PowerRow row{angle.data(), {}, {}};
    for (std::size_t k = 0; k <= kNodeReach; ++k) {
      row.cos[k] = cos[k].data();
      row.sin[k] = sin[k].data();
    }
    fillPowers(row, kCells);
  }
};

struct Waves {
  std::vector<float> qr, qi, angleX, angleY;

  explicit Waves(scenes::Random& random) {
    for (std::size_t x = 0; x < kCells; ++x) {
      const double phase = random.in(-3, 3);
      qr.push_back(static_cast<float>(std::cos(phase)));
      qi.push_back(static_cast<float>(std::sin(phase)));
      angleX.push_back(static_cast<float>(random.in(-1.5, 1.5)));
      angleY.push_back(static_cast<float>(random.in(-1.5, 1.5)));
    }
  }
};

const std::vector<float> kWeights{0.4f, 0.3f, 0.2f, 0.1f, 0.05f};

// The node row `b` half cells above a row of cells: columns 0 to 2 kCells, and those beyond that cells reach.
std::vector<float> nodesOf(const Waves& waves, int b) {
  const Powers x(waves.angleX), y(waves.angleY);
  std::vector<const float*> cx, sx;
  for (std::size_t a = 0; a <= kNodeReach; ++a) {
    cx.push_back(x.cos[a].data());
    sx.push_back(x.sin[a].data());
  }
  const auto k = static_cast<std::size_t>(std::abs(b));
  std::vector<float> r(kCells), i(kCells), even(kCells + 6), odd(kCells + 6);
  addToNodes({.qr = waves.qr.data(),
              .qi = waves.qi.data(),
              .cy = y.cos[k].data(),
              .sy = y.sin[k].data(),
              .sign = b < 0 ? -1.0f : 1.0f,
              .weightY = kWeights[k],
              .weightX = kWeights.data(),
              .cx = cx.data(),
              .sx = sx.data(),
              .r = r.data(),
              .i = i.data(),
              .even = even.data(),
              .odd = odd.data()},
             kCells);
  std::vector<float> nodes;
  for (std::size_t m = 0; m < even.size(); ++m) {
    nodes.push_back(even[m]);
    nodes.push_back(odd[m]);
  }
  return nodes;
}

}  // namespace

TEST_CASE("powers of a wave are those of its angle") {
  scenes::Random random(5);
  const Waves waves(random);
  const Powers powers(waves.angleX);
  for (std::size_t k = 1; k <= kNodeReach; ++k) {
    for (std::size_t x = 0; x < kCells; ++x) {
      const double angle = static_cast<double>(k) * static_cast<double>(waves.angleX[x]);
      CHECK(std::abs(static_cast<double>(powers.cos[k][x]) - std::cos(angle)) < 3e-6);
      CHECK(std::abs(static_cast<double>(powers.sin[k][x]) - std::sin(angle)) < 3e-6);
    }
  }
}

TEST_CASE("each node gets the weighted waves of the cells within reach") {
  scenes::Random random(6);
  for (int b = -kNodeReach; b <= kNodeReach; ++b) {
    const Waves waves(random);
    // Eq. 13 for each pair of cell and node by itself; column -4 is the first that cells reach.
    std::vector<double> expected(2 * kCells + 12, 0.0);
    for (std::size_t x = 0; x < kCells; ++x) {
      for (int a = -kNodeReach; a <= kNodeReach; ++a) {
        const std::complex<double> q(waves.qr[x], waves.qi[x]);
        const double turn = a * static_cast<double>(waves.angleX[x]) + b * static_cast<double>(waves.angleY[x]);
        const double weight = static_cast<double>(kWeights[static_cast<std::size_t>(std::abs(a))]) *
                              static_cast<double>(kWeights[static_cast<std::size_t>(std::abs(b))]);
        expected[static_cast<std::size_t>(2 * static_cast<int>(x) + 1 + a + 4)] +=
            weight * (q * std::polar(1.0, turn)).imag();
      }
    }
    const std::vector<float> nodes = nodesOf(waves, b);
    REQUIRE(nodes.size() == expected.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      CAPTURE(n);
      CHECK(std::abs(static_cast<double>(nodes[n]) - expected[n]) < 1e-5);
    }
  }
}
