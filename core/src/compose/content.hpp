// The content of a layer, read from its files.
#pragma once

#include <optional>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/input/read_input.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// The content of one layer, in its own millimetres or shares; what its kind does not have is empty.
struct LayerContent {
  Vec2 size;                   ///< of its box [mm]
  std::optional<Shape> shape;  ///< letters or a drawing; its page is the box
  std::optional<DirectionMap> map;
  ModeMap modes;
  std::vector<Tones> tones;      ///< of pictures under lamps
  std::optional<Image> picture;  ///< whose tones tell directions
  bool fills = false;            ///< that picture is the lowest layer's, and covers the page where it is clear, too
  DrawingFacts painted;          ///< of the drawing that it was painted from, if it was
  std::optional<Image> modules;
  std::optional<Shape> mask;  ///< its page is the box
};

inline constexpr double kTexelsPerBead = 4;  ///< of rasters
inline constexpr int kMostTexels = 4096;     ///< on a side of them

/// The surface that layers lie on.
struct LayerPlate {
  const Project& project;
  const Shape& shape;
  int width = 0;  ///< of the raster
  int height = 0;
  std::optional<Lamp> lamp = {};  ///< of pictures that name none
};

/// \param page  of the surface [mm].
/// \param lowest  it fills the page where it has no size.
/// \return the errors of reading, readSvg, decodeImage, textShape and qrModules.
Result<LayerContent> readContent(const Layer& layer, Vec2 page, bool lowest, const ReadInput& read);

}  // namespace sillon
