// A calibration plate that grows: bases, patches, labels.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "calibrate/strokes.hpp"
#include "sillon/calibrate/calibrate.hpp"
#include "sillon/gcode/patches.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

inline constexpr double kUnit = 0.55;                   ///< [mm] of writing: capitals of 3.3 mm
inline constexpr double kMargin = 0.6;                  ///< [mm] from writing to an edge
inline constexpr double kHigh = kUnit * kLetterHeight;  ///< [mm] of capitals

/// ".88", "-.06", "215".
std::string written(double value, int digits);

class PlateBuilder {
 public:
  PlateBuilder(const CalibrationRequest& request, std::vector<double> values);

  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  /// After the point, that all values need.
  [[nodiscard]] int digits() const;
  /// Of a bead: the nozzle [mm].
  [[nodiscard]] double width() const { return plate_.printer.nozzle; }
  [[nodiscard]] const Printer& printer() const { return plate_.printer; }
  [[nodiscard]] const PrintParams& print() const { return plate_.print; }
  PrintParams& print() { return plate_.print; }

  void base(Ring ring) { rings_.push_back(std::move(ring)); }

  /// Beads as oriented layers have them, until changed.
  Patch& patch(std::vector<PatchLine> lines, int layer = 1);
  Patch& labels() { return plate_.patches.patches.front(); }
  void draw(std::vector<PatchLine> lines);
  /// \param unit  a sixth of a capital's height [mm].
  void label(const std::string& text, Vec2 corner, double unit = kUnit);
  /// \param middle  of the writing.
  void labelAt(const std::string& text, Vec2 middle, double unit = kUnit);
  /// Of the patch that is laid next.
  void value(double value, std::string label, Vec2 at);

  /// Moves all to the page's corner.
  CalibrationPlate done() &&;

 private:
  CalibrationPlate plate_;
  std::vector<double> values_;
  std::vector<Ring> rings_;
};

}  // namespace sillon
