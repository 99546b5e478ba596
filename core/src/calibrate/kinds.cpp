#include "calibrate/kinds.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/decimal_text.hpp"

namespace sillon {
namespace {

constexpr const char* kNozzleHeight = "the printer's own Z offset";

// In the order of CalibrationKind; usualRange says what follows from the printer.
const CalibrationRow kKinds[] = {
    {"first-layer", -0.06, 0.06, 7, 3, kNozzleHeight, "mm", "the square whose lines just close, without ridges"},
    {"flow", 0.88, 1.0, 7, 2, "print.flow", "", "the lowest disc without dark gaps between its rounds"},
    {"advance", 0, 0.08, 9, 3, "printer.pressureAdvance, printer.setPressureAdvance", "s",
     "the row whose beads are as wide in the U-turns as along the legs"},
    {"speed", 15, 70, 12, 1, "printer.showSpeed, print.constantFlow", "mm/s",
     "the fastest row that is as glossy as the slowest one; the half that looks more even decides constantFlow"},
    {"temperature", -15, 15, 7, 0, "printer.nozzleTemperature", "degrees Celsius",
     "the glossiest strip whose edges are clean"},
    {"fan", 0, 100, 5, 0, "printer.showFan", "%", "the glossiest strip whose edges are clean"},
    {"width", 0.6, 1.6, 6, 3, "toolpath.spacing, toolpath.spacingVariation", "mm",
     "the two widths between which beads lie closed and do not tear or flatten"},
    {"directions", 0, 345, 24, 0, "print.showSide, print.mirror, pictures.spool", "degrees",
     "beads that run along the dial's spokes, and numbers that rise counter-clockwise"},
    {"swatch", 0, 165, 12, 0, "none", "degrees", "what this spool shows under your own lamps"},
    {"coupon", 0.91, 1.0, 4, 2, "print.flow", "", "the lowest disc without dark gaps between its rounds"},
};

std::optional<Error> invalid(std::string message) { return Error{ErrorCode::InvalidArgument, std::move(message)}; }

/// First and last value of a kind on this printer.
std::pair<double, double> usualRange(const CalibrationRequest& request) {
  const CalibrationRow& kind = rowOf(request.kind);
  const Printer& printer = request.project.printer;
  const PrintParams& print = request.project.print;
  switch (request.kind) {
    case CalibrationKind::FirstLayer: {
      // 30 % of the layer's height, in steps of whole hundredths where that is 0.2 mm.
      const double height = print.firstLayerHeight > 0 ? print.firstLayerHeight : print.layerHeight;
      const double reach = std::min(0.09, std::max(0.015, std::round(60 * height) * 0.005));
      return {-reach, reach};
    }
    case CalibrationKind::Temperature: {
      const double low = printer.anyTemperature ? 0 : 170;
      const double high = printer.anyTemperature ? 500 : printer.maxNozzleTemperature;
      return {std::max(low, printer.nozzleTemperature + kind.from),
              std::min(high, printer.nozzleTemperature + kind.to)};
    }
    case CalibrationKind::Speed: {
      const double most = std::min(kind.to, fastest(printer, print, 1.25));
      return {std::min(kind.from, most / 2), most};
    }
    case CalibrationKind::Advance: {
      // Around what is known; else a long retraction tells a tube between extruder and nozzle, which needs more.
      constexpr double kTube = 2, kWithTube = 0.8, kMostAdvance = 2;
      const double advance = printer.pressureAdvance;
      const bool known = advance > 0 && (printer.setPressureAdvance || advance != Printer().pressureAdvance);
      if (!known) return {kind.from, printer.retractLength >= kTube ? kWithTube : kind.to};
      const double steps = kind.count - 1, unit = std::pow(10.0, kind.digits);
      return {kind.from, std::min(kMostAdvance, steps * std::ceil(unit * 2 * advance / steps - 1e-9) / unit)};
    }
    case CalibrationKind::Width:
      return {kind.from * printer.nozzle, kind.to * printer.nozzle};
    default:
      return {kind.from, kind.to};
  }
}

std::optional<Error> checkRange(const CalibrationRequest& request) {
  const CalibrationRow& kind = rowOf(request.kind);
  const bool fixedValues = request.kind == CalibrationKind::Directions || request.kind == CalibrationKind::Swatch;
  if (fixedValues && (request.from || request.to)) {
    return invalid(std::string(kind.name) + " tries all directions; from and to must be left out");
  }
  const auto [low, high] = usualRange(request);
  const double from = request.from.value_or(low);
  const double to = request.to.value_or(high);
  if (!std::isfinite(from) || !std::isfinite(to) || std::abs(from) > 1e4 || std::abs(to) > 1e4) {
    return invalid("from and to must be numbers from -10000 to 10000");
  }
  // The writing tells the values apart, or nobody can.
  const double step = std::pow(10.0, -kind.digits);
  if (!fixedValues && to - from < (kind.count - 1) * step * (1 - 1e-9)) {
    return invalid(std::string(kind.name) + " from " + decimal(from, 4) + " to " + decimal(to, 4) + " has " +
                   std::to_string(kind.count) + " values; to must be at least " + decimal((kind.count - 1) * step, 4) +
                   " above from");
  }
  return std::nullopt;
}

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

/// The range of the setting that the values are of.
std::optional<Error> checkValues(const CalibrationRequest& request, const std::vector<double>& values) {
  const CalibrationRow& kind = rowOf(request.kind);
  const Printer& printer = request.project.printer;
  const auto within = [&](double low, double high) -> std::optional<Error> {
    for (const double value : values) {
      if (value >= low - 1e-9 && value <= high + 1e-9) continue;
      const std::string unit = *kind.unit == '\0' ? "" : std::string(" ") + kind.unit;
      return invalid(std::string(kind.name) + " would try " + decimal(value, 4) + unit + "; values must be " +
                     decimal(low, 4) + " to " + decimal(high, 4));
    }
    return std::nullopt;
  };
  switch (request.kind) {
    case CalibrationKind::FirstLayer:
      return within(-0.1, 0.1);
    case CalibrationKind::Flow:
    case CalibrationKind::Coupon:
      return within(0.5, 1.5);
    case CalibrationKind::Advance:
      return within(0, 2);
    case CalibrationKind::Speed:
      return within(1, 1000);
    case CalibrationKind::Temperature:
      return within(printer.anyTemperature ? 1 : 170, printer.anyTemperature ? 500 : printer.maxNozzleTemperature);
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

const CalibrationRow& rowOf(CalibrationKind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

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
