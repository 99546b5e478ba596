// The region that beads cover, as a field of distances.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "rebrush/blocks.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

/// A straight bead of one width [mm].
struct RegionBead {
  Vec2 from;
  Vec2 to;
  double width = 0;
};

/// Signed distance to the edge of the region at the middle of each cell, cut off at two cells or more outside. Row 0
/// is the lowest.
struct RegionField {
  Vec2 corner;      ///< lower left corner of cell (0, 0) on the bed [mm]
  double cell = 0;  ///< side of a cell [mm]
  int columns = 0;
  int rows = 0;
  std::vector<float> distance;     ///< [mm], < 0 inside
  std::vector<std::int32_t> part;  ///< connected part of each cell, -1 outside
  int parts = 0;                   ///< number of parts

  [[nodiscard]] int at(Vec2 p) const;  ///< index of the cell at a place on the bed; -1 outside the field
};

/// Dilates each bead by half its width, and fills places that no disc of radius `notch` [mm] reaches: the notches
/// between the round ends of beads, narrower than any wall. Cells are 0.05 mm; they are larger where the field would
/// have more than 4 million of them, which is on faces of more than 100 x 100 mm. \return TooLarge for coordinates
/// that no bed has.
Result<RegionField> fieldOfBeads(const std::vector<RegionBead>& beads, double notch = 0);

/// Finds the outline of one part, which runs between cells; holes smaller than `hole` [mm²] are filled.
/// \param corner  receives the lower left corner of the region's page on the bed.
/// \return EmptyShape if the part has no cell.
Result<Shape> regionOf(const RegionField& field, int part, double hole, Vec2& corner);

/// Depth of each cell: its distance from the border of its part [cells], within 8 % of the true one; 0 outside.
std::vector<float> depths(const RegionField& field);

/// Diameter of the largest disc in each part [mm]. \param depth  result of depths.
std::vector<double> breadths(const RegionField& field, const std::vector<float>& depth);

// Cura marks tops and inner skins alike. The plastic below and above a skin shows which of them are tops.

/// Sorts the skins of a print, layer by layer.
class Skins {
 public:
  /// Notes a bead of the layer that is being read.
  void bead(Vec2 from, Vec2 to);

  /// Adds a skin of that layer, which is a part of a stretch's region. The skins of a stretch must follow each other.
  void add(SurfaceBlock block, const std::shared_ptr<const RegionField>& field, int part);

  /// Leaves every skin of that layer that was added so far, for this reason.
  void leave(LeftBecause why);

  /// Ends the layer, as another one begins or the file ends. \return the skins of the layer below it that may be tops:
  /// nothing, or not much, lies on them.
  std::vector<SurfaceBlock> endLayer();

 private:
  struct Skin {
    SurfaceBlock block;
    int part = 0;
  };
  // Skins that share a region.
  struct SharedRegion {
    std::shared_ptr<const RegionField> field;
    double width = 0;             // width of its beads [mm]
    std::vector<double> carried;  // share of each part that lies on plastic of the layer below
    std::vector<bool> covered;    // cells that lie below plastic of the next layer
    std::vector<Skin> skins;
  };
  using BeadEnds = std::pair<Vec2, Vec2>;

  std::vector<BeadEnds> beads_;        // beads of this layer
  std::vector<BeadEnds> below_;        // beads of the layer below
  std::vector<SharedRegion> shared_;   // skins of this layer
  std::vector<SharedRegion> waiting_;  // skins of the layer below
};

}  // namespace sillon
