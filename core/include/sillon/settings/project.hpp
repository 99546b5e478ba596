// Everything a person may choose: shape, layers, pictures, toolpath, print and printer.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/layers.hpp"

namespace sillon {

// Choices about the print: layers, placement, flow, what goes into the file's
// header.

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

/// Layers and place of one plate.
struct PrintParams {
  int layers = 1;  ///< oriented layers, of each side shown, 1..1000
  int base = 2;    ///< plain layers, 0..1000
  BasePattern basePattern = BasePattern::Hatched;
  int basePerimeters = 1;  ///< loops along the border of hatched base layers, 0..10
  ShowSide showSide = ShowSide::Up;
  int skirt = 1;            ///< loops around the plates, 0..20; a purge line is laid in any case
  double purgeLength = 10;  ///< of filament, laid off the plate before the first layer [mm], 0..100
  int rim = 0;              ///< layers of a raised border on top of the oriented side, 0..50
  double rimWidth = 2;      ///< of that border, from the shape's inwards [mm], 0.1..100
  int brim = 0;             ///< loops that touch the plate, on the first layer, 0..50
  /// The first layer, if a base layer, stays this far within the border [mm], 0..0.5
  double elephantFoot = 0.1;
  bool constantFlow = false;  ///< oriented beads at speed × spacing / width, at most 1.5 speed
  double coast = 0;  ///< nothing is extruded over this length before a cycle's end [mm], 0..1
  /// Both ends of a cycle overlap over this length [mm], 0..20; not beside coast
  double scarf = 0;
  Vec2 copies{1, 1};  ///< plates in a row and in a column, one printed after the other, 1..20 each
  double copyGap = 10;       ///< between their boxes, brims included [mm], 1..100
  double layerHeight = 0.2;  ///< [mm], 0.05..0.8 nozzle
  /// Height of a print that stands on the bed, above which all layers lie [mm], 0..maxZ
  double startHeight = 0;
  double firstLayerHeight = 0;  ///< [mm], 0.05..0.8 nozzle; 0: same as layerHeight
  double flow = 0.95;  ///< of oriented layers, 0.01..2; `baseFlow`: of base layers, likewise
  double baseFlow = 1;
  /// Flow of an oriented layer on the bed, likewise: nothing below it takes what is too much
  double bedFlow = 1;
  double rotate = 0;    ///< of the plate on the bed, counter-clockwise [degrees], -360..360
  bool mirror = false;  ///< left to right, before turning: for plates seen from below
  /// Refuse a path that crosses itself or leaves the shape by more than 0.1 mm
  bool strict = false;
  /// Lower left corner of the turned page's box on the bed [mm]; unset: plate centred
  std::optional<Vec2> place;
  /// Written into line 1; core never reads a clock
  std::string date = "1970-01-01 at 00:00:00 UTC";
  std::vector<std::string> notes;     ///< extra header lines, without the semicolon
  std::vector<Thumbnail> thumbnails;  ///< in the header, in this order
};

/// Number of loops of a rim, which is made of whole lines.
/// \param line  width of each [mm].
inline int rimLoops(const PrintParams& print, double line) {
  return std::max(1, static_cast<int>(print.rimWidth / line + 0.5));
}

/// Tells whether a base layer takes a path of its own, which runs across the oriented beads.
inline bool needsAcross(const PrintParams& params) {
  return params.basePattern == BasePattern::Across && params.base > 0;
}

// Sizes of the pictures that a printer shows on its screen.

struct ThumbnailSize {
  int width = 0;   ///< [pixels], 16..1024
  int height = 0;  ///< [pixels], 16..1024
  ThumbnailFormat format = ThumbnailFormat::Png;
};

/// Reads Printer::screenSizes, the way slicers write it: "16x16/QOI, 313x173/QOI, 380x285/PNG".
/// \return at most 8; InvalidArgument.
Result<std::vector<ThumbnailSize>> readThumbnailSizes(std::string_view text);

// Choices about the shape.

inline constexpr double kDefaultWidth =
    80;  ///< page width [mm] of built-in shapes and masks that name none

enum class BuiltinShape {
  None,
  Rectangle,
  RoundedRectangle,
  Disc,
  Hexagon,
  Heart,
  Shield,
  Star,
  Ring,
  Tag,
  Text
};

/// Tells whether a shape has a diameter and no height.
inline bool isRound(BuiltinShape shape) {
  return shape == BuiltinShape::Disc || shape == BuiltinShape::Ring;
}

/// Ways to treat the corners of built-in shapes.
enum class CornerStyle { Round, Chamfer };

/// The measured spools, in the order of their keys: look/spools.hpp says what they look like.
enum class SpoolName { BluePla, ClearPetg, GoldPla, GreyPla, RedPetg };

/// Ways to fit pictures whose proportions are not the page's.
enum class PictureProportions {
  Keep,     ///< what sticks out is cut off, as much on either side
  Stretch,  ///< they are stretched over the page
};

/// Settings that all pictures of a surface share.
struct PictureParams {
  PictureProportions proportions = PictureProportions::Keep;
  SpoolName spool = SpoolName::BluePla;  ///< whose colour and slopes count
  /// Along and across the bead of a spool of one's own, 0.1..45 [degrees]
  std::optional<Vec2> slopes;
  double lampSize = 0.1;     ///< of all lamps, as a slope, 0..2
  double smoothness = 0.02;  ///< InversionParams::smoothness, 0.001..10
  double localContrast = 0;  ///< InversionParams::localContrast, 0..2
  /// Number of times that a single picture is solved anew for what its beads leave out, 0..8
  int corrections = 3;
};

// Choices about the toolpath. Each field is a row of the documentation: default,
// unit, range.

/// Ways in which beads meet the border.
enum class PerimeterMode {
  None,  ///< beads end at the border in U-turns
  Soft,  ///< beads follow the border where the directions allow it, and end there where they do not
  Count,  ///< `perimeters` beads follow the border
};

enum class MapFilter {
  Average,  ///< lines averaged over a cell, as numbers e^{2i angle}
  Nearest,  ///< the texel under the cell's centre
};

/// Ways to carry over the wave of a neighbour (Eq. 8).
enum class PhaseTransport {
  Midpoint,   ///< by the mean of both lines: second order
  Neighbour,  ///< by the neighbour's line alone, as published in 2023: first order
};

/// Orders in which a path lays its beads.
enum class BeadOrder {
  Even,   ///< neighbouring beads soon after one another
  Plain,  ///< follows from the cheapest joints
};

struct ToolpathParams {
  double spacing = 0.4;  ///< tau [mm], distance between neighbouring beads, 0.05..20
  PerimeterMode perimeterMode = PerimeterMode::Count;
  int perimeters = 1;  ///< beads along the border in mode Count, 0..100
  /// Solids nearer than this count as one part [mm], 0..100; unset: one spacing
  std::optional<double> bridge;
  MapFilter mapFilter = MapFilter::Average;
  /// 0: regular sample points; others: moved by `jitter`, another plate of like quality
  std::uint64_t seed = 0;
  double jitter = 0.025;  ///< how far a seed moves sample points [tau], 0..0.25
  PhaseTransport phaseTransport = PhaseTransport::Midpoint;
  int sweepsPerLevel = 8;  ///< smoothing sweeps on each level of the hierarchy, 1..1000
  /// Beads may lie up to e^this closer or wider where that saves U-turns, 0..0.5
  double spacingVariation = 0.3;
  /// Beads may run up to so far off the lines where that saves U-turns [degrees], 0..30
  double directionTolerance = 0;
  /// Over which the waves of cells are averaged: three sigma of Eq. 13 [tau], 0.45..1.5
  double kernelRadius = 1;
  /// Soft border: weight of the border's wave against a neighbour's, 0..100
  double borderWeight = 1;
  /// Cost of misaligned length made by a stitch, against 0.65 of added length, 0..10
  double stitchAlignment = 1.1;
  int repulsionRounds = 0;   ///< rounds of Eq. 15, 0..100
  int relaxationRounds = 2;  ///< rounds of spacing relaxation, 0..100
  BeadOrder order = BeadOrder::Even;
  /// Move towards the wider side per round, of the gaps' difference, 0..0.5
  double relaxationStrength = 0.08;
  double relaxationSmoothing = 0.65;  ///< pull towards the neighbours' middle per round, 0..1
  /// 0: the nearer neighbour bounds a bead on both sides (Eq. 16); 1: the room does, 0..1
  double widthBalance = 1;
  /// Greatest overlap of beads [tau], 0..1; 1: they are not held apart
  double beadOverlap = 0.0021;
  double minWidth = 0.5;  ///< narrowest bead [tau], 0.1..1
  double maxWidth = 2;    ///< widest bead [tau], 1..4
  /// Largest change of position and width by leaving out points [mm], 0..1
  double simplifyTolerance = 0.0013;

  friend bool operator==(const ToolpathParams&, const ToolpathParams&) = default;
};

/// Beads that follow the border whatever the directions: none in the other modes.
inline int countedPerimeters(const ToolpathParams& params) {
  return params.perimeterMode == PerimeterMode::Count ? params.perimeters : 0;
}

// A machine with its filament, as a person may describe it.

/// Bambu machines take only what their own slicer's start block begins: they need `startGcode`.
enum class GcodeFlavor { Marlin, Klipper, RepRap, PrusaBuddy, Bambu };

/// Speed of oriented beads at which an extruder keeps up without pressure advance [mm/s]
inline constexpr double kEvenSpeed = 20;

/// A machine with its filament. Lengths mm, speeds mm/s, accelerations mm/s², temperatures in
/// degrees Celsius. Ranges where none stands here: docs/reference/project.md, section `printer`.
struct Printer {
  std::string name = "Generic";
  GcodeFlavor flavor = GcodeFlavor::Marlin;
  Vec2 bedMin{0, 0};
  Vec2 bedMax{220, 220};
  bool roundBed = false;  ///< the disc within bedMin and bedMax, which must be a square
  Vec2 excludedMin;       ///< box on the bed that nothing may touch; of no size: none
  Vec2 excludedMax;
  double maxZ = 200;
  /// Added to each Z that is written, but those of startGcode and endGcode; -2..2
  double zOffset = 0;
  double nozzle = 0.4;  ///< 0.05..2
  double filamentDiameter = 1.75;
  double filamentDensity = 1.24;  ///< [g/cm³]
  /// The slicers' extrusion multiplier: of all that is laid, over the flows of PrintParams
  double filamentFlow = 1;
  std::string filamentType = "PLA";
  double maxNozzleTemperature = 300;  ///< what the hot end bears, 170..300
  double maxBedTemperature = 120;     ///< 0..120
  /// For those who know why: the limits that no machine may exceed, 300 and 120, instead of these, and cold nozzles
  bool generalHeatLimits = false;
  double nozzleTemperature = 215;  ///< 170..maxNozzleTemperature; 0..300 with generalHeatLimits
  double firstLayerNozzleTemperature = 220;
  double bedTemperature = 60;  ///< 0..maxBedTemperature; 0..120 with generalHeatLimits
  double speed = 50;
  double firstLayerSpeed = 20;
  double baseSpeed = 0;  ///< of base layers above the first; 0: `speed`
  /// Speed of oriented layers; 0: `speed`, but at most kEvenSpeed where nothing sets pressure
  /// advance
  double showSpeed = 0;
  double travelSpeed = 120;
  double machineSpeed = 0;  ///< all speeds are held at it; 0: not known
  double acceleration = 1000;
  double firstLayerAcceleration = 0;  ///< set like `acceleration`; 0: the same
  /// Put back at the end; 0: `acceleration` is only estimated with, not set
  double machineAcceleration = 0;
  double cornerSpeed = 5;  ///< Klipper's square corner velocity; Marlin's jerk is twice this
  /// Put back at the end; 0: `cornerSpeed` is only estimated with, not set
  double machineCornerSpeed = 0;
  /// Curves of radius r go at most at √(this · r); 0: as fast as straights
  double curveAcceleration = 1000;
  double firstLayerFan = 0;  ///< [%]
  /// Fan of base layers above the first [%]; below 0: what the filament usually gets
  double baseFan = -1;
  double showFan = -1;  ///< of oriented layers above the first [%], likewise
  /// Layers that would take less are slowed, not below 5 mm/s [s]; 0: none
  double minLayerTime = 8;
  double maxFlow = 10;  ///< [mm³/s]
  double maxSegmentsPerSecond = 300;
  double pressureAdvance = 0.04;    ///< [s]; bounds the change of width along the path
  bool setPressureAdvance = false;  ///< write it, and 0 at the end; else the printer's own stays
  double retractLength = 0.8;
  double retractSpeed = 35;
  double lift = 0.4;
  bool absoluteE = false;  ///< M82 and G92 E0 per layer, for hosts that know nothing else
  std::string startGcode;  ///< template, docs/reference/gcode.md; empty: home, heat, wait
  std::string endGcode;    ///< template; empty: park, heaters off
  /// Sizes of the pictures for its screen: WxH, WxH/PNG or WxH/QOI
  std::string screenSizes = "32x32, 300x300";
};

// All that a person chooses, as one struct. Every field is a row of the table of settings.

/// Everything needed to repeat a plate. File names are as written, relative to the project file.
struct Project {
  std::string shapeFile;  ///< SVG, or a mask picture; empty: builtin
  /// None without a shape file: a rectangle like the lowest layer's picture
  BuiltinShape builtin = BuiltinShape::None;
  /// [mm]; zero width: kDefaultWidth; zero height follows the lowest layer's picture, or is the
  /// shape's own
  Vec2 builtinSize;
  double builtinRadius = 3;  ///< of the corners that are no rectangle's [mm]
  CornerStyle corners = CornerStyle::Round;
  int starPoints = 5;       ///< 3..24
  double builtinInner = 0;  ///< diameter of the hole of a ring or a tag [mm]; 0: its usual one
  std::string shapeText;    ///< letters of the shape Text; lines between line feeds
  std::string shapeFont = "Nunito";  ///< as Layer::font
  int shapeWeight = 0;               ///< as Layer::weight
  double pageWidth = 0;              ///< scales the shape to this page width [mm]; 0: as drawn
  bool unitlessIsMm = false;         ///< scene files: SVG lengths without unit mean mm
  bool ignorePaint = false;  ///< scene files: outlines count whatever their paint, see SvgOptions
  /// The outline lies so much further out, or further in where below 0 [mm], -20..50; see
  /// offsetShape
  double outlineOffset = 0;
  std::vector<RoundHole> holes;  ///< 0..16, cut out of the shape
  bool keepThin = false;  ///< places of half a bead to one are widened to one, see keepThinPlaces
  std::vector<Layer> layers;  ///< what the plate shows, the last on top; 0..32; see groundOf
  PictureParams pictures;
  ToolpathParams toolpath;
  PrintParams print;
  std::string printerProfile;   ///< whose values `printer` began with; empty: none
  std::string filamentProfile;  ///< laid over them; empty: none
  Printer printer;
  std::string
      studio;  ///< what the studio keeps of its own in a project, a JSON object; empty: nothing
};

}  // namespace sillon
