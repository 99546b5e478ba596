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

// Choices about the print: layers, placement, flow, and facts for the file's header.

/// File formats of a thumbnail.
enum class ThumbnailFormat { Png, Qoi };

/// A picture for the printer's screen.
struct Thumbnail {
  int width = 0;   ///< [pixels], 1..1024
  int height = 0;  ///< [pixels], 1..1024
  std::vector<std::uint8_t> bytes;
  ThumbnailFormat format = ThumbnailFormat::Png;
};

/// Ways to fill base layers.
enum class BasePattern {
  Hatched,     ///< zigzags at 45 and 135 degrees in turn
  Concentric,  ///< loops along the border
  Same,        ///< the oriented cycles themselves
  Across,      ///< hatched, and across the oriented beads where one of their layers is next to it
};

/// Sides of the plate that show.
enum class ShowSide {
  Up,    ///< base layers below, oriented layers on top
  Bed,   ///< oriented layers on the bed, mirrored left to right, base layers above them
  Both,  ///< oriented layers mirrored on the bed, base layers, and as many oriented layers on top
};

/// Layers and place of one plate.
struct PrintParams {
  int layers = 1;  ///< oriented layers on each side that shows, 1..1000
  int base = 2;    ///< plain base layers, 0..1000
  BasePattern basePattern = BasePattern::Hatched;
  int basePerimeters = 1;  ///< loops along the border of hatched base layers, 0..10
  ShowSide showSide = ShowSide::Up;
  int skirt = 1;  ///< loops around the plates, 0..20; a purge line is laid in any case
  /// Filament purged beside the plate before the first layer [mm], 0..100
  double purgeLength = 10;
  int rim = 0;          ///< layers of a raised border on top of the oriented side, 0..50
  double rimWidth = 2;  ///< width of that border, from the shape's outline inwards [mm], 0.1..100
  int brim = 0;         ///< loops that touch the plate, on the first layer, 0..50
  /// Inset of the first layer, if a base layer, from the border [mm], 0..0.5: it is squeezed wider
  double elephantFoot = 0.1;
  /// Oriented beads are laid at speed × spacing / width, at most 1.5 speed
  bool constantFlow = false;
  double coast = 0;  ///< length before a cycle's end over which nothing is extruded [mm], 0..1
  /// Length over which both ends of a cycle overlap [mm], 0..20; not together with coast
  double scarf = 0;
  /// Plates in a row and in a column, printed one after the other, 1..20 each
  Vec2 copies{1, 1};
  double copyGap = 10;       ///< distance between their boxes, brims included [mm], 1..100
  double layerHeight = 0.2;  ///< height of a layer [mm], 0.05..0.8 nozzle
  /// Height of a print that stands on the bed, above which all layers lie [mm], 0..maxZ
  double startHeight = 0;
  /// Height of the first layer [mm], 0.05..0.8 nozzle; 0: layerHeight
  double firstLayerHeight = 0;
  double flow = 0.95;   ///< flow of oriented layers, 0.01..2
  double baseFlow = 1;  ///< flow of base layers, 0.01..2
  /// Flow of an oriented layer on the bed, 0.01..2; below it, nothing takes in excess plastic
  double bedFlow = 1;
  /// Turn of the plate on the bed, counter-clockwise [degrees], -360..360
  double rotate = 0;
  bool mirror = false;  ///< mirrored left to right, before turning: for plates seen from below
  /// Refuse a path that crosses itself or leaves the shape by more than 0.1 mm
  bool strict = false;
  /// Lower left corner of the turned page's box on the bed [mm]; unset: the plate is centred
  std::optional<Vec2> place;
  /// Date that is written into line 1; the core never reads a clock
  std::string date = "1970-01-01 at 00:00:00 UTC";
  std::vector<std::string> notes;     ///< extra lines of the header, without the semicolon
  std::vector<Thumbnail> thumbnails;  ///< pictures in the header, in this order
};

/// Returns the number of loops of a rim, which is made of whole lines.
/// \param line  width of each line [mm].
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

/// Reads Printer::screenSizes, in the form that slicers write: "16x16/QOI, 313x173/QOI,
/// 380x285/PNG".
/// \return at most 8 sizes; InvalidArgument.
Result<std::vector<ThumbnailSize>> readThumbnailSizes(std::string_view text);

// Choices about the shape.

/// Page width of built-in shapes and masks that name none [mm]
inline constexpr double kDefaultWidth = 80;

/// Shapes that need no file.
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

/// The measured spools, in the order of their keys; look/appearance.hpp has their colours and
/// slopes.
enum class SpoolName { BluePla, ClearPetg, GoldPla, GreyPla, RedPetg };

/// Ways to fit pictures whose proportions are not the page's.
enum class PictureProportions {
  Keep,     ///< parts that stick out are cut off, as much on either side
  Stretch,  ///< they are stretched over the page
};

/// Settings that all pictures of a surface share.
struct PictureParams {
  PictureProportions proportions = PictureProportions::Keep;
  SpoolName spool = SpoolName::BluePla;  ///< filament of the plate, which gives colour and slopes
  /// Slopes of a spool of one's own, along and across the bead, 0.1..45 [degrees]
  std::optional<Vec2> slopes;
  double lampSize = 0.1;     ///< size of all lamps, as a slope, 0..2
  double smoothness = 0.02;  ///< InversionParams::smoothness, 0.001..10
  double localContrast = 0;  ///< InversionParams::localContrast, 0..2
  /// Number of times that a single picture is solved anew for the light that its beads lose, 0..8
  int corrections = 3;
};

// Choices about the toolpath. Each field is a row of the documentation: default, unit, range.

/// Ways in which beads meet the border.
enum class PerimeterMode {
  None,  ///< beads end at the border in U-turns
  /// Beads follow the border where the directions allow it, and end there elsewhere
  Soft,
  Count,  ///< `perimeters` beads follow the border
};

/// Ways to read a picture's directions in a cell.
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
  Plain,  ///< order that follows from the cheapest joints
};

/// Choices about the toolpath, in the order of its stages.
struct ToolpathParams {
  double spacing = 0.4;  ///< distance tau between neighbouring beads [mm], 0.05..20
  PerimeterMode perimeterMode = PerimeterMode::Count;
  int perimeters = 1;  ///< beads along the border in mode Count, 0..100
  /// Greatest gap between solids that count as one part [mm], 0..100; unset: one spacing
  std::optional<double> bridge;
  MapFilter mapFilter = MapFilter::Average;
  /// Seed of the sample points; 0: they are regular; others move them by `jitter`, for another
  /// plate of like quality
  std::uint64_t seed = 0;
  double jitter = 0.025;  ///< distance by which a seed moves sample points [tau], 0..0.25
  PhaseTransport phaseTransport = PhaseTransport::Midpoint;
  int sweepsPerLevel = 8;  ///< smoothing sweeps on each level of the hierarchy, 1..1000
  /// Logarithm of the factor by which beads may lie closer or wider where that saves U-turns,
  /// 0..0.5
  double spacingVariation = 0.3;
  /// Angle by which beads may run off the lines where that saves U-turns [degrees], 0..30
  double directionTolerance = 0;
  /// Radius over which the waves of cells are averaged: three sigma of Eq. 13 [tau], 0.45..1.5
  double kernelRadius = 1;
  /// Weight of a soft border's wave against a neighbour's, 0..100
  double borderWeight = 1;
  /// Cost of misaligned length made by a stitch, against 0.65 for added length, 0..10
  double stitchAlignment = 1.1;
  int repulsionRounds = 0;   ///< rounds of Eq. 15, 0..100
  int relaxationRounds = 2;  ///< rounds of spacing relaxation, 0..100
  BeadOrder order = BeadOrder::Even;
  /// Share of the difference of its gaps by which a bead moves towards the wider one, per round,
  /// 0..0.5
  double relaxationStrength = 0.08;
  /// Pull towards the middle of the neighbouring points, per round, 0..1
  double relaxationSmoothing = 0.65;
  /// Bound of a bead's width, 0..1; 0: the nearer neighbour on both sides (Eq. 16); 1: the room
  /// between both neighbours
  double widthBalance = 1;
  /// Greatest overlap of beads [tau], 0..1; 1: they are not held apart
  double beadOverlap = 0.0021;
  double minWidth = 0.5;  ///< narrowest bead [tau], 0.1..1
  double maxWidth = 2;    ///< widest bead [tau], 1..4
  /// Largest change of position and width that leaving out points may make [mm], 0..1
  double simplifyTolerance = 0.0013;

  friend bool operator==(const ToolpathParams&, const ToolpathParams&) = default;
};

/// Returns the number of beads that follow the border whatever the directions: none in the other
/// modes.
inline int countedPerimeters(const ToolpathParams& params) {
  return params.perimeterMode == PerimeterMode::Count ? params.perimeters : 0;
}

// A machine with its filament, as a person may describe it.

/// Dialects of firmware. Bambu machines only take files that their own slicer's start block begins:
/// they need `startGcode`.
enum class GcodeFlavor { Marlin, Klipper, RepRap, PrusaBuddy, Bambu };

/// Greatest speed of oriented beads at which an extruder keeps up without pressure advance [mm/s]
inline constexpr double kEvenSpeed = 20;

/// A machine with its filament. Lengths in mm, speeds in mm/s, accelerations in mm/s², temperatures
/// in degrees Celsius. Ranges that are not given here: docs/reference/project.md, section
/// `printer`.
struct Printer {
  std::string name = "Generic";
  GcodeFlavor flavor = GcodeFlavor::Marlin;
  Vec2 bedMin{0, 0};
  Vec2 bedMax{220, 220};
  bool roundBed = false;  ///< the bed is the disc within bedMin and bedMax, which must be a square
  Vec2 excludedMin;       ///< corner of a box on the bed that nothing may touch; without size: none
  Vec2 excludedMax;
  double maxZ = 200;
  /// Offset added to each Z that is written, except in startGcode and endGcode; -2..2
  double zOffset = 0;
  double nozzle = 0.4;  ///< diameter, 0.05..2
  double filamentDiameter = 1.75;
  double filamentDensity = 1.24;  ///< density [g/cm³]
  /// Extrusion multiplier of the slicers: it multiplies every flow of PrintParams, and that of
  /// brims and purge lines
  double filamentFlow = 1;
  std::string filamentType = "PLA";
  double maxNozzleTemperature = 300;  ///< highest temperature that the hot end bears, 170..300
  double maxBedTemperature = 120;     ///< highest temperature of the bed, 0..120
  /// Replaces both limits by those that no machine may exceed, 300 and 120, and allows cold
  /// nozzles; for experts
  bool generalHeatLimits = false;
  double nozzleTemperature = 215;  ///< 170..maxNozzleTemperature; 0..300 with generalHeatLimits
  double firstLayerNozzleTemperature = 220;
  double bedTemperature = 60;  ///< 0..maxBedTemperature; 0..120 with generalHeatLimits
  double speed = 50;
  double firstLayerSpeed = 20;
  double baseSpeed = 0;  ///< speed of base layers above the first; 0: `speed`
  /// Speed of oriented layers; 0: `speed`, but at most kEvenSpeed where nothing sets pressure
  /// advance
  double showSpeed = 0;
  double travelSpeed = 120;
  double machineSpeed = 0;  ///< limit of all speeds; 0: not known
  double acceleration = 1000;
  double firstLayerAcceleration = 0;  ///< set like `acceleration`; 0: the same
  /// Machine's own acceleration, put back at the end; 0: `acceleration` is not set, only used for
  /// estimates
  double machineAcceleration = 0;
  double cornerSpeed = 5;  ///< Klipper's square corner velocity; Marlin's jerk is twice this
  /// Machine's own corner speed, put back at the end; 0: `cornerSpeed` is not set, only used for
  /// estimates
  double machineCornerSpeed = 0;
  /// Acceleration that limits curves of radius r to the speed √(this · r); 0: as fast as straights
  double curveAcceleration = 1000;
  double firstLayerFan = 0;  ///< fan of the first layer [%]
  /// Fan of base layers above the first [%]; below 0: the usual one for the filament
  double baseFan = -1;
  double showFan = -1;  ///< fan of oriented layers above the first [%], likewise
  /// Least time of a layer [s]; faster layers are slowed, but not below 5 mm/s; 0: none
  double minLayerTime = 8;
  double maxFlow = 10;  ///< greatest flow [mm³/s]
  double maxSegmentsPerSecond = 300;
  double pressureAdvance = 0.04;  ///< [s]; bounds the change of width along the path
  /// Write it, and 0 at the end; otherwise the printer keeps its own
  bool setPressureAdvance = false;
  double retractLength = 0.8;
  double retractSpeed = 35;
  double lift = 0.4;
  bool absoluteE = false;  ///< M82, and G92 E0 on each layer, for hosts that know nothing else
  std::string startGcode;  ///< template (docs/reference/gcode.md); empty: home, heat, wait
  std::string endGcode;    ///< template; empty: park, heaters off
  /// Sizes of the pictures for its screen: WxH, WxH/PNG or WxH/QOI
  std::string screenSizes = "32x32, 300x300";
};

// All that a person chooses, as one struct. Every field is a row of the table of settings.

/// Everything needed to repeat a plate. File names are as written, relative to the project file.
struct Project {
  std::string shapeFile;  ///< SVG, or a mask picture; empty: `builtin`
  /// Shape without a file; None: a rectangle like the lowest layer's picture
  BuiltinShape builtin = BuiltinShape::None;
  /// Size of a built-in shape [mm]. A width of 0 is kDefaultWidth; a height of 0 follows the lowest
  /// layer's picture, or is the shape's own.
  Vec2 builtinSize;
  double builtinRadius = 3;  ///< radius of the corners, except for a rectangle's [mm]
  CornerStyle corners = CornerStyle::Round;
  int starPoints = 5;       ///< number of a star's tips, 3..24
  double builtinInner = 0;  ///< diameter of the hole of a ring or a tag [mm]; 0: its usual one
  std::string shapeText;    ///< letters of the shape Text; lines between line feeds
  std::string shapeFont = "Nunito";  ///< font of these letters, as LayerLetters::font
  int shapeWeight = 0;               ///< weight of these letters, as LayerLetters::weight
  double pageWidth = 0;              ///< width to which the shape is scaled [mm]; 0: as drawn
  bool unitlessIsMm = false;         ///< scene files: SVG lengths without unit mean mm
  bool ignorePaint = false;  ///< scene files: outlines count whatever their paint, see SvgOptions
  /// Distance by which the outline lies further out, or further in where it is below 0 [mm],
  /// -20..50; see offsetShape
  double outlineOffset = 0;
  std::vector<RoundHole> holes;  ///< holes that are cut out of the shape, 0..16
  /// Widen places of half a bead to one bead to a whole bead, see keepThinPlaces
  bool keepThin = false;
  std::vector<Layer> layers;  ///< layers that the plate shows, the last on top; 0..32; see groundOf
  PictureParams pictures;
  ToolpathParams toolpath;
  PrintParams print;
  std::string printerProfile;   ///< profile with whose values `printer` began; empty: none
  std::string filamentProfile;  ///< profile of the filament, laid over them; empty: none
  Printer printer;
  /// Section that the studio keeps in a project, a JSON object; empty: nothing
  std::string studio;
};

}  // namespace sillon
