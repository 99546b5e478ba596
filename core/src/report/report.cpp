// The report as JSON text. Numbers have fixed decimals and are printed from integers, so the bytes are the same on
// every platform. The JSON library would write as many digits as a double needs, and each number of a list on its own
// line.
#include "sillon/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/json.hpp"
#include "base/numbers.hpp"
#include "report/told.hpp"
#include "sillon/base/words.hpp"

namespace sillon {
namespace {

/// A number with fixed decimals; null for NaN, which JSON lacks, and for huge values.
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

// Lists the largest places, at most kMost, so that the list stays readable.
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

void addMeasures(const Measures& measures, Object& object) {
  object.add("lengthMm", measures.lengthMm, 3);
  object.add("alignment", measures.alignment, 4);
  object.add("alignmentInterior", measures.alignmentInterior, 4);
  object.add("alignmentConstrained", measures.alignmentConstrained, 4);
  object.add("coverage", measures.coverage, 3);
  object.add("overlap", measures.overlap, 3);
  object.add("spill", measures.spill, 3);
  object.add("uTurns", measures.uTurns);
  object.add("kinks", measures.kinks);
  object.add("crossings", measures.crossings);
  object.add("dislocations", measures.dislocations);
  object.add("singularities", measures.singularities);
  object.add("dislocationBound", measures.dislocationBound, 0);
  object.add("turnBound", measures.turnBound, 0);
  object.add("width", widthJson(measures.width));
  object.add("fillRatio", measures.fillRatio, 4);
  object.add("lostAreaMm2", measures.lostAreaMm2, 4);
  object.add("lostPlaces", placesJson(measures.lostPlaces));
  object.add("keptAreaMm2", measures.keptAreaMm2, 4);
  object.add("keptPlaces", placesJson(measures.keptPlaces));
}

void addLikeness(Object& object, const Lamp& lamp, const PictureMeasures& measures) {
  object.add("lamp", std::string("[") + number(lamp.azimuth, 2) + ", " + number(lamp.elevation, 2) + "]");
  object.add("r", measures.r, 4);
  object.add("ssim", measures.ssim, 4);
  object.add("contrast", measures.contrast, 2);
}

/// Lists the layers with the shares of them that are hidden.
std::string layersJson(const std::vector<SeenLayer>& layers) {
  std::string list;
  for (const SeenLayer& one : layers) {
    Object object("    ");
    object.add("layer", std::to_string(one.layer));
    object.add("beside", one.beside, 4);
    object.add("underRim", one.underRim, 4);
    object.add("covered", one.covered, 4);
    object.add("alike", one.alike, 4);
    if (one.readable) object.add("readable", std::string(*one.readable ? "true" : "false"));
    list += (list.empty() ? "\n    " : ",\n    ") + object.text();
  }
  return "[" + list + "\n  ]";
}

/// Lists the pictures with their measures; `others` are the correlations with other pictures of the same layer.
std::string picturesJson(const std::vector<ReportedPicture>& pictures, bool fromGcode) {
  std::string list;
  std::size_t own = 0;  // index among the pictures of its layer
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    const auto& [layer, file, lamp, measures] = pictures[k];
    own = k > 0 && pictures[k - 1].layer == layer ? own + 1 : 0;
    std::string others;
    for (std::size_t other = 0; other < measures.others.size(); ++other) {
      if (other != own) others += (others.empty() ? "" : ", ") + number(measures.others[other], 4);
    }
    Object object("    ");
    object.add("layer", std::to_string(layer));
    // File names need not be UTF-8; invalid bytes become U+FFFD instead of an exception.
    object.add("file", jsonString(file));
    addLikeness(object, lamp, measures);
    object.add("others", "[" + others + "]");
    object.add("from", jsonString(fromGcode ? "gcode" : "toolpath"));
    list += (list.empty() ? "\n    " : ",\n    ") + object.text();
  }
  return "[" + list + "\n  ]";
}

/// Totals of a print on one line, without trailing zeros.
std::string printJson(const PrintTotals& print) {
  const auto hundredths = [](double value) { return jsonNumber(std::round(100 * value) / 100); };
  return "{\"seconds\":" + jsonNumber(std::round(print.seconds)) + ",\"filamentMm\":" + hundredths(print.filamentMm) +
         ",\"grams\":" + hundredths(print.grams) + "}";
}

std::string delayJson(const NeighbourDelay& delay) {
  return "{\"over30\": " + number(delay.over30, 4) + ", \"over120\": " + number(delay.over120, 4) +
         ", \"most\": " + number(delay.most, 1) + ", \"squeezed\": " + number(delay.squeezed, 4) + "}";
}

std::string perimeterText(const ToolpathParams& params) {
  if (params.perimeterMode == PerimeterMode::Count) return std::to_string(params.perimeters);
  return params.perimeterMode == PerimeterMode::None ? "none" : "soft";
}

}  // namespace

Report reportOf(const ToolpathResult& plate, const std::optional<Measures>& measures) {
  Report report;
  report.spacing = plate.toolpath.spacing;
  report.nx = plate.nx;
  report.ny = plate.ny;
  report.parts = plate.parts;
  report.cycles = plate.contourCycles;
  report.toolpaths = static_cast<std::int64_t>(plate.toolpath.cycles.size());
  for (const Cycle& cycle : plate.toolpath.cycles) report.points += static_cast<std::int64_t>(cycle.points.size());
  report.measures = measures;
  report.longestJointMm = plate.longestJointMm;
  report.gapJoints = plate.gapJoints;
  report.unjoined = plate.unjoined;
  report.apart = plate.apart;
  report.time = plate.time;
  report.digest = measures ? measures->digest : digestOf(plate.toolpath);
  return report;
}

std::string reportJson(const Report& report) {
  Object object("");
  object.add("version", jsonString(kVersion));
  object.add("spacing", report.spacing, 4);
  std::string grid = "[";
  grid += std::to_string(report.nx) + ", " + std::to_string(report.ny) + "]";
  object.add("grid", grid);
  object.add("parts", report.parts);
  object.add("cycles", report.cycles);
  object.add("toolpaths", report.toolpaths);
  object.add("points", report.points);
  if (report.measures) addMeasures(*report.measures, object);
  object.add("longestJointMm", report.longestJointMm, 4);
  object.add("gapJoints", report.gapJoints);
  object.add("unjoined", report.unjoined);
  object.add("apart", pointsJson(report.apart));
  object.add("time", timeJson(report.time));
  object.add("peakBytes", report.peakBytes);
  object.add("threads", static_cast<std::int64_t>(report.threads));
  object.add("digest", jsonString(report.digest));
  if (!report.pictures.empty()) object.add("pictures", picturesJson(report.pictures, report.fromGcode));
  if (!report.layers.empty()) object.add("layers", layersJson(report.layers));
  if (report.print) object.add("print", printJson(*report.print));
  if (report.delay) object.add("neighbourDelay", delayJson(*report.delay));
  object.add("notes", notesJson(report.notes));
  object.add("warnings", warningsJson(report.warnings));
  return object.text() + "\n";
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
