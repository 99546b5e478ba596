// Choices about one layer of a surface: its content, and its place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "sillon/base/types.hpp"

namespace sillon {

/// Encodings of directions in a picture. Colour pictures are read by their luma (Rec. 709), except
/// for tangents; alpha is ignored.
enum class DirectionEncoding {
  Angle,     ///< grey 0..1 is -90..90 degrees, as in the paper
  Rotation,  ///< grey 0..1 is 0..180 degrees, the rotation map of texture tools
  /// Red and green in 0..1 are x and y in -1..1, y up, as in glTF's KHR_materials_anisotropy;
  /// neutral is 0 degrees
  Tangent,
};

/// Ways in which a place chooses the directions of its beads.
enum class DirectionMode : std::uint8_t {
  Parallel,     ///< beads run parallel to the nearest border, smoothly
  Orthogonal,   ///< beads run across the nearest border, smoothly
  Smoothest,    ///< beads bend as little as possible
  Constrained,  ///< beads follow the directions of the layer
};

/// Contents of a layer, in the order of LayerContents.
enum class LayerKind {
  Direction,  ///< one direction
  Map,        ///< a direction picture
  Picture,    ///< pictures that are seen under their lamps
  Text,
  Code,     ///< a QR code in two directions
  Pattern,  ///< directions from a formula, or from the distance to a drawing
  Tones,    ///< directions from the tones, edges or colours of a picture
  Drawing,  ///< the outline of an SVG or a mask picture
  Border,   ///< a band along the surface's border
  Strokes,  ///< gestures of brushes
};

/// Formulas for the directions of a pattern.
enum class LayerPattern {
  Radial,  ///< rays from the layer's middle, turned by `angle`: 0 rays, 90 rings
  /// Rays that turn on their way out, by 180 degrees per `waveLength`; mirrored: the other way
  Spiral,
  Waves,  ///< along a sine wave
  Noise,  ///< smooth random directions; their knots lie a `waveLength` apart
  Echo,   ///< along contours of equal distance from the layer's drawing, inside and outside
};

/// Ways to read directions from a picture.
enum class TonesBy {
  Brightness,  ///< black runs at `from`, white at `to`, and greys between them
  Levels,      ///< darker than `threshold` runs at `from`, the rest at `to`
  Edges,       ///< along the picture's edges, smooth between them, turned by `angle`
  Colours,     ///< each flat colour in a direction of its own
};

/// Ways in which beads fill letters, drawings and borders.
enum class LayerFill {
  Angle,   ///< in one direction
  Along,   ///< along the outline, by the distance to it
  Across,  ///< across the beads below
};

/// Places where a layer shows.
enum class LayerMask {
  Own,      ///< its letters, its drawing, its modules, or its box
  Disc,     ///< the ellipse in its box
  Page,     ///< everywhere
  Inside,   ///< within `maskFile`, which is stretched over the layer's box
  Outside,  ///< outside `maskFile`
};

/// Share of a QR code that may be damaged: 7, 15, 25 or 30 percent.
enum class QrCorrection { Low, Medium, Quartile, High };

/// Places of a text's shorter lines in its box.
enum class TextAlign { Left, Middle, Right };

/// A picture and the position of its lamp.
struct LampPicture {
  std::string file;  ///< PNG, JPEG, BMP or TGA
  /// Azimuth counter-clockwise from +x, -360..360, and elevation, 1..90 [degrees]; unset: chosen
  /// for the picture
  std::optional<Vec2> lamp;

  friend bool operator==(const LampPicture&, const LampPicture&) = default;
};

/// A colour of a picture, and the direction of places that are painted in it.
struct ColourAngle {
  std::string colour;  ///< "#rrggbb"
  double angle = 0;    ///< -360..360 [degrees]

  friend bool operator==(const ColourAngle&, const ColourAngle&) = default;
};

/// Tools of a brush.
enum class StrokeTool {
  Comb,   ///< turns beads to the way of the brush, and makes them constrained
  Mode,   ///< sets `mode`
  Erase,  ///< brings back the beads below the layer
};

/// One gesture of a brush.
struct Stroke {
  StrokeTool tool = StrokeTool::Comb;
  double radius = 4;  ///< radius of the brush [mm], 0.1..1000
  double soft = 0.5;  ///< softness of the brush's rim: 0 is hard, 1 fades from its middle
  DirectionMode mode = DirectionMode::Constrained;
  std::vector<Vec2> points;  ///< points on the page, from the lower left corner [mm]

  friend bool operator==(const Stroke&, const Stroke&) = default;
};

// Settings that several kinds have. A setting of the table belongs to every kind that derives from
// its struct.

struct LayerAngle {
  /// Direction of its beads on the page, whatever the rotation [degrees]
  double angle = 0;
  friend bool operator==(const LayerAngle&, const LayerAngle&) = default;
};

struct LayerFile {
  std::string file;
  friend bool operator==(const LayerFile&, const LayerFile&) = default;
};

/// The part of a picture that is used, in shares of the picture.
struct LayerCrop {
  Vec2 cropMin{0, 0};  ///< lower left corner
  Vec2 cropMax{1, 1};
  friend bool operator==(const LayerCrop&, const LayerCrop&) = default;
};

struct LayerFilled {
  LayerFill fill = LayerFill::Across;
  friend bool operator==(const LayerFilled&, const LayerFilled&) = default;
};

struct LayerGround {
  /// Direction in the box behind letters, drawings and dark modules [degrees]. If it is unset, the
  /// beads below show there, and light modules lie across the dark ones.
  std::optional<double> ground;
  friend bool operator==(const LayerGround&, const LayerGround&) = default;
};

struct LayerWords {
  std::string text;
  friend bool operator==(const LayerWords&, const LayerWords&) = default;
};

/// The look of letters.
struct LayerLetters {
  std::string font = "Nunito";  ///< name of a built-in font, or a file for which isFontFile holds
  int weight = 0;               ///< weight of a variable font, 1..1000; 0: the font's own
  double textSize = 10;         ///< height of capitals, where the layer's size is 0 [mm]
  /// Radius of the circle that letters stand on [mm]; 0: straight lines; below 0: they read along
  /// its lower side
  double circle = 0;
  TextAlign align = TextAlign::Middle;
  friend bool operator==(const LayerLetters&, const LayerLetters&) = default;
};

// The kinds of layers. Ranges: docs/reference/project.md, section `layers`.

struct DirectionLayer : LayerAngle {
  friend bool operator==(const DirectionLayer&, const DirectionLayer&) = default;
};

struct MapLayer : LayerFile, LayerCrop {
  DirectionEncoding encoding = DirectionEncoding::Angle;
  friend bool operator==(const MapLayer&, const MapLayer&) = default;
};

struct PictureLayer : LayerCrop {
  std::vector<LampPicture> pictures;  ///< pictures that lie over one another, 1..4
  friend bool operator==(const PictureLayer&, const PictureLayer&) = default;
};

struct TextLayer : LayerWords, LayerLetters, LayerAngle, LayerFilled, LayerGround {
  friend bool operator==(const TextLayer&, const TextLayer&) = default;
};

struct CodeLayer : LayerWords, LayerAngle, LayerGround {
  QrCorrection correction = QrCorrection::Medium;
  friend bool operator==(const CodeLayer&, const CodeLayer&) = default;
};

struct PatternLayer : LayerAngle, LayerFile, LayerWords, LayerLetters {
  LayerPattern pattern = LayerPattern::Radial;
  /// Length of a wave, way out of a half turn of a spiral, or distance of the knots of noise [mm]
  double waveLength = 20;
  /// Angle by which waves and noise turn directions to either side [degrees]
  double amplitude = 20;
  std::uint64_t seed = 1;  ///< seed of the noise
  friend bool operator==(const PatternLayer&, const PatternLayer&) = default;
};

struct TonesLayer : LayerFile, LayerCrop, LayerAngle {
  TonesBy by = TonesBy::Brightness;
  double from = 0;         ///< direction of dark places [degrees]
  double to = 90;          ///< direction of light places [degrees]
  double threshold = 0.5;  ///< tone between dark and light levels, 0..1
  double contrast = 1;  ///< contrast of brightness about the middle grey; 1: as the picture has it
  /// Radius [mm] of a blur of brightness, or of the average over which edges are taken
  double smoothing = 0;
  /// Directions of colours; other colours go with the nearest of these
  std::vector<ColourAngle> colours;
  friend bool operator==(const TonesLayer&, const TonesLayer&) = default;
};

struct DrawingLayer : LayerFile, LayerAngle, LayerFilled, LayerGround {
  friend bool operator==(const DrawingLayer&, const DrawingLayer&) = default;
};

struct BorderLayer : LayerAngle, LayerFilled {
  double width = 3;  ///< width of the band [mm]
  friend bool operator==(const BorderLayer&, const BorderLayer&) = default;
};

struct StrokesLayer {
  std::vector<Stroke> strokes;  ///< gestures in the order in which they were painted
  friend bool operator==(const StrokesLayer&, const StrokesLayer&) = default;
};

using LayerContents =
    std::variant<DirectionLayer, MapLayer, PictureLayer, TextLayer, CodeLayer, PatternLayer,
                 TonesLayer, DrawingLayer, BorderLayer, StrokesLayer>;

/// One layer of a surface. Later layers lie on top; groundOf() finds the lowest.
struct Layer {
  LayerContents contents;
  bool visible = true;
  /// Middle of its box on the page, from the lower left corner [mm]; unset: the page's middle
  std::optional<Vec2> at;
  /// Size of its box, before it turns [mm]. A side of 0 follows the content's proportions; without
  /// both, contents have their own size, or a share of the page.
  Vec2 size;
  double rotation = 0;  ///< turn, counter-clockwise [degrees]
  bool mirror = false;  ///< mirrored left to right, before it turns
  LayerMask mask = LayerMask::Own;
  std::string maskFile;
  /// Width over which its directions turn into those below, about its edge [mm]
  double soft = 0;
  DirectionMode mode = DirectionMode::Constrained;
  std::string modeFile;  ///< mode picture over its box, instead of `mode`

  [[nodiscard]] LayerKind kind() const { return static_cast<LayerKind>(contents.index()); }
  /// Returns the part of this type that its kind has, or null if it has none.
  template <class Part>
  [[nodiscard]] const Part* as() const {
    return std::visit(
        [](const auto& contents) -> const Part* {
          if constexpr (std::is_base_of_v<Part, std::decay_t<decltype(contents)>>) {
            return &contents;
          } else {
            return nullptr;
          }
        },
        contents);
  }
  template <class Part>
  [[nodiscard]] Part* as() {
    return const_cast<Part*>(std::as_const(*this).as<Part>());
  }

  friend bool operator==(const Layer&, const Layer&) = default;
};

/// Returns the lowest layer, where it fills the surface by itself: one direction, a map or pictures
/// without place, size, turn, mask and soft edge. A map is then stretched over the page, and
/// pictures are laid out by PictureParams::proportions. Null means that beads run at 0 degrees
/// wherever no layer covers them.
const Layer* groundOf(const std::vector<Layer>& layers);

/// Returns the pictures of that layer; empty: it has none.
std::vector<LampPicture> groundPictures(const std::vector<Layer>& layers);

}  // namespace sillon
