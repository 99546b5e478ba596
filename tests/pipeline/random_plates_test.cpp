// Promises that hold for any shape, field and parameters: one simple closed path per part, no spill, bounded work, for
// 320 random plates and 120 drawings of many solids.
#include <doctest/doctest.h>

#include "sillon/geometry/outline.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"
#include "support/random_plates.hpp"

using namespace sillon;

TEST_CASE("plates that once came out wrong keep the promises") {
  // Cycles whose few points were used up by joints among themselves (550, 956, 1534, 1667, 1924), a path whose near end
  // is a joint (1609), one that only a used piece faces (1116), tips too
  // sharp for a joint (1302), tiny cycles that a joint turned inside out (20526,
  // 21949), segments that relaxation let cross, long ones (867) and the second next (1193), and a cycle that shrank to
  // nothing (11599).
  const RunContext run(2);
  constexpr std::uint64_t kSeeds[] = {550, 867, 956, 1116, 1193, 1302, 1534, 1609, 1667, 1924, 11599, 20526, 21949};
  for (const std::uint64_t seed : kSeeds) {
    const scenes::RandomPlate plate = scenes::randomPlate(seed);
    CAPTURE(seed);
    const auto result = generateToolpath(plate.input, plate.params, run);
    REQUIRE(result.ok());
    CHECK(static_cast<int>(result.value().toolpath.cycles.size()) == result.value().parts);
    const Measures m = measureToolpath(result.value().toolpath, plate.input.shape, plate.input.directions,
                                       plate.input.modes, plate.params, run)
                           .value();
    CHECK(m.crossings == 0);
    CHECK(m.spill <= scenes::spillAllowed(plate, result.value()));
  }
}

namespace {

// Joints looked at per cell. The most among 400 random plates is 12, among 900 drawings 106.
constexpr double kMostWork = 300;

// What every plate that can be made keeps. \return false if it has no room for a bead.
bool keepsPromises(const scenes::RandomPlate& plate, const RunContext& run, Measures& m, int& unjoined) {
  CAPTURE(plate.name);
  const auto result = generateToolpath(plate.input, plate.params, run);
  if (!result.ok()) {
    CHECK(result.error().code == ErrorCode::EmptyShape);
    return false;
  }
  const ToolpathResult& made = result.value();
  const auto measures =
      measureToolpath(made.toolpath, plate.input.shape, plate.input.directions, plate.input.modes, plate.params, run);
  REQUIRE(measures.ok());
  m = measures.value();
  unjoined = made.unjoined;
  CHECK(m.crossings == 0);
  CHECK(static_cast<std::int64_t>(made.toolpath.cycles.size()) == made.parts + made.unjoined);
  CHECK(m.spill <= scenes::spillAllowed(plate, made));
  CHECK(m.coverage > 0);
  CHECK(m.coverage <= 100);
  CHECK(static_cast<double>(made.stitchWork) <= kMostWork * made.nx * made.ny);
  return true;
}

}  // namespace

TEST_CASE("320 random plates keep the promises") {
  const RunContext run(2);
  int made = 0;
  int kinked = 0;
  for (std::uint64_t seed = 1; seed <= 320; ++seed) {
    CAPTURE(seed);
    Measures m;
    int unjoined = 0;
    if (!keepsPromises(scenes::randomPlate(seed), run, m, unjoined)) continue;
    ++made;
    CHECK(unjoined == 0);
    kinked += static_cast<double>(m.kinks) > 0.05 * static_cast<double>(m.uTurns) ? 1 : 0;
  }
  CHECK(made >= 300);
  // Where a strand crosses from one solid to another, or an arm leaves no room to turn, a kink may stay.
  CHECK(kinked <= made / 50);
}

TEST_CASE("120 random drawings of many solids keep the promises") {
  const RunContext run(2);
  int made = 0;
  int apart = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    CAPTURE(seed);
    Measures m;
    int unjoined = 0;
    if (!keepsPromises(scenes::randomDrawing(seed), run, m, unjoined)) continue;
    ++made;
    apart += unjoined > 0 ? 1 : 0;
  }
  CHECK(made >= 100);
  CHECK(apart <= made / 20);  // solids of icons that hang together by lines too thin for a bead
}
