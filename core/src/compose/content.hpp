// Content of a layer, read from its files.
#pragma once

#include <optional>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// Content of one layer, in its own millimetres or shares; fields that do not apply to its kind are empty.
struct LayerContent {
  Vec2 size;                   ///< size of its box [mm]
  std::optional<Shape> shape;  ///< letters or a drawing; its page is the box
  std::optional<DirectionMap> map;
  ModeMap modes;
  std::vector<Tones> tones;      ///< tones of pictures under lamps
  std::optional<Image> picture;  ///< picture whose tones give directions
  bool fills = false;    ///< true if `picture` belongs to the lowest layer and also covers the page where it is clear
  DrawingFacts painted;  ///< facts of the drawing that `picture` was painted from
  std::optional<Image> modules;
  std::optional<Shape> mask;  ///< its page is the box
};

inline constexpr double kTexelsPerBead = 4;  ///< texels of rasters per spacing
inline constexpr int kMostTexels = 4096;     ///< texels on a side of a raster

/// Surface that layers lie on.
struct LayerPlate {
  const Project& project;
  const Shape& shape;
  int width = 0;  ///< width and height of the raster [texels]
  int height = 0;
  std::optional<Lamp> lamp = {};  ///< lamp for pictures that name none
};

/// Reads the content of a layer.
/// \param page  size of the surface [mm].
/// \param lowest  if true, maps and pictures without a size fill the page.
/// \return the errors of reading files, readSvg(), decodeImage(), textShape() and qrModules().
Result<LayerContent> readContent(const Layer& layer, Vec2 page, bool lowest, const ReadInput& read);

}  // namespace sillon
