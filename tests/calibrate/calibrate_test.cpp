// Calibration plates are looked at as the G-code that a printer gets.
#include "sillon/calibrate/calibrate.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "calibrate/prints.hpp"
#include "printer/dialect.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/settings/presets.hpp"
#include "support/about.hpp"
#include "support/gcode_check.hpp"

using namespace sillon;
using namespace sillon::test;

namespace {

constexpr double kFilament = std::numbers::pi * 1.75 * 1.75 / 4;  // [mm²]

std::vector<CalibrationKind> allKinds() {
  std::vector<CalibrationKind> all;
  for (std::size_t k = 0; k < calibrationKinds().size(); ++k) all.push_back(static_cast<CalibrationKind>(k));
  return all;
}

const std::string& nameOf(CalibrationKind kind) { return calibrationKinds()[static_cast<std::size_t>(kind)]; }

CalibrationPlate made(CalibrationKind kind, const Project& project = {}) {
  const RunContext run(1);
  Result<CalibrationPlate> plate = makeCalibration({kind, {}, {}, project}, run);
  REQUIRE_MESSAGE(plate.ok(), plate.error().message);
  return std::move(plate).value();
}

std::string refused(const CalibrationRequest& request) {
  const RunContext run(1);
  const Result<CalibrationPlate> plate = makeCalibration(request, run);
  return plate ? "made" : plate.error().message;
}

struct Written {
  GcodeSummary summary;
  std::string text;
};

Written written(const CalibrationPlate& plate) {
  std::string text;
  const Result<GcodeSummary> summary = writeCalibration(plate, [&](std::string_view piece) {
    text += piece;
    return true;
  });
  REQUIRE_MESSAGE(summary.ok(), summary.error().message);
  return {summary.value(), text};
}

/// Where a point of the bed lies on the plate [mm].
Vec2 onPlate(const CalibrationPlate& plate, const ReadMove& move) {
  const Vec2 corner = 0.5 * (plate.printer.bedMin + plate.printer.bedMax - plate.patches.shape.page);
  return Vec2{static_cast<double>(move.x1) / 1000, static_cast<double>(move.y1) / 1000} - corner;
}

/// The value whose place is nearest.
const CalibrationValue& nearest(const CalibrationPlate& plate, Vec2 p) {
  return *std::min_element(
      plate.values.begin(), plate.values.end(),
      [&](const CalibrationValue& a, const CalibrationValue& b) { return length(a.at - p) < length(b.at - p); });
}

/// Bead area times height of the lines of a patch, without its flow [mm³].
double cells(const Patch& patch, double height) {
  double sum = 0;
  for (const PatchLine& line : patch.lines) {
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      sum += length(line.points[i + 1] - line.points[i]) * (line.widths[i] + line.widths[i + 1]) / 2;
    }
  }
  return sum * height;
}

/// One printer per dialect; Bambu machines need a start block, as their own slicer's files have one.
std::vector<Project> dialects() {
  std::vector<Project> all;
  for (const char* id : {"creality-ender-3-v2", "voron-2-4-300", "generic", "prusa-mk4", "bambu-p1s"}) {
    Project project;
    REQUIRE_FALSE(applyProfile(ProfileKind::Printer, id, project.printer));
    if (project.printer.flavor == GcodeFlavor::Bambu) {
      project.printer.startGcode = "G28\nM190 S{first_layer_bed_temperature}\nM109 S{first_layer_temperature}";
    }
    if (std::string(id) == "generic") project.printer.flavor = GcodeFlavor::RepRap;
    all.push_back(project);
  }
  return all;
}

}  // namespace

TEST_CASE("every kind passes the check without a finding on a printer of every dialect") {
  std::set<GcodeFlavor> flavors;
  for (const Project& project : dialects()) {
    flavors.insert(project.printer.flavor);
    for (const CalibrationKind kind : allKinds()) {
      CAPTURE(nameOf(kind) + " on " + project.printer.name);
      const CalibrationPlate plate = made(kind, project);
      const Written file = written(plate);
      const GcodeCheck check = checkGcode(file.text, plate.printer);
      for (const GcodeFinding& finding : check.findings) FAIL_CHECK(finding.message << " in line " << finding.line);
      CHECK(check.filamentMm > 100);
      CHECK(check.layers == plate.print.base + plate.print.layers);
    }
  }
  CHECK(flavors.size() == 5);
}

TEST_CASE("on the default printer each takes at most ten minutes and three grams; the swatch takes twenty") {
  for (const CalibrationKind kind : allKinds()) {
    CAPTURE(nameOf(kind));
    const GcodeSummary summary = written(made(kind)).summary;
    CHECK(summary.seconds <= (kind == CalibrationKind::Swatch ? 1200 : 600));
    CHECK(summary.filamentGrams <= 3);
    CHECK(summary.filamentGrams > 0.3);
  }
}

TEST_CASE("each value is written differently, and told in the file") {
  for (const CalibrationKind kind : allKinds()) {
    if (kind == CalibrationKind::Swatch) continue;
    CAPTURE(nameOf(kind));
    const CalibrationPlate plate = made(kind);
    std::set<std::string> labels;
    const std::string text = written(plate).text;
    for (const CalibrationValue& value : plate.values) {
      labels.insert(value.label);
      CHECK(text.find("\n; written " + value.label + ": ") != std::string::npos);
      CHECK(value.at.x > 0);
      CHECK(value.at.y > 0);
      CHECK(value.at.x < plate.patches.shape.page.x);
      CHECK(value.at.y < plate.patches.shape.page.y);
    }
    CHECK(labels.size() == plate.values.size());
    CHECK(text.find("\n; calibration: " + nameOf(kind) + "\n") != std::string::npos);
  }
}

TEST_CASE("the plastic of a disc is flow x area x height") {
  for (const CalibrationKind kind : {CalibrationKind::Flow, CalibrationKind::Coupon}) {
    const CalibrationPlate plate = made(kind);
    const bool coupon = kind == CalibrationKind::Coupon;
    const double radius = coupon ? 3.7 : 6.5;
    const ReadFile file = readGcode(written(plate).text);
    CHECK(plate.values.size() == (coupon ? 4 : 7));
    CHECK(plate.values.front().value == (coupon ? 0.91 : 0.88));
    CHECK(plate.values.back().value == 1);
    for (const CalibrationValue& value : plate.values) {
      double mm3 = 0;
      for (const ReadPath& path : file.paths) {
        if (path.layer == 1) continue;
        const bool inside = std::all_of(path.moves.begin(), path.moves.end(), [&](const ReadMove& move) {
          return length(onPlate(plate, move) - value.at) < radius + 0.01;
        });
        if (inside) mm3 += path.filament() * kFilament;
      }
      const double area = std::numbers::pi * radius * radius;
      CHECK(mm3 == about(value.value * area * 0.2 * plate.print.layers, 0.003));
    }
  }
}

TEST_CASE("each row runs at its speed, and where the flow is constant fast beads are thin ones") {
  Project project;
  project.printer.curveAcceleration = 0;
  const CalibrationPlate plate = made(CalibrationKind::Speed, project);
  const ReadFile file = readGcode(written(plate).text);
  CHECK(plate.values.front().value == 15);
  CHECK(plate.values.back().value == 70);
  int rows = 0;
  for (const ReadPath& path : file.paths) {
    if (path.layer != 2 || path.moves.size() < 20) continue;
    ++rows;
    const CalibrationValue& value = nearest(plate, onPlate(plate, path.moves[path.moves.size() / 2]));
    const bool constant = onPlate(plate, path.moves.front()).x > value.at.x;
    double fastest = 0;
    double slowest = 1e9;
    double mm3 = 0;
    for (const ReadMove& move : path.moves) {
      fastest = std::max(fastest, static_cast<double>(move.feedrate) / 60);
      slowest = std::min(slowest, static_cast<double>(move.feedrate) / 60);
      mm3 += static_cast<double>(move.e) / 1e5 * kFilament;
    }
    if (constant) {
      CHECK(fastest > 1.15 * value.value);  // at three quarters of the width: 1.33, in whole mm/s
      CHECK(slowest < 0.85 * value.value);
    } else {
      CHECK(fastest == doctest::Approx(value.value));
      CHECK(slowest == doctest::Approx(value.value));
    }
    // Two waves of ten beads: 18 x 4 mm and the joints.
    CHECK(mm3 == about(plate.print.flow * 0.2 * (18 * 4 + 9 * 0.4 * 0.4), 0.01));
  }
  CHECK(rows == 24);
}

TEST_CASE("each strip has its own fan") {
  const CalibrationPlate cool = made(CalibrationKind::Fan);
  const std::string fans = written(cool).text;
  std::size_t at = fans.find(";LAYER_CHANGE", fans.find(";LAYER_CHANGE") + 1);
  for (const char* command : {"M106 S0", "M106 S64", "M106 S128", "M106 S191", "M106 S255"}) {
    CAPTURE(command);
    at = fans.find("\n" + std::string(command) + "\n", at);
    CHECK(at != std::string::npos);
  }
}

TEST_CASE("the wedge goes from 0.6 to 1.6 nozzle, and its plastic is that of the trapezoid") {
  for (const double nozzle : {0.25, 0.4, 0.8}) {
    CAPTURE(nozzle);
    Project project;
    project.printer.nozzle = nozzle;
    project.print.layerHeight = 0.5 * nozzle;
    const CalibrationPlate plate = made(CalibrationKind::Width, project);
    const Patch& patch = plate.patches.patches[plate.values.front().patch];
    REQUIRE(patch.lines.size() == 1);
    const auto [least, most] = std::minmax_element(patch.lines[0].widths.begin(), patch.lines[0].widths.end());
    CHECK(*least == about(0.6 * nozzle, 0.01));
    CHECK(*most == about(1.6 * nozzle, 0.01));
    CHECK(plate.values.front().value == doctest::Approx(0.6 * nozzle));
    CHECK(plate.values.back().value == doctest::Approx(1.6 * nozzle));
    CHECK(cells(patch, 1) == about(55 * 12 * 1.1 * nozzle, 0.01));
    CHECK(written(plate).summary.filamentMm > 0);
  }
}

TEST_CASE("sector k of the star lies at 15 k degrees counter-clockwise from the right, and so run its beads") {
  const CalibrationPlate plate = made(CalibrationKind::Directions);
  REQUIRE(plate.values.size() == 24);
  const Vec2 middle = 0.5 * (plate.values[0].at + plate.values[12].at);
  for (int k = 0; k < 24; ++k) {
    CAPTURE(k);
    const CalibrationValue& value = plate.values[static_cast<std::size_t>(k)];
    CHECK(value.value == 15 * k);
    const double angle = std::numbers::pi * k / 12;
    const Vec2 along{std::cos(angle), std::sin(angle)};
    CHECK(length(value.at - middle - 12 * along) < 1e-9);
    const Patch& patch = plate.patches.patches[value.patch];
    REQUIRE(patch.lines.size() == 1);
    const std::vector<Vec2>& points = patch.lines[0].points;
    CHECK(points.size() >= 16);
    double lengthAlong = 0;
    double lengthOfAll = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Vec2 d = points[i + 1] - points[i];
      if (i % 2 == 0) CHECK(std::abs(cross(along, d)) < 1e-9);
      lengthOfAll += length(d);
      if (i % 2 == 0) lengthAlong += length(d);
    }
    CHECK(lengthAlong > 0.75 * lengthOfAll);
  }
  // The numbers are written as they are read: the first stroke of "0" begins at its lower left.
  CHECK(plate.values[0].at.x > plate.values[12].at.x);
  CHECK(plate.values[6].at.y > plate.values[18].at.y);
}

TEST_CASE("turns of the coupon's loose spirals lie two nozzles apart") {
  const CalibrationPlate plate = made(CalibrationKind::Coupon);
  for (const CouponSpiral& loose : looseSpirals(0.4)) {
    const auto patch = std::find_if(plate.patches.patches.begin(), plate.patches.patches.end(), [&](const Patch& p) {
      return p.lines.size() == 1 && length(p.lines[0].points.front() - loose.centre) < 0.5;
    });
    REQUIRE(patch != plate.patches.patches.end());
    const std::vector<Vec2>& points = patch->lines[0].points;
    for (std::size_t k = 0; k + 72 < points.size(); ++k) {
      if (k + 73 == points.size()) continue;  // the last one may be cut
      const double here = length(points[k] - loose.centre);
      CHECK(length(points[k + 72] - loose.centre) - here == about(0.8, 1e-3));
    }
  }
}

TEST_CASE("the coupon's ruler has a tick every millimetre for 30 mm, and its corner marks frame it") {
  const CalibrationPlate plate = made(CalibrationKind::Coupon);
  std::vector<double> ticks;
  std::vector<double> tall;
  Bounds marks;
  for (const PatchLine& line : plate.patches.patches.front().lines) {
    const Vec2 a = line.points.front();
    const Vec2 b = line.points.back();
    if (line.points.size() == 2 && a.x == b.x && a.y == 1) {
      ticks.push_back(a.x);
      if (b.y == 4) tall.push_back(a.x);
    }
  }
  for (const CouponSpiral& mark : couponMarks(0.4)) {
    const auto patch = std::find_if(plate.patches.patches.begin(), plate.patches.patches.end(), [&](const Patch& p) {
      return p.lines.size() == 1 && length(p.lines[0].points.front() - mark.centre) < 0.5;
    });
    REQUIRE(patch != plate.patches.patches.end());
    CHECK(patch->flow == plate.print.flow);
    for (const Vec2 p : patch->lines[0].points) marks.add(p);
  }
  REQUIRE(ticks.size() == 31);
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    CHECK(ticks[k] - ticks[0] == doctest::Approx(static_cast<double>(k)));
  }
  REQUIRE(tall.size() == 4);
  CHECK(tall[3] - tall[0] == doctest::Approx(30));
  // 54 mm less twice 1 mm of edge, and the last turn of a spiral is on average half a bead within its radius.
  CHECK(marks.size().x == about(52 - 0.4, 0.01));
  CHECK(marks.size().y == about(52 - 0.4, 0.01));
}

TEST_CASE("the swatch shows all directions along its edge and is as large as a card") {
  const CalibrationPlate plate = made(CalibrationKind::Swatch);
  CHECK(plate.patches.shape.page == Vec2{85.6, 53.98});
  CHECK(plate.toolpath.cycles.size() == 1);
  for (const CalibrationValue& value : plate.values) {
    if (value.value < 30 || value.value > 150) continue;  // next to the background's own direction
    const Vec2 along{std::cos(value.value * std::numbers::pi / 180), std::sin(value.value * std::numbers::pi / 180)};
    double right = 0;
    double all = 0;
    const std::vector<Vec2f>& points = plate.toolpath.cycles[0].points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Vec2 p{points[i].x, points[i].y};
      const Vec2 d{points[i + 1].x - points[i].x, points[i + 1].y - points[i].y};
      if (std::abs(p.x - value.at.x) > 1.5 || std::abs(p.y - value.at.y) > 1.5) continue;
      all += length(d);
      if (std::abs(cross(along, d)) < 0.26 * length(d)) right += length(d);  // within 15 degrees
    }
    CAPTURE(value.value);
    CHECK(right > 0.85 * all);
    CHECK(all > 10);
  }
}

TEST_CASE("values that are out of range, too near each other or too fast are refused in a sentence") {
  CHECK(refused({CalibrationKind::Flow, 1.0, 0.9, {}})
            .find("flow from 1 to 0.9 has 7 values; to must be at least 0.06") == 0);
  CHECK(refused({CalibrationKind::Flow, 0.88, 0.9, {}}).find("to must be at least 0.06 above from") !=
        std::string::npos);
  CHECK(refused({CalibrationKind::Flow, 0.1, 1.0, {}}).find("flow is 0.1; it must be 0.5 to 1.5") == 0);
  CHECK(refused({CalibrationKind::Fan, 50, 150, {}}).find("fan is 125 %") != std::string::npos);
  CHECK(refused({CalibrationKind::Width, 0.1, 0.6, {}}).find("it must be 0.24 to 0.64 mm") != std::string::npos);
  CHECK(refused({CalibrationKind::Swatch, 0.0, {}, {}}).find("from and to must be left out") != std::string::npos);
  CHECK(refused({CalibrationKind::Fan, std::nan(""), {}, {}}).find("it must be -10000 to 10000") != std::string::npos);
  CHECK(refused({CalibrationKind::Fan, {}, 1e300, {}}).find("it must be -10000 to 10000") != std::string::npos);

  const RunContext run(1);
  const auto plate = makeCalibration({CalibrationKind::Speed, 50, 300, {}}, run);
  REQUIRE(plate.ok());
  const auto tooFast = writeCalibration(plate.value(), [](std::string_view) { return true; });
  REQUIRE(!tooFast.ok());
  CHECK(tooFast.error().message.find("maxFlow is 10") != std::string::npos);

  Project small;
  small.printer.bedMax = {50, 50};
  const auto over = writeCalibration(made(CalibrationKind::Coupon, small), [](std::string_view) { return true; });
  REQUIRE(!over.ok());
  CHECK(over.error().code == ErrorCode::DoesNotFit);
}

TEST_CASE("a weak hot end gets slower rows, not a refusal") {
  Project project;
  project.printer.maxFlow = 4;
  const CalibrationPlate plate = made(CalibrationKind::Speed, project);
  CHECK(plate.values.back().value < 45);
  CHECK(plate.values.front().value == 15);
  CHECK(written(plate).summary.filamentMm > 0);
}

TEST_CASE("with other nozzles and heights every kind can still be printed") {
  for (const double nozzle : {0.25, 0.6, 0.8}) {
    for (const CalibrationKind kind : allKinds()) {
      if (kind == CalibrationKind::Swatch) continue;
      CAPTURE(nameOf(kind) + " with " + std::to_string(nozzle));
      Project project;
      project.printer.nozzle = nozzle;
      project.print.layerHeight = 0.5 * nozzle;
      const CalibrationPlate plate = made(kind, project);
      const GcodeCheck check = checkGcode(written(plate).text, plate.printer);
      for (const GcodeFinding& finding : check.findings) FAIL_CHECK(finding.message << " in line " << finding.line);
    }
  }
}

TEST_CASE("the shown toolpath has a cycle for every line, there and back, as wide as its flow makes it") {
  const CalibrationPlate plate = made(CalibrationKind::Flow);
  const Toolpath shown = shownCalibration(plate);
  std::size_t lines = 0;
  for (const Patch& patch : plate.patches.patches) lines += patch.lines.size();
  CHECK(shown.cycles.size() == lines);
  CHECK(shown.cycles.back().widths.front() == doctest::Approx(0.4));
  for (const Cycle& cycle : shown.cycles) CHECK(cycle.points.size() == cycle.widths.size());
}
