// Choices about one layer of a plate: what it draws, and where.
#pragma once

#include <optional>
#include <string>

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

/// Contents of a layer.
enum class LayerKind {
  Direction,  ///< one direction
  Map,        ///< a direction picture
  Picture,    ///< a picture that shows under its lamp
  Text,
  Qr,       ///< a QR code in two directions
  Pattern,  ///< directions from a formula, or from the distance to a drawing
  Drawing,  ///< the outline of an SVG or a mask picture
  Border,   ///< a band along the plate's border
};

enum class LayerPattern {
  Radial,  ///< rays from the layer's middle, turned by `angle`: 0 rays, 90 rings, between them
           ///< spirals
  Waves,   ///< along a sine wave
  Echo,    ///< along contours of equal distance from the layer's drawing, inside and outside
};

/// Ways in which beads fill letters, drawings and borders.
enum class LayerFill {
  Angle,   ///< in one direction
  Along,   ///< along the outline, by the distance to it
  Across,  ///< across whatever lies below
};

/// Tells whether layers of a kind have a fill; the others have their own directions.
constexpr bool hasFill(LayerKind kind) {
  return kind == LayerKind::Text || kind == LayerKind::Drawing || kind == LayerKind::Border;
}

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

/// One layer. Later layers lie on top. Ranges: docs/reference/project.md, section `layers`.
struct Layer {
  LayerKind kind = LayerKind::Direction;
  bool visible = true;
  /// Middle of its box on the page, from the lower left corner [mm]; unset: the page's middle
  std::optional<Vec2> at;
  /// Size of its box, before it turns [mm]. A side of 0 follows the content's proportions; without
  /// both, contents have the size that contentSize gives.
  Vec2 size;
  double rotation = 0;  ///< counter-clockwise [degrees]
  bool mirror = false;  ///< left to right, before it turns
  LayerMask mask = LayerMask::Own;
  std::string maskFile;
  double soft = 0;   ///< width over which its directions turn into those below, about its edge [mm]
  double angle = 0;  ///< of its beads on the page, whatever the rotation [degrees]
  /// Direction in the box behind letters, drawings and dark modules [degrees]; unset: what lies
  /// below shows there, and light modules lie across the dark ones
  std::optional<double> ground;
  LayerFill fill = LayerFill::Across;
  DirectionEncoding encoding = DirectionEncoding::Angle;  ///< of a map
  std::string file;    ///< of a map, a picture, a drawing or an echo
  Vec2 cropMin{0, 0};  ///< lower left corner of the part of a picture that is used, in shares of it
  Vec2 cropMax{1, 1};
  std::optional<Vec2>
      lamp;          ///< of a picture: azimuth and elevation [degrees]; unset: as the plate's first
  std::string text;  ///< of a text or a QR code
  std::string font = "Nunito";  ///< a built-in one, or a file that ends in .ttf or .otf
  double textSize = 10;         ///< height of its capitals, where the size is 0 [mm]
  double circle = 0;  ///< radius of the line that letters stand on [mm]; below 0: they read along
                      ///< its lower side
  TextAlign align = TextAlign::Middle;
  QrCorrection correction = QrCorrection::Medium;
  LayerPattern pattern = LayerPattern::Radial;
  double waveLength = 20;  ///< [mm]
  double amplitude = 20;   ///< by which waves turn directions [degrees]
  double width = 3;        ///< of a border [mm]

  friend bool operator==(const Layer&, const Layer&) = default;
};

}  // namespace sillon
