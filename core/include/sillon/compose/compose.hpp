// From the list of layers of a surface to the directions of its beads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/input/read_input.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/report/input_note.hpp"
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

/// Pictures of one layer, as they are solved for in a window of the page. All lists have one entry
/// per picture.
struct LayerPictures {
  Vec2 origin;                      ///< lower left corner of the window [mm]
  Vec2 size;                        ///< [mm]
  double level = 1;                 ///< SolvedDirections::level
  std::vector<ShownPicture> shown;  ///< what shall be seen
  std::vector<Tones> solved;  ///< what was solved for: with what plates before left out on top
  DirectionMap directions;    ///< over the window
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
    std::optional<DirectionMode> mode = {};  ///< of the topmost layer; none: of what lies below
  };
  int width = 0;  ///< 0: no layer is visible
  int height = 0;
  std::vector<Texel> texels;  ///< row 0 on top
  std::size_t open = 0;       ///< number of those that show
  /// By layer; only of visible pictures
  std::map<std::size_t, LayerPictures> pictures;
  std::vector<LayerInk> inks;       ///< one per visible layer above the ground that is no strokes
  std::vector<PlacedLayer> placed;  ///< one per layer of the project, invisible ones too
};

/// A surface with all that its layers say, and what was solved for.
struct Composition {
  PlateInput ground;       ///< the shape, and what the lowest layer says where it fills it
  PlatePictures pictures;  ///< of the lowest layer
  LayerStack layers;       ///< those above it

  /// The layers laid over the ground.
  [[nodiscard]] PlateInput laid() const;
  /// Tells whether any picture is shown under a lamp.
  [[nodiscard]] bool showsPictures() const {
    return !pictures.shown.empty() || !layers.pictures.empty();
  }
};

/// Inputs of a composition besides its project.
struct ComposeOptions {
  const ReadInput& read;
  std::optional<KeptPictures>* kept = nullptr;  ///< as of solvePictures
  OnTrial onTrial = {};
};

/// Reads the files of the layers and solves for their pictures. Layers above the ground are drawn
/// in texels of a quarter of the bead spacing, at most 4096 on a side. Hidden layers are not read;
/// one with a letter that no font has is left out, with its problem. \param ground
/// readPlateInput's, or that of another surface. \return the errors of reading, readSvg,
/// decodeImage, textShape, qrModules and solveDirections, with the layer's number, or Cancelled.
Result<Composition> compose(const Project& project, PlateInput ground,
                            const ComposeOptions& options, const RunContext& run);

/// One picture of a surface as it was judged, where its layer is on top.
struct JudgedPicture {
  std::size_t layer = 1;  ///< number, from 1
  std::string file;
  Lamp lamp;
  PictureMeasures measures;
};

/// Tells how well a path shows each picture of a composition.
/// \return the errors of seePlate.
Result<std::vector<JudgedPicture>> judgePictures(const Composition& composition,
                                                 const Toolpath& toolpath, const RunContext& run);

/// Number of paths that makeShown makes: one, and one more per correction of pictures.
int pathsFor(const Project& project);

/// Makes a path of an input.
using MakeToolpath = std::function<Result<ToolpathResult>(const PlateInput& input)>;

/// Makes the path of a composition. It is then looked at: what its beads, above all their ends,
/// take from the pictures' tones is asked for on top of them, and the path is made again,
/// `corrections` times. The path with the highest sum of r is returned, and the composition has its
/// directions. Pictures with local contrast are made once. \return what make, seePlate,
/// solveDirections and compose return.
Result<ToolpathResult> makeShown(const Project& project, Composition& composition,
                                 const ReadInput& read, const MakeToolpath& make,
                                 const RunContext& run);

/// The boxes alone, for those who show handles: no picture is solved for, and a layer that cannot
/// be made keeps no other from being shown.
std::vector<PlacedLayer> placeLayers(const Project& project, const Shape& shape,
                                     const ReadInput& read);

/// Tells how much of each visible layer above the ground is seen.
/// \param placed  one per layer of the project.
std::vector<SeenLayer> seeLayers(const Project& project, const std::vector<PlacedLayer>& placed,
                                 const Composition& composition);

/// Notes and warnings about the layers of a composition.
struct LayersTold {
  std::vector<InputNote> notes;
  std::vector<Warning> warnings;
};
LayersTold toldOf(const std::vector<PlacedLayer>& placed, const std::vector<SeenLayer>& seen,
                  Vec2 page, double spacing);

}  // namespace sillon
