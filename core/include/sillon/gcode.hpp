// Toolpath to G-code that printers take. Rules and reasons: docs/gcode.md.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/outline.hpp"
#include "sillon/result.hpp"
#include "sillon/shape.hpp"
#include "sillon/types.hpp"

namespace sillon {

/// Bambu machines take only what their own slicer's start block begins: they need `startGcode`.
enum class GcodeFlavor { Marlin, Klipper, RepRap, PrusaBuddy, Bambu };

/// A machine with its filament. Lengths mm, speeds mm/s, accelerations mm/s², temperatures in degrees Celsius. Ranges
/// where none stands here: docs/project.md, section `printer`.
struct Printer {
  std::string name = "Generic";
  GcodeFlavor flavor = GcodeFlavor::Marlin;
  Vec2 bedMin{0, 0};
  Vec2 bedMax{220, 220};
  bool roundBed = false;  ///< the disc within bedMin and bedMax, which must be a square
  Vec2 excludedMin;       ///< box on the bed that nothing may touch; of no size: none
  Vec2 excludedMax;
  double maxZ = 200;
  double nozzle = 0.4;  ///< (0, 2]
  double filamentDiameter = 1.75;
  double filamentDensity = 1.24;  ///< [g/cm³]
  std::string filamentType = "PLA";
  bool anyTemperature = false;     ///< for those who know why: temperatures up to 500 and 200, and cold nozzles
  double nozzleTemperature = 215;  ///< 170..300; 0..500 with anyTemperature
  double firstLayerNozzleTemperature = 220;
  double bedTemperature = 60;  ///< 0..120; 0..200 with anyTemperature
  double speed = 50;
  double firstLayerSpeed = 20;
  double travelSpeed = 120;
  double machineSpeed = 0;  ///< all speeds are held at it; 0: not known
  double acceleration = 1000;
  double machineAcceleration = 0;   ///< put back at the end; 0: `acceleration` is only estimated with, not set
  double cornerSpeed = 5;           ///< Klipper's square corner velocity; Marlin's jerk is twice this
  double machineCornerSpeed = 0;    ///< put back at the end; 0: `cornerSpeed` is only estimated with, not set
  double curveAcceleration = 1000;  ///< curves of radius r go at most at √(this · r); 0: as fast as straights
  double maxFlow = 10;              ///< [mm³/s]
  double maxSegmentsPerSecond = 300;
  double pressureAdvance = 0.04;    ///< [s]; bounds the change of width along the path
  bool setPressureAdvance = false;  ///< write it, and 0 at the end; else the printer's own stays
  double retractLength = 0.8;
  double retractSpeed = 35;
  double lift = 0.4;
  bool absoluteE = false;                      ///< M82 and G92 E0 per layer, for hosts that know nothing else
  std::string startGcode;                      ///< template, docs/gcode.md; empty: home, heat, wait
  std::string endGcode;                        ///< template; empty: park, heaters off
  std::string screenSizes = "32x32, 300x300";  ///< of the pictures for its screen: WxH, WxH/PNG or WxH/QOI
};

enum class ThumbnailFormat { Png, Qoi };

/// A picture for the printer's screen.
struct Thumbnail {
  int width = 0;   ///< [pixels], 1..1024
  int height = 0;  ///< [pixels], 1..1024
  std::vector<std::uint8_t> bytes;
  ThumbnailFormat format = ThumbnailFormat::Png;
};

enum class BasePattern {
  Hatched,     ///< zigzags at 45 and 135 degrees in turn
  Concentric,  ///< loops along the border
  Same,        ///< the oriented cycles themselves
};

enum class ShowSide {
  Up,    ///< base layers below, oriented layers on top
  Bed,   ///< oriented layers on the bed, mirrored left to right, base layers above them
  Both,  ///< oriented layers mirrored on the bed, base layers, and as many oriented layers on top
};

/// How one plate is stacked and placed.
struct PrintParams {
  int layers = 1;  ///< oriented layers, of each side shown, 1..1000
  int base = 2;    ///< plain layers, 0..1000
  BasePattern basePattern = BasePattern::Hatched;
  ShowSide showSide = ShowSide::Up;
  int skirt = 1;                ///< loops around the plates, 0..20; without one a purge line primes
  int brim = 0;                 ///< loops that touch the plate, on the first layer, 0..50
  double elephantFoot = 0.1;    ///< the first layer, if a base layer, stays this far within the border [mm], 0..0.5
  bool constantFlow = false;    ///< oriented beads at speed × spacing / width, at most 1.5 speed
  double coast = 0;             ///< nothing is extruded over this length before a cycle's end [mm], 0..1
  Vec2 copies{1, 1};            ///< plates in a row and in a column, one printed after the other, 1..20 each
  double copyGap = 10;          ///< between their boxes, brims included [mm], 1..100
  double layerHeight = 0.2;     ///< [mm], 0.05..0.8 nozzle
  double startHeight = 0;       ///< of a print that stands on the bed, above which all layers lie [mm], 0..maxZ
  double firstLayerHeight = 0;  ///< [mm], 0.05..0.8 nozzle; 0: same as layerHeight
  double flow = 0.95;           ///< of oriented layers, 0.01..2; `baseFlow`: of base layers, likewise
  double baseFlow = 1;
  double rotate = 0;          ///< of the plate on the bed, counter-clockwise [degrees], -360..360
  bool mirror = false;        ///< left to right, before turning: for plates seen from below
  bool strict = false;        ///< refuse a path that crosses itself or leaves the shape by more than 0.1 mm
  std::optional<Vec2> place;  ///< lower left corner of the turned page's box on the bed [mm]; unset: plate centred
  std::string date = "1970-01-01 at 00:00:00 UTC";  ///< written into line 1; core never reads a clock
  std::vector<std::string> notes;                   ///< extra header lines, without the semicolon
  std::vector<Thumbnail> thumbnails;                ///< in the header, in this order
};

/// Totals of what was written, and what the user should know.
struct GcodeSummary {
  double filamentMm = 0;
  double filamentCm3 = 0;
  double filamentGrams = 0;
  double seconds = 0;  ///< estimate: trapezoids with look-ahead
  std::int64_t moves = 0;
  std::int64_t bytes = 0;
  double clampedLengthMm = 0;  ///< extruded with a width held at 0.6 or 1.6 nozzle
  double curveSlowedMm = 0;    ///< of oriented beads that curveAcceleration slows, or that stay even beside slower ones
  std::vector<std::string> warnings;
};

/// Receives the file in pieces; returning false stops the writing (Cancelled).
using GcodeSink = std::function<bool(std::string_view)>;

/// Checks the whole job, then writes it. Nothing reaches the sink if anything is wrong.
/// \return InvalidArgument, DoesNotFit (overhang per side), EmptyShape.
Result<GcodeSummary> writeGcode(const Toolpath& toolpath, const Shape& shape, const Printer& printer,
                                const PrintParams& params, const GcodeSink& sink);

/// Filament for a bead: height * width * length / filament area [mm], the bead as the cell it fills.
double extrusion(double layerHeight, double width, double length, double filamentDiameter, double flow);

}  // namespace sillon
