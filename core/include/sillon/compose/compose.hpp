// Layers over a plate's directions: texts, drawings, pictures, codes and patterns where the maker
// put them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/input/read_input.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/report/layers.hpp"
#include "sillon/report/warning.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// The box of a layer on the page, before it turns.
struct PlacedLayer {
  Vec2 at;    ///< its middle [mm]
  Vec2 size;  ///< [mm]
  /// Share of letters or of a drawing that is narrower than two beads, 0..1
  double thin = 0;
  std::optional<Error> problem;  ///< its content cannot be made; the box is what it asks for
  /// Facts read from its letters or drawing, and from its mask
  std::vector<DrawingFacts> drawings = {};
  std::vector<LackedLetter> lacked = {};  ///< of its text, as in ShapedLine
};

/// A picture under its lamp, as it is solved for in a window of the page.
struct LayerPicture {
  Lamp lamp;
  Vec2 origin;       ///< lower left corner of the window [mm]
  Vec2 size;         ///< [mm]
  double level = 1;  ///< SolvedDirections::level
  Tones asked;       ///< what shall be seen
  Tones solved;      ///< what was solved for: with what plates before left out on top
};

/// The modules of a QR code, and where they lie.
struct PlacedCode {
  Image modules;            ///< as of qrModules, inside the quiet zone
  std::vector<int> texels;  ///< of LayerStack: that in the middle of each module; -1: none
};

/// Ink of a layer, before others cover it: its letters, its drawing, its band, or its box.
struct LayerInk {
  std::size_t layer = 0;   ///< its place in the project's list
  double beside = 0;       ///< share of its ink that lies beside the plate, or in its holes, 0..1
  double underRim = 0;     ///< share that the rim hides
  std::size_t texels = 0;  ///< of LayerStack, that show the rest
  bool ground = false;     ///< it lies on all that shows of the plate
  std::optional<PlacedCode> code;
};

/// The layers of a project on a raster of the page, blended with one another but not yet with what
/// lies below.
struct LayerStack {
  /// Parts of the page.
  enum class Place : std::uint8_t { Beside, UnderRim, Open };
  /// Ink of the topmost layer, by how its line meets what it stands out from.
  enum class Ink : std::uint8_t {
    None,
    Alike,
    Turned,       ///< by more than 15 degrees
    OnBelow,      ///< known once it is known what lies below all layers
    AcrossBelow,  ///< likewise, from what lies across that
  };
  /// A texel's line, e^(2i angle), is `line` + `through` times that of what lies below.
  struct Texel {
    Vec2f line;
    float through = 1;     ///< 0: nothing shines through; -1: across what lies below
    float cover = 0;       ///< share that is laid by layers, 0..1
    std::uint8_t top = 0;  ///< number of the topmost layer that covers half of it, from 1; 0: none
    Place place = Place::Beside;
    Ink ink = Ink::None;
  };
  int width = 0;  ///< 0: no layer is visible
  int height = 0;
  std::vector<Texel> texels;  ///< row 0 on top
  std::size_t open = 0;       ///< number of those that show
  /// By layer; only of visible pictures
  std::map<std::size_t, LayerPicture> pictures;
  std::vector<LayerInk> inks;       ///< one per visible layer, from the lowest
  std::vector<PlacedLayer> placed;  ///< one per layer of the project, invisible ones too
};

/// Reads the files of the layers, and rasters them in texels of a quarter of the bead spacing, at
/// most 4096 on a side. Hidden layers are not read; one with a letter that no font has is left out,
/// with its problem. \param shape  of the plate: a border lies along it, and pictures are solved
/// within it. \return the errors of reading, readSvg, decodeImage, textShape, qrModules and
/// solveDirections, with the layer's number, or Cancelled.
/// \param before  whose pictures are solved for anew, with their `solved`; none: as they are asked
/// for.
Result<LayerStack> makeLayers(const Project& project, const Shape& shape, const ReadInput& read,
                              const RunContext& run, const LayerStack* before = nullptr);

/// Looks at the pictures of a plate's layers, where they are on top, and adds what its beads leave
/// out to `solved`. \return what is seen of each, in the order of `stack.pictures`; the errors of
/// seePlate.
Result<std::vector<PictureMeasures>> askForMissing(LayerStack& stack, const Toolpath& toolpath,
                                                   Vec2 page, const Roughness& roughness,
                                                   const RunContext& run);

/// Warnings about layers that are left out, and about letters that come from other fonts or from
/// none.
std::vector<Warning> letterWarnings(const std::vector<PlacedLayer>& placed);

/// The boxes alone, for those who show handles: no picture is solved for, and a layer that cannot
/// be made keeps no other from being shown.
std::vector<PlacedLayer> placeLayers(const Project& project, const Shape& shape,
                                     const ReadInput& read);

/// Tells how much of each visible layer is seen.
/// \param placed  one per layer of the project.
/// \param below  the directions that the layers lie on.
std::vector<SeenLayer> seeLayers(const Project& project, const std::vector<PlacedLayer>& placed,
                                 const LayerStack& stack, const DirectionMap& below);

/// Lays the stack over directions and modes, in place. Without a visible layer nothing changes.
void layOver(const LayerStack& stack, PlateInput& input);

}  // namespace sillon
