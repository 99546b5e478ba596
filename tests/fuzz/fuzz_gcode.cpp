// Any bytes as start block, end block and numbers of a job: a file that the checker passes, or an error and no byte.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "bytes.hpp"
#include "gcode_reader/parser.hpp"
#include "sillon/gcode/writer.hpp"
#include "sillon/gcode_reader/check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sillon;
  fuzz::Bytes bytes(data, size);
  Printer printer;
  PrintParams params;
  printer.flavor = static_cast<GcodeFlavor>(bytes.byte() % 5);
  printer.roundBed = bytes.byte() % 4 == 1;
  printer.absoluteE = bytes.byte() % 4 == 1;
  for (double* field : {&printer.bedMin.x,
                        &printer.bedMin.y,
                        &printer.bedMax.x,
                        &printer.bedMax.y,
                        &printer.excludedMin.x,
                        &printer.excludedMax.x,
                        &printer.excludedMax.y,
                        &printer.maxZ,
                        &printer.nozzle,
                        &printer.filamentDiameter,
                        &printer.speed,
                        &printer.firstLayerSpeed,
                        &printer.acceleration,
                        &printer.cornerSpeed,
                        &printer.machineCornerSpeed,
                        &printer.machineAcceleration,
                        &printer.curveAcceleration,
                        &printer.maxFlow,
                        &printer.maxSegmentsPerSecond,
                        &printer.pressureAdvance,
                        &printer.retractLength,
                        &printer.lift,
                        &params.layerHeight,
                        &params.startHeight,
                        &params.firstLayerHeight,
                        &params.flow,
                        &params.elephantFoot,
                        &params.coast,
                        &params.copies.x,
                        &params.copyGap,
                        &params.rotate}) {
    *field = bytes.number(*field);
  }
  params.base = bytes.byte() % 5;
  params.layers = 1 + bytes.byte() % 3;
  params.skirt = bytes.byte() % 4;
  params.brim = bytes.byte() % 4;
  params.basePattern = static_cast<BasePattern>(bytes.byte() % 4);
  params.showSide = static_cast<ShowSide>(bytes.byte() % 3);
  params.constantFlow = bytes.byte() % 2 == 1;
  params.strict = bytes.byte() % 4 == 1;
  printer.setPressureAdvance = bytes.byte() % 4 == 1;
  Toolpath toolpath;
  toolpath.spacing = bytes.number(0.4);
  toolpath.cycles.resize(1);
  const int count = 3 + bytes.byte() % 20;
  for (int k = 0; k < count; ++k) {
    toolpath.cycles[0].points.push_back(
        {static_cast<float>(bytes.number(bytes.byte() / 45.0)), static_cast<float>(bytes.number(bytes.byte() / 45.0))});
    toolpath.cycles[0].widths.push_back(static_cast<float>(bytes.number(0.4)));
  }
  const Shape shape{{{{{{0, 0}, {6, 0}, {6, 6}, {0, 6}}}, FillRule::NonZero}}, {6, 6}};
  const std::size_t half = 1 + bytes.byte() * 4U;
  printer.endGcode = bytes.rest(half);
  printer.startGcode = bytes.rest(4096);

  std::string text;
  const auto sink = [&](std::string_view piece) {
    text += piece;
    return true;
  };
  const auto result = writeGcode(toolpath, shape, printer, params, sink, &toolpath);
  if (!result) {
    if (!text.empty() || result.error().message.empty()) std::abort();
    return 0;
  }
  // What the user's blocks say is theirs; all other lines are ours.
  if (printer.startGcode.empty() && printer.endGcode.empty()) {
    for (const GcodeFinding& finding : checkGcode(text, printer).findings) {
      if (finding.error) std::abort();
    }
  }
  return 0;
}
