// A sliced file as a sequence of events, and the surfaces that its stretches lay.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "gcode_reader/file_settings.hpp"
#include "gcode_reader/machine.hpp"
#include "rebrush/blocks.hpp"
#include "rebrush/region.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"

namespace sillon {

/// A line within a stretch, with the machine's state before and after it.
struct StretchLine {
  std::size_t begin = 0;  ///< [bytes]
  std::size_t end = 0;    ///< [bytes]
  std::int64_t number = 0;
  std::optional<MachineMove> move;
  MachineState before;
  MachineState after;
  std::string object;
  double acceleration = 0;

  [[nodiscard]] bool bead() const { return move && move->e > 0 && move->length > 0; }
};

/// Lines of one role in one layer, up to the last bead, with what the file says around them.
struct Stretch {
  RoleKind role = RoleKind::Other;
  int layer = 0;
  bool onBed = false;  ///< true if its layer lies on the bed; with objects printed one by one, each has such a layer
  bool byCura = false;
  std::optional<double> height;  ///< height of the layer, if a mark gives it [mm]
  double previousZ = 0;          ///< Z of the layer below [mm]
  double travelSpeed = 0;        ///< speed of the last travel [mm/s]
  double filamentArea = 0;       ///< section of the filament [mm²]
  bool volumetric = false;       ///< true if E counts mm³
  std::vector<StretchLine> lines;

  /// Height of the layer whose beads lie at z [mm]: the marked one, or the distance from the layer below.
  [[nodiscard]] double heightAt(double z) const;
  /// Section of a bead [mm²].
  [[nodiscard]] double sectionOf(const MachineMove& bead) const {
    return bead.e * (volumetric ? 1 : filamentArea) / bead.length;
  }
};

/// Another layer begins.
struct LayerBegins {};
/// The slicer irons what this layer has laid so far.
struct LayerIroned {};
/// A bead of any role, in files of Cura.
struct BeadLaid {
  Vec2 from;
  Vec2 to;
};
using SlicedEvent = std::variant<LayerBegins, LayerIroned, BeadLaid, Stretch>;

/// Facts of the whole file.
struct SlicedFacts {
  SlicedFile file;                 ///< without its surfaces
  std::map<int, double> mostFeed;  ///< largest feed of each tool's beads [mm of filament / s]
  double filamentArea = 0;         ///< section of the filament [mm²]
  bool cut = false;                ///< true if the file ends within a surface
};

/// Reads a file and hands over its events one by one. Only roles that may be surfaces make stretches.
/// \return InvalidFile for files whose surfaces cannot be found or replaced, or Cancelled.
Result<SlicedFacts> readEvents(std::string_view gcode, const FileSettings& settings,
                               const std::function<void(SlicedEvent)>& visit, const RunContext& run);

/// Surfaces of one stretch.
struct StretchSurfaces {
  struct Surface {
    SurfaceBlock block;
    int part = 0;  ///< number of its part in the field
  };
  std::shared_ptr<const RegionField> field;  ///< region of all surfaces; none if there are no surfaces
  std::vector<Surface> surfaces;             ///< surfaces in the order in which they are begun
  bool ironing = false;                      ///< true if the beads are so thin that they iron the layer (Cura)
};

/// Splits a stretch into connected surfaces.
/// \param gcode  the whole file: the lines behind each surface are read, too.
StretchSurfaces surfacesOf(const Stretch& stretch, std::string_view gcode);

/// Marks a surface as left. The first reason that is given stays.
void leaveSurface(SurfaceBlock& block, LeftBecause why);

/// Indices into SurfaceBlock::kept of the last line of each kind.
using KeptPlaces = std::map<std::string, std::size_t>;

/// Notes a line within a surface that moves nothing. Settings are repeated behind the new beads, the last one of each
/// kind; for a line that can be neither repeated nor dropped, the surface is left.
void keepCommand(std::string_view line, KeptPlaces& places, SurfaceBlock& block);

/// Notes the wipes and the first travel behind a surface. The surface is left if what follows needs the nozzle where
/// the slicer's last bead ended.
void lookAhead(std::string_view gcode, bool byCura, SurfaceBlock& block);

}  // namespace sillon
