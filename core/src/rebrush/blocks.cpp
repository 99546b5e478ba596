#include "rebrush/blocks.hpp"

#include <algorithm>
#include <utility>

#include "base/sort_key.hpp"
#include "rebrush/stretches.hpp"

namespace sillon {
namespace {

// Gathers surfaces from events. Cura's skins wait for the next layer, which shows which of them are tops.
class Gatherer {
 public:
  explicit Gatherer(std::string_view gcode) : gcode_(gcode) {}

  void operator()(LayerBegins) {
    endSkins();
    layerBegin_ = blocks_.size();
  }

  void operator()(LayerIroned) {
    for (std::size_t k = layerBegin_; k < blocks_.size(); ++k) leaveSurface(blocks_[k], LeftBecause::Ironed);
  }

  void operator()(BeadLaid bead) { skins_.bead(bead.from, bead.to); }

  void operator()(const Stretch& stretch) {
    StretchSurfaces made = surfacesOf(stretch, gcode_);
    if (made.ironing) {
      skins_.leave(LeftBecause::Ironed);
      (*this)(LayerIroned{});
    }
    for (auto& [block, part] : made.surfaces) {
      if (stretch.role == RoleKind::Skin && block.surface.side == SurfaceSide::Top) {
        skins_.add(std::move(block), made.field, part);
      } else {
        blocks_.push_back(std::move(block));
      }
    }
  }

  // Ends the last layers, and hands over the blocks in the order of the file.
  // \param cut  true if the file ends within a surface.
  std::vector<SurfaceBlock> finish(bool cut) {
    if (cut && !blocks_.empty()) leaveSurface(blocks_.back(), LeftBecause::Cut);
    endSkins();
    endSkins();
    sortBy(blocks_, [](const SurfaceBlock& block) { return block.surface.begin; });
    return std::move(blocks_);
  }

 private:
  void endSkins() {
    for (SurfaceBlock& top : skins_.endLayer()) blocks_.push_back(std::move(top));
  }

  std::string_view gcode_;
  Skins skins_;
  std::vector<SurfaceBlock> blocks_;
  std::size_t layerBegin_ = 0;  // index of this layer's first block
};

}  // namespace

Result<SlicedBlocks> readBlocks(std::string_view gcode, const RunContext& run) {
  SlicedBlocks out;
  out.settings = readFileSettings(gcode, {});
  Gatherer gatherer(gcode);
  Result<SlicedFacts> facts = readEvents(
      gcode, out.settings, [&](SlicedEvent event) { std::visit(gatherer, std::move(event)); }, run);
  if (!facts) return facts.error();
  out.file = std::move(facts.value().file);
  out.filamentArea = facts.value().filamentArea;
  out.blocks = gatherer.finish(facts.value().cut);
  for (SurfaceBlock& block : out.blocks) {
    const int tool = block.surface.tool;
    block.mostFlow = std::max(mostFlowOf(out.settings, tool), facts.value().mostFeed[tool] * out.filamentArea);
  }
  return out;
}

}  // namespace sillon
