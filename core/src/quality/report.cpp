// The report as JSON text. Numbers have fixed decimals and come from integers: the same bytes on every platform. Not by
// the JSON library: it writes as many digits as a double needs, and each number of a list on a line of its own.
#include "sillon/quality/report.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/decimal_text.hpp"
#include "base/json_text.hpp"
#include "sillon/base/version.hpp"

namespace sillon {
namespace {

/// Fixed decimals, or null: JSON has no NaN.
std::string number(double value, int decimals) { return std::abs(value) < 1e12 ? fixed(value, decimals) : "null"; }

/// An object with one member per line; members are JSON texts.
class Object {
 public:
  explicit Object(std::string indent) : indent_(std::move(indent)) {}

  void add(std::string_view key, const std::string& value) {
    body_ += (body_.empty() ? "\n" : ",\n") + indent_ + "  " + jsonString(key) + ": " + value;
  }
  void add(std::string_view key, std::int64_t value) { add(key, std::to_string(value)); }
  void add(std::string_view key, double value, int decimals) { add(key, number(value, decimals)); }
  [[nodiscard]] std::string text() const { return "{" + body_ + "\n" + indent_ + "}"; }

 private:
  std::string indent_;
  std::string body_;
};

std::string widthJson(const WidthMeasures& width) {
  Object object("  ");
  object.add("p01", width.p01, 4);
  object.add("median", width.median, 4);
  object.add("p99", width.p99, 4);
  object.add("belowHalf", width.belowHalf, 5);
  object.add("clamped", width.clamped, 5);
  return object.text();
}

std::string timeJson(const std::vector<StageTime>& stages) {
  Object object("  ");
  double total = 0;
  for (const StageTime& stage : stages) {
    object.add(stage.stage, stage.seconds, 4);
    total += stage.seconds;
  }
  object.add("total", total, 4);
  return object.text();
}

std::int64_t pointCount(const Toolpath& toolpath) {
  std::int64_t count = 0;
  for (const Cycle& cycle : toolpath.cycles) count += static_cast<std::int64_t>(cycle.points.size());
  return count;
}

// The largest; more are no list to read.
std::string placesJson(const std::vector<ThinPlace>& places) {
  constexpr std::size_t kMost = 100;
  std::string list;
  for (std::size_t k = 0; k < std::min(places.size(), kMost); ++k) {
    const ThinPlace& place = places[k];
    list += (k == 0 ? "[" : ", [") + number(place.at.x, 2) + ", " + number(place.at.y, 2) + ", " +
            number(place.areaMm2, 3) + ", " + number(place.width, 3) + "]";
  }
  return "[" + list + "]";
}

std::string pointsJson(const std::vector<Vec2>& points) {
  std::string list;
  for (const Vec2 p : points) list += (list.empty() ? "[" : ", [") + number(p.x, 2) + ", " + number(p.y, 2) + "]";
  return "[" + list + "]";
}

void addMeasures(const Measures& measures, Object& report) {
  report.add("lengthMm", measures.lengthMm, 3);
  report.add("alignment", measures.alignment, 4);
  report.add("alignmentInterior", measures.alignmentInterior, 4);
  report.add("alignmentConstrained", measures.alignmentConstrained, 4);
  report.add("coverage", measures.coverage, 3);
  report.add("overlap", measures.overlap, 3);
  report.add("spill", measures.spill, 3);
  report.add("uTurns", measures.uTurns);
  report.add("kinks", measures.kinks);
  report.add("crossings", measures.crossings);
  report.add("dislocations", measures.dislocations);
  report.add("singularities", measures.singularities);
  report.add("dislocationBound", measures.dislocationBound, 0);
  report.add("turnBound", measures.turnBound, 0);
  report.add("width", widthJson(measures.width));
  report.add("fillRatio", measures.fillRatio, 4);
  report.add("lostAreaMm2", measures.lostAreaMm2, 4);
  report.add("lostPlaces", placesJson(measures.lostPlaces));
  report.add("keptAreaMm2", measures.keptAreaMm2, 4);
  report.add("keptPlaces", placesJson(measures.keptPlaces));
}

std::string perimeterText(const ToolpathParams& params) {
  switch (params.perimeterMode) {
    case PerimeterMode::None:
      return "none";
    case PerimeterMode::Soft:
      return "soft";
    case PerimeterMode::Count:
      break;
  }
  return std::to_string(params.perimeters);
}

}  // namespace

std::string reportJson(const ToolpathResult& plate, const std::optional<Measures>& measures, int threads,
                       std::int64_t peakBytes) {
  Object report("");
  report.add("version", jsonString(kVersion));
  report.add("spacing", plate.toolpath.spacing, 4);
  std::string grid = "[";
  grid += std::to_string(plate.nx) + ", " + std::to_string(plate.ny) + "]";
  report.add("grid", grid);
  report.add("parts", plate.parts);
  report.add("cycles", plate.contourCycles);
  report.add("toolpaths", static_cast<std::int64_t>(plate.toolpath.cycles.size()));
  report.add("points", pointCount(plate.toolpath));
  if (measures) addMeasures(*measures, report);
  report.add("longestJointMm", plate.longestJointMm, 4);
  report.add("gapJoints", static_cast<std::int64_t>(plate.gapJoints));
  report.add("unjoined", static_cast<std::int64_t>(plate.unjoined));
  report.add("apart", pointsJson(plate.apart));
  report.add("time", timeJson(plate.time));
  report.add("peakBytes", peakBytes);
  report.add("threads", static_cast<std::int64_t>(threads));
  report.add("digest", jsonString(measures ? measures->digest : digestOf(plate.toolpath)));
  return report.text() + "\n";
}

std::string withEntry(std::string report, std::string_view name, std::string_view json) {
  const std::size_t end = report.rfind("\n}");
  if (end == std::string::npos) return report;
  report.resize(end);
  return report.append(",\n  ").append(jsonString(name)).append(": ").append(json).append("\n}\n");
}

std::string withPictures(std::string report, std::span<const ShownPicture> pictures,
                         std::span<const PictureMeasures> measures, bool fromGcode) {
  const std::size_t count = std::min(pictures.size(), measures.size());
  if (count == 0) return report;
  std::string list;
  for (std::size_t k = 0; k < count; ++k) {
    const PictureMeasures& m = measures[k];
    const Lamp& lamp = pictures[k].lamp;
    std::string others;
    for (std::size_t other = 0; other < m.others.size(); ++other) {
      if (other != k) others += (others.empty() ? "" : ", ") + number(m.others[other], 4);
    }
    Object object("    ");
    // File names need not be UTF-8; what is not becomes U+FFFD instead of an exception.
    object.add("file", jsonString(pictures[k].file));
    object.add("lamp", std::string("[") + number(lamp.azimuth, 2) + ", " + number(lamp.elevation, 2) + "]");
    object.add("r", m.r, 4);
    object.add("ssim", m.ssim, 4);
    object.add("contrast", m.contrast, 2);
    object.add("others", "[" + others + "]");
    object.add("from", jsonString(fromGcode ? "gcode" : "toolpath"));
    list += (list.empty() ? "\n    " : ",\n    ") + object.text();
  }
  return withEntry(std::move(report), "pictures", "[" + list + "\n  ]");
}

std::vector<std::string> plateNotes(const ToolpathParams& params, const std::optional<Measures>& measures) {
  std::vector<std::string> notes = {"seed = " + std::to_string(params.seed) +
                                    ", perimeters = " + perimeterText(params)};
  if (measures) {
    notes.push_back("alignment = " + number(measures->alignment, 4) + ", coverage = " + number(measures->coverage, 2) +
                    ", overlap = " + number(measures->overlap, 2) +
                    ", crossings = " + std::to_string(measures->crossings));
    notes.push_back("toolpath digest = " + measures->digest);
  }
  return notes;
}

}  // namespace sillon
