#include "geometry/outline.hpp"
#include "input/svg/svg_path.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sillon::svg {
namespace {

constexpr double kOverlap = 1e-3;             // overlap beyond a straight edge below which no cut is made [mm]
constexpr std::int64_t kWorkPerCut = 400;     // work of a point that is combined with other paths, in bytes read
constexpr std::int64_t kWorkPerStraight = 2;  // work of a point that is cut along straight lines, in bytes read
constexpr int kMaxCrossings = 256;            // crossings of a path with cut lines; with more, pieces may overlap often

// Returns the part of a ring beyond an axis-parallel line. The part is closed along the line, so that winding numbers
// beyond it stay the same.
Ring beyond(const Ring& ring, double Vec2::*axis, double line, double side, int& crossings) {
  Ring kept;
  Vec2 a = ring.empty() ? Vec2{} : ring.back();
  for (const Vec2 b : ring) {
    const double from = side * (a.*axis - line), to = side * (b.*axis - line);
    if ((from > 0) != (to > 0)) {
      kept.push_back(onGrid(a + from / (from - to) * (b - a)));
      kept.back().*axis = line;
      ++crossings;
    }
    if (to > 0) kept.push_back(b);
    a = b;
  }
  return kept;
}

// Returns the part of a path inside a box, or nothing if the path enters and leaves the box too often.
std::optional<FilledPath> cutTo(const Bounds& box, const FilledPath& path) {
  FilledPath kept{{}, path.fillRule};
  int crossings = 0;
  for (Ring ring : path.rings) {
    ring = beyond(ring, &Vec2::x, box.min.x, 1, crossings);
    ring = beyond(ring, &Vec2::x, box.max.x, -1, crossings);
    ring = beyond(ring, &Vec2::y, box.min.y, 1, crossings);
    ring = beyond(ring, &Vec2::y, box.max.y, -1, crossings);
    if (crossings > kMaxCrossings) return std::nullopt;
    if (!ring.empty()) kept.rings.push_back(std::move(ring));
  }
  return kept;
}

}  // namespace

Bounds boxOf(const std::vector<Ring>& rings) {
  Bounds box;
  for (const Ring& ring : rings) {
    for (const Vec2 p : ring) box.add(p);
  }
  return box;
}

bool covers(const Limit& limit, const Bounds& box) {
  return limit.isBox && box.min.x >= limit.box.min.x - kOverlap && box.min.y >= limit.box.min.y - kOverlap &&
         box.max.x <= limit.box.max.x + kOverlap && box.max.y <= limit.box.max.y + kOverlap;
}

FilledPath combine(const std::vector<FilledPath>& paths, const InsideRule& rule, Work& work) {
  for (const FilledPath& path : paths) work.spendOnCuts(path, kWorkPerCut);
  Result<FilledPath> area = combined(paths, rule);
  if (!area) throw Refused{area.error()};
  return std::move(area).value();
}

FilledPath within(FilledPath path, const std::vector<const Limit*>& limits, Work& work) {
  std::vector<FilledPath> paths(1);
  for (const Limit* limit : limits) {
    const Bounds box = boxOf(path.rings);
    if (covers(*limit, box)) continue;
    work.spendOnCuts(limit->isBox ? path : limit->area, kWorkPerStraight);
    // Only the part of a limit near the path matters: most paths do not touch its border.
    const Vec2 rim{kOverlap, kOverlap};
    std::optional<FilledPath> cut =
        limit->isBox ? cutTo(limit->box, path) : cutTo({box.min - rim, box.max + rim}, limit->area);
    if (cut && cut->rings.empty()) return {};
    if (cut && limit->isBox) {
      path = *std::move(cut);
    } else if (!cut || !covers(*limitOf(*cut), box)) {
      paths.push_back(cut ? *std::move(cut) : limit->area);
    }
  }
  if (paths.size() == 1) return path;
  paths[0] = std::move(path);
  return combine(
      paths, [](const std::vector<char>& filled) { return std::find(filled.begin(), filled.end(), 0) == filled.end(); },
      work);
}

std::vector<FilledPath> beyondBox(const FilledPath& path, const Limit& limit, Work& work) {
  const auto [low, high] = limit.box;
  const Vec2 rim{1, 1};
  const Bounds all = boxOf(path.rings);
  const Vec2 least = all.min - rim, most = all.max + rim;
  std::vector<FilledPath> pieces;
  work.spendOnCuts(path, kWorkPerStraight);
  // The pieces left, right, below and above the box.
  for (const Bounds& side : {Bounds{least, {low.x, most.y}}, Bounds{{high.x, least.y}, most},
                             Bounds{{low.x, least.y}, {high.x, low.y}}, Bounds{{low.x, high.y}, {high.x, most.y}}}) {
    if (side.max.x <= side.min.x || side.max.y <= side.min.y) continue;
    std::optional<FilledPath> cut = cutTo(side, path);
    if (!cut) {
      return {combine(
          {path, limit.area}, [](const std::vector<char>& filled) { return filled[0] != 0 && filled[1] == 0; }, work)};
    }
    if (!cut->rings.empty()) pieces.push_back(*std::move(cut));
  }
  return pieces;
}

std::shared_ptr<const Limit> limitOf(FilledPath area) {
  auto limit = std::make_shared<Limit>();
  limit->box = boxOf(area.rings);
  limit->isBox = area.rings.size() == 1 && area.rings[0].size() == 4;
  if (limit->isBox) {
    const Ring& ring = area.rings[0];
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec2 side = ring[(k + 1) % 4] - ring[k];
      if (side.x != 0 && side.y != 0) limit->isBox = false;
    }
  }
  limit->area = std::move(area);
  return limit;
}

FilledPath flattened(const std::vector<PaintLayer>& layers, Work& work) {
  if (layers.empty()) return {};
  if (layers.size() == 1) return layers[0].adds ? layers[0].path : FilledPath{};
  std::vector<FilledPath> paths;
  for (const PaintLayer& layer : layers) paths.push_back(layer.path);
  return combine(
      paths,
      [&](const std::vector<char>& filled) {
        for (std::size_t k = layers.size(); k-- > 0;) {
          if (filled[k] != 0) return layers[k].adds;
        }
        return false;
      },
      work);
}

}  // namespace sillon::svg
