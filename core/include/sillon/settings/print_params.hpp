// What a person may choose about the print: layers, placement, flow, what goes into the file's header.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sillon/base/types.hpp"

namespace sillon {

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
  Across,      ///< hatched, and across the oriented beads where one of their layers is next to it
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
  int basePerimeters = 1;  ///< loops along the border of hatched base layers, 0..10
  ShowSide showSide = ShowSide::Up;
  int skirt = 1;                ///< loops around the plates, 0..20; a purge line is laid in any case
  double purgeLength = 10;      ///< of filament, laid off the plate before the first layer [mm], 0..100
  int brim = 0;                 ///< loops that touch the plate, on the first layer, 0..50
  double elephantFoot = 0.1;    ///< the first layer, if a base layer, stays this far within the border [mm], 0..0.5
  bool constantFlow = false;    ///< oriented beads at speed × spacing / width, at most 1.5 speed
  double coast = 0;             ///< nothing is extruded over this length before a cycle's end [mm], 0..1
  double scarf = 0;             ///< both ends of a cycle overlap over this length [mm], 0..20; not beside coast
  Vec2 copies{1, 1};            ///< plates in a row and in a column, one printed after the other, 1..20 each
  double copyGap = 10;          ///< between their boxes, brims included [mm], 1..100
  double layerHeight = 0.2;     ///< [mm], 0.05..0.8 nozzle
  double startHeight = 0;       ///< of a print that stands on the bed, above which all layers lie [mm], 0..maxZ
  double firstLayerHeight = 0;  ///< [mm], 0.05..0.8 nozzle; 0: same as layerHeight
  double flow = 0.95;           ///< of oriented layers, 0.01..2; `baseFlow`: of base layers, likewise
  double baseFlow = 1;
  double bedFlow = 1;         ///< of an oriented layer on the bed, likewise: nothing below it takes what is too much
  double rotate = 0;          ///< of the plate on the bed, counter-clockwise [degrees], -360..360
  bool mirror = false;        ///< left to right, before turning: for plates seen from below
  bool strict = false;        ///< refuse a path that crosses itself or leaves the shape by more than 0.1 mm
  std::optional<Vec2> place;  ///< lower left corner of the turned page's box on the bed [mm]; unset: plate centred
  std::string date = "1970-01-01 at 00:00:00 UTC";  ///< written into line 1; core never reads a clock
  std::vector<std::string> notes;                   ///< extra header lines, without the semicolon
  std::vector<Thumbnail> thumbnails;                ///< in the header, in this order
};

/// Whether a base layer takes a path of its own, which runs across the oriented beads.
inline bool needsAcross(const PrintParams& params) {
  return params.basePattern == BasePattern::Across && params.base > 0;
}

}  // namespace sillon
