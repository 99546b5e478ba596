// Cura marks tops and inner skins alike. What lies under a skin and what lies on it tell which of them are tops.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "rebrush/blocks.hpp"
#include "rebrush/region.hpp"

namespace sillon {

/// The skins of a print, layer by layer.
class Skins {
 public:
  /// Plastic of the layer that is being read.
  void bead(Vec2 from, Vec2 to);

  /// A skin of that layer: a part of a region.
  void add(SurfaceBlock block, std::shared_ptr<const RegionField> field, int part);

  /// For the reason, every skin of that layer that was added so far is left.
  void leave(LeftBecause why);

  /// Another layer begins, or the file ends. \return the skins of the layer below that one which may be tops: nothing,
  /// or not much, lies on them
  std::vector<SurfaceBlock> endLayer();

 private:
  struct Skin {
    SurfaceBlock block;
    std::shared_ptr<const RegionField> field;  // of its stretch
    int part = 0;
    std::vector<bool> covered;  // by the next layer, for each cell
  };
  using Bead = std::pair<Vec2, Vec2>;

  std::vector<Bead> beads_;  // of this layer
  std::vector<Bead> below_;
  std::vector<Skin> skins_;    // of this layer
  std::vector<Skin> waiting_;  // of the layer below
};

}  // namespace sillon
