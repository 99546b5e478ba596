#include "sillon/export/export.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "look/preview_parts.hpp"
#include "toolpath/path.hpp"

namespace sillon {
namespace {

constexpr std::int64_t kWidthTolerance = 10;  // [µm]; beads whose widths differ by less share a stroke
constexpr double kColourTolerance = 2.5 / 180 * kDirectionColours;

/// Point in the drawing [µm], y down.
struct Micron {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

/// Converts millimetres to µm. Values that are no numbers or lie far outside any page become printable ones.
std::int64_t microns(double mm) {
  constexpr double kFarthest = 1e6;  // [mm]
  return std::isfinite(mm) ? std::llround(std::clamp(mm, -kFarthest, kFarthest) * 1000) : 0;
}

/// Appends µm as millimetres with at most 3 decimals and no needless zeros: 12.3, -.05, 0.
void appendMm(std::string& out, std::int64_t micron) {
  if (micron < 0) out += '-';
  const std::int64_t size = std::abs(micron);
  const std::int64_t whole = size / 1000, rest = size % 1000;
  char digits[24];
  if (whole > 0 || rest == 0) out.append(digits, std::to_chars(digits, digits + sizeof digits, whole).ptr);
  if (rest == 0) return;
  const char fraction[] = {'.', static_cast<char>('0' + rest / 100), static_cast<char>('0' + rest / 10 % 10),
                           static_cast<char>('0' + rest % 10)};
  out.append(fraction, rest % 10 != 0 ? 4 : rest % 100 != 0 ? 3 : 2);
}

/// Appends two numbers; a minus sign separates them as well as a space does.
void appendPair(std::string& out, std::int64_t x, std::int64_t y) {
  appendMm(out, x);
  if (y >= 0) out += ' ';
  appendMm(out, y);
}

void appendMove(std::string& out, Micron to) {
  out += 'M';
  appendPair(out, to.x, to.y);
}

void appendLine(std::string& out, Micron from, Micron to) {
  out += 'l';
  appendPair(out, to.x - from.x, to.y - from.y);
}

void appendColour(std::string& out, Rgb colour) {
  constexpr std::string_view kHex = "0123456789abcdef";
  out += '#';
  for (const std::uint8_t byte : {colour.red, colour.green, colour.blue}) {
    out += kHex[byte >> 4];
    out += kHex[byte & 15u];
  }
}

/// One segment of a bead: its mean width [µm] and the place of its direction on the wheel of colours.
struct DrawnBead {
  std::int64_t width = 0;
  double colour = 0;
};

/// Tells whether a bead can share a stroke with another one, by width and colour.
bool fits(const DrawnBead& bead, const DrawnBead& stroke) {
  const double apart = std::abs(bead.colour - stroke.colour);
  return std::abs(bead.width - stroke.width) <= kWidthTolerance &&
         std::min(apart, kDirectionColours - apart) <= kColourTolerance;
}

/// Appends a cycle: strokes of like beads, then the path of the nozzle as a thin line.
void appendCycle(std::string& out, const Cycle& cycle, double pageHeight, std::size_t number) {
  const std::size_t count = cycle.points.size();
  const auto at = [&](std::size_t k) {
    const Vec2f p = cycle.points[k % count];
    return Micron{microns(p.x), microns(pageHeight - static_cast<double>(p.y))};
  };
  const auto widthAt = [&](std::size_t k) {
    return k % count < cycle.widths.size() ? microns(cycle.widths[k % count]) : 0;
  };
  const auto beadAt = [&](std::size_t k) {
    const Micron a = at(k), b = at(k + 1);
    return DrawnBead{std::max<std::int64_t>(0, (widthAt(k) + widthAt(k + 1)) / 2),
                     directionColourPlace(static_cast<double>(b.x - a.x), static_cast<double>(a.y - b.y))};
  };

  out += "<g id=\"cycle";
  out += std::to_string(number);
  out += "\">\n";
  DrawnBead stroke;
  for (std::size_t k = 0; k < count; ++k) {
    const DrawnBead bead = beadAt(k);
    if (k == 0 || !fits(bead, stroke)) {
      if (k > 0) out += "\"/>\n";
      stroke = bead;
      out += "<path stroke=\"";
      appendColour(out, directionColourAt(stroke.colour));
      out += "\" stroke-width=\"";
      appendMm(out, stroke.width);
      out += "\" d=\"";
      appendMove(out, at(k));
    }
    appendLine(out, at(k), at(k + 1));
  }
  if (count > 0) {
    out += "\"/>\n<path class=\"nozzle\" stroke=\"#26221f\" stroke-opacity=\".55\" stroke-width=\".03\" d=\"";
    appendMove(out, at(0));
    for (std::size_t k = 0; k + 1 < count; ++k) appendLine(out, at(k), at(k + 1));
    out += "z\"/>\n";
  }
  out += "</g>\n";
}

}  // namespace

Result<std::string> toolpathSvg(const Toolpath& toolpath, Vec2 page) {
  if (auto defect = toolpathDefect(toolpath, page)) return *std::move(defect);
  const std::int64_t width = microns(page.x);
  const std::int64_t height = microns(page.y);
  std::size_t points = 0;
  for (const Cycle& cycle : toolpath.cycles) points += cycle.points.size();

  std::string out;
  out.reserve(points * 32 + 1024);
  out += "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"";
  appendMm(out, width);
  out += "mm\" height=\"";
  appendMm(out, height);
  out += "mm\" viewBox=\"0 0 ";
  appendPair(out, width, height);
  out += "\">\n<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
  for (std::size_t k = 0; k < toolpath.cycles.size(); ++k) {
    appendCycle(out, toolpath.cycles[k], static_cast<double>(height) / 1000, k + 1);
  }
  out += "</g>\n</svg>\n";
  return out;
}

}  // namespace sillon
