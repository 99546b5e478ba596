// The library in a page: a disc whose beads spiral around its centre, written as G-code.
//   minimal > spiral.gcode
#include <cmath>
#include <cstdio>

#include "sillon/gcode/writer.hpp"
#include "sillon/pipeline/pipeline.hpp"

namespace {

/// Directions as numbers instead of a picture: each texel's bead runs 60 degrees off the ray from the centre.
sillon::DirectionMap spiral(int side) {
  constexpr double kPi = 3.14159265358979323846;
  sillon::DirectionMap map;
  map.width = side;
  map.height = side;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double x = column + 0.5 - side / 2.0;
      const double y = side / 2.0 - (row + 0.5);  // row 0 is on top
      const double angle = std::atan2(y, x) + kPi / 3;
      const double line = angle - kPi * std::floor(angle / kPi + 0.5);  // a line has no sense: -90 to 90 degrees
      map.angle.push_back(static_cast<std::uint16_t>(std::lround((line / kPi + 0.5) * 65535)));
    }
  }
  return map;
}

int fail(const sillon::Error& error) {
  std::fprintf(stderr, "%s\n", error.message.c_str());
  return 1;
}

}  // namespace

int main() {
  const auto disc = sillon::makeDisc(40);  // mm
  if (!disc) return fail(disc.error());
  const sillon::PlateInput input{disc.value(), spiral(256), sillon::uniformMode(sillon::DirectionMode::Constrained)};

  sillon::ToolpathParams params;
  params.spacing = 0.4;  // mm between neighbouring beads

  const sillon::RunContext run(4);  // threads
  const auto plate = sillon::generateToolpath(input, params, run);
  if (!plate) return fail(plate.error());

  const auto summary = sillon::writeGcode(
      plate.value().toolpath, input.shape, sillon::Printer{}, sillon::PrintParams{},
      [](std::string_view text) { return std::fwrite(text.data(), 1, text.size(), stdout) == text.size(); });
  if (!summary) return fail(summary.error());
  std::fprintf(stderr, "%zu toolpath, %.1f g of filament, %.0f minutes\n", plate.value().toolpath.cycles.size(),
               summary.value().filamentGrams, summary.value().seconds / 60);
}
