#include "gcode/blocks.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "gcode/file_comments.hpp"
#include "printer/bed.hpp"
#include "printer/dialect.hpp"

namespace sillon {
namespace {

// Takes over from the start block, whatever its state: the nozzle is lifted above all that may be on the bed, goes
// aside and is heated. Filament is retracted, unless the block did so, and given back before the first bead, so that no
// string is drawn and no bead lacks filament. Waiting for heat again costs no time if the block has already waited.
void takeOver(Nozzle& nozzle, const GcodeJob& job, const Printer& printer, const PrintParams& params) {
  nozzle.out() << "G21\nG90\n" << (printer.absoluteE ? "M82" : "M83") << "\nG92 E0\nM220 S100\n";
  nozzle.noteRetracted(job.startRetracted);
  if (job.hotStart) nozzle.retract();
  nozzle.clearNextApproach(safeHeight(printer, params) - printer.lift);
  nozzle.moveZ(safeHeight(printer, params));
  if (job.ownStart || !job.purge.points.empty()) nozzle.travel(job.aside, printer.travelSpeed);
  const std::string bed = fixed(printer.bedTemperature, 0);
  nozzle.out() << (printer.bedTemperature > 0 ? "M190 S" : "M140 S") << bed << "\nM109 S"
               << fixed(printer.firstLayerNozzleTemperature, 0) << "\n";
  if (job.purge.points.empty()) nozzle.retract();
}

// Lays the purge line, if there is one.
void purge(Nozzle& nozzle, const GcodeJob& job, const Printer& printer, const PrintParams& params) {
  if (job.purge.points.empty()) return;
  MotionLimits limits = nozzle.machineLimits();
  limits.layerHeight = job.purgeHeight;
  limits.flow = printer.filamentFlow;
  limits.filamentArea = filamentArea(printer.filamentDiameter);
  limits.speed = std::min(printer.firstLayerSpeed, printer.speed);
  limits.maxFlow = printer.maxFlow;
  limits.maxSegmentsPerSecond = printer.maxSegmentsPerSecond;
  const Motion motion = planMotion(job.purge, 0, limits);
  nozzle.moveZ(job.purgeHeight);
  nozzle.unretract();
  nozzle.bead(motion, limits.flow, job.purgeHeight);
  nozzle.dropResidue();
  nozzle.leave(motion, limits.speed, job.purgeHeight);
  nozzle.clearNextApproach(safeHeight(printer, params) - printer.lift);
}

// Restores the settings of the machine that the file has changed.
void restoreMachine(ChunkedOutput& out, const GcodeJob& job, const Printer& printer) {
  // Klipper does not cap these values and keeps those of the file, so nothing is raised there after the print.
  const bool capped = printer.flavor != GcodeFlavor::Klipper;
  if (printer.setPressureAdvance && capped) {
    out << pressureAdvanceCommand(printer.flavor, 0);
  }
  if (printer.machineAcceleration > 0 && capped) {
    out << accelerationCommand(printer.flavor, printer.machineAcceleration);
  }
  if (printer.machineCornerSpeed > 0 && capped) {
    out << cornerSpeedCommand(printer.flavor, printer.machineCornerSpeed);
  }
  if (job.startFlow != 100) out << "M221 S100\n";
}

}  // namespace

void writeStart(Nozzle& nozzle, const GcodeJob& job, const Printer& printer, const PrintParams& params) {
  writeRole(nozzle.out(), kCustomRole);
  // A block is written for a printer that was just switched on, not for the modes that the last file left. A flow that
  // the block or its macros set is the owner's or the maker's choice, and holds for the whole print.
  nozzle.out() << "G21\nG90\nM82\nM221 S100\n" << job.startBlock;
  takeOver(nozzle, job, printer, params);
  if (printer.flavor == GcodeFlavor::Klipper) {
    nozzle.out() << "SET_PRINT_STATS_INFO TOTAL_LAYER=" << std::to_string(fileLayers(job, params)) << "\n";
  }
  defineObjects(nozzle.out(), job, printer.flavor);
  if (printer.machineAcceleration > 0) nozzle.out() << accelerationCommand(printer.flavor, printer.acceleration);
  if (printer.machineCornerSpeed > 0) nozzle.out() << cornerSpeedCommand(printer.flavor, printer.cornerSpeed);
  if (printer.setPressureAdvance) nozzle.out() << pressureAdvanceCommand(printer.flavor, printer.pressureAdvance);
  purge(nozzle, job, printer, params);
}

void writeEnd(Nozzle& nozzle, const GcodeJob& job, const Printer& printer, const PrintParams& params) {
  endObject(nozzle.out(), job, printer.flavor, static_cast<int>(job.copies.size()) - 1);
  // Some hosts read only the last MiB, and would otherwise take the lift for the height of the plate.
  nozzle.out() << ";BEFORE_LAYER_CHANGE\n;" << decimal(layerTop(params, layerCount(params) - 1), 3) << "\n";
  writeRole(nozzle.out(), kCustomRole);
  nozzle.moveZ(std::min(highest(printer), nozzle.z() + kParkLift));
  restoreMachine(nozzle.out(), job, printer);
  if (!job.endBlock.empty()) {
    if (printer.absoluteE) nozzle.out() << "G92 E0\n";  // so that "G1 E-2" in the block draws back 2 mm
    nozzle.out() << job.endBlock << "M73 P100 R0\n";
    return;
  }
  Vec2 park{std::ceil(printer.bedMin.x * 1000), std::floor(printer.bedMax.y * 1000)};
  if (printer.roundBed) {
    const Bed bed(printer);
    park = 1000.0 * (bed.centre() + Vec2{0, 0.95 * bed.radius()});
  }
  nozzle.travel({std::llround(park.x), std::llround(park.y)}, printer.travelSpeed);
  nozzle.out() << "M104 S0\n";
  for (const int tool : job.otherHotTools) nozzle.out() << "M104 T" << std::to_string(tool) << " S0\n";
  nozzle.out() << "M140 S0\n" << (job.hotChamber ? "M141 S0\n" : "") << "M107\nM84\nM73 P100 R0\n";
}

}  // namespace sillon
