#include "gcode/job.hpp"

#include "base/numbers.hpp"
#include "base/refused.hpp"
#include "gcode/base_layers.hpp"
#include "gcode/blocks.hpp"
#include "gcode/layout.hpp"
#include "quality/measured_parts.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/quality/metrics.hpp"

namespace sillon {
namespace {

constexpr double kMinFlowSpeed = 5;  // [mm/s]; a hot end that allows less is too small for the job
constexpr double kMinArea = 1e-6;    // [mm²]; a smaller area is rounding

// Checks that the hot end can melt the widest bead at a speed worth printing.
std::optional<Error> checkFlow(const GcodeJob& job, const Printer& printer, const PrintParams& params) {
  double widest = 0;
  for (const BeadPath& path : job.cycles) {
    for (const double width : path.widths) widest = std::max(widest, width);
  }
  const double height = std::max(params.layerHeight, firstLayerHeight(params));
  double area = params.flow * height * widest;
  for (const BeadPath& path : job.across) {
    for (const double width : path.widths) area = std::max(area, params.baseFlow * height * width);
  }
  for (const PlacedPatch& patch : job.patches) {
    for (const BeadPath& path : patch.paths) {
      for (const double width : path.widths) area = std::max(area, patch.how.flow * height * width);
    }
  }
  if (params.base > 0 || params.skirt > 0 || params.rim > 0)
    area = std::max(area, params.baseFlow * height * printer.nozzle);
  area *= printer.filamentFlow;
  if (printer.maxFlow >= kMinFlowSpeed * area) return std::nullopt;
  return refusedArgument("FlowTooLow", {{"flow", printer.maxFlow}, {"section", area}, {"least", kMinFlowSpeed * area}});
}

// Warns of a print on the bed: there is no skirt and no purge line, because the nozzle must not go down to the bed.
// Homing, in the user's start block, may still do so.
void warnAbovePrint(GcodeJob& job, const Printer& printer, const PrintParams& params, const Bounds& beads) {
  job.warn(WarningCode::PrintOnBed, {{"height", params.startHeight}});
  // A macro may prime the nozzle; its commands are unknown.
  if (!primesItself(printer, params, beads) && !runsStartMacro(printer.startGcode))
    job.warn(WarningCode::NotPrimedAbovePrint);
}

// A corner of the bed, or its front if it is round, where nothing is printed.
PointUm corner(const Printer& printer) {
  const Bed bed(printer);
  if (printer.roundBed) return rounded(bed.centre() - Vec2{0, 0.9 * bed.radius()});
  return rounded(printer.bedMin + Vec2{1, 1});
}

// Places the cycles that face the bed. Seen from below, a plate is its mirror image, so the shape must equal its own
// mirror image to show the same on both sides.
Result<std::vector<BeadPath>> bedCycles(const Toolpath& given, const Shape& givenShape, const PlateTransform& turn,
                                        const ShapeScan& inside, PointUm offset, const Printer& printer) {
  const Bounds box = bounds(givenShape);
  const double sum = box.min.x + box.max.x;
  Toolpath flipped = given;
  for (Cycle& cycle : flipped.cycles) {
    for (Vec2f& p : cycle.points) p.x = static_cast<float>(sum - static_cast<double>(p.x));
  }
  const Toolpath toolpath = turn.none() ? flipped : turn.apply(flipped);
  if (const std::int64_t outside = countOutside(toolpath, inside); outside > 0) {
    return refusedArgument("NotMirrored", {{"points", outside}});
  }
  PlacedCycles placedCycles;
  if (auto error = placeCycles(toolpath, offset, printer.nozzle, placedCycles)) return *error;
  return std::move(placedCycles.paths);
}

// Chooses the speed of oriented layers. Without pressure advance the extruder lags behind every change of speed: beads
// are thick where the nozzle slows down and thin where it speeds up. A slow, constant speed keeps them even. Klipper
// and RepRapFirmware keep pressure advance in their own settings.
void setShowSpeed(GcodeJob& job, const Printer& printer, double cyclesMm, const PrintParams& params) {
  const bool own = printer.flavor == GcodeFlavor::Klipper || printer.flavor == GcodeFlavor::RepRap;
  job.knowsAdvance = own || printer.setPressureAdvance || setsPressureAdvance(job.startBlock);
  job.showSpeed = printer.showSpeed > 0 ? printer.showSpeed : printer.speed;
  const bool unused = !job.patches.empty() && cyclesMm == 0;  // all patches set their own speeds
  if (job.knowsAdvance || unused || printer.showSpeed > 0 || job.showSpeed <= kEvenSpeed) return;
  job.showSpeed = kEvenSpeed;
  const double length = cyclesMm * (layersBelowRim(params) - params.base) * static_cast<double>(job.copies.size());
  const double minutes = length * (1 / kEvenSpeed - 1 / printer.speed) / 60;
  job.warn(WarningCode::NoPressureAdvance,
           {{"speed", kEvenSpeed}, {"minutes", std::ceil(minutes)}, {"asked", printer.speed}});
}

// Adds the warnings about settings and beads that are allowed but unusual.
void addWarnings(GcodeJob& job, const Printer& printer, const PrintParams& params) {
  const double d = printer.filamentDiameter;
  if (std::abs(d - 1.75) > 0.1 && std::abs(d - 2.85) > 0.15) {
    job.warn(WarningCode::UnusualFilament, {{"value", d}});
  }
  if (params.layerHeight < 0.2 * printer.nozzle) {
    job.warn(WarningCode::ThinLayers, {{"value", params.layerHeight}});
  }
  const auto unusualFlow = [&](const std::string& field, double flow) {
    if (flow >= 0.8 && flow <= 1.1) return;
    job.warn(WarningCode::UnusualFlow, {{"field", field}, {"value", flow}});
  };
  unusualFlow("printer.filamentFlow", printer.filamentFlow);
  unusualFlow("print.flow", params.flow);
  unusualFlow("print.baseFlow", params.baseFlow);
  if (params.showSide != ShowSide::Up) unusualFlow("print.bedFlow", params.bedFlow);
  std::int64_t flat = 0;
  for (const BeadPath& path : job.cycles) {
    flat += std::count_if(path.widths.begin(), path.widths.end(), [&](double w) {
      return w <= params.layerHeight && w >= kLeastBead * printer.nozzle - 1e-6;  // threads do not count
    });
  }
  if (flat > 0) {
    job.warn(WarningCode::FlatBeads, {{"n", static_cast<double>(flat)}, {"height", params.layerHeight}});
  }
  if (job.patches.empty() && (job.fillRatio < 0.97 || job.fillRatio > 1.05)) {
    job.warn(WarningCode::FillRatio, {{"percent", percent(job.fillRatio)}});
  }
  if (params.mirror && params.showSide == ShowSide::Up) {
    job.warn(WarningCode::MirroredUp);
  }
  if (printer.setPressureAdvance) {
    const bool stays = printer.flavor == GcodeFlavor::Klipper;
    job.warn(WarningCode::PressureAdvanceReset, {{"value", stays ? printer.pressureAdvance : 0}});
  }
}

// Finds the box around all copies and checks that it fits on the bed. The box of the first plate is stored in the job.
Result<Bounds> fittedBox(GcodeJob& job, const Shape& shape, const Bounds& shapeBox, PointUm offset,
                         const Printer& printer) {
  Bounds box{shapeBox.min + mm(offset), shapeBox.max + mm(offset)};
  for (const auto* paths : {&job.cycles, &job.bedCycles, &job.across, &job.bedAcross, &job.brim}) {
    for (const BeadPath& path : *paths) addBeads(box, path);
  }
  for (const PlacedPatch& patch : job.patches) {
    for (const BeadPath& path : patch.paths) addBeads(box, path);
  }
  job.firstPlate = box;
  for (const PointUm copy : job.copies) {
    box.add(job.firstPlate.min + mm(copy));
    box.add(job.firstPlate.max + mm(copy));
  }
  if (auto error = checkFit(box, shape, mm(offset), job, printer)) return *error;
  return box;
}

// The shape for base layers, brims and rims: paths that touch are united into one body, as in the oriented layers.
Result<Shape> bodyOf(const Shape& shape, const PrintParams& params) {
  const bool filled = params.base > 0 && params.basePattern != BasePattern::Same;
  return filled || params.brim > 0 || params.rim > 0 ? unitedOnGrid(shape) : shape;
}

// Adds the skirt and the purge line around the plates, and the blocks before and after them.
std::optional<Error> addSurroundings(GcodeJob& job, const Bounds& box, const Printer& printer,
                                     const PrintParams& params) {
  if (beginsOnBed(params)) {
    addSkirt(job, box, printer, params.skirt);
    if (!primesItself(printer, params, box)) addPurge(job, box, printer, params);
  } else {
    warnAbovePrint(job, printer, params, box);
  }
  job.aside = job.purge.points.empty() ? corner(printer) : job.purge.points.front();
  const Vec2 last = 0.5 * (job.firstPlate.min + job.firstPlate.max) + mm(job.copies.back());
  return addBlocks(job, box, last, printer, params);
}

}  // namespace

Result<GcodeJob> prepareGcodeJob(const Toolpath& given, const Toolpath* across, const Shape& givenShape,
                                 const Printer& printer, const PrintParams& params) {
  if (auto error = checkGcodeInput(given, across, givenShape, printer, params)) return *error;
  PrintParams turning = params;
  if (params.showSide == ShowSide::Bed) turning.mirror = !params.mirror;
  const PlateTransform turn(turning, givenShape.page);
  const Toolpath& toolpath = turn.none() ? given : turn.apply(given);
  const Shape& shape = turn.none() ? givenShape : turn.apply(givenShape);
  const Bounds shapeBox = bounds(shape);
  if (shapeBox.empty()) return refused(ErrorCode::EmptyShape, "NoArea");

  GcodeJob job;
  job.spacing = toolpath.spacing;
  job.plate = shapeBox.size();
  const PointUm offset = placement(shapeBox, printer, params);
  job.copies = copyPlaces(shapeBox, printer, params);
  PlacedCycles cycles;
  if (auto error = placeCycles(toolpath, offset, printer.nozzle, cycles)) return *error;
  job.cycles = std::move(cycles.paths);
  job.clampedMm = cycles.heldMm;
  if (cycles.heldMm > 0.01 * cycles.lengthMm) {
    job.warn(WarningCode::WidthHeld, {{"percent", percent(cycles.heldMm / cycles.lengthMm)},
                                      {"low", kLeastBead * printer.nozzle},
                                      {"high", kWidestBead * printer.nozzle}});
  }
  std::int64_t outside = 0;
  const ShapeScan inside = scanShape(shape, shapeBox);
  if (across != nullptr) {
    const Toolpath& turned = turn.none() ? *across : turn.apply(*across);
    PlacedCycles below;
    if (auto error = placeCycles(turned, offset, printer.nozzle, below)) return *error;
    job.across = std::move(below.paths);
    outside = countOutside(turned, inside);
  }
  if (auto error = checkFlow(job, printer, params)) return *error;
  if (!(inside.area > kMinArea)) return refused(ErrorCode::EmptyShape, "NoArea");
  if (params.showSide == ShowSide::Both) {
    Result<std::vector<BeadPath>> onBed = bedCycles(given, givenShape, turn, inside, offset, printer);
    if (!onBed) return onBed.error();
    job.bedCycles = std::move(onBed).value();
    if (across != nullptr) {
      onBed = bedCycles(*across, givenShape, turn, inside, offset, printer);
      if (!onBed) return onBed.error();
      job.bedAcross = std::move(onBed).value();
    }
  }
  const Result<Shape> body = bodyOf(shape, params);
  if (!body) return body.error();
  if (auto error = addBrim(job, body.value(), offset, printer, params)) return *error;

  const Result<Bounds> box = fittedBox(job, shape, shapeBox, offset, printer);
  if (!box) {
    Error error = box.error();
    error.message += wayOut(givenShape, printer, params);
    return error;
  }

  job.fillRatio = cycles.beadArea / inside.area;
  outside += countOutside(toolpath, inside);
  if (outside > 0) {
    const Warning warning{WarningCode::OutsideShape, {{"n", static_cast<double>(outside)}}};
    if (params.strict) {
      Error error = refusalOf(warning);
      error.message += "; print.strict refuses that";
      return error;
    }
    job.warnings.push_back(warning);
  }
  if (params.strict) {
    if (const std::int64_t crossings = countCrossings(toolpath); crossings > 0) {
      return refusedArgument("CrossesItself", {{"times", crossings}});
    }
  }
  markSeams(job.cycles, offset, shape, inside, job.spacing);
  markSeams(job.bedCycles, offset, shape, inside, job.spacing);
  if (auto error = addBaseLayers(job, body.value(), offset, printer, params)) return *error;
  if (auto error = addRim(job, body.value(), offset, printer, params)) return *error;
  if (auto error = addSurroundings(job, box.value(), printer, params)) return *error;
  setShowSpeed(job, printer, cycles.lengthMm, params);
  addWarnings(job, printer, params);
  return job;
}

Result<GcodeJob> preparePatchJob(const PatchPlate& plate, const Printer& printer, const PrintParams& params) {
  if (auto error = checkPatchInput(plate, printer, params)) return *error;
  const Bounds shapeBox = bounds(plate.shape);
  if (shapeBox.empty()) return refused(ErrorCode::EmptyShape, "NoArea");
  const ShapeScan inside = scanShape(plate.shape, shapeBox);
  if (!(inside.area > kMinArea)) return refused(ErrorCode::EmptyShape, "NoArea");

  GcodeJob job;
  job.spacing = printer.nozzle;
  job.plate = shapeBox.size();
  const PointUm offset = placement(shapeBox, printer, params);
  double lengthOfAll = 0;  // [mm], length printed at the job's speed
  for (const Patch& patch : plate.patches) {
    PlacedPatch placedPatch{patch, {}};
    placedPatch.how.lines.clear();
    for (const PatchLine& line : patch.lines) {
      BeadPath path;
      for (std::size_t i = 0; i < line.points.size(); ++i) {
        if (!holds(inside, line.points[i])) {
          return refusedArgument("PatchOutside", {{"x", line.points[i].x}, {"y", line.points[i].y}});
        }
        const PointUm point = rounded(line.points[i]) + offset;
        if (!path.points.empty() && path.points.back() == point) continue;
        if (!path.points.empty() && patch.speed == 0) lengthOfAll += lengthMm(point - path.points.back());
        path.points.push_back(point);
        path.widths.push_back(line.widths[i]);
      }
      if (path.points.size() < 2) return refusedArgument("NoLength");
      placedPatch.paths.push_back(std::move(path));
    }
    job.patches.push_back(std::move(placedPatch));
  }
  if (auto error = checkFlow(job, printer, params)) return *error;
  const Result<Shape> body = bodyOf(plate.shape, params);
  if (!body) return body.error();
  if (auto error = addBrim(job, body.value(), offset, printer, params)) return *error;
  const Result<Bounds> box = fittedBox(job, plate.shape, shapeBox, offset, printer);
  if (!box) return box.error();
  if (auto error = addBaseLayers(job, body.value(), offset, printer, params)) return *error;
  if (auto error = addSurroundings(job, box.value(), printer, params)) return *error;
  setShowSpeed(job, printer, lengthOfAll / params.layers, params);
  addWarnings(job, printer, params);
  return job;
}

}  // namespace sillon
