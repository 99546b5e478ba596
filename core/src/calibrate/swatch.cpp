#include "calibrate/prints.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <utility>

#include "base/numbers.hpp"
#include "sillon/pipeline/pipeline.hpp"

namespace sillon {
namespace {

constexpr Vec2 kCard{85.6, 53.98};  // [mm] size of a card of ISO/IEC 7810 ID-1
constexpr double kCorner = 3.18;    // [mm] radius of the card's corners, by the same standard
constexpr double kPixel = 0.2;      // [mm] side of a pixel of the direction map
constexpr double kCardMargin = 5;   // [mm] margin between the writing and the card's edge
constexpr double kLargest = 1.4;    // [mm] largest unit of writing
constexpr double kBold = 0.9;       // [units] thickness of strokes
constexpr int kPatches = 12;        // patches along the lower edge, one per direction
constexpr double kPatchHeight = 7;  // [mm] height of these patches

/// Distance of a point from the segment from a to b.
double distance(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double along = dot(d, d);
  const double t = along > 0 ? std::clamp(dot(p - a, d) / along, 0.0, 1.0) : 0.0;
  return length(p - a - t * d);
}

/// Direction map of the card, into which writing and patches are drawn.
struct Picture {
  DirectionMap map;

  Picture() {
    map.width = static_cast<int>(std::lround(kCard.x / kPixel));
    map.height = static_cast<int>(std::lround(kCard.y / kPixel));
    map.angle.assign(cellCount(map.width, map.height), stored(0));
  }

  /// Value of a direction in the map. \param degrees  -90..90.
  static std::uint16_t stored(double degrees) {
    return static_cast<std::uint16_t>(std::lround((degrees + 90) / 180 * 65535));
  }

  /// Gives a direction to the pixels of a box whose middles are inside.
  template <class Inside>
  void fill(Bounds where, double degrees, const Inside& inside) {
    const auto clamped = [](double at, int count) { return std::clamp(static_cast<int>(at), 0, count - 1); };
    for (int row = clamped((kCard.y - where.max.y) / kPixel, map.height);
         row <= clamped((kCard.y - where.min.y) / kPixel, map.height); ++row) {
      for (int column = clamped(where.min.x / kPixel, map.width); column <= clamped(where.max.x / kPixel, map.width);
           ++column) {
        const Vec2 p{(column + 0.5) * kPixel, kCard.y - (row + 0.5) * kPixel};
        if (!inside(p)) continue;
        map.angle[indexOf(column, row, map.width)] = stored(degrees);
      }
    }
  }

  /// Draws text whose bold strokes have a direction of 90 degrees.
  void write(const std::string& text, Vec2 corner, double unit) {
    const double reach = kBold * unit / 2;
    for (const std::vector<Vec2>& points : textStrokes(text, corner, unit)) {
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        Bounds box;
        for (const Vec2 p : {points[i], points[i + 1]}) {
          box.add(p - Vec2{reach, reach});
          box.add(p + Vec2{reach, reach});
        }
        fill(box, 90, [&](Vec2 p) { return distance(p, points[i], points[i + 1]) <= reach; });
      }
    }
  }
};

// Cuts a text after 16 letters: more would become too small to read.
std::string shown(std::string text) {
  constexpr std::size_t kLongest = 16;
  text.resize(std::min(text.size(), kLongest));
  return text;
}

}  // namespace

std::optional<Error> addSwatch(CalibrationPlate& plate, const Project& project, const RunContext& run) {
  const Printer& printer = plate.printer;
  const PrintParams& print = plate.print;
  const std::string name = project.filamentProfile.empty() ? printer.filamentType : project.filamentProfile;
  const auto words = [](std::initializer_list<std::string_view> parts) {
    std::string text;
    for (const std::string_view part : parts) text += part;
    return text;
  };
  std::string layers = words({decimal(printer.nozzle, 2), "X", decimal(print.layerHeight, 2), "MM"});
  // A speed is written only if the printer sets one; otherwise it depends on other settings.
  if (printer.showSpeed > 0) layers += words({" ", decimal(printer.showSpeed, 0), "MM/S"});
  const std::string lines[] = {
      shown(name), words({decimal(printer.nozzleTemperature, 0), "C BED ", decimal(printer.bedTemperature, 0)}),
      words({"FLOW ", decimal(print.flow, 2)}), layers};
  Picture picture;
  const double room = kCard.y - 2 * kCardMargin - kPatchHeight;
  const double line = room / static_cast<double>(std::size(lines));
  for (std::size_t k = 0; k < std::size(lines); ++k) {
    if (lines[k].empty()) continue;
    const double unit =
        std::min({kLargest, (kCard.x - 2 * kCardMargin) / textWidth(lines[k]), 0.72 * line / kLetterHeight});
    const double y = kCard.y - kCardMargin - line * static_cast<double>(k + 1) + (line - kLetterHeight * unit) / 2;
    picture.write(lines[k], {kCardMargin, y}, unit);
  }
  const double step = (kCard.x - 2 * kCardMargin) / kPatches;
  plate.values.clear();
  for (int k = 0; k < kPatches; ++k) {
    const double degrees = 15 * k;
    const Bounds box{{kCardMargin + k * step, kCardMargin - 2},
                     {kCardMargin + (k + 1) * step, kCardMargin - 2 + kPatchHeight}};
    picture.fill(box, degrees > 90 ? degrees - 180 : degrees,
                 [&](Vec2 p) { return p.x >= box.min.x && p.x < box.max.x && p.y >= box.min.y && p.y < box.max.y; });
    plate.values.push_back({"", degrees, 0.5 * (box.min + box.max), 0});
  }

  const Result<Shape> shape = makeRoundedRectangle(kCard, kCorner);
  if (!shape) return shape.error();
  Result<ToolpathResult> made = generateToolpath(
      {shape.value(), std::move(picture.map), uniformMode(DirectionMode::Constrained)}, project.toolpath, run);
  if (!made) return made.error();
  plate.toolpath = std::move(made.value().toolpath);
  plate.patches.shape = shape.value();
  return std::nullopt;
}

}  // namespace sillon
