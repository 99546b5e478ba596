#include "sillon/gcode/writer.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "base/refused.hpp"
#include "gcode/blocks.hpp"
#include "gcode/file_comments.hpp"
#include "gcode/job.hpp"
#include "gcode/layers.hpp"
#include "gcode/motion.hpp"
#include "gcode/nozzle.hpp"

namespace sillon {
namespace {

constexpr double kManyMoves = 2e6;
constexpr double kManyBytes = 100e6;

// Estimate of a file before it is written: its time, and the pace of each kind of layer.
struct Estimate {
  double seconds = 0;
  Paces pace;

  Estimate() { pace.fill(1); }
};

// Estimates the time of all copies without writing them. Layers of one kind differ by the seam only, so one of each
// kind is planned. Layers too short for the plastic to set are slowed.
Estimate estimateFile(const GcodeJob& job, const Printer& printer, const PrintParams& params, MotionPlans& plans) {
  std::array<double, kLayerKinds> known;
  known.fill(-1);
  Nozzle silent(printer, nullptr);
  LayerWriter layers(job, printer, params, plans, silent);
  writeStart(silent, job, printer, params);
  Estimate estimate;
  estimate.seconds = silent.seconds();
  const auto timeOf = [&](const FileLayer& layer) {
    layers.setPace(estimate.pace);
    const double before = silent.seconds();
    layers.write(layer);
    return silent.seconds() - before;
  };
  for (int copy = 0; copy < static_cast<int>(job.copies.size()); ++copy) {
    for (int i = 0; i < layerCount(params); ++i) {
      const FileLayer layer = layerAt(params, copy, i);
      const std::size_t kind = kindOf(layer);
      double& seconds = known[kind];
      if (layer.oriented && !job.patches.empty()) {  // patches differ per layer, and keep their own speeds
        estimate.seconds += timeOf(layer);
        continue;
      }
      if (seconds < 0) {
        seconds = timeOf(layer);
        for (int round = 0; round < 3 && seconds < printer.minLayerTime * 0.98; ++round) {
          estimate.pace[kind] *= seconds / printer.minLayerTime;
          seconds = timeOf(layer);
        }
      }
      estimate.seconds += seconds;
    }
  }
  return estimate;
}

// Sums up a finished file, with warnings about its speed and size.
GcodeSummary summaryOf(const Nozzle& nozzle, const OrientedLength& oriented, const GcodeJob& job,
                       const Printer& printer, const PrintParams& params) {
  GcodeSummary summary;
  summary.filamentMm = nozzle.filamentMm();
  summary.filamentCm3 = summary.filamentMm * filamentArea(printer.filamentDiameter) / 1000;
  summary.filamentGrams = summary.filamentCm3 * printer.filamentDensity;
  summary.seconds = nozzle.seconds();
  summary.moves = nozzle.moves();
  summary.bytes = nozzle.out().bytes();
  summary.clampedLengthMm = job.clampedMm * params.layers * static_cast<double>(job.copies.size()) *
                            (params.showSide == ShowSide::Both ? 2 : 1);
  summary.curveSlowedMm = oriented.curveSlowed;
  summary.warnings = job.warnings;
  const auto warn = [&](WarningCode code, const char* name, double value) {
    summary.warnings.push_back({code, {{name, value}}});
  };
  const auto slowed = [&](WarningCode code, double mm) {
    if (mm > 0.1 * oriented.all) warn(code, "percent", percent(mm / oriented.all));
  };
  slowed(WarningCode::MaxFlowSlows, oriented.flowSlowed);
  slowed(WarningCode::SegmentsSlow, oriented.segmentSlowed);
  const auto moves = static_cast<double>(nozzle.moves());
  if (moves > kManyMoves) warn(WarningCode::ManyMoves, "n", moves);
  const auto bytes = static_cast<double>(summary.bytes);
  if (bytes > kManyBytes) warn(WarningCode::ManyBytes, "mb", std::floor(bytes / 1e6));
  return summary;
}

// Writes a prepared job: header, start, layers, end and footer.
Result<GcodeSummary> writeFile(const GcodeJob& job, const Printer& printer, const PrintParams& params,
                               const GcodeSink& sink) {
  MotionPlans plans;
  const Estimate expected = estimateFile(job, printer, params, plans);
  Nozzle nozzle(printer, &sink);
  nozzle.expect(expected.seconds);
  LayerWriter layers(job, printer, params, plans, nozzle);
  layers.setPace(expected.pace);

  ChunkedOutput& out = nozzle.out();
  writeHeader(out, job, printer, params, expected.seconds);
  nozzle.progress();
  writeStart(nozzle, job, printer, params);
  for (int copy = 0; copy < static_cast<int>(job.copies.size()); ++copy) {
    for (int i = 0; i < layerCount(params) && !out.failed(); ++i) layers.write(layerAt(params, copy, i));
  }
  writeEnd(nozzle, job, printer, params);
  writeFooter(out, {nozzle.filamentMm(), nozzle.seconds()}, job, printer, params);
  out.flush();
  if (out.failed()) return refused(ErrorCode::Cancelled, "WritingStopped");
  return summaryOf(nozzle, layers.oriented(), job, printer, params);
}

using Prepare = std::function<Result<GcodeJob>(const Printer&)>;

// Prepares and writes a job with the speeds that the machine allows, and warns of those that were lowered.
Result<GcodeSummary> write(const Prepare& prepare, const Printer& given, const PrintParams& params,
                           const GcodeSink& sink) {
  if (!sink) return refusedArgument("NoSink");
  Printer printer = given;
  std::vector<Warning> held;
  const auto hold = [&](const std::string& field, double& speed) {
    if (!(given.machineSpeed > 0 && speed > given.machineSpeed)) return;
    held.push_back({WarningCode::SpeedHeld, {{"field", field}, {"asked", speed}, {"held", given.machineSpeed}}});
    speed = given.machineSpeed;
  };
  const bool tooFast = given.machineAcceleration > 0 && given.acceleration > given.machineAcceleration;
  if (tooFast) printer.acceleration = given.machineAcceleration;
  if (!beginsOnBed(params)) printer.firstLayerNozzleTemperature = printer.nozzleTemperature;
  Result<GcodeJob> prepared = prepare(printer);
  if (!prepared) return prepared.error();
  GcodeJob& job = prepared.value();
  hold("printer.speed", printer.speed);
  hold("printer.showSpeed", job.showSpeed);
  hold("printer.baseSpeed", printer.baseSpeed);
  hold("printer.firstLayerSpeed", printer.firstLayerSpeed);
  hold("printer.travelSpeed", printer.travelSpeed);

  Result<GcodeSummary> written = writeFile(job, printer, params, sink);
  if (!written) return written;
  GcodeSummary summary = std::move(written).value();
  if (tooFast) {
    summary.warnings.push_back(
        {WarningCode::AccelerationHeld, {{"asked", given.acceleration}, {"held", given.machineAcceleration}}});
  }
  summary.warnings.insert(summary.warnings.end(), held.begin(), held.end());
  return summary;
}

}  // namespace

Result<GcodeSummary> writeGcode(const Toolpath& toolpath, const Shape& shape, const Printer& printer,
                                const PrintParams& params, const GcodeSink& sink, const Toolpath* across) {
  const auto prepare = [&](const Printer& held) {
    return prepareGcodeJob(toolpath, needsAcross(params) ? across : nullptr, shape, held, params);
  };
  return write(prepare, printer, params, sink);
}

Result<GcodeSummary> writePatches(const PatchPlate& plate, const Printer& printer, const PrintParams& params,
                                  const GcodeSink& sink) {
  const auto prepare = [&](const Printer& held) { return preparePatchJob(plate, held, params); };
  return write(prepare, printer, params, sink);
}

}  // namespace sillon
