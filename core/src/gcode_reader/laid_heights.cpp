#include "gcode_reader/layers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sillon {
namespace {

constexpr int kTile = 64;         // [cells], side of a tile
constexpr int kTiles = 160;       // [tiles], side of the plane, from -5120 to 5120 mm
constexpr double kStep = 0.7;     // [mm] between places on a move; less than a cell, so that few are skipped
constexpr int kMostSteps = 4096;  // places on a move, at most, which bounds the work

// Address of a cell; not known beyond the tiles.
struct TileCell {
  std::size_t tile = 0;
  std::size_t index = 0;
  bool known = false;
};

// The cell of 1 mm that a place lies in.
TileCell cellAt(Vec2 p) {
  constexpr double kReach = kTile * kTiles / 2.0;
  if (!(std::abs(p.x) < kReach && std::abs(p.y) < kReach)) return {};
  const std::size_t x = toSize(p.x + kReach);
  const std::size_t y = toSize(p.y + kReach);
  return {y / kTile * kTiles + x / kTile, y % kTile * kTile + x % kTile, true};
}

// Steps along a move. \param take  called with each place on the way and the height there.
template <class Take>
void follow(const MachineMove& move, Take&& take) {
  const int steps = std::clamp(static_cast<int>(std::ceil(move.length / kStep)), 1, kMostSteps);
  for (int k = 0; k <= steps; ++k) {
    const double share = static_cast<double>(k) / steps;
    const Vec2 p = move.arc && move.readable ? onArc(move, share) : move.from + share * (move.to - move.from);
    take(p, move.zFrom + share * (move.z - move.zFrom));
  }
}

}  // namespace

void LaidHeights::add(const MachineMove& bead) {
  if (tiles_.empty()) tiles_.resize(std::size_t{kTiles} * kTiles);
  follow(bead, [&](Vec2 p, double z) {
    const TileCell cell = cellAt(p);
    if (!cell.known) return;
    std::vector<float>& tile = tiles_[cell.tile];
    if (tile.empty()) tile.resize(std::size_t{kTile} * kTile);
    tile[cell.index] = std::max(tile[cell.index], static_cast<float>(z));
  });
  top_ = std::max({top_, bead.zFrom, bead.z});
}

double LaidHeights::depthOf(const MachineMove& move) const {
  if (std::min(move.zFrom, move.z) >= top_) return 0;
  double depth = 0;
  follow(move, [&](Vec2 p, double z) {
    const TileCell cell = cellAt(p);
    if (!cell.known) return;
    const std::vector<float>& tile = tiles_[cell.tile];
    if (tile.empty() || tile[cell.index] == 0) return;
    depth = std::max(depth, static_cast<double>(tile[cell.index]) - z);
  });
  return depth;
}

double LaidHeights::touched(const MachineMove& move, double gap) const {
  if (std::min(move.zFrom, move.z) >= top_ + gap) return 0;
  int places = 0;
  int touching = 0;
  follow(move, [&](Vec2 p, double z) {
    const TileCell cell = cellAt(p);
    ++places;
    if (!cell.known) return;
    const std::vector<float>& tile = tiles_[cell.tile];
    if (!tile.empty() && tile[cell.index] > 0 && static_cast<double>(tile[cell.index]) > z - gap) ++touching;
  });
  return move.length * touching / places;
}

}  // namespace sillon
