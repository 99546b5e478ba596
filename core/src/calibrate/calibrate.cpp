#include "sillon/calibrate/calibrate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/decimal_text.hpp"
#include "calibrate/pieces.hpp"
#include "calibrate/strokes.hpp"
#include "calibrate/swatch.hpp"

namespace sillon {
namespace {

constexpr double kUnit = 0.55;                   // [mm] of writing: capitals of 3.3 mm
constexpr double kBand = 4.6;                    // [mm], high enough for a line of writing
constexpr double kMargin = 0.6;                  // [mm] from writing to an edge
constexpr double kOutline = 0.35;                // [mm], what is laid keeps off the edge of its base
constexpr double kHigh = kUnit * kLetterHeight;  // [mm] of capitals

std::optional<Error> invalid(std::string message) { return Error{ErrorCode::InvalidArgument, std::move(message)}; }

// What a kind tries, and what is said of it.
struct Kind {
  const char* name;
  double from, to;
  int count;
  int digits;  // of the values
  const char* setting;
  const char* unit;
  const char* advice;
};

constexpr double kLeastWidth = 0.6;  // [nozzle], the narrowest and the widest bead that is printed
constexpr double kMostWidth = 1.6;

constexpr const char* kNozzleHeight = "Z offset of the printer itself";

// In the order of CalibrationKind. Ranges of NaN follow from the printer.
const Kind kKinds[] = {
    {"first-layer", -0.06, 0.06, 7, 3, kNozzleHeight, "mm",
     "the square whose lines just close, without ridges; add its value to the printer's Z offset"},
    {"flow", 0.88, 1.0, 7, 2, "print.flow", "", "the lowest disc without dark gaps between its rounds"},
    {"advance", 0, 0.08, 9, 3, "printer.pressureAdvance, printer.setPressureAdvance", "s",
     "the row whose hairpins are as wide in their turns as along their legs"},
    {"speed", 15, 70, 12, 1, "printer.showSpeed, print.constantFlow", "mm/s",
     "the fastest row that is as glossy as the slowest one; the half that looks more even tells constantFlow"},
    {"temperature", -15, 15, 7, 0, "printer.nozzleTemperature", "degrees Celsius",
     "the glossiest strip whose edges are clean"},
    {"fan", 0, 100, 5, 0, "printer.showFan", "%", "the glossiest strip whose edges are clean"},
    {"width", 0.6, 1.6, 6, 3, "toolpath.spacing, toolpath.spacingVariation", "mm",
     "between the widths where beads first lie closed and where they begin to tear or to flatten"},
    {"directions", 0, 345, 24, 0, "print.showSide, print.mirror, pictures.spool", "degrees",
     "beads run along the dial's spokes, and the numbers rise counter-clockwise"},
    {"swatch", 0, 165, 12, 0, "pictures.spool", "degrees", "the spool's look: keep the card with it"},
    {"coupon", 0.91, 1.0, 4, 2, "print.flow", "", "the lowest disc without dark gaps between its rounds"},
};

const Kind& row(CalibrationKind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

/// ".88", "-.06", "215".
std::string written(double value, int digits) {
  const std::string text = fixed(value, digits);
  if (text.starts_with("0.")) return text.substr(1);
  return text.starts_with("-0.") ? "-" + text.substr(2) : text;
}

/// What hot end and machine manage [mm/s]. \param width  of the widest bead [nozzle].
double fastest(const Printer& printer, const PrintParams& print, double width) {
  const double byFlow = std::floor(printer.maxFlow / (print.flow * print.layerHeight * width * printer.nozzle));
  return printer.machineSpeed > 0 ? std::min(byFlow, printer.machineSpeed) : byFlow;
}

// A plate that grows.
class Plate {
 public:
  Plate(const CalibrationRequest& request, std::vector<double> values) : values_(std::move(values)) {
    const Kind& kind = row(request.kind);
    plate_.kind = request.kind;
    plate_.setting = kind.setting;
    plate_.unit = kind.unit;
    plate_.advice = kind.advice;
    plate_.printer = request.project.printer;
    PrintParams& print = plate_.print = request.project.print;
    print.showSide = ShowSide::Up;
    print.rotate = 0;
    print.mirror = false;
    print.copies = {1, 1};
    print.startHeight = 0;
    print.place.reset();
    print.basePattern = BasePattern::Hatched;
    print.constantFlow = false;
    print.base = 1;
    print.layers = 1;
    width_ = plate_.printer.nozzle;
    plate_.patches.patches.emplace_back();  // labels come first: what they are laid with is nobody's test
    plate_.patches.patches.front().layer = 1;
  }

  [[nodiscard]] double width() const { return width_; }
  /// That all values need.
  [[nodiscard]] int digits() const {
    int digits = 0;
    for (const double value : values_) {
      const std::string text = decimal(value, row(plate_.kind).digits);
      const std::size_t point = text.find('.');
      if (point != std::string::npos) digits = std::max(digits, static_cast<int>(text.size() - point - 1));
    }
    return digits;
  }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  [[nodiscard]] const Printer& printer() const { return plate_.printer; }
  [[nodiscard]] const PrintParams& print() const { return plate_.print; }
  PrintParams& print() { return plate_.print; }

  void base(Ring ring) { rings_.push_back(std::move(ring)); }

  /// Beads as oriented layers have them, until changed.
  Patch& patch(std::vector<PatchLine> lines, int layer = 1) {
    Patch patch;
    patch.layer = layer;
    patch.lines = std::move(lines);
    patch.flow = plate_.print.flow;
    plate_.patches.patches.push_back(std::move(patch));
    return plate_.patches.patches.back();
  }
  void add(Patch patch) { plate_.patches.patches.push_back(std::move(patch)); }

  Patch& labels() { return plate_.patches.patches.front(); }
  void draw(std::vector<PatchLine> lines) {
    std::vector<PatchLine>& all = labels().lines;
    for (PatchLine& line : lines) all.push_back(std::move(line));
  }
  void label(const std::string& text, Vec2 corner, double unit = kUnit) { draw(writing(text, corner, unit, width_)); }
  /// \param middle  of the writing.
  void labelAt(const std::string& text, Vec2 middle, double unit = kUnit) {
    label(text, middle - 0.5 * unit * Vec2{textWidth(text), kLetterHeight}, unit);
  }

  /// Of the patch that is laid next.
  void value(double value, std::string label, Vec2 at) {
    plate_.values.push_back({std::move(label), value, at, plate_.patches.patches.size()});
  }

  /// Moves all to the page's corner.
  CalibrationPlate done() && {
    Bounds all;
    for (const Ring& ring : rings_) {
      for (const Vec2 p : ring) all.add(p);
    }
    FilledPath path;
    for (Ring& ring : rings_) {
      for (Vec2& p : ring) p = p - all.min;
      path.rings.push_back(std::move(ring));
    }
    plate_.patches.shape = {{std::move(path)}, all.size()};
    std::erase_if(plate_.patches.patches, [](const Patch& patch) { return patch.lines.empty(); });
    for (Patch& patch : plate_.patches.patches) {
      for (PatchLine& line : patch.lines) {
        for (Vec2& p : line.points) p = p - all.min;
      }
    }
    for (CalibrationValue& value : plate_.values) value.at = value.at - all.min;
    return std::move(plate_);
  }

 private:
  CalibrationPlate plate_;
  std::vector<double> values_;
  std::vector<Ring> rings_;
  double width_ = 0;
};

/// Lower left corners of cells, four in a row, from the upper left.
Vec2 cell(int k, Vec2 step) { return {(k % 4) * step.x, -(k / 4) * step.y}; }

// The whole square is one layer, lifted by its value; the writing lies on it.
void firstLayer(Plate& plate) {
  constexpr double kSide = 15;
  plate.print().base = 0;
  plate.print().layers = 2;
  const double width = plate.width();
  for (std::size_t k = 0; k < plate.values().size(); ++k) {
    const double value = plate.values()[k];
    const Vec2 corner = cell(static_cast<int>(k), {kSide + 2, kSide + kBand + 2});
    const Ring square = box(corner, corner + Vec2{kSide, kSide + kBand});
    plate.base(square);
    const std::string label = (value > 0 ? "+" : "") + written(value, plate.digits());
    plate.label(label, corner + Vec2{kMargin, kMargin});
    plate.value(value, label, corner + 0.5 * Vec2{kSide, kSide + kBand});
    Patch& patch = plate.patch(filled(square, {1, 0}, width), 0);
    patch.flow = plate.print().baseFlow;
    patch.lift = value;
  }
}

void discs(Plate& plate) {
  constexpr double kRadius = 6.5;
  constexpr double kAround = kRadius + 0.5;
  constexpr double kNumbers = 5;  // [mm] of the band below a disc
  constexpr double kTouch = 0.7;  // [mm], by which a band reaches into what is above and below it
  plate.print().layers = 2;
  for (std::size_t k = 0; k < plate.values().size(); ++k) {
    const double value = plate.values()[k];
    const Vec2 corner = cell(static_cast<int>(k), {2 * kAround, 2 * kAround + kNumbers - kTouch});
    const Vec2 centre = corner + Vec2{kAround, kNumbers + kAround};
    plate.base(disc(centre, kAround));
    plate.base(box(corner, corner + Vec2{2 * kAround, kNumbers + kTouch}));
    plate.labelAt(written(value, 2), corner + Vec2{kAround, (kTouch + kNumbers) / 2});
    plate.value(value, written(value, 2), centre);
    for (const int layer : {1, 2}) plate.patch({spiral(centre, kRadius, plate.width())}, layer).flow = value;
  }
}

// One below the other, with the value on the left of each.
// \param lay  (place of the row's lower left corner, value). \return how wide the writing is [mm].
template <class Lay>
void rows(Plate& plate, double length, double high, const Lay& lay) {
  const int digits = plate.digits();
  double writing = 0;
  for (const double value : plate.values()) writing = std::max(writing, kUnit * textWidth(written(value, digits)));
  const double left = writing + 2 * kMargin + plate.width();
  const auto count = static_cast<double>(plate.values().size());
  plate.base(box({-left, -count * high}, {length + kOutline, kOutline}));
  for (std::size_t k = 0; k < plate.values().size(); ++k) {
    const double value = plate.values()[k];
    const Vec2 corner{0, -high * static_cast<double>(k + 1) + kOutline};
    const std::string label = written(value, digits);
    plate.label(label, corner + Vec2{-left + kMargin + plate.width() / 2, (high - kOutline - kHigh) / 2});
    plate.value(value, label, corner + 0.5 * Vec2{length, high - kOutline});
    lay(corner, value);
  }
}

void combs(Plate& plate) {
  constexpr double kLength = 36;
  constexpr double kRow = 6;
  const Printer& printer = plate.printer();
  // As fast as plates run: slower hairpins show nothing.
  double speed = printer.showSpeed > 0 ? printer.showSpeed : printer.speed;
  speed = std::min(speed, fastest(printer, plate.print(), 1));
  rows(plate, kLength, kRow, [&](Vec2 corner, double value) {
    Patch& patch = plate.patch({comb(corner, kLength, kRow - 1, plate.width())});
    patch.advance = value;
    patch.speed = speed;
  });
}

void speeds(Plate& plate) {
  plate.labels().speed = plate.values().front();
  const double width = plate.width();
  const double half = 18 + width;  // two waves
  const int lines = 2 * std::max(1, static_cast<int>(2 / width));
  rows(plate, 2 * half + 2, std::max(lines * width + 0.6, kHigh + 1.2), [&](Vec2 corner, double value) {
    for (const bool constant : {false, true}) {
      const Vec2 from = corner + Vec2{constant ? half + 2 : 0, 0};
      Patch& patch = plate.patch({wavyRow(from, half, lines, width)});
      patch.speed = value;
      patch.constantFlow = constant;
      patch.spacing = width;
    }
  });
}

void strips(Plate& plate, double Patch::*field) {
  constexpr double kLength = 36;
  const double high = std::max(1.0, std::floor(4.6 / plate.width())) * plate.width();
  rows(plate, kLength, high + 0.6, [&](Vec2 corner, double value) {
    plate.patch(filled(box(corner, corner + Vec2{kLength, high}), {1, 0}, plate.width())).*field = value;
  });
}

// A wedge with its narrow end on the left, ticks and numbers below.
void wedgeWithTicks(Plate& plate, Vec2 leftMiddle, double length, int lines) {
  const double nozzle = plate.width();
  const double least = plate.values().front();
  const double most = plate.values().back();
  plate.patch({wedge(leftMiddle, length, lines, least, most)});
  const double bottom = leftMiddle.y - lines * most / 2;
  for (const double value : plate.values()) {
    const double x = std::clamp(leftMiddle.x + length * (value - least) / (most - least), leftMiddle.x + nozzle / 2,
                                leftMiddle.x + length - nozzle / 2);
    plate.draw({stroke({x, bottom - 1 - 1.2}, {x, bottom - 1}, nozzle)});
    plate.labelAt(written(value, 2), {x, bottom - 2.8 - kHigh / 2});
  }
}

void widths(Plate& plate) {
  constexpr double kLength = 55;
  constexpr int kLines = 12;
  const double most = plate.values().back();
  const double side = kUnit * textWidth(".00") / 2 + kMargin + plate.width();
  const double top = kLines * most / 2 + kOutline;
  plate.base(box({-side, -top - 3 - kHigh - kMargin}, {kLength + side, top}));
  const double least = plate.values().front();
  for (const double value : plate.values()) {
    plate.value(value, written(value, 2), {kLength * (value - least) / (most - least), 0});
  }
  wedgeWithTicks(plate, {0, 0}, kLength, kLines);
}

// Cosines of 0, 15, ..., 90 degrees: the angles of the star are exact.
Vec2 spoke(int k) {
  const double root2 = std::sqrt(2.0);
  const double root3 = std::sqrt(3.0);
  const double root6 = std::sqrt(6.0);
  const double cosines[] = {1, (root6 + root2) / 4, root3 / 2, root2 / 2, 0.5, (root6 - root2) / 4, 0};
  const int quarter = k / 6 % 4;
  const int rest = k % 6;
  const Vec2 first{cosines[rest], cosines[6 - rest]};
  return quarter == 0   ? first
         : quarter == 1 ? Vec2{-first.y, first.x}
         : quarter == 2 ? Vec2{-first.x, -first.y}
                        : Vec2{first.y, -first.x};
}

// Sector k lies where the dial says 15 k degrees, and its beads run that way.
// \param tell  whether the degrees are the values of the plate.
void star(Plate& plate, Vec2 centre, double inner, double outer, bool tell) {
  constexpr double kTangent = 0.13165249758739583;  // of half a sector
  constexpr double kGap = 0.15;                     // [mm] off each side
  const double apex = kGap / kTangent;
  for (int k = 0; k < 24; ++k) {
    const Vec2 along = spoke(k);
    const Vec2 across{-along.y, along.x};
    const auto at = [&](double u, double side) { return centre + u * along + side * (u - apex) * kTangent * across; };
    if (tell) plate.value(15 * k, std::to_string(15 * k), centre + 0.5 * (inner + outer) * along);
    plate.patch(filled({at(inner, -1), at(outer, -1), at(outer, 1), at(inner, 1)}, along, plate.width()));
  }
}

void directions(Plate& plate) {
  constexpr double kInner = 5;
  constexpr double kOuter = 19;
  constexpr double kTick = 1.4;
  constexpr double kNumbers = 25.2;
  constexpr double kSmall = 0.45;  // [mm] of writing
  plate.base(disc({0, 0}, 29.2));
  for (int k = 0; k < 24; ++k) {
    const double length = k % 3 == 0 ? kTick : kTick / 2;
    plate.draw({stroke((kOuter + 0.8) * spoke(k), (kOuter + 0.8 + length) * spoke(k), plate.width())});
    if (k % 3 == 0) plate.labelAt(std::to_string(15 * k), kNumbers * spoke(k), kSmall);
  }
  star(plate, {0, 0}, kInner, kOuter, true);
}

// Star on the upper left, discs on the right, wedge below them, ruler and corner marks along the edges.
void coupon(Plate& plate) {
  constexpr double kSide = 54;
  constexpr double kMark = 4;
  constexpr double kEdge = 1;
  constexpr double kSmall = 0.45;  // [mm] of writing
  constexpr double kRadius = 3.7;
  const double width = plate.width();
  plate.base(box({0, 0}, {kSide, kSide}));

  for (const Vec2 corner : {Vec2{kEdge, kEdge},
                            {kSide - kEdge - kMark, kEdge},
                            {kEdge, kSide - kEdge - kMark},
                            {kSide - kEdge - kMark, kSide - kEdge - kMark}}) {
    plate.draw(filled(box(corner, corner + Vec2{kMark, kMark}), {1, 0}, width));
  }
  // A second square beside the lower left one tells which way round the coupon lies.
  const Vec2 beside{kEdge + kMark + 1, kEdge};
  plate.draw(filled(box(beside, beside + Vec2{kMark / 2, kMark}), {1, 0}, width));

  for (int mm = 0; mm <= 30; ++mm) {  // the ruler
    const double x = 13 + mm;
    const double length = mm % 10 == 0 ? 3 : mm % 5 == 0 ? 2.2 : 1.5;
    plate.draw({stroke({x, kEdge}, {x, kEdge + length}, std::clamp(0.45, kLeastWidth * width, width))});
  }

  const Vec2 middle{15.5, 34};
  for (const int k : {0, 6}) {
    plate.draw({stroke(middle + 13.6 * spoke(k), middle + 14.8 * spoke(k), width)});
  }
  plate.labelAt("0", middle + 16.6 * spoke(0), kSmall);
  plate.labelAt("90", middle + 17 * spoke(6), kSmall);

  for (std::size_t k = 0; k < plate.values().size(); ++k) {
    const double value = plate.values()[k];
    const Vec2 centre{46, 43.5 - 8.2 * static_cast<double>(k)};
    const std::string label = written(value, 2);
    plate.labelAt(label, centre - Vec2{4.4 + kSmall * textWidth(label) / 2 + width, 0}, kSmall);
    plate.value(value, label, centre);
    plate.patch({spiral(centre, kRadius, width)}).flow = value;
  }

  const double least = kLeastWidth * width;
  const double most = kMostWidth * width;
  const int lines = std::max(2, static_cast<int>(6.4 / most));
  plate.patch({wedge({6, 9.2}, 42, lines, least, most)});
  star(plate, middle, 3.5, 13, false);
}

/// First and last value of a kind on this printer.
std::pair<double, double> usualRange(const CalibrationRequest& request) {
  const Kind& kind = row(request.kind);
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
      const double high = printer.anyTemperature ? 500 : 300;
      return {std::max(low, printer.nozzleTemperature + kind.from),
              std::min(high, printer.nozzleTemperature + kind.to)};
    }
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

std::optional<Error> checkRange(const CalibrationRequest& request) {
  const Kind& kind = row(request.kind);
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
  const Kind& kind = row(request.kind);
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
  const Kind& kind = row(request.kind);
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
      return within(printer.anyTemperature ? 1 : 170, printer.anyTemperature ? 500 : 300);
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

// The table again, for those who find the file later.
void addNotes(CalibrationPlate& plate) {
  std::vector<std::string>& notes = plate.print.notes;
  notes.clear();
  notes.push_back(std::string("calibration: ") + row(plate.kind).name);
  notes.push_back("look for: " + plate.advice);
  notes.push_back("type back: " + plate.setting);
  for (const CalibrationValue& value : plate.values) {
    const std::string unit = plate.unit.empty() ? "" : " " + plate.unit;
    notes.push_back("written " + value.label + ": " + decimal(value.value, 4) + unit + " at " + fixed(value.at.x, 1) +
                    ", " + fixed(value.at.y, 1) + " mm from the lower left");
  }
}

}  // namespace

const std::vector<std::string>& calibrationKinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Kind& kind : kKinds) all.emplace_back(kind.name);
    return all;
  }();
  return names;
}

Result<CalibrationPlate> makeCalibration(const CalibrationRequest& request, const RunContext& run) {
  if (auto error = checkRange(request)) return *error;
  std::vector<double> values = valuesOf(request);
  if (auto error = checkValues(request, values)) return *error;
  Plate plate(request, std::move(values));
  switch (request.kind) {
    case CalibrationKind::FirstLayer:
      firstLayer(plate);
      break;
    case CalibrationKind::Flow:
      discs(plate);
      break;
    case CalibrationKind::Advance:
      combs(plate);
      break;
    case CalibrationKind::Speed:
      speeds(plate);
      break;
    case CalibrationKind::Temperature:
      strips(plate, &Patch::temperature);
      break;
    case CalibrationKind::Fan:
      strips(plate, &Patch::fan);
      break;
    case CalibrationKind::Width:
      widths(plate);
      break;
    case CalibrationKind::Directions:
      directions(plate);
      break;
    case CalibrationKind::Coupon:
      coupon(plate);
      break;
    case CalibrationKind::Swatch:
      break;
  }
  CalibrationPlate made = std::move(plate).done();
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
