#include "sillon/settings/table.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>

#include "settings/json.hpp"

namespace sillon {
namespace {

Project* part(const SettingsView& view, const Project* /*of this type*/) { return view.project; }
ToolpathParams* part(const SettingsView& view, const ToolpathParams* /*of this type*/) { return view.toolpath; }
PrintParams* part(const SettingsView& view, const PrintParams* /*of this type*/) { return view.print; }
PictureParams* part(const SettingsView& view, const PictureParams* /*of this type*/) {
  return view.project == nullptr ? nullptr : &view.project->pictures;
}
Printer* part(const SettingsView& view, const Printer* /*of this type*/) { return view.printer; }
Layer* part(const SettingsView& view, const Layer* /*of this type*/) { return view.layer; }
/// The part of a layer that only some kinds have; null if this layer lacks it.
template <class Part>
Part* part(const SettingsView& view, const Part* /*of this type*/) {
  return view.layer == nullptr ? nullptr : view.layer->as<Part>();
}

/// Makes new contents of the kind with this number.
template <std::size_t Kind = 0>
LayerContents contentsOf(std::size_t index) {
  if constexpr (Kind + 1 < std::variant_size_v<LayerContents>) {
    if (index != Kind) return contentsOf<Kind + 1>(index);
  }
  return LayerContents(std::in_place_index<Kind>);
}

/// Section of the settings whose fields lie in a struct; layers have their own, and parts that only some kinds have.
template <class Part>
constexpr Section sectionOf = Section::Layers;
template <>
constexpr Section sectionOf<Project> = Section::Shape;
template <>
constexpr Section sectionOf<PictureParams> = Section::Pictures;
template <>
constexpr Section sectionOf<ToolpathParams> = Section::Toolpath;
template <>
constexpr Section sectionOf<PrintParams> = Section::Print;
template <>
constexpr Section sectionOf<Printer> = Section::Printer;

/// Type of the numbers and lists that a field holds.
template <class Value>
constexpr SettingType typeOf = SettingType::Number;
template <>
constexpr SettingType typeOf<int> = SettingType::Integer;
template <>
constexpr SettingType typeOf<std::uint64_t> = SettingType::Integer;
template <>
constexpr SettingType typeOf<Vec2> = SettingType::Pair;
template <>
constexpr SettingType typeOf<std::optional<Vec2>> = SettingType::Pair;
template <>
constexpr SettingType typeOf<std::vector<LampPicture>> = SettingType::PictureList;
template <>
constexpr SettingType typeOf<std::vector<RoundHole>> = SettingType::HoleList;
template <>
constexpr SettingType typeOf<std::vector<ColourAngle>> = SettingType::ColourList;
template <>
constexpr SettingType typeOf<std::vector<Stroke>> = SettingType::StrokeList;

template <auto Member>
struct Access;
template <class Part, class Value, Value Part::*Member>
struct Access<Member> {
  static constexpr Section section = sectionOf<Part>;
  static constexpr SettingType type = typeOf<Value>;
  static Field field(const SettingsView& view) {
    Part* const owner = part(view, static_cast<const Part*>(nullptr));
    if (owner == nullptr) return std::monostate{};
    if constexpr (std::is_enum_v<Value>) {
      return choiceField(owner->*Member);
    } else {
      return &(owner->*Member);
    }
  }
};

/// Accessor of the field that a member pointer names.
template <auto Member>
constexpr auto at = &Access<Member>::field;

/// Field of the kind of a layer. Setting it replaces the contents of the layer.
Field kindOf(const SettingsView& view) {
  if (view.layer == nullptr) return std::monostate{};
  return ChoiceField{view.layer, [](const void* at) { return static_cast<const Layer*>(at)->contents.index(); },
                     [](void* at, std::size_t index) { static_cast<Layer*>(at)->contents = contentsOf(index); }};
}

/// Field of a setting without storage: it is only read, and its values go into other fields.
Field nowhere(const SettingsView& /*view*/) { return std::monostate{}; }

using enum Section;
using enum Level;
using enum SettingType;

constexpr double kMaxSide = 10'000;      // [mm], side of a page
constexpr double kMaxBed = 5'000;        // [mm]; beds may have their origin anywhere
constexpr double kLine = 1024;           // [bytes], text of one line
constexpr double kBlock = 65'536;        // [bytes], start or end block
constexpr double kText = 4096;           // [bytes], text of a layer
constexpr double kMaxLayerHeight = 1.6;  // [mm], 0.8 of the widest nozzle
constexpr double kSeeds = 18446744073709551615.0;

/// A setting and its words.
struct SettingRow {
  Setting setting;
  SettingWords words;
};

/// Lowest and highest value, and their unit.
struct Range {
  double low;
  double high;
  const char* unit = "";
};

template <auto Member>
constexpr SettingRow typed(SettingType type, const char* key, Level level, Range range, SettingWords words) {
  return {{Access<Member>::section, key, type, at<Member>, range.unit, range.low, range.high, level}, words};
}

// Rows by the type of their value; the member tells the section. Each ends with the label, the sentence of help and the
// option of the command line.

template <auto Member>
constexpr SettingRow number(const char* key, Level level, Range range, const char* label, const char* help,
                            const char* option = "") {
  return typed<Member>(Access<Member>::type, key, level, range, {label, help, option});
}
template <auto Member>
constexpr SettingRow list(const char* key, Level level, double most, const char* label, const char* help,
                          const char* option = "") {
  return typed<Member>(Access<Member>::type, key, level, {0, most}, {label, help, option});
}
template <auto Member>
constexpr SettingRow flag(const char* key, Level level, const char* label, const char* help, const char* option = "") {
  return typed<Member>(Flag, key, level, {}, {label, help, option});
}
template <auto Member>
constexpr SettingRow line(const char* key, Level level, const char* label, const char* help, const char* option = "") {
  return typed<Member>(Text, key, level, {0, kLine}, {label, help, option});
}
template <auto Member>
constexpr SettingRow block(const char* key, Level level, double most, const char* label, const char* help) {
  return typed<Member>(Block, key, level, {0, most}, {label, help});
}
template <auto Member>
constexpr SettingRow choice(const char* key, Level level, const char* choices, const char* label, const char* help,
                            const char* option = "") {
  SettingRow row = typed<Member>(Choice, key, level, {}, {label, help, option});
  row.setting.choices = choices;
  return row;
}

// Rows of the table. Within a section they stand in the order of written files. The ranges of temperatures, bed corners
// and layer heights also depend on other settings: validator.cpp.
constexpr SettingRow kRows[] = {
    line<&Project::shapeFile>("file", Basic, "File",
                              "SVG, or a mask picture (PNG, JPEG, BMP, TGA): bright, opaque pixels are inside",
                              "--shape"),
    choice<&Project::builtin>("builtin", Basic, "none rectangle rounded disc hexagon heart shield star ring tag text",
                              "Built-in shape", "A built-in shape instead of a file; naming both is an error"),
    number<&Project::builtinSize>("size", Basic, {0, kMaxSide, "mm"}, "Size",
                                  "Size of a built-in shape; width 0 is 80 mm; height 0 takes the direction picture's "
                                  "proportions, or the shape's own; a disc and a ring use the width",
                                  "--size"),
    number<&Project::builtinRadius>("radius", Basic, {0, kMaxSide, "mm"}, "Corner radius",
                                    "Corner radius of the shapes \"rounded\", \"hexagon\", \"shield\", \"star\" and "
                                    "\"tag\", at most what half of the shorter side at a corner holds",
                                    "--radius"),
    choice<&Project::corners>("corners", Basic, "round chamfer", "Corners",
                              "Corners with a radius are round, or cut off straight between the ends of that arc",
                              "--corners"),
    number<&Project::starPoints>("points", Basic, {3, 24}, "Points", "Number of points of the shape \"star\"",
                                 "--points"),
    number<&Project::builtinInner>(
        "inner", Basic, {0, kMaxSide, "mm"}, "Inner diameter",
        "Diameter of the hole of the shapes \"ring\" and \"tag\"; 0 is half of the ring's width, or 5 mm", "--inner"),
    block<&Project::shapeText>("text", Basic, kText, "Letters",
                               "Letters of the shape \"text\", which fill its size as far as their proportions allow"),
    line<&Project::shapeFont>("font", Basic, "Font", "Font of these letters: a built-in one, or a TTF or OTF file"),
    number<&Project::shapeWeight>("weight", Advanced, {0, 1000}, "Weight",
                                  "Weight of these letters, where their font is a variable one; 0 is the font's own"),
    number<&Project::pageWidth>("pageWidth", Basic, {0, kMaxSide, "mm"}, "Page width",
                                "Scales the file to this page width; 0 keeps its own size, or 80 mm for a mask"),
    choice<&Project::unitlessIsMm>("unitless", Advanced, "px mm", "SVG unit",
                                   "Unit of SVG sizes that name none: px (1/96 inch, as SVG defines) or mm"),
    choice<&Project::ignorePaint>("paint", Advanced, "shown ignore", "Paint",
                                  "Read a drawing as it is painted, or as all its outlines regardless of paint",
                                  "--paint"),
    number<&Project::outlineOffset>("offset", Basic, {-20, 50, "mm"}, "Offset",
                                    "Moves the outline outwards, with round corners, and the page's edges with it; "
                                    "below 0 inwards on the same page",
                                    "--offset"),
    list<&Project::holes>("holes", Basic, 16, "Holes",
                          "Round holes cut out of the shape: {\"x\", \"y\", \"diameter\"} in mm, from the lower left "
                          "corner of the page; an offset does not change them",
                          "--hole"),
    flag<&Project::keepThin>(
        "keepThin", Advanced, "Keep thin places",
        "Widen places that are at least half a bead but less than one bead wide to one bead; otherwise they stay empty",
        "--keep-thin"),

    {{.section = Layers,
      .key = "kind",
      .type = Choice,
      .field = kindOf,
      .level = Basic,
      .choices = "direction map picture text code pattern tones drawing border strokes"},
     {.label = "Kind",
      .help = "The content of the layer: one direction, a direction picture, pictures under their lamps, a text, a QR "
              "code, a pattern, the tones of a picture, a drawing, a band along the border, or strokes of brushes"}},
    flag<&Layer::visible>("visible", Basic, "Visible", "A layer that is not visible draws nothing"),
    number<&Layer::at>("at", Basic, {-10000, 10000, "mm"}, "Place",
                       "Middle of the layer, from the lower left corner of the page; null: the middle of the page"),
    number<&Layer::size>("size", Basic, {0, kMaxSide, "mm"}, "Size",
                         "Width and height before it turns; a side of 0 follows the content"),
    number<&Layer::rotation>("rotation", Basic, {-360, 360, "degrees"}, "Rotation",
                             "Turns the layer counter-clockwise about its middle"),
    flag<&Layer::mirror>("mirror", Basic, "Mirror", "Mirrors the layer left to right before it turns"),
    choice<&Layer::mask>("mask", Basic, "own disc page inside outside", "Mask",
                         "The places where it shows: its own letters, drawing or box, the disc in its box, the whole "
                         "page, or inside or outside of the mask file"),
    line<&Layer::maskFile>("maskFile", Basic, "Mask file",
                           "Drawing or mask picture that bounds the layer, stretched over its box"),
    number<&Layer::soft>("soft", Basic, {0, 100, "mm"}, "Soft edge",
                         "Width over which its directions turn into those below, about its edge"),
    choice<&Layer::mode>("mode", Basic, "parallel orthogonal smoothest constrained", "Mode",
                         "Beads lie along the border, across it, as smoothly as possible, or as the directions say",
                         "--mode"),
    line<&Layer::modeFile>("modeFile", Basic, "Mode file",
                           "Picture of the modes, over the layer's box; empty: the mode everywhere", "--modes"),
    number<&LayerAngle::angle>(
        "angle", Basic, {-360, 360, "degrees"}, "Angle",
        "Direction of its beads on the page, counter-clockwise from the right; turns rays, rings and edges", "--angle"),
    number<&LayerGround::ground>("ground", Basic, {-360, 360, "degrees"}, "Ground",
                                 "Direction in the box around letters or a drawing; null: what lies below shows, and "
                                 "the light modules of a QR code lie across the dark ones"),
    choice<&LayerFilled::fill>(
        "fill", Basic, "angle along across", "Fill",
        "Beads fill letters, drawings and borders in one direction, along the outline, or across what lies below"),
    line<&LayerFile::file>("file", Basic, "File", "File of a map, of tones, of a drawing or of an echo",
                           "--directions"),
    choice<&MapLayer::encoding>("encoding", Basic, "angle rotation tangent", "Encoding",
                                "Reading of a map's picture as directions: grey is -90 to 90 degrees; grey is 0 to 180 "
                                "degrees; red and green are x and y",
                                "--encoding"),
    list<&PictureLayer::pictures>(
        "pictures", Basic, 4, "Pictures",
        "Pictures to show, one per lamp: {\"file\", \"lamp\"}; lamp is [azimuth, elevation] in degrees; null: the "
        "solver chooses, and above other layers it is the lamp of the lowest pictures, or 60 and 45"),
    number<&LayerCrop::cropMin>("cropMin", Basic, {0, 1}, "Crop from",
                                "Lower left corner of the part of a picture that is used, in shares of the picture"),
    number<&LayerCrop::cropMax>("cropMax", Basic, {0, 1}, "Crop to", "Upper right corner of that part"),
    block<&LayerWords::text>(
        "text", Basic, kText, "Text",
        "Letters, in one or several lines, what a QR code says, or what an echo without a file follows"),
    line<&LayerLetters::font>("font", Basic, "Font", "A built-in font, or a TTF or OTF file"),
    number<&LayerLetters::weight>("weight", Advanced, {0, 1000}, "Weight",
                                  "Weight of the letters, where the font is a variable one; 0 is the font's own"),
    number<&LayerLetters::textSize>("textSize", Basic, {1, 1000, "mm"}, "Letter height",
                                    "Height of capitals, where the size is 0"),
    number<&LayerLetters::circle>("circle", Basic, {-5000, 5000, "mm"}, "Circle",
                                  "Radius of the circle that letters stand on; 0: straight; below 0: along the lower "
                                  "side, to be read from inside"),
    choice<&LayerLetters::align>("align", Basic, "left middle right", "Alignment", "Place of shorter lines in the box"),
    choice<&CodeLayer::correction>("correction", Basic, "low medium quartile high", "Correction",
                                   "Share of a QR code that may be damaged: 7, 15, 25 or 30 percent"),
    choice<&PatternLayer::pattern>("pattern", Basic, "radial spiral waves noise echo", "Pattern",
                                   "Rays from the middle turned by the angle (90 makes rings), rays that turn on their "
                                   "way out, waves, smooth chance, or contours around a drawing or letters"),
    number<&PatternLayer::waveLength>(
        "waveLength", Basic, {1, 1000, "mm"}, "Wavelength",
        "Length of one wave, way out over which a spiral turns by 180 degrees, or distance of the knots of noise"),
    number<&PatternLayer::amplitude>("amplitude", Basic, {0, 90, "degrees"}, "Amplitude",
                                     "Angle by which waves and noise turn the directions to either side"),
    number<&PatternLayer::seed>("seed", Basic, {0, kSeeds}, "Seed",
                                "Another number makes another noise of the same kind"),
    choice<&TonesLayer::by>(
        "by", Basic, "brightness levels edges colours", "Read by",
        "Directions follow the brightness, two levels of it, the edges, or the flat colours of a picture or drawing"),
    number<&TonesLayer::from>("from", Basic, {-360, 360, "degrees"}, "Dark",
                              "Direction where the picture is black, or darker than the threshold"),
    number<&TonesLayer::to>("to", Basic, {-360, 360, "degrees"}, "Light",
                            "Direction where the picture is white, or lighter than the threshold"),
    number<&TonesLayer::threshold>("threshold", Basic, {0, 1}, "Threshold",
                                   "Tone between dark and light levels: 0 is black, 1 is white"),
    number<&TonesLayer::contrast>("contrast", Basic, {0, 10}, "Contrast",
                                  "Contrast of brightness about the middle grey; 1 leaves the picture as it is"),
    number<&TonesLayer::smoothing>("smoothing", Basic, {0, 100, "mm"}, "Smoothing",
                                   "Blur of the brightness, or width over which edges are averaged"),
    list<&TonesLayer::colours>(
        "colours", Basic, 32, "Colours",
        "Directions of flat colours: {\"colour\": \"#rrggbb\", \"angle\": degrees}; other colours go with the nearest"),
    number<&BorderLayer::width>("width", Basic, {0.1, 1000, "mm"}, "Width", "Width of a band along the border"),
    list<&StrokesLayer::strokes>(
        "strokes", Basic, 10'000, "Strokes",
        "Gestures of brushes, in order: {\"tool\", \"radius\", \"soft\", \"mode\", \"points\"}; tool is comb, mode or "
        "erase; points are [x, y, x, y, ...] in mm on the page"),

    choice<&PictureParams::proportions>("proportions", Advanced, "keep stretch", "Proportions",
                                        "Keep cuts off what sticks out of a page of other proportions, as much on "
                                        "either side; stretch covers the page with all of the picture",
                                        "--proportions"),
    choice<&PictureParams::spool>("spool", Basic, "bluePla clearPetg goldPla greyPla redPetg", "Spool",
                                  "The filament whose reflection the pictures are solved for", "--spool"),
    number<&PictureParams::slopes>(
        "slopes", Expert, {0.1, 45, "degrees"}, "Spool slopes",
        "RMS surface slopes of your own spool, along and across the bead; null uses the named spool's"),
    number<&PictureParams::lampSize>("lampSize", Basic, {0, 2}, "Lamp size",
                                     "Angular size of the lamp, as the surface slope that would blur its reflection as "
                                     "much: 0.02 is a bulb, 0.1 a softbox, 0.4 a window"),
    number<&PictureParams::smoothness>(
        "smoothness", Advanced, {0.001, 10}, "Smoothness",
        "Weight of smooth directions against exact tones: larger values give fewer U-turns and less detail",
        "--smoothness"),
    number<&PictureParams::localContrast>(
        "localContrast", Advanced, {0, 2}, "Local contrast",
        "Amount of local contrast added before solving; makes faces readable but departs from the picture's own tones",
        "--local-contrast"),
    number<&PictureParams::corrections>("corrections", Advanced, {0, 8}, "Corrections",
                                        "Number of times the pictures are solved again to correct what the previous "
                                        "plate did not show; each takes as long as a plate",
                                        "--corrections"),

    {{.section = Toolpath, .key = "preset", .type = Name, .field = nowhere, .level = Basic},
     {.label = "Preset",
      .help = "A named set of values for this section; other keys in the section override it",
      .option = "--preset"}},
    number<&ToolpathParams::spacing>(
        "spacing", Basic, {0.05, 20, "mm"}, "Line width",
        "Width of the lines: the distance between the middles of neighbouring beads; start with the nozzle diameter",
        "--spacing"),
    choice<&ToolpathParams::perimeterMode>(
        "perimeterMode", Basic, "none soft count", "Outline",
        "Whether beads end at the outline, follow it where the directions allow, or are enclosed by a number of walls",
        "--perimeters"),
    number<&ToolpathParams::perimeters>("perimeters", Basic, {0, 100}, "Walls",
                                        "Number of beads along the outline, where they enclose the others"),
    number<&ToolpathParams::bridge>("bridge", Advanced, {0, 100, "mm"}, "Bridge gaps up to",
                                    "Joins solids closer than this into one path; null uses one spacing", "--bridge"),
    choice<&ToolpathParams::mapFilter>(
        "mapFilter", Advanced, "average nearest", "Image sampling",
        "Whether neighbouring pixels of the direction picture are averaged or the nearest one is taken",
        "--map-filter"),
    number<&ToolpathParams::seed>("seed", Basic, {0, kSeeds}, "Seed",
                                  "0 is regular; every other number gives a different plate of the same quality",
                                  "--seed"),
    number<&ToolpathParams::jitter>("jitter", Expert, {0, 0.25, "spacings"}, "Seed strength",
                                    "How far a seed moves the points where directions are sampled", "--jitter"),
    choice<&ToolpathParams::phaseTransport>(
        "phaseTransport", Expert, "midpoint neighbour", "Phase transport",
        "Continues a neighbour's wave by the mean of both directions, or by the neighbour's alone as in 2023",
        "--phase-transport"),
    number<&ToolpathParams::sweepsPerLevel>("sweepsPerLevel", Expert, {1, 1000}, "Smoothing sweeps",
                                            "Smoothing sweeps on each level of the hierarchy; more sweeps take longer",
                                            "--sweeps"),
    number<&ToolpathParams::spacingVariation>("spacingVariation", Advanced, {0, 0.5}, "Line width variation",
                                              "How much closer or wider than the line width beads may lie to save "
                                              "U-turns, by a factor of up to e^this; 0 keeps them evenly spaced",
                                              "--spacing-variation"),
    number<&ToolpathParams::directionTolerance>(
        "directionTolerance", Advanced, {0, 30, "degrees"}, "Direction tolerance",
        "Beads may deviate from the directions by up to this angle to save U-turns; takes about twice as long",
        "--direction-tolerance"),
    number<&ToolpathParams::kernelRadius>(
        "kernelRadius", Expert, {0.45, 1.5, "spacings"}, "Kernel radius",
        "Radius over which the cells' waves are averaged: three standard deviations of a Gaussian; 0.5 in 2023",
        "--kernel-radius"),
    number<&ToolpathParams::borderWeight>(
        "borderWeight", Expert, {0, 100},
        "Border weight", "How strongly beads follow the outline where the choice is theirs, relative to a neighbour",
        "--border-weight"),
    number<&ToolpathParams::stitchAlignment>("stitchAlignment", Expert, {0, 10}, "Joint alignment",
                                             "Cost of misaligned length where two curves are joined",
                                             "--stitch-alignment"),
    choice<&ToolpathParams::order>(
        "order", Advanced, "even plain", "Bead order",
        "Lays neighbouring beads soon after one another, for an even shine, or joins curves wherever that costs least",
        "--order"),
    number<&ToolpathParams::repulsionRounds>(
        "repulsionRounds", Expert, {0, 100},
        "Repulsion rounds",
        "Rounds that move beads apart where they lie nearer than half a spacing (Eq. 15); 8 in 2023",
        "--repulsion-rounds"),
    number<&ToolpathParams::relaxationRounds>(
        "relaxationRounds", Expert, {0, 100},
        "Relaxation rounds",
        "Rounds of relaxation, which evens out the gaps between beads: fewer kinks, slightly less exact directions",
        "--relaxation-rounds"),
    number<&ToolpathParams::relaxationStrength>(
        "relaxationStrength", Expert, {0, 0.5},
        "Relaxation strength",
        "How far a bead moves towards its wider gap per round, as a fraction of the difference between its gaps",
        "--relaxation-strength"),
    number<&ToolpathParams::relaxationSmoothing>("relaxationSmoothing", Expert, {0, 1}, "Relaxation smoothing",
                                                 "How much each round of relaxation straightens a bead",
                                                 "--relaxation-smoothing"),
    number<&ToolpathParams::widthBalance>(
        "widthBalance", Expert, {0, 1}, "Width balance",
        "0: the nearer neighbour limits the width on both sides (Eq. 16); 1: the space between both neighbours does",
        "--width-balance"),
    number<&ToolpathParams::beadOverlap>(
        "beadOverlap", Expert, {0, 1, "spacings"}, "Bead overlap",
        "Overlap of neighbouring beads above which both are made narrower; 1 allows any", "--bead-overlap"),
    number<&ToolpathParams::minWidth>("minWidth", Advanced, {0.1, 1, "spacings"}, "Narrowest bead",
                                      "Minimum bead width, except where the border leaves less space", "--min-width"),
    number<&ToolpathParams::maxWidth>("maxWidth", Advanced, {1, 4, "spacings"}, "Widest bead", "Maximum bead width",
                                      "--max-width"),
    number<&ToolpathParams::simplifyTolerance>(
        "simplifyTolerance", Expert, {0, 1, "mm"}, "Simplification",
        "Largest change of position and width when points are removed; larger values make smaller files", "--simplify"),

    number<&PrintParams::layers>("layers", Basic, {1, 1000}, "Top layers",
                                 "Number of layers of directed beads, which show, on each side that shows them",
                                 "--layers"),
    number<&PrintParams::base>("base", Basic, {0, 1000}, "Bottom layers", "Number of plain layers under the top layers",
                               "--base"),
    choice<&PrintParams::basePattern>(
        "basePattern", Advanced, "hatched concentric same across", "Bottom pattern",
        "Hatching at alternately 45 and 135 degrees, loops that follow the outline, the path of the top layers itself, "
        "or hatching with the layer next to the top layers across their beads, which takes a second path",
        "--base-pattern"),
    number<&PrintParams::basePerimeters>("basePerimeters", Advanced, {0, 10}, "Bottom walls",
                                         "Loops along the outline of hatched bottom layers"),
    choice<&PrintParams::showSide>("showSide", Basic, "up bed both", "Side to show",
                                   "Top: what shows is on top. Bed: it is mirrored on the bed, the bottom layers above "
                                   "it. Both: both sides, for shapes that are their own mirror image",
                                   "--show"),
    number<&PrintParams::skirt>("skirt", Advanced, {0, 20}, "Skirt loops",
                                "Loops around the plates that prime the nozzle", "--skirt"),
    number<&PrintParams::purgeLength>(
        "purgeLength", Advanced, {0, 100, "mm"}, "Purge length",
        "Filament extruded beside the plate before printing, in addition to what the last print retracted"),
    number<&PrintParams::rim>(
        "rim", Basic, {0, 50}, "Rim",
        "Number of layers of a raised border on top of the top layers, along the outline and its holes", "--rim"),
    number<&PrintParams::rimWidth>("rimWidth", Basic, {0.1, 100, "mm"}, "Rim width",
                                   "Width of the raised border, in whole lines as wide as the nozzle and at least one",
                                   "--rim-width"),
    number<&PrintParams::brim>("brim", Basic, {0, 50}, "Brim",
                               "Loops attached to the plate's first layer, for adhesion", "--brim"),
    number<&PrintParams::elephantFoot>("elephantFoot", Advanced, {0, 0.5, "mm"}, "Elephant's foot",
                                       "Inset of the first bottom layer, to compensate for its being squeezed wider"),
    flag<&PrintParams::constantFlow>(
        "constantFlow", Advanced, "Constant flow",
        "Prints wide beads of top layers slower and narrow ones faster (speed x spacing / width, at most 1.5 times the "
        "speed), so that the plastic flows evenly; not on the first layer"),
    number<&PrintParams::coast>("coast", Advanced, {0, 1, "mm"}, "Coasting",
                                "Length before the end of a path that is travelled without extruding"),
    number<&PrintParams::scarf>("scarf", Advanced, {0, 20, "mm"}, "Scarf seam",
                                "Length over which the two ends of a top layer's cycle overlap, one ramping down while "
                                "the other ramps up; requires coasting of 0"),
    typed<&PrintParams::copies>(
        IntegerPair, "copies", Basic, {1, 20},
        {"Copies", "Columns and rows of copies, printed one after another; copied plates may be at most 3 mm high",
         "--copies"}),
    number<&PrintParams::copyGap>("copyGap", Advanced, {1, 100, "mm"}, "Gap between copies",
                                  "Distance between copies, brims included"),
    number<&PrintParams::layerHeight>("layerHeight", Basic, {0.05, kMaxLayerHeight, "mm"}, "Layer height",
                                      "Layer height, at most 0.8 of the nozzle diameter", "--layer-height"),
    number<&PrintParams::startHeight>("startHeight", Advanced, {0, kMaxBed, "mm"}, "Start height",
                                      "Prints on top of an object of this height that stands on the bed, which the "
                                      "printer must not touch as it homes; at most the build height",
                                      "--start-height"),
    number<&PrintParams::firstLayerHeight>(
        "firstLayerHeight", Advanced, {0, kMaxLayerHeight, "mm"}, "First layer height",
        "First layer height, at least 0.05 mm and at most 0.8 of the nozzle diameter; 0 uses the layer height"),
    number<&PrintParams::flow>(
        "flow", Advanced, {0.01, 2}, "Flow, top layers",
        "Extrusion multiplier of the top layers; slightly below 1 keeps the grooves between beads crisp", "--flow"),
    number<&PrintParams::baseFlow>("baseFlow", Advanced, {0.01, 2}, "Flow, bottom layers",
                                   "Extrusion multiplier of the bottom layers; 1 fills them"),
    number<&PrintParams::bedFlow>(
        "bedFlow", Advanced, {0.01, 2}, "Flow on the bed",
        "Extrusion multiplier of a top layer that is printed on the bed; less than 1 leaves fine gaps there"),
    number<&PrintParams::rotate>("rotate", Basic, {-360, 360, "degrees"}, "Rotation on the bed",
                                 "Rotation of the plate on the bed, counter-clockwise", "--rotate"),
    flag<&PrintParams::mirror>("mirror", Basic, "Mirrored",
                               "Mirrors the plate left to right, before rotation, for plates seen from below; a show "
                               "side on the bed is mirrored automatically",
                               "--mirror"),
    flag<&PrintParams::strict>(
        "strict", Advanced, "Strict",
        "Refuses a path that crosses itself or leaves the shape by more than 0.1 mm; otherwise both are only reported",
        "--strict"),
    number<&PrintParams::place>("place", Basic, {-kMaxSide, kMaxSide, "mm"}, "Position on the bed",
                                "Where the lower left corner of the (rotated) page goes on the bed; null centres it",
                                "--place"),

    {{.section = Section::Printer,
      .key = "profile",
      .type = Name,
      .field = at<&Project::printerProfile>,
      .high = kLine,
      .level = Basic},
     {.label = "Profile",
      .help = "Id of a printer profile, such as \"prusa-mk4s\"; other keys in this section override its values",
      .option = "--printer"}},
    {{.section = Section::Printer,
      .key = "filament",
      .type = Name,
      .field = at<&Project::filamentProfile>,
      .high = kLine,
      .level = Basic},
     {.label = "Filament",
      .help = "Id of a filament, such as \"petg\"; its values override those of the printer profile",
      .option = "--filament"}},
    line<&Printer::name>("name", Advanced, "Name", "Printer name, written into the G-code"),
    choice<&Printer::flavor>(
        "flavor", Advanced, "marlin klipper reprap prusa bambu", "Dialect",
        "Firmware dialect of the G-code; Prusa is for Prusa's Buddy boards; Bambu needs your own start block",
        "--flavor"),
    number<&Printer::bedMin>(
        "bedMin", Advanced, {-kMaxBed, kMaxBed, "mm"}, "Bed, lower left",
        "Lower left corner of the bed: 0, 0 on most printers, negative where the origin is at the centre"),
    number<&Printer::bedMax>(
        "bedMax", Advanced, {-kMaxBed, kMaxBed, "mm"}, "Bed, upper right",
        "Upper right corner of the bed, at least 10 mm to the right of and above the lower left one", "--bed"),
    flag<&Printer::roundBed>("roundBed", Advanced, "Round bed",
                             "The bed is the disc inscribed in its corners, which must form a square"),
    number<&Printer::excludedMin>("excludedMin", Advanced, {-kMaxBed, kMaxBed, "mm"}, "Excluded area, lower left",
                                  "Lower left corner of a rectangle on the bed that nothing may touch"),
    number<&Printer::excludedMax>("excludedMax", Advanced, {-kMaxBed, kMaxBed, "mm"}, "Excluded area, upper right",
                                  "Upper right corner of that rectangle; equal corners exclude nothing"),
    number<&Printer::maxZ>("maxZ", Advanced, {0.05, kMaxBed, "mm"}, "Build height",
                           "Highest Z the printer can reach while printing"),
    number<&Printer::zOffset>("zOffset", Advanced, {-2, 2, "mm"}, "Z offset",
                              "Added to each Z position between the start block and the end block, for printers whose "
                              "Z is 0 above or below the bed; slicers call it z_offset"),
    number<&Printer::nozzle>("nozzle", Basic, {0.05, 2, "mm"}, "Nozzle", "Nozzle diameter; 0.4 mm on most printers",
                             "--nozzle"),
    number<&Printer::filamentDiameter>("filamentDiameter", Advanced, {0.5, 5, "mm"}, "Filament diameter",
                                       "Filament diameter: 1.75 mm, or 2.85 mm on some printers"),
    number<&Printer::filamentDensity>("filamentDensity", Advanced, {0.1, 25, "g/cm3"}, "Filament density",
                                      "Filament density, used only to estimate weight"),
    number<&Printer::filamentFlow>("filamentFlow", Advanced, {0.1, 2}, "Filament flow",
                                   "Flow ratio of the filament (extrusion multiplier), as calibrated in your slicer; "
                                   "it multiplies the flow of every layer, brim and purge line"),
    line<&Printer::filamentType>("filamentType", Advanced, "Filament type", "Filament type, written into the G-code"),
    number<&Printer::maxNozzleTemperature>(
        "maxNozzleTemperature", Advanced, {170, 300, "degrees Celsius"}, "Nozzle temperature limit",
        "Highest nozzle temperature that the hot end is made for, such as 240 with a PTFE tube down to the nozzle"),
    number<&Printer::maxBedTemperature>("maxBedTemperature", Advanced, {0, 120, "degrees Celsius"},
                                        "Bed temperature limit",
                                        "Highest bed temperature that the printer is made for"),
    flag<&Printer::generalHeatLimits>("generalHeatLimits", Advanced, "General heat limits",
                                      "For experts: the nozzle may have 0 to 300 degrees Celsius and the bed up to "
                                      "120, which no machine may exceed, instead of the printer's own limits"),
    number<&Printer::nozzleTemperature>(
        "nozzleTemperature", Basic, {0, 300, "degrees Celsius"}, "Nozzle temperature",
        "Nozzle temperature, as on the filament's label; 170 to the printer's limit unless the general limits hold"),
    number<&Printer::firstLayerNozzleTemperature>(
        "firstLayerNozzleTemperature", Advanced, {0, 300, "degrees Celsius"}, "Nozzle, first layer",
        "Nozzle temperature of the first layer, often slightly higher for adhesion; 170 to the printer's limit unless "
        "the general limits hold"),
    number<&Printer::bedTemperature>(
        "bedTemperature", Basic, {0, 120, "degrees Celsius"}, "Bed temperature",
        "Bed temperature, as on the filament's label; at most the printer's limit unless the general limits hold"),
    number<&Printer::speed>("speed", Basic, {5, 1000, "mm/s"}, "Speed",
                            "Printing speed; slow and constant gives the cleanest reflection"),
    number<&Printer::firstLayerSpeed>("firstLayerSpeed", Advanced, {5, 1000, "mm/s"}, "Speed, first layer",
                                      "Printing speed of the first layer; slower adheres better"),
    number<&Printer::baseSpeed>("baseSpeed", Advanced, {0, 1000, "mm/s"}, "Speed, bottom layers",
                                "Printing speed of bottom layers above the first; 0 uses the printing speed"),
    number<&Printer::showSpeed>("showSpeed", Advanced, {0, 1000, "mm/s"}, "Speed, top layers",
                                "Printing speed of the top layers; 0 uses the printing speed, but at most 20 mm/s "
                                "where pressure advance is not set"),
    number<&Printer::travelSpeed>("travelSpeed", Advanced, {5, 1000, "mm/s"}, "Travel speed",
                                  "Speed of moves that do not extrude"),
    number<&Printer::machineSpeed>(
        "machineSpeed", Advanced, {0, 1000, "mm/s"}, "Machine speed limit",
        "The machine's own speed limit, at least 5; all speeds are capped at it; 0 means unknown"),
    number<&Printer::acceleration>("acceleration", Advanced, {1, 100'000, "mm/s2"}, "Acceleration",
                                   "Acceleration while printing; 1000 to 2000 gives clean U-turns"),
    number<&Printer::firstLayerAcceleration>("firstLayerAcceleration", Advanced, {0, 100'000, "mm/s2"},
                                             "Acceleration, first layer",
                                             "Acceleration on the first layer; 0 uses the printing acceleration"),
    number<&Printer::machineAcceleration>(
        "machineAcceleration", Advanced, {0, 100'000, "mm/s2"}, "Machine acceleration",
        "The printer's own acceleration, restored at the end, and the upper limit while printing; 0 means unknown: "
        "acceleration is only used for estimates and not set"),
    number<&Printer::cornerSpeed>("cornerSpeed", Advanced, {0.1, 100, "mm/s"}, "Corner speed",
                                  "Klipper's square corner velocity; about half of Marlin's jerk"),
    number<&Printer::machineCornerSpeed>("machineCornerSpeed", Advanced, {0, 100, "mm/s"}, "Machine corner speed",
                                         "The printer's own corner speed, restored at the end; 0 means unknown: corner "
                                         "speed is only used for estimates and not set"),
    number<&Printer::curveAcceleration>("curveAcceleration", Advanced, {0, 100'000, "mm/s2"}, "Curve acceleration",
                                        "Limits speed in curves of radius r to the square root of this times r, but "
                                        "never below 5 mm/s; 0 means no limit"),
    number<&Printer::firstLayerFan>("firstLayerFan", Advanced, {0, 100, "%"}, "Fan, first layer",
                                    "Fan speed on the first layer"),
    number<&Printer::baseFan>("baseFan", Advanced, {-1, 100, "%"}, "Fan, bottom layers",
                              "Fan speed on bottom layers above the first; negative values choose what the filament "
                              "usually gets, such as 100 for PLA, 50 for PETG and 10 for ABS"),
    number<&Printer::showFan>("showFan", Advanced, {-1, 100, "%"}, "Fan, top layers",
                              "Fan speed on top layers above the first; negative values choose what the filament "
                              "usually gets, such as 100 for PLA, 50 for PETG and 10 for ABS"),
    number<&Printer::minLayerTime>(
        "minLayerTime", Advanced, {0, 300, "s"}, "Minimum layer time",
        "Layers that would take less time are slowed down, but not below 5 mm/s; 0 means no minimum"),
    number<&Printer::maxFlow>(
        "maxFlow", Advanced, {0.1, 1000, "mm3/s"}, "Maximum flow",
        "Largest volume per second the hot end can melt; wide beads are slowed down to stay within it"),
    number<&Printer::maxSegmentsPerSecond>("maxSegmentsPerSecond", Advanced, {1, 100'000, "1/s"}, "Moves per second",
                                           "Largest number of moves per second the printer's board can process"),
    number<&Printer::pressureAdvance>(
        "pressureAdvance", Advanced, {0, 2, "s"}, "Pressure advance",
        "Pressure advance of the printer and filament; limits how fast the bead width changes along the path"),
    flag<&Printer::setPressureAdvance>("setPressureAdvance", Advanced, "Set pressure advance",
                                       "Writes pressure advance into the G-code; otherwise the printer keeps its own"),
    number<&Printer::retractLength>("retractLength", Advanced, {0, 20, "mm"}, "Retraction",
                                    "Length of filament retracted before a travel"),
    number<&Printer::retractSpeed>("retractSpeed", Advanced, {1, 200, "mm/s"}, "Retraction speed",
                                   "Speed at which filament is retracted and returned"),
    number<&Printer::lift>("lift", Advanced, {0, 20, "mm"}, "Lift", "Height the nozzle is raised before a travel"),
    flag<&Printer::absoluteE>("absoluteE", Advanced, "Absolute extrusion",
                              "Writes E as absolute positions (M82, reset with G92 E0 on each layer) instead of "
                              "distances, for hosts that do not support relative extrusion"),
    block<&Printer::startGcode>(
        "startGcode", Advanced,
        kBlock, "Start G-code",
        "Start block with optional placeholders; empty uses the built-in one: home, heat, wait"),
    block<&Printer::endGcode>("endGcode", Advanced, kBlock, "End G-code",
                              "End block with optional placeholders; empty uses the built-in one: park, heaters off"),
    line<&Printer::screenSizes>(
        "screenSizes", Advanced, "Thumbnails",
        "Thumbnail sizes in pixels: WxH, WxH/PNG or WxH/QOI; at most 8, with sides of 16 to 1024"),
};

// Kept apart from the words, so that programs without them do not carry these.
constexpr auto kSettings = [] {
  std::array<Setting, std::size(kRows)> settings{};
  for (std::size_t k = 0; k < settings.size(); ++k) settings[k] = kRows[k].setting;
  return settings;
}();

constexpr auto kWords = [] {
  std::array<SettingWords, std::size(kRows)> words{};
  for (std::size_t k = 0; k < words.size(); ++k) words[k] = kRows[k].words;
  return words;
}();

}  // namespace

bool isFontFile(std::string_view font) {
  for (const std::string_view end : {".ttf", ".otf", ".ttc", ".woff", ".woff2"}) {
    const std::string_view own = font.substr(font.size() - std::min(end.size(), font.size()));
    const auto same = [](char a, char b) { return a == b || (a >= 'A' && a <= 'Z' && a + 32 == b); };
    if (std::equal(own.begin(), own.end(), end.begin(), end.end(), same)) return true;
  }
  return false;
}

const Layer* groundOf(const std::vector<Layer>& layers) {
  if (layers.empty()) return nullptr;
  const Layer& lowest = layers[0];
  const bool fills =
      lowest.kind() == LayerKind::Direction || lowest.kind() == LayerKind::Map || lowest.kind() == LayerKind::Picture;
  const bool placed = lowest.at || lowest.size != Vec2{} || lowest.rotation != 0 || lowest.mirror ||
                      lowest.mask != LayerMask::Own || lowest.soft != 0;
  return fills && lowest.visible && !placed ? &lowest : nullptr;
}

std::vector<LampPicture> groundPictures(const std::vector<Layer>& layers) {
  const Layer* const ground = groundOf(layers);
  const PictureLayer* const pictures = ground == nullptr ? nullptr : ground->as<PictureLayer>();
  return pictures == nullptr ? std::vector<LampPicture>() : pictures->pictures;
}

SettingsView viewOf(Project& project) { return {&project, &project.toolpath, &project.print, &project.printer}; }

std::span<const Setting> settings() { return kSettings; }

SettingWords wordsOf(const Setting& setting) { return kWords.at(&setting - kSettings.data()); }

const Setting* findSetting(Section section, std::string_view key) {
  for (const Setting& setting : kSettings) {
    if (setting.section == section && setting.key == key) return &setting;
  }
  return nullptr;
}

const char* sectionName(Section section) {
  constexpr std::array kNames{"shape", "layers", "pictures", "toolpath", "print", "printer"};
  return kNames[toSize(section)];
}

std::string fullName(const Setting& setting) { return std::string(sectionName(setting.section)) + "." + setting.key; }

std::vector<std::string> splitWords(std::string_view text) {
  std::vector<std::string> words;
  while (!text.empty()) {
    const std::size_t space = std::min(text.find(' '), text.size());
    if (space > 0) words.emplace_back(text.substr(0, space));
    text.remove_prefix(std::min(space + 1, text.size()));
  }
  return words;
}

std::size_t chosen(const Field& field) {
  if (bool* const* flag = std::get_if<bool*>(&field)) return **flag ? 1 : 0;
  const ChoiceField& choice = std::get<ChoiceField>(field);
  return choice.get(choice.at);
}

void choose(const Field& field, std::size_t index) {
  if (bool* const* flag = std::get_if<bool*>(&field)) {
    **flag = index != 0;
  } else {
    const ChoiceField& choice = std::get<ChoiceField>(field);
    choice.set(choice.at, index);
  }
}

}  // namespace sillon
