#include "input/svg/svg_path.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <fast_float/fast_float.h>

namespace sillon::svg {

std::optional<Unit> unitOf(std::string_view unit) {
  static constexpr std::array<std::pair<std::string_view, Unit>, 11> kUnits{{{"", {}},
                                                                             {"px", {kMmPerPx}},
                                                                             {"mm", {1}},
                                                                             {"cm", {10}},
                                                                             {"q", {0.25}},
                                                                             {"in", {25.4}},
                                                                             {"pt", {25.4 / 72}},
                                                                             {"pc", {25.4 / 6}},
                                                                             {"em", {0, 1}},
                                                                             {"rem", {16 * kMmPerPx}},
                                                                             {"ex", {0, 0.5}}}};
  for (const auto& [name, known] : kUnits) {
    if (name == unit) return known;
  }
  return std::nullopt;
}

std::optional<Length> lengthOf(const Node& node, const char* name) {
  const auto text = attribute(node, name);
  if (!text || trimmed(*text) == "auto") return std::nullopt;
  Reader reader(trimmed(*text), name);
  Length length;
  length.value = reader.number();
  if (reader.rest() == "%") {
    length.percent = true;
    return length;
  }
  const auto unit = unitOf(lowered(reader.rest()));
  if (!unit) {
    refuse("SvgUnit", {{"attribute", name}, {"text", quoted(*text)}});
  }
  length.unit = *unit;
  return length;
}

double UserUnits::of(const Node& node, const char* name, double full, double missing) const {
  const std::optional<Length> length = lengthOf(node, name);
  if (!length) return missing;
  if (length->percent) return length->value / 100 * full;
  return of(length->value, length->unit);
}

double UserUnits::positive(const Node& node, const char* name, double full, double missing) const {
  const double value = of(node, name, full, missing);
  if (value < 0) refuse("SvgNegative", {{"attribute", name}, {"text", quoted(*attribute(node, name))}});
  return value;
}

Vec2 UserUnits::radii(const Node& node, Vec2 full) const {
  const bool hasX = lengthOf(node, "rx").has_value(), hasY = lengthOf(node, "ry").has_value();
  const double rx = positive(node, "rx", full.x, 0), ry = positive(node, "ry", full.y, 0);
  return {hasX ? rx : ry, hasY ? ry : rx};
}

double UserUnits::ofStyle(std::string_view text, double full) const {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  text = trimmed(text);
  if (text.empty()) return kNone;
  double value = 0;
  if (text[0] == '+') text.remove_prefix(1);
  const auto [end, error] = fast_float::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) return kNone;
  const std::string unit = lowered(text.substr(end - text.data()));
  if (unit == "%") return value / 100 * full;
  const auto known = unitOf(unit);
  return known ? of(value, *known) : kNone;
}

}  // namespace sillon::svg
