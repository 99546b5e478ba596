#include "sillon/calibrate/calibrate.hpp"

#include <cstddef>
#include <utility>

#include "base/numbers.hpp"
#include "calibrate/prints.hpp"

namespace sillon {
namespace {

// Notes kind, advice, setting and every value with its place in the file, so that it explains itself later.
void addNotes(CalibrationPlate& plate) {
  std::vector<std::string>& notes = plate.print.notes;
  notes.clear();
  notes.push_back(std::string("calibration: ") + rowOf(plate.kind).name);
  notes.push_back("look for: " + plate.advice);
  notes.push_back("value to enter: " + plate.setting);
  for (const CalibrationValue& value : plate.values) {
    const std::string unit = plate.unit.empty() ? "" : " " + plate.unit;
    notes.push_back("written " + value.label + ": " + decimal(value.value, 4) + unit + " at " + fixed(value.at.x, 1) +
                    ", " + fixed(value.at.y, 1) + " mm from the lower left");
  }
}

}  // namespace

Result<CalibrationPlate> makeCalibration(const CalibrationRequest& request, const RunContext& run) {
  Result<std::vector<double>> values = valuesToTry(request);
  if (!values) return values.error();
  PlateBuilder builder(request, std::move(values).value());
  layOut(request.kind, builder);
  CalibrationPlate made = std::move(builder).done();
  if (request.kind == CalibrationKind::Swatch) {
    if (auto error = addSwatch(made, request.project, run)) return *error;
  }
  addNotes(made);
  return made;
}

Result<GcodeSummary> writeCalibration(const CalibrationPlate& plate, const GcodeSink& sink) {
  if (!plate.toolpath.cycles.empty()) {
    return writeGcode(plate.toolpath, plate.patches.shape, plate.printer, plate.print, sink);
  }
  return writePatches(plate.patches, plate.printer, plate.print, sink);
}

Toolpath shownCalibration(const CalibrationPlate& plate) {
  if (!plate.toolpath.cycles.empty()) return plate.toolpath;
  Toolpath shown;
  shown.spacing = plate.printer.nozzle;
  for (const Patch& patch : plate.patches.patches) {
    for (const PatchLine& line : patch.lines) {
      // A patch's line is open, and a cycle is closed: the cycle runs along the line and back.
      Cycle cycle;
      const auto add = [&](std::size_t i) {
        cycle.points.push_back({static_cast<float>(line.points[i].x), static_cast<float>(line.points[i].y)});
        cycle.widths.push_back(static_cast<float>(line.widths[i] * patch.flow));
      };
      for (std::size_t i = 0; i < line.points.size(); ++i) add(i);
      for (std::size_t i = line.points.size() - 1; i-- > 1;) add(i);
      shown.cycles.push_back(std::move(cycle));
    }
  }
  return shown;
}

}  // namespace sillon
