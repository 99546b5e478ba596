#include "input/svg/svg_clip.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sillon::svg {
namespace {

constexpr double kOverlap = 1e-3;  // less than this over a straight edge is not worth a cut [mm]

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
  work.spendOnCuts(paths);
  Result<FilledPath> area = combined(paths, rule);
  if (!area) throw Refused{area.error().code, area.error().message};
  return std::move(area).value();
}

FilledPath within(FilledPath path, const std::vector<const Limit*>& limits, Work& work) {
  const Bounds box = boxOf(path.rings);
  std::vector<FilledPath> paths{std::move(path)};
  for (const Limit* limit : limits) {
    if (covers(*limit, box)) continue;
    const Bounds& other = limit->box;
    if (other.empty() || other.min.x >= box.max.x || other.max.x <= box.min.x || other.min.y >= box.max.y ||
        other.max.y <= box.min.y) {
      return {};
    }
    paths.push_back(limit->area);
  }
  if (paths.size() == 1) return std::move(paths[0]);
  return combine(
      paths, [](const std::vector<char>& filled) { return std::find(filled.begin(), filled.end(), 0) == filled.end(); },
      work);
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

FilledPath flattened(const std::vector<Layer>& layers, Work& work) {
  if (layers.empty()) return {};
  if (layers.size() == 1) return layers[0].adds ? layers[0].path : FilledPath{};
  std::vector<FilledPath> paths;
  for (const Layer& layer : layers) paths.push_back(layer.path);
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
