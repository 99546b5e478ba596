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
