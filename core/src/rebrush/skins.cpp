#include "rebrush/skins.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace sillon {
namespace {

constexpr double kExpanded = 2;         // [mm] by which skins reach under the next layer's walls
constexpr double kInside = 0.8;         // of a skin that is no top at all
constexpr double kMostExpanded = 0.35;  // of a skin that may lie there
constexpr double kCovered = 0.02;       // of a skin: less below the next layer is none
constexpr double kCarried = 0.08;       // of a skin: less plastic below it, and it bridges air

// The cells of a region that a bead of this width lies over or under.
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
        cells[static_cast<std::size_t>(v) * static_cast<std::size_t>(field.columns) + static_cast<std::size_t>(u)] =
            true;
      }
    }
  }
}

double share(std::int64_t some, std::int64_t whole) {
  return whole > 0 ? static_cast<double>(some) / static_cast<double>(whole) : 1.0;
}

void leaveBecause(SurfaceBlock& block, LeftBecause why) {
  if (block.surface.left == LeftBecause::None) block.surface.left = why;
}

}  // namespace

void Skins::bead(Vec2 from, Vec2 to) {
  beads_.emplace_back(from, to);
  for (Skin& skin : waiting_) mark(skin.covered, *skin.field, skin.block.surface.width, from, to);
}

void Skins::add(SurfaceBlock block, std::shared_ptr<const RegionField> field, int part) {
  std::vector<bool> carried(field->distance.size(), false);
  for (const auto& [from, to] : below_) mark(carried, *field, block.surface.width, from, to);
  std::int64_t all = 0;
  std::int64_t some = 0;
  for (std::size_t k = 0; k < carried.size(); ++k) {
    if (field->part[k] != part) continue;
    ++all;
    some += carried[k] ? 1 : 0;
  }
  if (share(some, all) < kCarried) leaveBecause(block, LeftBecause::Bridge);
  std::vector<bool> covered(field->distance.size(), false);
  skins_.push_back({std::move(block), std::move(field), part, std::move(covered)});
}

void Skins::leave(LeftBecause why) {
  for (Skin& skin : skins_) leaveBecause(skin.block, why);
}

std::vector<SurfaceBlock> Skins::endLayer() {
  std::vector<SurfaceBlock> tops;
  for (Skin& skin : waiting_) {
    // Skins reach a little under the walls of the next layer. Infill above would cover them all over.
    const std::vector<float> depth = depths(*skin.field);
    std::int64_t all = 0;
    std::int64_t covered = 0;
    std::int64_t deep = 0;
    std::int64_t deepCovered = 0;
    for (std::size_t k = 0; k < skin.covered.size(); ++k) {
      if (skin.field->part[k] != skin.part) continue;
      const bool inner = static_cast<double>(depth[k]) * skin.field->cell > kExpanded;
      ++all;
      deep += inner ? 1 : 0;
      covered += skin.covered[k] ? 1 : 0;
      deepCovered += inner && skin.covered[k] ? 1 : 0;
    }
    if (share(covered, all) > kInside) continue;
    const bool rim = share(deepCovered, deep) <= kCovered && share(covered, all) <= kMostExpanded;
    if (share(covered, all) > kCovered && !rim) leaveBecause(skin.block, LeftBecause::Covered);
    tops.push_back(std::move(skin.block));
  }
  waiting_ = std::move(skins_);
  skins_.clear();
  below_ = std::move(beads_);
  beads_.clear();
  return tops;
}

}  // namespace sillon
