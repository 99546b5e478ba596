#include "calibrate/prints.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/refused.hpp"

namespace sillon {
namespace {

// Rows in the order of CalibrationKind. usualRange fits speeds to the printer and multiplies widths by its nozzle.
const CalibrationRow kKinds[] = {
    {"flow", 0.88, 1.0, 7, 2, "print.flow", "", "the lowest disc without dark gaps between its rounds"},
    {"speed", 15, 70, 12, 1, "printer.showSpeed, print.constantFlow", "mm/s",
     "the fastest row that is as glossy as the slowest one; the half that looks more even decides constantFlow"},
    {"fan", 0, 100, 5, 0, "printer.showFan", "%", "the glossiest strip whose edges are clean"},
    {"width", 0.6, 1.6, 6, 3, "toolpath.spacing, toolpath.spacingVariation", "mm",
     "the two widths between which beads lie closed and do not tear or flatten"},
    {"directions", 0, 345, 24, 0, "print.showSide, print.mirror, pictures.spool", "degrees",
     "beads that run along the dial's spokes, and numbers that rise counter-clockwise"},
    {"swatch", 0, 165, 12, 0, "none", "degrees", "what this spool shows under your own lamps"},
    {"coupon", 0.91, 1.0, 4, 2, "print.flow", "", "the lowest disc without dark gaps between its rounds"},
};

/// First and last value that a kind tries on this printer unless the request gives others.
std::pair<double, double> usualRange(const CalibrationRequest& request) {
  const CalibrationRow& kind = rowOf(request.kind);
  const Printer& printer = request.project.printer;
  const PrintParams& print = request.project.print;
  switch (request.kind) {
    case CalibrationKind::Speed: {
      const double most = std::min(kind.to, fastest(printer, print, 1.25));
      return {std::min(kind.from, most / 2), most};
    }
    case CalibrationKind::Width:
      return {kind.from * printer.nozzle, kind.to * printer.nozzle};
    default:
      return {kind.from, kind.to};
  }
}

/// Refuses ranges that are not finite, or too narrow for their number of values.
std::optional<Error> checkRange(const CalibrationRequest& request) {
  const CalibrationRow& kind = rowOf(request.kind);
  const bool fixedValues = request.kind == CalibrationKind::Directions || request.kind == CalibrationKind::Swatch;
  if (fixedValues && (request.from || request.to)) {
    return refusedArgument("AllDirections", {{"kind", kind.name}});
  }
  const auto [low, high] = usualRange(request);
  const double from = request.from.value_or(low);
  const double to = request.to.value_or(high);
  if (!(std::abs(from) <= 1e4)) return outOfRange("from", from, -1e4, 1e4, "");
  if (!(std::abs(to) <= 1e4)) return outOfRange("to", to, -1e4, 1e4, "");
  // Neighbouring values must differ in the digits that are written, or their labels would be equal.
  const double step = std::pow(10.0, -kind.digits);
  if (!fixedValues && to - from < (kind.count - 1) * step * (1 - 1e-9)) {
    return refusedArgument(
        "StepsTooFine",
        {{"kind", kind.name}, {"from", from}, {"to", to}, {"count", kind.count}, {"least", (kind.count - 1) * step}});
  }
  return std::nullopt;
}

/// Evenly spaced values, rounded to the digits of the kind.
std::vector<double> valuesOf(const CalibrationRequest& request) {
  const CalibrationRow& kind = rowOf(request.kind);
  const auto [low, high] = usualRange(request);
  const double from = request.from.value_or(low);
  const double to = request.to.value_or(high);
  std::vector<double> values;
  const double unit = std::pow(10.0, kind.digits);
  for (int k = 0; k < kind.count; ++k) {
    const double value = from + (to - from) * k / (kind.count - 1);
    values.push_back(std::round(value * unit) / unit);
  }
  return values;
}

/// Refuses values outside the range of the setting that they are for.
std::optional<Error> checkValues(const CalibrationRequest& request, const std::vector<double>& values) {
  const CalibrationRow& kind = rowOf(request.kind);
  const Printer& printer = request.project.printer;
  const auto within = [&](double low, double high) -> std::optional<Error> {
    for (const double value : values) {
      if (value >= low - 1e-9 && value <= high + 1e-9) continue;
      return outOfRange(kind.name, value, low, high, kind.unit);
    }
    return std::nullopt;
  };
  switch (request.kind) {
    case CalibrationKind::Flow:
    case CalibrationKind::Coupon:
      return within(0.5, 1.5);
    case CalibrationKind::Speed:
      return within(1, 1000);
    case CalibrationKind::Fan:
      return within(0, 100);
    case CalibrationKind::Width:
      return within(kLeastWidth * printer.nozzle, kMostWidth * printer.nozzle);
    case CalibrationKind::Directions:
    case CalibrationKind::Swatch:
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

const CalibrationRow& rowOf(CalibrationKind kind) { return kKinds[toSize(kind)]; }

double fastest(const Printer& printer, const PrintParams& print, double width) {
  const double byFlow =
      std::floor(printer.maxFlow / (printer.filamentFlow * print.flow * print.layerHeight * width * printer.nozzle));
  return printer.machineSpeed > 0 ? std::min(byFlow, printer.machineSpeed) : byFlow;
}

const std::vector<std::string>& calibrationKinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const CalibrationRow& kind : kKinds) all.emplace_back(kind.name);
    return all;
  }();
  return names;
}

Result<std::vector<double>> valuesToTry(const CalibrationRequest& request) {
  if (auto error = checkRange(request)) return *error;
  std::vector<double> values = valuesOf(request);
  if (auto error = checkValues(request, values)) return *error;
  return values;
}

}  // namespace sillon
