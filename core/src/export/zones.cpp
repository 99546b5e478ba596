#include "sillon/export/zones.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include "base/cancelled.hpp"
#include "base/decimal_text.hpp"
#include "export/prism.hpp"
#include "export/zone_outlines.hpp"
#include "sillon/geometry/outline.hpp"

namespace sillon {
namespace {

constexpr double kFinest = 0.15;    // [mm], of a cell
constexpr double kMostCells = 1e6;  // in all
constexpr double kBorder = 1;       // [mm] beyond the page
constexpr int kBins = 720;          // of a quarter of a degree
constexpr double kEven = 12;        // [degrees] of error that a place takes for as many neighbours as it has

using Labels = std::vector<std::int32_t>;

// Of directions, which are the same after half a turn.
double between(double a, double b) {
  const double d = std::fmod(std::abs(a - b), 180);
  return std::min(d, 180 - d);
}

struct Picture {
  Grid grid;
  std::vector<char> inside;
  std::vector<float> degrees;
};

Picture rastered(const Shape& shape, const DirectionMap& map) {
  Picture picture;
  Grid& grid = picture.grid;
  const Vec2 size = shape.page + Vec2{2 * kBorder, 2 * kBorder};
  grid.cell = std::max(kFinest, std::sqrt(size.x * size.y / kMostCells));
  grid.nx = std::max(1, static_cast<int>(std::ceil(size.x / grid.cell)));
  grid.ny = std::max(1, static_cast<int>(std::ceil(size.y / grid.cell)));
  grid.origin = 0.5 * shape.page - 0.5 * grid.cell * Vec2{static_cast<double>(grid.nx), static_cast<double>(grid.ny)};
  picture.inside.assign(grid.size(), 0);
  picture.degrees.assign(grid.size(), 0);
  const auto rows = insideIntervals(shape, grid.centre(0, 0).y, grid.cell, grid.ny);
  for (int y = 0; y < grid.ny; ++y) {
    for (const Interval& span : rows[static_cast<std::size_t>(y)]) {
      for (int x = 0; x < grid.nx; ++x) {
        const Vec2 p = grid.centre(x, y);
        if (p.x < span.begin || p.x >= span.end) continue;
        picture.inside[grid.index(x, y)] = 1;
        const auto texel = [](double share, int count) {
          return static_cast<std::size_t>(std::clamp(share * count, 0.0, count - 1.0));
        };
        const std::size_t row = texel(1 - p.y / shape.page.y, map.height);
        const std::size_t column = texel(p.x / shape.page.x, map.width);
        const double angle = map.angle[row * static_cast<std::size_t>(map.width) + column] / 65535.0 * 180 - 90;
        picture.degrees[grid.index(x, y)] = static_cast<float>(angle < 0 ? angle + 180 : angle);
      }
    }
  }
  return picture;
}

// The mean direction of a bin's share: by doubled angles, as directions have no head.
double meanDirection(const std::vector<double>& weights, const std::vector<int>& owner, int k) {
  Vec2 sum;
  for (std::size_t bin = 0; bin < weights.size(); ++bin) {
    if (owner[bin] != k) continue;
    const double twice = 2 * std::numbers::pi * (static_cast<double>(bin) + 0.5) / kBins;
    sum = sum + weights[bin] * Vec2{std::cos(twice), std::sin(twice)};
  }
  const double angle = std::atan2(sum.y, sum.x) / (2 * std::numbers::pi) * 180;
  return angle < 0 ? angle + 180 : angle;
}

// Lloyd's rounds from shares of equal weight, begun at several places; the best of them.
std::vector<double> chosenDirections(const Picture& picture, int most) {
  constexpr int kStarts = 12;
  constexpr int kRounds = 60;
  std::vector<double> weights(kBins, 0);
  double all = 0;
  for (std::size_t k = 0; k < picture.inside.size(); ++k) {
    if (picture.inside[k] == 0) continue;
    weights[static_cast<std::size_t>(picture.degrees[k] / 180 * kBins) % kBins] += 1;
    all += 1;
  }
  std::vector<double> best;
  double least = std::numeric_limits<double>::infinity();
  for (int start = 0; start < kStarts; ++start) {
    std::vector<double> centres;
    const int first = start * kBins / kStarts;
    double sum = 0;
    for (int bin = 0; bin < kBins; ++bin) {
      const double weight = weights[static_cast<std::size_t>((first + bin) % kBins)];
      const double goal = (static_cast<double>(centres.size()) + 0.5) * all / most;
      sum += weight;
      if (weight > 0 && sum > goal && static_cast<int>(centres.size()) < most) {
        centres.push_back(((first + bin) % kBins + 0.5) * 180 / kBins);
      }
    }
    std::vector<int> owner(kBins, 0);
    double error = 0;
    for (int round = 0; round < kRounds; ++round) {
      error = 0;
      for (int bin = 0; bin < kBins; ++bin) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < centres.size(); ++k) {
          const double off = between((bin + 0.5) * 180 / kBins, centres[k]);
          if (off >= nearest) continue;
          nearest = off;
          owner[static_cast<std::size_t>(bin)] = static_cast<int>(k);
        }
        error += weights[static_cast<std::size_t>(bin)] * nearest * nearest;
      }
      bool moved = false;
      for (std::size_t k = 0; k < centres.size(); ++k) {
        const double mean = meanDirection(weights, owner, static_cast<int>(k));
        moved = moved || between(mean, centres[k]) > 1e-3;
        centres[k] = mean;
      }
      if (!moved) break;
    }
    if (error < least - 1e-9) {
      least = error;
      best = centres;
    }
  }
  return best;
}

// The means of the directions themselves, not of bins, in whole tenths; what is the same then is one.
std::vector<double> refined(const Picture& picture, std::vector<double> directions) {
  std::vector<Vec2> sums(directions.size());
  for (std::size_t k = 0; k < picture.inside.size(); ++k) {
    if (picture.inside[k] == 0) continue;
    const auto angle = static_cast<double>(picture.degrees[k]);
    const auto nearest = std::min_element(directions.begin(), directions.end(),
                                          [&](double a, double b) { return between(angle, a) < between(angle, b); });
    const double twice = 2 * angle * std::numbers::pi / 180;
    Vec2& sum = sums[static_cast<std::size_t>(nearest - directions.begin())];
    sum = sum + Vec2{std::cos(twice), std::sin(twice)};
  }
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double angle = std::atan2(sums[k].y, sums[k].x) / (2 * std::numbers::pi) * 180;
    directions[k] = std::fmod(std::round(10 * (angle < 0 ? angle + 180 : angle)) / 10, 180);
  }
  std::sort(directions.begin(), directions.end());
  directions.erase(
      std::unique(directions.begin(), directions.end(), [](double a, double b) { return between(a, b) < 0.05; }),
      directions.end());
  if (directions.size() > 1 && between(directions.front(), directions.back()) < 0.05) directions.pop_back();
  return directions;
}

// Directions averaged over squares as wide as the narrowest zone: what is finer would only fray the borders.
std::vector<float> smoothed(const Picture& picture, double least) {
  const Grid& grid = picture.grid;
  const int reach = static_cast<int>(least / 2 / grid.cell);
  std::vector<Vec2> sums(grid.size());
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const double twice = static_cast<double>(picture.degrees[k]) * std::numbers::pi / 90;
    if (picture.inside[k] != 0) sums[k] = {std::cos(twice), std::sin(twice)};
  }
  // Along rows, then along columns, by sums from the beginning.
  for (const bool rows : {true, false}) {
    const int lines = rows ? grid.ny : grid.nx;
    const int size = rows ? grid.nx : grid.ny;
    std::vector<Vec2> before(static_cast<std::size_t>(size) + 1);
    for (int line = 0; line < lines; ++line) {
      const auto at = [&](int k) -> Vec2& { return sums[rows ? grid.index(k, line) : grid.index(line, k)]; };
      for (int k = 0; k < size; ++k)
        before[static_cast<std::size_t>(k) + 1] = before[static_cast<std::size_t>(k)] + at(k);
      for (int k = 0; k < size; ++k) {
        at(k) = before[static_cast<std::size_t>(std::min(size, k + reach + 1))] -
                before[static_cast<std::size_t>(std::max(0, k - reach))];
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

Labels nearestDirections(const Picture& picture, const std::vector<double>& directions, double least) {
  const std::vector<float> degrees = smoothed(picture, least);
  const Grid& grid = picture.grid;
  Labels label(grid.size(), -1);
  const auto errorOf = [&](std::size_t k, std::int32_t zone) {
    const double off = between(static_cast<double>(degrees[k]), directions[static_cast<std::size_t>(zone)]) / kEven;
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
  // Each place in turn takes what suits it and its neighbours best.
  for (int round = 0; round < 12; ++round) {
    for (int y = 1; y + 1 < grid.ny; ++y) {
      for (int x = 1; x + 1 < grid.nx; ++x) {
        const std::size_t k = grid.index(x, y);
        if (label[k] < 0) continue;
        std::array<int, 16> like{};
        for (int v = y - 1; v <= y + 1; ++v) {
          for (int u = x - 1; u <= x + 1; ++u) {
            const std::int32_t other = label[grid.index(u, v)];
            if (other >= 0 && (u != x || v != y)) ++like[static_cast<std::size_t>(other)];
          }
        }
        const auto cost = [&](std::int32_t zone) {
          return errorOf(k, zone) - like[static_cast<std::size_t>(zone)] / 8.0;
        };
        std::int32_t best = label[k];
        for (std::int32_t zone = 0; zone < count; ++zone) {
          if (like[static_cast<std::size_t>(zone)] > 0 && cost(zone) < cost(best) - 1e-12) best = zone;
        }
        label[k] = best;
      }
    }
  }
  return label;
}

// Distance of each cell to the nearest one that is not free, in cells; within 8 %.
std::vector<float> distanceFrom(const std::vector<char>& wall, const Grid& grid) {
  constexpr float kDiagonal = 1.4142136F;
  std::vector<float> far(wall.size());
  for (std::size_t k = 0; k < wall.size(); ++k) far[k] = wall[k] != 0 ? 0 : 1e9F;
  const auto relax = [&](int x, int y, int dx, int dy) {
    const int u = x + dx;
    const int v = y + dy;
    if (u < 0 || v < 0 || u >= grid.nx || v >= grid.ny) return;
    float& here = far[grid.index(x, y)];
    here = std::min(here, far[grid.index(u, v)] + (dx != 0 && dy != 0 ? kDiagonal : 1));
  };
  for (int y = 0; y < grid.ny; ++y) {
    for (int x = 0; x < grid.nx; ++x) {
      for (const auto& [dx, dy] : {std::pair{-1, 0}, {0, -1}, {-1, -1}, {1, -1}}) relax(x, y, dx, dy);
    }
  }
  for (int y = grid.ny - 1; y >= 0; --y) {
    for (int x = grid.nx - 1; x >= 0; --x) {
      for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {-1, 1}}) relax(x, y, dx, dy);
    }
  }
  return far;
}

// Cells without a zone take that of the nearest ones, ring by ring. \param where  which may.
void spread(Labels& label, const std::vector<char>& where, const Grid& grid) {
  std::vector<std::size_t> front;
  for (std::size_t k = 0; k < label.size(); ++k) {
    if (label[k] >= 0) front.push_back(k);
  }
  while (!front.empty()) {
    std::vector<std::size_t> next;
    for (const std::size_t k : front) {
      const int x = static_cast<int>(k % static_cast<std::size_t>(grid.nx));
      const int y = static_cast<int>(k / static_cast<std::size_t>(grid.nx));
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

// What no disc as wide as `least` gets into goes to the neighbours; the border of the shape bounds no disc.
void widen(Labels& label, int count, const Picture& picture, double least) {
  const Grid& grid = picture.grid;
  const auto radius = static_cast<float>(least / 2 / grid.cell);
  for (int round = 0; round < 6; ++round) {
    Labels kept(label.size(), -1);
    std::size_t lost = 0;
    for (std::int32_t zone = 0; zone < count; ++zone) {
      std::vector<char> foreign(label.size(), 0);
      for (std::size_t k = 0; k < label.size(); ++k) foreign[k] = label[k] >= 0 && label[k] != zone ? 1 : 0;
      const std::vector<float> depth = distanceFrom(foreign, grid);
      std::vector<char> core(label.size(), 0);
      for (std::size_t k = 0; k < label.size(); ++k) core[k] = label[k] == zone && depth[k] > radius ? 1 : 0;
      const std::vector<float> off = distanceFrom(core, grid);
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
      // All is narrow: one zone, the one that has most.
      std::array<std::size_t, 16> cells{};
      for (const std::int32_t zone : label) cells[zone >= 0 ? static_cast<std::size_t>(zone) : 15] += zone >= 0 ? 1 : 0;
      const auto most = static_cast<std::int32_t>(std::max_element(cells.begin(), cells.end()) - cells.begin());
      for (std::int32_t& zone : label) zone = zone >= 0 ? most : zone;
      return;
    }
    label = std::move(kept);
    spread(label, picture.inside, grid);
    if (lost == 0) break;
  }
}

// Parts of a zone that are smaller than a square of the least width go to the zone they touch most.
void dropSpecks(Labels& label, const Picture& picture, double least) {
  const Grid& grid = picture.grid;
  const double cells = least * least / (grid.cell * grid.cell);
  std::vector<char> seen(label.size(), 0);
  for (std::size_t seed = 0; seed < label.size(); ++seed) {
    if (label[seed] < 0 || seen[seed] != 0) continue;
    std::vector<std::size_t> part{seed};
    seen[seed] = 1;
    std::array<std::size_t, 16> touched{};
    for (std::size_t at = 0; at < part.size(); ++at) {
      const int x = static_cast<int>(part[at] % static_cast<std::size_t>(grid.nx));
      const int y = static_cast<int>(part[at] / static_cast<std::size_t>(grid.nx));
      for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        const int u = x + dx;
        const int v = y + dy;
        if (u < 0 || v < 0 || u >= grid.nx || v >= grid.ny) continue;
        const std::size_t other = grid.index(u, v);
        if (label[other] < 0) continue;
        if (label[other] != label[seed]) {
          ++touched[static_cast<std::size_t>(label[other])];
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

Result<DirectionZones> directionZones(const Shape& shape, const DirectionMap& directions, const ZoneParams& params,
                                      const RunContext& run) {
  if (params.most < 2 || params.most > 12) {
    return Error{ErrorCode::InvalidArgument, outOfRange("zones", params.most, "", "2 to 12")};
  }
  if (!(params.least >= 0.5 && params.least <= 100)) {
    return Error{ErrorCode::InvalidArgument, outOfRange("least zone", params.least, " mm", "0.5 to 100 mm")};
  }
  if (directions.width < 1 || directions.height < 1) {
    return Error{ErrorCode::InvalidArgument, "the map of directions has no texels"};
  }
  if (!(shape.page.x > 0 && shape.page.y > 0)) return Error{ErrorCode::EmptyShape, "the shape has no page"};
  const Picture picture = rastered(shape, directions);
  if (std::none_of(picture.inside.begin(), picture.inside.end(), [](char in) { return in != 0; })) {
    return Error{ErrorCode::EmptyShape,
                 "the shape is too small for zones; a cell of them is " + decimal(picture.grid.cell, 2) + " mm wide"};
  }
  const std::vector<double> chosen = refined(picture, chosenDirections(picture, params.most));
  if (run.cancelled()) return cancelledRun();
  Labels label = nearestDirections(picture, chosen, params.least);
  if (run.cancelled()) return cancelledRun();
  widen(label, static_cast<int>(chosen.size()), picture, params.least);
  dropSpecks(label, picture, params.least);

  spread(label, std::vector<char>(label.size(), 1), picture.grid);
  DirectionZones out;
  std::vector<double> areas(chosen.size(), 0);
  double all = 0;
  for (std::size_t k = 0; k < label.size(); ++k) {
    if (picture.inside[k] == 0) continue;
    const auto zone = static_cast<std::size_t>(label[k]);
    areas[zone] += picture.grid.cell * picture.grid.cell;
    out.error += between(static_cast<double>(picture.degrees[k]), chosen[zone]);
    all += 1;
  }
  out.error /= std::max(1.0, all);
  std::vector<std::vector<Ring>> rings = zoneOutlines(std::move(label), static_cast<int>(chosen.size()), picture.grid);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (!rings[k].empty() && areas[k] > 0) out.zones.push_back({chosen[k], areas[k], std::move(rings[k])});
  }
  return out;
}

}  // namespace sillon
