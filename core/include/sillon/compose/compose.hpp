// The way from the layers of a surface to the directions of its beads.
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
#include "sillon/look/inversion.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/report/warning.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// The box of a layer on the page, before it turns.
struct PlacedLayer {
  Vec2 at;    ///< its middle [mm]
  Vec2 size;  ///< [mm]
  /// Share of its letters or its drawing that is narrower than two beads, 0..1
  double thin = 0;
  /// Reason why its content cannot be made; the box is then what it asks for
  std::optional<Error> problem;
  /// Facts read from its letters or drawing, and from its mask
  std::vector<DrawingFacts> drawings = {};
  /// Letters of its text that the font lacks, as in ShapedLine
  std::vector<LackedLetter> lacked = {};
};

/// Pictures of one layer, solved for in a window of the page. All lists have one entry per picture.
struct LayerPictures {
  Vec2 origin;                      ///< lower left corner of the window [mm]
  Vec2 size;                        ///< [mm]
  double level = 1;                 ///< SolvedDirections::level
  std::vector<ShownPicture> shown;  ///< pictures that shall be seen
  /// Tones that were solved for: `shown` plus what earlier plates left out
  std::vector<Tones> solved;
  DirectionMap directions;  ///< directions over the window
};

/// The modules of a QR code, and their places.
struct PlacedCode {
  Image modules;  ///< modules as qrModules makes them, inside the quiet zone
  /// LayerStack texel in the middle of each module; -1: it lies off the page
  std::vector<int> texels;
};

/// The ink of a layer before others cover it: its letters, its drawing, its band, or its box.
struct LayerInk {
  std::size_t layer = 0;   ///< its index in the project's list
  double beside = 0;       ///< share of its ink that lies beside the plate, or in its holes, 0..1
  double underRim = 0;     ///< share of its ink that the rim hides
  std::size_t texels = 0;  ///< number of LayerStack texels that show the rest
  bool ground = false;     ///< the layer covers all that shows of the plate
  std::optional<PlacedCode> code;
};

/// The layers of a project on a raster of the page, blended with one another but not yet with what
/// lies below.
struct LayerStack {
  /// Parts of the page.
  enum class Place : std::uint8_t { Beside, UnderRim, Open };
  /// Ink of the topmost layer: its line compared with the line that it has to stand out from.
  enum class Ink : std::uint8_t {
    None,
    Alike,        ///< within 15 degrees of that line
    Turned,       ///< more than 15 degrees away from it
    OnBelow,      ///< known once the directions below all layers are known
    AcrossBelow,  ///< likewise, compared with the line across those directions
  };
  /// A texel's line, e^(2i angle), is `line` + `through` times the line of what lies below.
  struct Texel {
    Vec2f line;
    /// Weight of what lies below; 0: it does not show; -1: this line lies across it
    float through = 1;
    float cover = 0;       ///< share that layers cover, 0..1
    std::uint8_t top = 0;  ///< number of the topmost layer that covers half of it, from 1; 0: none
    Place place = Place::Beside;
    Ink ink = Ink::None;
    /// Mode of the topmost layer; none: the mode of what lies below
    std::optional<DirectionMode> mode = {};
  };
  int width = 0;  ///< texels in a row; 0: no layer is visible
  int height = 0;
  std::vector<Texel> texels;  ///< row 0 on top
  std::size_t open = 0;       ///< number of texels that show
  /// Pictures by layer, for visible layers only
  std::map<std::size_t, LayerPictures> pictures;
  std::vector<LayerInk> inks;       ///< one per visible layer above the ground, but for strokes
  std::vector<PlacedLayer> placed;  ///< one per layer of the project, invisible ones too
};

/// A surface with all that its layers say, and the pictures that were solved for.
struct Composition {
  PlateInput ground;  ///< the shape, and the lowest layer's directions where it fills the shape
  PlatePictures pictures;  ///< pictures of the lowest layer
  LayerStack layers;       ///< layers above the lowest

  /// Returns the layers laid over the ground.
  [[nodiscard]] PlateInput laid() const;
  /// Tells whether any picture is shown under a lamp.
  [[nodiscard]] bool showsPictures() const {
    return !pictures.shown.empty() || !layers.pictures.empty();
  }
};

/// Inputs of a composition besides its project.
struct ComposeOptions {
  const ReadInput& read;
  /// Result of the plate before, as solvePictures takes it
  std::optional<KeptPictures>* kept = nullptr;
  OnTrial onTrial = {};
};

/// Reads the files of the layers and solves for their pictures. Layers above the ground are drawn
/// in texels of a quarter of the bead spacing, at most 4096 on a side. Hidden layers are not read;
/// one with a letter that no font has is left out, and PlacedLayer::problem tells it.
/// \param ground  result of readPlateInput, or the input of another surface.
/// \return the errors of reading, readSvg, decodeImage, textShape, qrModules and solveDirections,
/// with the layer's number, or Cancelled.
Result<Composition> compose(const Project& project, PlateInput ground,
                            const ComposeOptions& options, const RunContext& run);

/// One picture of a surface as it was judged, where its layer is on top.
struct JudgedPicture {
  std::size_t layer = 1;  ///< number of its layer, from 1
  std::string file;
  Lamp lamp;
  PictureMeasures measures;
};

/// Tells how well a path shows each picture of a composition.
/// \return the errors of seePlate.
Result<std::vector<JudgedPicture>> judgePictures(const Composition& composition,
                                                 const Toolpath& toolpath, const RunContext& run);

/// Returns the number of paths that makeShown makes: one, and one more per correction of pictures.
int pathsFor(const Project& project);

/// Makes a path from an input.
using MakeToolpath = std::function<Result<ToolpathResult>(const PlateInput& input)>;

/// Makes the path of a composition, and corrects its pictures. The path is looked at from above;
/// the light that its beads, above all their ends, take from the pictures' tones is asked for in
/// addition, and the path is made again, `corrections` times. The path with the highest sum of r is
/// returned, and the composition gets its directions. Pictures with local contrast are made once.
/// \return the errors of `make`, seePlate, solveDirections and compose.
Result<ToolpathResult> makeShown(const Project& project, Composition& composition,
                                 const ReadInput& read, const MakeToolpath& make,
                                 const RunContext& run);

/// Places the boxes of the layers alone, for editors that show handles. No picture is solved for,
/// and a layer that cannot be made does not keep the others from being shown.
std::vector<PlacedLayer> placeLayers(const Project& project, const Shape& shape,
                                     const ReadInput& read);

}  // namespace sillon
