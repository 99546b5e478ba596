// The library in a page: a disc whose beads spiral around its centre, written as G-code.
//   minimal > spiral.gcode
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "sillon/job/plate.hpp"

namespace {

/// Directions as numbers instead of a file: each pixel's bead runs 60 degrees off the ray from the centre.
sillon::Image spiral(int side) {
  constexpr double kPi = 3.14159265358979323846;
  sillon::Image picture{side, side, 1, {}};
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double x = column + 0.5 - side / 2.0;
      const double y = side / 2.0 - (row + 0.5);  // row 0 is on top
      const double angle = std::atan2(y, x) + kPi / 3;
      const double line = angle - kPi * std::floor(angle / kPi + 0.5);  // a line has no sense: -90 to 90 degrees
      picture.samples.push_back(static_cast<std::uint16_t>(std::lround((line / kPi + 0.5) * 65535)));
    }
  }
  return picture;
}

int fail(const sillon::Error& error) {
  std::fprintf(stderr, "%s\n", error.message.c_str());
  return 1;
}

}  // namespace

int main() {
  sillon::Project project;  // what a project file would say
  project.builtin = sillon::BuiltinShape::Disc;
  project.builtinSize.x = 40;  // mm
  project.layers.emplace_back().contents.emplace<sillon::MapLayer>().file = "spiral";
  project.toolpath.spacing = 0.4;  // mm between neighbouring beads

  const sillon::RunContext run(4);  // threads
  const auto read = [](const std::string& /*name*/, const std::string& /*what*/) {
    return sillon::Result<sillon::InputFile>(spiral(256));
  };
  auto plate = sillon::makePlate(project, read, {}, run);
  if (!plate) return fail(plate.error());

  const auto print = [](std::string_view text) {
    return std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  };
  if (const auto error = sillon::writePlateGcode(plate.value(), {}, print, run)) return fail(*error);
  std::fprintf(stderr, "%zu toolpath, %.1f g of filament, %.0f minutes\n", plate.value().toolpath().cycles.size(),
               plate.value().gcode->filamentGrams, plate.value().gcode->seconds / 60);
}
