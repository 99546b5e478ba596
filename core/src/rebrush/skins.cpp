#include "rebrush/region.hpp"

#include <algorithm>
#include <cstddef>

namespace sillon {
namespace {

constexpr double kExpanded = 2;         // [mm] length by which skins reach under the next layer's walls
constexpr double kInside = 0.8;         // covered share above which a skin is no top at all
constexpr double kMostExpanded = 0.35;  // largest share of a top that lies under the next layer's walls
constexpr double kCovered = 0.02;       // covered share up to which a skin counts as free
constexpr double kCarried = 0.08;       // least share of a skin on plastic: with less, it bridges air

// Marks the cells of a region that lie over or under a bead of this width.
void mark(std::vector<bool>& cells, const RegionField& field, double width, Vec2 from, Vec2 to) {
  const int steps = std::clamp(static_cast<int>(length(to - from) / field.cell) + 1, 1, 100000);
  const int reach = static_cast<int>(width / 2 / field.cell);
  for (int k = 0; k <= steps; ++k) {
    const int cell = field.at(from + (static_cast<double>(k) / steps) * (to - from));
    if (cell < 0) continue;
    const int x = cell % field.columns;
    const int y = cell / field.columns;
    for (int v = std::max(0, y - reach); v <= std::min(field.rows - 1, y + reach); ++v) {
      for (int u = std::max(0, x - reach); u <= std::min(field.columns - 1, x + reach); ++u) {
        cells[indexOf(u, v, field.columns)] = true;
      }
    }
  }
}

// Counts the cells of a part, and those among them that are marked.
struct CellCount {
  std::int64_t all = 0;
  std::int64_t marked = 0;

  void add(bool mark) {
    ++all;
    marked += mark ? 1 : 0;
  }
  [[nodiscard]] double share() const { return all > 0 ? static_cast<double>(marked) / static_cast<double>(all) : 1.0; }
};

void leaveBecause(SurfaceBlock& block, LeftBecause why) {
  if (block.surface.left == LeftBecause::None) block.surface.left = why;
}

}  // namespace

void Skins::bead(Vec2 from, Vec2 to) {
  beads_.emplace_back(from, to);
  for (SharedRegion& shared : waiting_) mark(shared.covered, *shared.field, shared.width, from, to);
}

void Skins::add(SurfaceBlock block, const std::shared_ptr<const RegionField>& field, int part) {
  if (shared_.empty() || shared_.back().field != field) {
    SharedRegion& shared = shared_.emplace_back();
    shared.field = field;
    shared.width = block.surface.width;
    shared.covered.resize(field->part.size());
    std::vector<bool> carried(field->part.size());
    for (const auto& [from, to] : below_) mark(carried, *field, shared.width, from, to);
    std::vector<CellCount> cells(field->parts);
    for (std::size_t k = 0; k < carried.size(); ++k) {
      if (field->part[k] >= 0) cells[field->part[k]].add(carried[k]);
    }
    for (const CellCount& of : cells) shared.carried.push_back(of.share());
  }
  SharedRegion& shared = shared_.back();
  if (shared.carried[part] < kCarried) leaveBecause(block, LeftBecause::Bridge);
  shared.skins.push_back({std::move(block), part});
}

void Skins::leave(LeftBecause why) {
  for (SharedRegion& shared : shared_) {
    for (Skin& skin : shared.skins) leaveBecause(skin.block, why);
  }
}

std::vector<SurfaceBlock> Skins::endLayer() {
  std::vector<SurfaceBlock> tops;
  for (SharedRegion& shared : waiting_) {
    // A top may reach a little under the walls of the next layer. Infill above a skin would cover all of it.
    const RegionField& field = *shared.field;
    const std::vector<float> depth = depths(field);
    std::vector<CellCount> all(field.parts);
    std::vector<CellCount> deep(all.size());
    for (std::size_t k = 0; k < shared.covered.size(); ++k) {
      if (field.part[k] < 0) continue;
      const std::size_t part = field.part[k];
      all[part].add(shared.covered[k]);
      if (static_cast<double>(depth[k]) * field.cell > kExpanded) deep[part].add(shared.covered[k]);
    }
    for (Skin& skin : shared.skins) {
      const std::size_t part = skin.part;
      const double covered = all[part].share();
      if (covered > kInside) continue;
      const bool rim = deep[part].share() <= kCovered && covered <= kMostExpanded;
      if (covered > kCovered && !rim) leaveBecause(skin.block, LeftBecause::Covered);
      tops.push_back(std::move(skin.block));
    }
  }
  waiting_ = std::move(shared_);
  shared_.clear();
  below_ = std::move(beads_);
  beads_.clear();
  return tops;
}

}  // namespace sillon
