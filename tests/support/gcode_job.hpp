// Plates for tests of the G-code room, and what holds for every file that is written of them.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "base/numbers.hpp"
#include "gcode/motion.hpp"
#include "sillon/gcode/writer.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "support/gcode_check.hpp"

namespace sillon::test {

inline constexpr double kArea = 2.4052818754046854;  // of filament of 1.75 mm [mm²]
/// Filament for a bead as the cell that it fills [mm].
inline double extrusion(double height, double width, double length, double flow = 1) {
  return flow * height * width * length / kArea;
}

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Written {
  Result<GcodeSummary> result;
  std::string text;
  std::size_t chunks;
};

struct Job {
  // What would blur closed forms is off: speeds that other settings choose, and loops that cross the hatch.
  Job() {
    printer.showSpeed = printer.speed;
    printer.minLayerTime = 0;
    params.basePerimeters = 0;
    params.bedFlow = params.flow;
  }

  Toolpath toolpath;
  std::optional<Toolpath> across;
  Shape shape;
  Printer printer;
  PrintParams params;

  [[nodiscard]] Written write() const {
    std::string text;
    std::size_t chunks = 0;
    const auto sink = [&](std::string_view piece) {
      CHECK(piece.size() <= 64 * 1024);
      text += piece;
      ++chunks;
      return true;
    };
    auto result = writeGcode(toolpath, shape, printer, params, sink, across ? &*across : nullptr);
    return {std::move(result), std::move(text), chunks};
  }
};

inline Shape rectangle(double width, double height) {
  return {{{{{{0, 0}, {width, 0}, {width, height}, {0, height}}}, FillRule::NonZero}}, {width, height}};
}

// A comb that covers width x height with beads of `spacing` and comes back along the bottom: cells exactly filled.
inline Cycle comb(double width, double height, double spacing, double step) {
  Cycle cycle;
  const auto add = [&](double x, double y) {
    const Vec2f p{static_cast<float>(std::round(x * 1000) / 1000), static_cast<float>(std::round(y * 1000) / 1000)};
    if (!cycle.points.empty()) {
      const Vec2f from = cycle.points.back();
      const int pieces = std::max(1, static_cast<int>(length(p - from) / step));
      for (int k = 1; k < pieces; ++k) {
        const float t = static_cast<float>(k) / static_cast<float>(pieces);
        const Vec2f q = from + t * (p - from);
        cycle.points.push_back({std::round(q.x * 1000) / 1000, std::round(q.y * 1000) / 1000});
      }
    }
    cycle.points.push_back(p);
  };
  const int columns = static_cast<int>(width / spacing / 2) * 2;  // even: the comb ends at the bottom
  add(spacing / 2, spacing / 2);
  for (int k = 0; k < columns; ++k) {
    const double x = (k + 0.5) * spacing;
    const double bottom = k == 0 ? spacing / 2 : 1.5 * spacing;
    const double top = height - spacing / 2;
    add(x, k % 2 == 0 ? bottom : top);
    add(x, k % 2 == 0 ? top : k + 1 == columns ? spacing / 2 : bottom);
  }
  cycle.points.erase(cycle.points.begin());
  cycle.widths.assign(cycle.points.size(), static_cast<float>(spacing));
  return cycle;
}

inline double pathVolume(const Cycle& cycle) {  // sum of w L
  double sum = 0;
  for (std::size_t i = 0; i < cycle.points.size(); ++i) {
    const std::size_t j = (i + 1) % cycle.points.size();
    const Vec2 a{cycle.points[i].x, cycle.points[i].y};
    const Vec2 b{cycle.points[j].x, cycle.points[j].y};
    sum += length(b - a) * (double(cycle.widths[i]) + double(cycle.widths[j])) / 2;
  }
  return sum;
}

inline Job plate(double width = 30, double height = 20, double step = 5) {
  Job job;
  job.shape = rectangle(width, height);
  job.toolpath.cycles = {comb(width, height, 0.4, step)};
  job.toolpath.spacing = 0.4;
  return job;
}

inline bool contains(const std::vector<Warning>& list, std::string_view part) {
  return std::any_of(list.begin(), list.end(),
                     [&](const Warning& warning) { return warning.message.find(part) != std::string::npos; });
}

// Everything that holds for every file.
inline ReadFile checkFile(const Job& job, const Written& written) {
  REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
  const GcodeSummary& summary = written.result.value();
  CHECK(grammarError(written.text) == "");
  const GcodeCheck check = checkGcode(written.text, job.printer);
  for (const GcodeFinding& finding : check.findings) {
    // Thin plates without room to prime or slow down are warned about, as they should be.
    if (finding.error) FAIL_CHECK(finding.rule << " " << finding.message << " in line " << finding.line);
  }
  ReadFile file = readGcode(written.text);
  CHECK_MESSAGE(file.faults.empty(), file.faults.front());
  CHECK(file.minX >= job.printer.bedMin.x);
  CHECK(file.minY >= job.printer.bedMin.y);
  CHECK(file.maxX <= job.printer.bedMax.x);
  CHECK(file.maxY <= job.printer.bedMax.y);
  CHECK(file.maxZ <= job.printer.maxZ);
  CHECK(file.layers == job.params.base + job.params.layers + job.params.rim);
  CHECK(file.moves == summary.moves);
  CHECK(static_cast<std::int64_t>(written.text.size()) == summary.bytes);
  CHECK(file.filament == doctest::Approx(summary.filamentMm).epsilon(1e-9));
  CHECK(check.filamentMm == doctest::Approx(summary.filamentMm).epsilon(1e-9));
  CHECK(check.layers == file.layers);
  CHECK(valueOf(written.text, "; filament used [mm] = ") == fixed(file.filament, 2));
  CHECK(valueOf(written.text, "; total layers count = ") == std::to_string(file.layers));

  double oriented = 0;
  for (const ReadPath& path : file.paths) {
    const bool isOriented = path.role == "Top solid infill";
    if (isOriented || (path.role == "Skirt/Brim" && path.moves.size() > 1)) CHECK(path.closed());
    CHECK(path.retractsAfter == (job.printer.retractLength > 0));
    const double height =
        path.layer == 1 && job.params.firstLayerHeight > 0 ? job.params.firstLayerHeight : job.params.layerHeight;
    const double speed = path.layer == 1 ? job.printer.firstLayerSpeed : job.printer.speed;
    if (isOriented) oriented += path.filament() / height / job.params.flow;
    double fastest = 0;
    double volumeRate = 0;
    for (const ReadMove& move : path.moves) {
      fastest = std::max(fastest, double(move.feedrate) / 60);
      if (move.length() > 0.02) {
        volumeRate =
            std::max(volumeRate, double(move.e - 1) / 1e5 * kArea / move.length() * double(move.feedrate) / 60);
      }
    }
    CHECK(fastest <= speed + 1e-9);
    CHECK(volumeRate <= job.printer.maxFlow);
    for (std::size_t i = 0; i + 8 <= path.moves.size(); ++i) {
      double seconds = 0;
      for (std::size_t k = i; k < i + 8; ++k) seconds += path.moves[k].length() * 60 / double(path.moves[k].feedrate);
      if (seconds * job.printer.maxSegmentsPerSecond < 8 * (1 - 1e-9)) FAIL_CHECK("too many segments per second");
    }
  }
  if (summary.clampedLengthMm == 0) {
    double expected = 0;
    for (const Cycle& cycle : job.toolpath.cycles) expected += pathVolume(cycle) / kArea;
    CHECK(oriented == doctest::Approx(expected * job.params.layers).epsilon(1e-5));
  }
  return file;
}

inline const ReadPath& lastPath(const ReadFile& file) { return file.paths.back(); }

// A rough closed path: a wavy circle whose widths jump.
inline Cycle roughCircle(std::mt19937& random, double radius, int count, double low, double high) {
  Cycle cycle;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * 3.14159265358979 * k / count;
    const double r = radius + 0.3 * double(random() % 1000) / 1000;
    cycle.points.push_back({static_cast<float>(std::round((15 + r * std::cos(angle)) * 1000) / 1000),
                            static_cast<float>(std::round((15 + r * std::sin(angle)) * 1000) / 1000)});
    cycle.widths.push_back(static_cast<float>(low + (high - low) * double(random() % 1000) / 999));
  }
  return cycle;
}

inline MotionLimits someLimits(GcodeFlavor flavor = GcodeFlavor::Klipper) {
  MotionLimits limits;
  limits.flavor = flavor;
  limits.layerHeight = 0.2;
  limits.filamentArea = kArea;
  limits.speed = 50;
  limits.acceleration = 1000;
  limits.cornerSpeed = flavor == GcodeFlavor::Klipper ? 5 : 4;
  limits.maxFlow = 100;
  limits.maxSegmentsPerSecond = 100000;
  limits.pressureAdvance = 0.04;
  return limits;
}

inline BeadPath pathOf(const std::vector<Vec2>& mm, double width, bool closed = false) {
  BeadPath path;
  path.closed = closed;
  for (const Vec2 p : mm) path.points.push_back({std::llround(p.x * 1000), std::llround(p.y * 1000)});
  path.widths.assign(mm.size(), width);
  return path;
}

inline double volumeOf(const std::vector<double>& widths, const std::vector<double>& lengths) {
  double sum = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) sum += lengths[i] * (widths[i] + widths[i + 1]) / 2;
  return sum;
}

}  // namespace sillon::test
