// The content of a layer, read from its files.
#pragma once

#include <optional>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/input/read_input.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/settings/layers.hpp"

namespace sillon {

/// The content of one layer, in its own millimetres or shares; what its kind does not have is empty.
struct LayerContent {
  Vec2 size;                   ///< of its box [mm]
  std::optional<Shape> shape;  ///< letters or a drawing; its page is the box
  std::optional<DirectionMap> map;
  std::optional<Tones> tones;
  std::optional<Image> modules;
  std::optional<Shape> mask;  ///< its page is the box
};

/// \param page  of the plate [mm].
/// \return the errors of reading, readSvg, decodeImage, textShape and qrModules.
Result<LayerContent> readContent(const Layer& layer, Vec2 page, const ReadInput& read);

}  // namespace sillon
