// The region that beads cover, as a picture of distances.
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

/// Signed distance to the edge of the region at the middle of each cell, cut off two cells or more from it; row 0
/// below.
struct RegionField {
  Vec2 corner;      ///< lower left of cell (0, 0) on the bed
  double cell = 0;  ///< [mm]
  int columns = 0;
  int rows = 0;
  std::vector<float> distance;     ///< [mm], < 0 inside
  std::vector<std::int32_t> part;  ///< connected part of each cell, -1 outside
  int parts = 0;

  [[nodiscard]] int at(Vec2 p) const;  ///< index of the cell of a place; -1 beside the field
};

/// Dilates each bead by half its width, and fills what no disc of radius `notch` [mm] gets into: the notches between
/// the round ends of beads, narrower than any wall. Cells are 0.05 mm, larger where the field would have more than 4
/// million: on faces of more than 100 x 100 mm. \return TooLarge for coordinates that no bed has.
Result<RegionField> fieldOfBeads(const std::vector<RegionBead>& beads, double notch = 0);

/// The outline of one part, between cells; holes smaller than `hole` [mm²] are filled.
/// \param corner  receives the lower left corner of the region's page on the bed.
/// \return EmptyShape if nothing of it is inside.
Result<Shape> regionOf(const RegionField& field, int part, double hole, Vec2& corner);

/// How deep each cell lies in its part, in cells from its border; 0 outside. Within 8 % of the true distance.
std::vector<float> depths(const RegionField& field);

/// The widest disc in each part, its diameter [mm]. \param depth  as depths gives it.
std::vector<double> breadths(const RegionField& field, const std::vector<float>& depth);

// Cura marks tops and inner skins alike. What lies under a skin and what lies on it tell which of them are tops.

/// The skins of a print, layer by layer.
class Skins {
 public:
  /// Plastic of the layer that is being read.
  void bead(Vec2 from, Vec2 to);

  /// A skin of that layer: a part of a stretch's region, whose skins come one after the other.
  void add(SurfaceBlock block, const std::shared_ptr<const RegionField>& field, int part);

  /// For the reason, every skin of that layer that was added so far is left.
  void leave(LeftBecause why);

  /// Another layer begins, or the file ends. \return the skins of the layer below that one which may be tops: nothing,
  /// or not much, lies on them
  std::vector<SurfaceBlock> endLayer();

 private:
  struct Skin {
    SurfaceBlock block;
    int part = 0;
  };
  struct Stretch {
    std::shared_ptr<const RegionField> field;
    double width = 0;             // of its beads
    std::vector<double> carried;  // share of each part that lies on plastic of the layer below
    std::vector<bool> covered;    // cells below plastic of the next layer
    std::vector<Skin> skins;
  };
  using Bead = std::pair<Vec2, Vec2>;

  std::vector<Bead> beads_;  // of this layer
  std::vector<Bead> below_;
  std::vector<Stretch> stretches_;  // of this layer
  std::vector<Stretch> waiting_;    // of the layer below
};

}  // namespace sillon
