// A sliced file as events in its order, and the surfaces of the stretches that lay some.
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

/// A line within a stretch.
struct StretchLine {
  std::size_t begin = 0;  ///< [bytes]
  std::size_t end = 0;
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
  bool onBed = false;  ///< its layer lies on the bed; of objects printed one by one, each has such a layer
  bool byCura = false;
  std::optional<double> height;  ///< of the layer, as a mark tells it [mm]
  double previousZ = 0;          ///< of the layer below
  double travelSpeed = 0;        ///< of the last travel [mm/s]
  double filamentArea = 0;       ///< [mm²]
  bool volumetric = false;       ///< E counts mm³
  std::vector<StretchLine> lines;

  /// \return height of the layer whose beads lie at z [mm].
  [[nodiscard]] double heightAt(double z) const;
  /// \return section of a bead [mm²].
  [[nodiscard]] double sectionOf(const MachineMove& bead) const {
    return bead.e * (volumetric ? 1 : filamentArea) / bead.length;
  }
};

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
  std::map<int, double> mostFeed;  ///< of each tool's beads [mm of filament / s]
  double filamentArea = 0;         ///< [mm²]
  bool cut = false;                ///< the file ends within a surface
};

/// Reads a file and hands over its events one by one; stretches only of roles that may be surfaces.
/// \return InvalidFile for files whose surfaces cannot be found or replaced, or Cancelled.
Result<SlicedFacts> readEvents(std::string_view gcode, const FileSettings& settings,
                               const std::function<void(SlicedEvent)>& visit, const RunContext& run);

/// Surfaces of one stretch.
struct StretchSurfaces {
  struct Surface {
    SurfaceBlock block;
    int part = 0;  ///< of the field
  };
  std::shared_ptr<const RegionField> field;  ///< none: there are no surfaces
  std::vector<Surface> surfaces;             ///< in the order in which they are begun
  bool ironing = false;                      ///< beads so thin that they iron what lies below (Cura)
};

/// Splits a stretch into connected surfaces.
/// \param gcode  the whole file, to look ahead in.
StretchSurfaces surfacesOf(const Stretch& stretch, std::string_view gcode);

/// The surface will not be replaced, for this reason if there is none yet.
void leaveSurface(SurfaceBlock& block, LeftBecause why);

/// Places in SurfaceBlock::kept of what was kept so far, by kind.
using KeptPlaces = std::map<std::string, std::size_t>;

/// Notes a line within a surface that moves nothing: it must be repeated behind the new beads, where nothing that
/// follows takes its place, or it forbids to replace the surface.
void keepCommand(std::string_view line, KeptPlaces& places, SurfaceBlock& block);

/// Notes wipes and the first travel behind a surface: what they need of where it ended.
void lookAhead(std::string_view gcode, bool byCura, SurfaceBlock& block);

}  // namespace sillon
