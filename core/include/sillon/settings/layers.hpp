// Choices about one layer of a surface: what it draws, and where.
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

/// Encodings of directions in a picture. Colour pictures are read by their luma (Rec. 709) except
/// for tangents; alpha is ignored.
enum class DirectionEncoding {
  Angle,     ///< grey 0..1 is -90..90 degrees, as in the paper
  Rotation,  ///< grey 0..1 is 0..180 degrees, the rotation map of texture tools
  /// red, green in 0..1 are x, y in -1..1, y up, as in glTF's KHR_materials_anisotropy; neutral is
  /// 0 degrees
  Tangent,
};

/// Demands of a place on its beads.
enum class DirectionMode : std::uint8_t {
  Parallel,     ///< to the nearest border, smoothly
  Orthogonal,   ///< to the nearest border, smoothly
  Smoothest,    ///< whatever bends least
  Constrained,  ///< the directions of the layer
};

/// Contents of a layer, in the order of LayerContents.
enum class LayerKind {
  Direction,  ///< one direction
  Map,        ///< a direction picture
  Picture,    ///< pictures that show under their lamps
  Text,
  Code,     ///< a QR code in two directions
  Pattern,  ///< directions from a formula, or from the distance to a drawing
  Tones,    ///< directions from the tones, edges or colours of a picture
  Drawing,  ///< the outline of an SVG or a mask picture
  Border,   ///< a band along the surface's border
  Strokes,  ///< gestures of brushes
};

enum class LayerPattern {
  Radial,  ///< rays from the layer's middle, turned by `angle`: 0 rays, 90 rings
  Spiral,  ///< rays that turn on their way out, by 180 degrees per `waveLength`; mirrored: the
           ///< other way
  Waves,   ///< along a sine wave
  Noise,   ///< smooth chance; its knots lie a `waveLength` apart
  Echo,    ///< along contours of equal distance from the layer's drawing, inside and outside
};

/// Ways to read directions from a picture.
enum class TonesBy {
  Brightness,  ///< black runs at `from`, white at `to`, and greys between
  Levels,      ///< darker than `threshold` runs at `from`, the rest at `to`
  Edges,       ///< along the picture's edges and smoothly between them, turned by `angle`
  Colours,     ///< each flat colour in a direction of its own
};

/// Ways in which beads fill letters, drawings and borders.
enum class LayerFill {
  Angle,   ///< in one direction
  Along,   ///< along the outline, by the distance to it
  Across,  ///< across whatever lies below
};

/// Places where a layer shows.
enum class LayerMask {
  Own,      ///< its letters, its drawing, its modules, or its box
  Disc,     ///< the ellipse in its box
  Page,     ///< everywhere
  Inside,   ///< within `maskFile`, which is stretched over the layer's box
  Outside,  ///< around it
};

/// Share of a QR code that may be damaged: 7, 15, 25 or 30 percent.
enum class QrCorrection { Low, Medium, Quartile, High };

/// Places of a text's shorter lines in its box.
enum class TextAlign { Left, Middle, Right };

/// A picture and where its lamp stands.
struct LampPicture {
  std::string file;  ///< PNG, JPEG, BMP or TGA
  /// Azimuth counter-clockwise from +x, -360..360, and elevation, 1..90 [degrees]; unset: chosen
  /// for the picture
  std::optional<Vec2> lamp;

  friend bool operator==(const LampPicture&, const LampPicture&) = default;
};

/// A colour of a picture, and the direction of what is painted in it.
struct ColourAngle {
  std::string colour;  ///< "#rrggbb"
  double angle = 0;    ///< -360..360 [degrees]

  friend bool operator==(const ColourAngle&, const ColourAngle&) = default;
};

enum class StrokeTool {
  Comb,   ///< turns beads to the way of the brush, and makes them constrained
  Mode,   ///< sets `mode`
  Erase,  ///< brings back what lies below the layer
};

/// One gesture of a brush.
struct Stroke {
  StrokeTool tool = StrokeTool::Comb;
  double radius = 4;  ///< of the brush [mm], 0.1..1000
  double soft = 0.5;  ///< rim of the brush: 0 is hard, 1 fades from its middle
  DirectionMode mode = DirectionMode::Constrained;
  std::vector<Vec2> points;  ///< on the page, from the lower left corner [mm]

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

/// Part of a picture that is used, in shares of it.
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
  /// Direction in the box behind letters, drawings and dark modules [degrees]; unset: what lies
  /// below shows there, and light modules lie across the dark ones
  std::optional<double> ground;
  friend bool operator==(const LayerGround&, const LayerGround&) = default;
};

struct LayerWords {
  std::string text;
  friend bool operator==(const LayerWords&, const LayerWords&) = default;
};

/// The look of letters.
struct LayerLetters {
  std::string font = "Nunito";  ///< a built-in one, or a file for which isFontFile holds
  int weight = 0;               ///< of a variable font, 1..1000; 0: the font's own
  double textSize = 10;         ///< height of capitals, where the layer's size is 0 [mm]
  /// Radius of the line that letters stand on [mm]; below 0: they read along its lower side
  double circle = 0;
  TextAlign align = TextAlign::Middle;
  friend bool operator==(const LayerLetters&, const LayerLetters&) = default;
};

// The kinds. Ranges: docs/reference/project.md, section `layers`.

struct DirectionLayer : LayerAngle {
  friend bool operator==(const DirectionLayer&, const DirectionLayer&) = default;
};

struct MapLayer : LayerFile, LayerCrop {
  DirectionEncoding encoding = DirectionEncoding::Angle;
  friend bool operator==(const MapLayer&, const MapLayer&) = default;
};

struct PictureLayer : LayerCrop {
  std::vector<LampPicture> pictures;  ///< 1..4, over one another
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
  double waveLength = 20;  ///< [mm]
  double amplitude = 20;   ///< by which waves and noise turn directions to either side [degrees]
  std::uint64_t seed = 1;  ///< of noise
  friend bool operator==(const PatternLayer&, const PatternLayer&) = default;
};

struct TonesLayer : LayerFile, LayerCrop, LayerAngle {
  TonesBy by = TonesBy::Brightness;
  double from = 0;         ///< direction of dark places [degrees]
  double to = 90;          ///< direction of light places [degrees]
  double threshold = 0.5;  ///< tone between dark and light levels, 0..1
  double contrast = 1;     ///< of brightness, about the middle grey; 1: as the picture has it
  double smoothing = 0;    ///< radius of a blur (brightness), or over which edges are averaged [mm]
  std::vector<ColourAngle> colours;  ///< other colours go with the nearest of these
  friend bool operator==(const TonesLayer&, const TonesLayer&) = default;
};

struct DrawingLayer : LayerFile, LayerAngle, LayerFilled, LayerGround {
  friend bool operator==(const DrawingLayer&, const DrawingLayer&) = default;
};

struct BorderLayer : LayerAngle, LayerFilled {
  double width = 3;  ///< [mm]
  friend bool operator==(const BorderLayer&, const BorderLayer&) = default;
};

struct StrokesLayer {
  std::vector<Stroke> strokes;  ///< in the order in which they were painted
  friend bool operator==(const StrokesLayer&, const StrokesLayer&) = default;
};

using LayerContents =
    std::variant<DirectionLayer, MapLayer, PictureLayer, TextLayer, CodeLayer, PatternLayer,
                 TonesLayer, DrawingLayer, BorderLayer, StrokesLayer>;

/// One layer of a surface. Later layers lie on top; see groundOf for the lowest.
struct Layer {
  LayerContents contents;
  bool visible = true;
  /// Middle of its box on the page, from the lower left corner [mm]; unset: the page's middle
  std::optional<Vec2> at;
  /// Size of its box, before it turns [mm]. A side of 0 follows the content's proportions; without
  /// both, contents have their own size, or a share of the page.
  Vec2 size;
  double rotation = 0;  ///< counter-clockwise [degrees]
  bool mirror = false;  ///< left to right, before it turns
  LayerMask mask = LayerMask::Own;
  std::string maskFile;
  double soft = 0;  ///< width over which its directions turn into those below, about its edge [mm]
  DirectionMode mode = DirectionMode::Constrained;
  std::string modeFile;  ///< a mode picture over its box, instead of `mode`

  [[nodiscard]] LayerKind kind() const { return static_cast<LayerKind>(contents.index()); }
  /// The part of this type that its kind has; null: it has none.
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

/// The lowest layer, where it fills the surface by itself: one direction, a map or pictures without
/// place, size, turn, mask and soft edge. Maps are then stretched over the page, and pictures laid
/// out by PictureParams::proportions. Null: what no layer covers runs at 0 degrees.
const Layer* groundOf(const std::vector<Layer>& layers);

/// The pictures of that layer; empty: it has none.
std::vector<LampPicture> groundPictures(const std::vector<Layer>& layers);

}  // namespace sillon
