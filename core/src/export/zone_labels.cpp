#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "export/zone_parts.hpp"
#include "geometry/signed_distance.hpp"
#include "sillon/base/types.hpp"

namespace sillon {
namespace {

constexpr int kEvenRounds = 12;
constexpr int kWideRounds = 6;
constexpr double kEvenShare = 0.5;  // share of the time, for progress
constexpr int kPollRows = 32;
// Error that weighs as much as all eight neighbours of a cell [degrees]; larger: smoother borders.
constexpr double kEven = 12;

using Labels = std::vector<std::int32_t>;

// Averages directions over squares as wide as the narrowest zone, because finer detail would only fray the borders.
std::vector<float> smoothed(const DirectionPicture& picture, double least) {
  const Grid& grid = picture.grid;
  const int reach = static_cast<int>(least / 2 / grid.cell);
  std::vector<Vec2> sums(grid.size());
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const double twice = static_cast<double>(picture.degrees[k]) * std::numbers::pi / 90;
    if (picture.inside[k] != 0) sums[k] = {std::cos(twice), std::sin(twice)};
  }
  // A box filter along rows, then along columns, by prefix sums.
  for (const bool rows : {true, false}) {
    const int lines = rows ? grid.ny : grid.nx;
    const int size = rows ? grid.nx : grid.ny;
    std::vector<Vec2> before(size + 1);
    for (int line = 0; line < lines; ++line) {
      const auto at = [&](int k) -> Vec2& { return sums[rows ? grid.index(k, line) : grid.index(line, k)]; };
      for (int k = 0; k < size; ++k) before[k + 1] = before[k] + at(k);
      for (int k = 0; k < size; ++k) {
        at(k) = before[std::min(size, k + reach + 1)] - before[std::max(0, k - reach)];
      }
    }
  }
  std::vector<float> out = picture.degrees;
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (picture.inside[k] == 0 || !(length(sums[k]) > 1e-6)) continue;
    const double angle = std::atan2(sums[k].y, sums[k].x) * 90 / std::numbers::pi;
    out[k] = static_cast<float>(angle < 0 ? angle + 180 : angle);
  }
  return out;
}

// Gives each cell the direction that suits it and its neighbours best: the Potts model, by iterated conditional modes.
Labels nearestDirections(const DirectionPicture& picture, const std::vector<double>& directions, double least,
                         const RunContext& run) {
  const std::vector<float> degrees = smoothed(picture, least);
  const Grid& grid = picture.grid;
  Labels label(grid.size(), -1);
  const auto errorOf = [&](std::size_t k, std::int32_t zone) {
    const double off = angleBetween(static_cast<double>(degrees[k]), directions[zone]) / kEven;
    return off * off;
  };
  const auto count = static_cast<std::int32_t>(directions.size());
  for (std::size_t k = 0; k < label.size(); ++k) {
    if (picture.inside[k] == 0) continue;
    label[k] = 0;
    for (std::int32_t zone = 1; zone < count; ++zone) {
      if (errorOf(k, zone) < errorOf(k, label[k])) label[k] = zone;
    }
  }
  // Each cell in turn takes the label of least cost.
  for (int round = 0; round < kEvenRounds; ++round) {
    run.report(kEvenShare * round / kEvenRounds);
    for (int y = 1; y + 1 < grid.ny; ++y) {
      if (y % kPollRows == 0 && run.poll()) return label;
      for (int x = 1; x + 1 < grid.nx; ++x) {
        const std::size_t k = grid.index(x, y);
        if (label[k] < 0) continue;
        std::array<int, 16> like{};
        for (int v = y - 1; v <= y + 1; ++v) {
          for (int u = x - 1; u <= x + 1; ++u) {
            const std::int32_t other = label[grid.index(u, v)];
            if (other >= 0 && (u != x || v != y)) ++like[other];
          }
        }
        const auto cost = [&](std::int32_t zone) { return errorOf(k, zone) - like[zone] / 8.0; };
        std::int32_t best = label[k];
        for (std::int32_t zone = 0; zone < count; ++zone) {
          if (like[zone] > 0 && cost(zone) < cost(best) - 1e-12) best = zone;
        }
        label[k] = best;
      }
    }
  }
  return label;
}

// Gives all places that no disc of diameter `least` reaches to their neighbours: a morphological opening of each zone.
// The border of the shape does not limit the discs.
void widen(Labels& label, int count, const DirectionPicture& picture, double least, const RunContext& run) {
  const Grid& grid = picture.grid;
  const auto radius = static_cast<float>(least / 2 / grid.cell);
  for (int round = 0; round < kWideRounds; ++round) {
    Labels kept(label.size(), -1);
    std::size_t lost = 0;
    for (std::int32_t zone = 0; zone < count; ++zone) {
      if (run.poll()) return;
      run.report(kEvenShare + (1 - kEvenShare) * (round + static_cast<double>(zone) / count) / kWideRounds);
      std::vector<char> foreign(label.size(), 0);
      for (std::size_t k = 0; k < label.size(); ++k) foreign[k] = label[k] >= 0 && label[k] != zone ? 1 : 0;
      const std::vector<float> depth = chamferDistance(foreign, grid.nx, grid.ny);
      std::vector<char> core(label.size(), 0);
      for (std::size_t k = 0; k < label.size(); ++k) core[k] = label[k] == zone && depth[k] > radius ? 1 : 0;
      const std::vector<float> off = chamferDistance(core, grid.nx, grid.ny);
      for (std::size_t k = 0; k < label.size(); ++k) {
        if (label[k] != zone) continue;
        if (off[k] <= radius) {
          kept[k] = zone;
        } else {
          ++lost;
        }
      }
    }
    if (std::none_of(kept.begin(), kept.end(), [](std::int32_t zone) { return zone >= 0; })) {
      // All zones are too narrow: the largest one takes the whole shape.
      std::array<std::size_t, 16> cells{};
      for (const std::int32_t zone : label) cells[zone >= 0 ? zone : 15] += zone >= 0 ? 1 : 0;
      const auto most = static_cast<std::int32_t>(std::max_element(cells.begin(), cells.end()) - cells.begin());
      for (std::int32_t& zone : label) zone = zone >= 0 ? most : zone;
      return;
    }
    label = std::move(kept);
    spreadLabels(label, picture.inside, grid);
    if (lost == 0) break;
  }
}

// Gives parts of a zone that are smaller than a square of side `least` to the zone they touch most.
void dropSpecks(Labels& label, const DirectionPicture& picture, double least) {
  const Grid& grid = picture.grid;
  const double cells = least * least / (grid.cell * grid.cell);
  std::vector<char> seen(label.size(), 0);
  for (std::size_t seed = 0; seed < label.size(); ++seed) {
    if (label[seed] < 0 || seen[seed] != 0) continue;
    std::vector<std::size_t> part{seed};
    seen[seed] = 1;
    std::array<std::size_t, 16> touched{};
    for (std::size_t at = 0; at < part.size(); ++at) {
      const int x = static_cast<int>(part[at] % grid.nx);
      const int y = static_cast<int>(part[at] / grid.nx);
      for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        const int u = x + dx;
        const int v = y + dy;
        if (u < 0 || v < 0 || u >= grid.nx || v >= grid.ny) continue;
        const std::size_t other = grid.index(u, v);
        if (label[other] < 0) continue;
        if (label[other] != label[seed]) {
          ++touched[label[other]];
        } else if (seen[other] == 0) {
          seen[other] = 1;
          part.push_back(other);
        }
      }
    }
    const auto most = std::max_element(touched.begin(), touched.end());
    if (static_cast<double>(part.size()) >= cells || *most == 0) continue;
    for (const std::size_t k : part) label[k] = static_cast<std::int32_t>(most - touched.begin());
  }
}

}  // namespace

void spreadLabels(Labels& label, const std::vector<char>& where, const Grid& grid) {
  std::vector<std::size_t> front;
  for (std::size_t k = 0; k < label.size(); ++k) {
    if (label[k] >= 0) front.push_back(k);
  }
  while (!front.empty()) {
    std::vector<std::size_t> next;
    for (const std::size_t k : front) {
      const int x = static_cast<int>(k % grid.nx);
      const int y = static_cast<int>(k / grid.nx);
      for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        const int u = x + dx;
        const int v = y + dy;
        if (u < 0 || v < 0 || u >= grid.nx || v >= grid.ny) continue;
        const std::size_t other = grid.index(u, v);
        if (label[other] >= 0 || where[other] == 0) continue;
        label[other] = label[k];
        next.push_back(other);
      }
    }
    front = std::move(next);
  }
}

std::vector<std::int32_t> zoneLabels(const DirectionPicture& picture, const std::vector<double>& directions,
                                     double least, const RunContext& run) {
  Labels label = nearestDirections(picture, directions, least, run);
  widen(label, static_cast<int>(directions.size()), picture, least, run);
  dropSpecks(label, picture, least);
  return label;
}

}  // namespace sillon
