#include "input/plate_size.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/numbers.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {
namespace {

// Largest number of cells of a plate. With 32-bit pointers a process has 4 GB at most, and the plate must leave room
// for its results.
constexpr double kMaxCells = sizeof(void*) == 4 ? 20e6 : 100e6;
constexpr double kFrame = 3;  // margin around the outline, in each direction [tau]

// Returns the spacing at which the plate has `cells` cells [mm]; infinite if the margin alone has more.
double spacingFor(Vec2 size, double cells) {
  // Solves cells = 4 (w u + frame) (h u + frame) for u = 1 / spacing.
  const double a = size.x * size.y;
  const double b = kFrame * (size.x + size.y);
  const double c = kFrame * kFrame - cells / 4;
  if (c >= 0) return std::numeric_limits<double>::infinity();
  return (b + std::sqrt(b * b - 4 * a * c)) / (-2 * c);
}

}  // namespace

double cellsOf(Vec2 size, double spacing) { return 4 * (size.x / spacing + kFrame) * (size.y / spacing + kFrame); }

std::optional<Error> plateTooLarge(Vec2 size, double spacing, double freeBytes) {
  const double cells = cellsOf(size, spacing);
  const bool byMemory = freeBytes < kMaxCells * kBytesPerCell;
  const double most = byMemory ? std::max(0.0, freeBytes / kBytesPerCell) : kMaxCells;
  if (cells <= most) return std::nullopt;
  const auto millions = [](double tenths) { return decimal(tenths / 10, 1); };
  std::string text = "the plate of " + decimal(size.x, 1) + " x " + decimal(size.y, 1) + " mm needs " +
                     millions(std::ceil(cells / 1e5)) + " million cells at spacing " + decimal(spacing, 3) +
                     " mm; at most " + millions(std::floor(most / 1e5)) + " million are possible";
  if (byMemory) text += " in " + decimal(std::floor(freeBytes / 1e7) / 100, 2) + " GB of memory";
  const double wider = std::ceil(1000 * spacingFor(size, most)) / 1000;
  const double percent = std::floor(100 * spacing / wider);
  std::vector<NamedValue> values{{"spacing", spacing}};
  if (wider <= findSetting(Section::Toolpath, "spacing")->high) {
    text += ": use a spacing of at least " + decimal(wider, 3) + " mm";
    values.emplace_back("leastSpacing", wider);
  }
  if (percent >= 1) {
    text += ", or a size of at most " + decimal(percent, 0) + " % of this";
    values.emplace_back("percent", percent);
  }
  return Error{byMemory ? ErrorCode::OutOfMemory : ErrorCode::TooLarge, std::move(text), reason::kPlateTooLarge,
               std::move(values)};
}

}  // namespace sillon
