// Visibility of a plate's layers.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sillon/base/types.hpp"
#include "sillon/report/warning.hpp"
#include "sillon/settings/layers.hpp"

namespace sillon {

/// A visible layer, and the shares of what it draws that are not seen, 0..1, each for one reason.
struct SeenLayer {
  std::size_t layer = 1;  ///< number of the layer, from 1
  LayerKind kind = LayerKind::Direction;
  Vec2 size;                     ///< size of its box, before it turns [mm]
  double thin = 0;               ///< share that is narrower than two beads
  double beside = 0;             ///< share beside the plate, or in its holes
  double underRim = 0;           ///< share under the rim
  double covered = 0;            ///< share covered by layers above
  double alike = 0;              ///< share within 15 degrees of what it lies on
  double module = 0;             ///< side of a code's modules [mm]
  std::optional<bool> readable;  ///< tells whether decoders read it; unset: it is no code
};

/// Makes warnings about layers that are not seen: letters and codes of which more than 2 % are
/// hidden or alike; drawings of which more than 2 % are hidden or 10 % alike; others of which less
/// than 2 % are left; thin letters and modules; and codes that cannot be read.
/// \param page  size of the plate [mm].
/// \param spacing  tau [mm].
std::vector<Warning> layerWarnings(const std::vector<SeenLayer>& layers, Vec2 page, double spacing);

}  // namespace sillon
