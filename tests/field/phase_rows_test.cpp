#include "field/phase_rows.hpp"

#include <doctest/doctest.h>

#include <cstring>

#include "base/simd.hpp"
#include "sillon/pipeline/stages.hpp"
#include "support/scenes.hpp"

using namespace sillon;

namespace {

SineField wavesOf(const PlateInput& input, const ToolpathParams& params, bool eight) {
  const bool before = eightAtOnce;
  eightAtOnce = eight;
  Stages stages = generateStages(input, params, RunContext(2)).value();
  eightAtOnce = before;
  return std::move(stages.waves);
}

bool sameBytes(const std::vector<Vec2f>& a, const std::vector<Vec2f>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

}  // namespace

TEST_CASE("phases of cells taken eight at once are those of cells taken four at once, to the last bit") {
  if (!eightAtOnce) {
    MESSAGE("skipped: this processor, or this program, has no AVX2");
    return;
  }
  ToolpathParams moved;
  moved.seed = 5;
  ToolpathParams published;
  published.phaseTransport = PhaseTransport::Neighbour;
  published.seed = 2;
  ToolpathParams soft;
  soft.perimeterMode = PerimeterMode::Soft;
  // Rows of levels end anywhere within a vector.
  for (const double width : {7.0, 8.3, 9.1, 12.2, 13.0}) {
    const PlateInput input =
        scenes::plate(scenes::shapeOf({scenes::circle({width / 2, 5}, 0.49 * width)}, {width, 10}), scenes::waves());
    for (const ToolpathParams& params : {ToolpathParams{}, moved, published, soft}) {
      const SineField eight = wavesOf(input, params, true);
      const SineField four = wavesOf(input, params, false);
      CAPTURE(width);
      REQUIRE(eight.phase.size() > 300);
      CHECK(sameBytes(eight.wave, four.wave));
      CHECK(sameBytes(eight.phase, four.phase));
    }
  }
}
