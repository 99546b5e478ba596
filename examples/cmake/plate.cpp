// A disc, a bead every 0.5 mm: how long its toolpath is and how well it fills the disc.
#include <cstdio>

#include "sillon/sillon.hpp"

int main() {
  const auto disc = sillon::makeDisc(20);           // mm
  const auto lines = sillon::uniformDirection(30);  // degrees
  if (!disc || !lines) return 1;
  sillon::ToolpathParams params;
  params.spacing = 0.5;  // mm
  const sillon::PlateInput input{disc.value(), lines.value(), sillon::uniformMode(sillon::DirectionMode::Constrained)};
  const sillon::RunContext run(2);  // threads
  const auto plate = sillon::generateToolpath(input, params, run);
  if (!plate) {
    std::fprintf(stderr, "%s\n", plate.error().message.c_str());
    return 1;
  }
  std::printf("sillon %s: %zu toolpath of %zu points\n", sillon::kVersion, plate.value().toolpath.cycles.size(),
              plate.value().toolpath.cycles[0].points.size());
}
