#include "sillon/look/preview.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace sillon;

namespace {

/// The same direction.
bool same(double a, double b) { return std::abs(std::remainder(a - b, 360)) < 1e-3; }

}  // namespace

TEST_CASE("one lamp goes round once, in even steps") {
  const std::vector<LoopFrame> frames = loopFrames(std::vector<Lamp>{{350, 40, 0.1}});
  REQUIRE(frames.size() == 36);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    CHECK(same(frames[k].lamp.azimuth, 350 + 10.0 * static_cast<double>(k)));
    CHECK(frames[k].lamp.elevation == 40);
    CHECK(frames[k].lamp.slope == 0.1);
    CHECK(frames[k].milliseconds == 100);
    CHECK_FALSE(invalidLamp(frames[k].lamp));
  }
}

TEST_CASE("several lamps are held in turn, with a quick way to the next, the short way round") {
  const std::vector<LoopFrame> frames = loopFrames(std::vector<Lamp>{{350, 40, 0.1}, {20, 60, 0.1}});
  REQUIRE(frames.size() == 14);
  for (std::size_t k = 0; k < frames.size(); ++k) CHECK(frames[k].milliseconds == (k % 7 == 0 ? 1200 : 60));
  CHECK(same(frames[0].lamp.azimuth, 350));
  CHECK(same(frames[7].lamp.azimuth, 20));
  CHECK(frames[7].lamp.elevation == 60);
  for (const std::size_t k : {1, 13}) {  // there and back alike; web/test/unit/loop.test.ts has the same
    CHECK(same(frames[k].lamp.azimuth, 351.662));
    CHECK(frames[k].lamp.elevation == doctest::Approx(41.108).epsilon(1e-4));
  }
}

TEST_CASE("qualities fall, and never reach nothing") {
  const std::vector<int> qualities = loopQualities();
  REQUIRE(qualities.size() > 2);
  CHECK(qualities.front() <= 100);
  CHECK(qualities.back() > 0);
  for (std::size_t k = 1; k < qualities.size(); ++k) CHECK(qualities[k] < qualities[k - 1]);
}
