// Any bytes as a shape, directions, modes, and settings of outline, toolpath and print: a plate that keeps its promises
// and whose file for one of the machines the checker passes, or an error with a message.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bytes.hpp"
#include "geometry/parts.hpp"
#include "sillon/gcode/writer.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/settings/presets.hpp"

namespace {

const sillon::Printer& machineOf(std::uint8_t byte) {
  static const std::vector<sillon::PrinterProfile> machines = sillon::profiles(sillon::ProfileKind::Printer);
  return machines[byte % machines.size()].printer;
}

sillon::PrintParams printOf(fuzz::Bytes& bytes) {
  sillon::PrintParams print;
  print.layers = 1 + bytes.byte() % 3;
  print.base = bytes.byte() % 4;
  print.basePattern = static_cast<sillon::BasePattern>(bytes.byte() % 4);
  print.basePerimeters = bytes.byte() % 3;
  print.showSide = static_cast<sillon::ShowSide>(bytes.byte() % 3);
  print.skirt = bytes.byte() % 3;
  print.brim = bytes.byte() % 3;
  print.copies = {1.0 + bytes.byte() % 2, 1.0 + bytes.byte() % 2};
  print.copyGap = 1 + 10 * bytes.share();
  print.layerHeight = 0.08 + 0.24 * bytes.share();
  const std::uint8_t ways = bytes.byte();
  print.mirror = (ways & 1) != 0;
  print.constantFlow = (ways & 2) != 0;
  print.coast = (ways & 4) != 0 ? 1 : 0;
  print.scarf = (ways & 12) == 8 ? 20 * bytes.share() : 0;
  print.rotate = (ways & 16) != 0 ? 360 * bytes.share() : 0;
  print.elephantFoot = (ways & 32) != 0 ? 0.5 * bytes.share() : 0;
  if ((ways & 64) != 0) {
    print.rim = 1 + bytes.byte() % 3;
    print.rimWidth = 0.1 + 5 * bytes.share();
  }
  return print;
}

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sillon;
  fuzz::Bytes bytes(data, size);
  ToolpathParams params;
  params.spacing = 0.2 + 2 * bytes.share();
  params.perimeterMode = static_cast<PerimeterMode>(bytes.byte() % 3);
  params.perimeters = bytes.byte() % 4;
  params.seed = bytes.byte() % 3;
  params.spacingVariation = 0.5 * bytes.share();
  params.directionTolerance = bytes.byte() % 4 == 1 ? 30 : 0;
  params.relaxationRounds = bytes.byte() % 4;
  params.beadOverlap = bytes.byte() % 4 == 1 ? bytes.share() : params.beadOverlap;
  params.simplifyTolerance = bytes.byte() % 4 == 1 ? bytes.share() : params.simplifyTolerance;
  const Printer& printer = machineOf(bytes.byte());
  const PrintParams print = printOf(bytes);
  PlateInput input;
  input.showsPictures = bytes.byte() % 4 == 1;
  enum { AsItIs, KeepThin, Offset, Hole };
  const int change = bytes.byte() % 4;
  const double offset = change == Offset ? 8 * bytes.share() - 4 : 0;
  const Vec2 middle{change == Hole ? bytes.share() : 0, change == Hole ? bytes.share() : 0};
  const double diameter = change == Hole ? 10 * bytes.share() : 0;
  input.directions = {1 + bytes.byte() % 4, 1 + bytes.byte() % 4, {}};
  for (int k = 0; k < input.directions.width * input.directions.height; ++k)
    input.directions.angle.push_back(static_cast<std::uint16_t>(257 * bytes.byte()));
  input.modes = {1 + bytes.byte() % 2, 1, {}};
  for (int k = 0; k < input.modes.width; ++k) input.modes.mode.push_back(static_cast<DirectionMode>(bytes.byte() % 4));

  // Points on a grid of up to forty spacings, so that many meet, and rarely one between its lines.
  const double step = params.spacing * (0.02 + bytes.share()) * 40 / 255;
  FilledPath path{{{}}, bytes.byte() % 2 == 0 ? FillRule::EvenOdd : FillRule::NonZero};
  Vec2 far{step, step};
  while (!bytes.empty()) {
    const std::uint8_t x = bytes.byte();
    if (x == 255) {
      path.rings.emplace_back();
      continue;
    }
    Vec2 p{step * x, step * bytes.byte()};
    if (x == 254) p = {p.x * bytes.share(), p.y * bytes.share()};
    far = {std::max(far.x, p.x), std::max(far.y, p.y)};
    path.rings.back().push_back(p);
  }
  input.shape = {{path}, far};

  const RunContext run(1);
  if (change != AsItIs) {
    auto changed = change == KeepThin ? keepThinPlaces(input.shape, params.spacing, run)
                   : change == Offset ? offsetShape(input.shape, offset, run)
                                      : withHoles(input.shape, {{{middle.x * far.x, middle.y * far.y}, diameter}});
    if (!changed) {
      require(!changed.error().message.empty());
      return 0;
    }
    input.shape = std::move(changed).value();
  }
  const auto plate = generateToolpath(input, params, run);
  if (!plate) {
    require(!plate.error().message.empty());
    return 0;
  }
  const Toolpath& toolpath = plate.value().toolpath;
  require(static_cast<std::int64_t>(toolpath.cycles.size()) == plate.value().parts + plate.value().unjoined);
  for (const Cycle& cycle : toolpath.cycles) {
    require(cycle.points.size() >= 3 && cycle.points.size() == cycle.widths.size());
    for (const float width : cycle.widths) {
      require(width > 0 && static_cast<double>(width) <= params.maxWidth * params.spacing + 0.001);
    }
  }
  const auto measures = measureToolpath(toolpath, input, params, run);
  require(measures.ok());
  require(measures.value().crossings == 0);
  require(measures.value().coverage <= 100);

  Toolpath across;
  if (needsAcross(print)) {
    const auto below = generateAcross(input, params, run);
    require(below.ok());
    across = below.value().toolpath;
  }
  std::string text;
  const auto sink = [&](std::string_view piece) {
    text += piece;
    return true;
  };
  const auto written = writeGcode(toolpath, input.shape, printer, print, sink, &across);
  if (!written) {
    require(text.empty() && !written.error().message.empty());
    return 0;
  }
  require(checkGcode(text, printer).errors() == 0);
  return 0;
}
