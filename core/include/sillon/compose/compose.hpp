// Layers over a plate's directions: texts, drawings, pictures, codes and patterns where the maker
// put them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/input/read_input.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// The box of a layer on the page, before it turns.
struct PlacedLayer {
  Vec2 at;    ///< its middle [mm]
  Vec2 size;  ///< [mm]
  /// Share of letters or of a drawing that is narrower than two beads, 0..1
  double thin = 0;
};

/// The layers of a project on a raster of the page, blended with one another but not yet with what
/// lies below.
struct LayerStack {
  /// A texel's line, e^(2i angle), is `line` + `through` times that of what lies below.
  struct Texel {
    Vec2f line;
    float through = 1;  ///< 0: nothing shines through; -1: across what lies below
    float cover = 0;    ///< share that is laid by layers, 0..1
  };
  int width = 0;  ///< 0: no layer is visible
  int height = 0;
  std::vector<Texel> texels;        ///< row 0 on top
  bool showsPictures = false;       ///< one of them is a picture under a lamp
  std::vector<PlacedLayer> placed;  ///< one per layer of the project, invisible ones too
};

/// Reads the files of the layers, and rasters them in texels of a quarter of the bead spacing, at
/// most 4096 on a side. \param shape  of the plate: a border lies along it, and pictures are solved
/// within it. \return the errors of reading, readSvg, decodeImage, textShape, qrModules and
/// solveDirections, with the layer's number, or Cancelled.
Result<LayerStack> makeLayers(const Project& project, const Shape& shape, const ReadInput& read,
                              const RunContext& run);

/// The boxes alone, for those who show handles: no picture is solved for.
/// \return as makeLayers.
Result<std::vector<PlacedLayer>> placeLayers(const Project& project, const Shape& shape,
                                             const ReadInput& read);

/// Lays the stack over directions and modes, in place. Without a visible layer nothing changes.
void layOver(const LayerStack& stack, PlateInput& input);

}  // namespace sillon
