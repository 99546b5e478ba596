#include "sillon/quality/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <utility>

#include "base/fast_math.hpp"
#include "base/parallel_for.hpp"
#include "base/refused.hpp"
#include "base/simd.hpp"
#include "input/map_defect.hpp"
#include "look/rasters.hpp"
#include "quality/seen_cells.hpp"
#include "sillon/input/image_io.hpp"
#include "toolpath/path.hpp"

namespace sillon {
namespace {

constexpr double kCellSpacings = 2;
constexpr int kPointsPerCell = 8;  // points per cell and axis
constexpr int kBandCells = 4;      // rows of cells that one task rasters
constexpr float kReach = 0.75f;  // [tau], reach of a bead of width tau from its centre line, a quarter beyond its edge

struct Segment {
  // Ends, in points of the raster, y down.
  Vec2f a;
  Vec2f b;
  float radius = 0;
};

struct PictureCells {
  int width = 0;
  int height = 0;
};

/// Light per picture of each cell, row by row; negative where less than half of the cell is covered.
using Lights = std::vector<std::vector<float>>;

/// First and last row of points that a segment reaches; they may lie off the page.
std::pair<int, int> rowsOf(const Segment& s) {
  return {static_cast<int>(std::floor(std::min(s.a.y, s.b.y) - s.radius)),
          static_cast<int>(std::ceil(std::max(s.a.y, s.b.y) + s.radius))};
}

/// All beads, with the light they reflect, and the cells below them.
struct LitBeads {
  std::vector<Segment> segments;
  std::vector<float> light;  ///< light of each segment, per picture
  std::size_t pictures;
  PictureCells cells;
};

/// Rasters a band of cells: each point takes the light of its nearest segment, and each cell the mean of its points.
/// \param inBand  segments that reach the rows of the band, in their order; the first of equally near ones counts.
void drawBand(const LitBeads& beads, const std::vector<std::uint32_t>& inBand, int firstCell, int endCell,
              Lights& lights) {
  const PictureCells cells = beads.cells;
  const int width = cells.width * kPointsPerCell;
  const int top = firstCell * kPointsPerCell;
  const int rows = (endCell - firstCell) * kPointsPerCell;
  const std::size_t stride = width + 3;  // room for groups of four that pass the end of a row
  std::vector<float> distance(stride * rows, 1e30f);
  std::vector<std::uint32_t> nearest(distance.size(), 0);
  for (const std::uint32_t k : inBand) {
    const Segment& s = beads.segments[k];
    const auto [from, to] = rowsOf(s);
    const int y0 = std::max(top, from);
    const int y1 = std::min(top + rows - 1, to);
    const int x0 = std::max(0, static_cast<int>(std::floor(std::min(s.a.x, s.b.x) - s.radius)));
    const int x1 = std::min(width - 1, static_cast<int>(std::ceil(std::max(s.a.x, s.b.x) + s.radius)));
    const Vec2f d = s.b - s.a;
    const float squared = dot(d, d);
    const F4 perSquared = splat(squared > 0 ? 1 / squared : 0);
    const F4 none = splat(0);
    const F4 all = splat(1);
    const F4 dx = splat(d.x);
    const F4 dy = splat(d.y);
    const F4 within = splat(s.radius * s.radius);
    const I4 label = splatInt(static_cast<std::int32_t>(k));
    for (int y = y0; y <= y1; ++y) {
      const F4 py = splat(static_cast<float>(y) + 0.5f - s.a.y);
      const std::size_t row = (y - top) * stride;
      for (int x = x0; x <= x1; x += 4) {
        const F4 px = toFloat(I4{x, x + 1, x + 2, x + 3}) + splat(0.5f) - splat(s.a.x);
        const F4 t = max4(min4((px * dx + py * dy) * perSquared, all), none);
        const F4 offX = px - dx * t;
        const F4 offY = py - dy * t;
        const F4 away = offX * offX + offY * offY;
        const std::size_t at = row + x;
        const F4 before = load4(&distance[at]);
        const I4 nearer = (away < within) & (away < before);
        store4(&distance[at], select4(nearer, away, before));
        const I4 labels = loadInt4(&nearest[at]);
        storeInt4(&nearest[at], (nearer & label) | (~nearer & labels));
      }
    }
  }
  for (int cy = firstCell; cy < endCell; ++cy) {
    for (int cx = 0; cx < cells.width; ++cx) {
      for (std::size_t k = 0; k < beads.pictures; ++k) {
        float sum = 0;
        int seen = 0;
        for (int j = 0; j < kPointsPerCell * kPointsPerCell; ++j) {
          const std::size_t at = ((cy - firstCell) * kPointsPerCell + j / kPointsPerCell) * stride +
                                 (cx * kPointsPerCell + j % kPointsPerCell);
          if (!(distance[at] < 1e30f)) continue;
          sum += beads.light[nearest[at] * beads.pictures + k];
          ++seen;
        }
        const std::size_t cell = indexOf(cx, cy, cells.width);
        lights[k][cell] = 2 * seen >= kPointsPerCell * kPointsPerCell ? sum / static_cast<float>(seen) : -1.0f;
      }
    }
  }
}

/// Weighted sums for means, variances and a correlation.
struct Sums {
  double weight = 0;
  double x = 0;
  double y = 0;
  double xx = 0;
  double yy = 0;
  double xy = 0;

  void add(double w, double a, double b) {
    weight += w;
    x += w * a;
    y += w * b;
    xx += w * a * a;
    yy += w * b * b;
    xy += w * a * b;
  }
  [[nodiscard]] double varianceX() const { return std::max(0.0, xx / weight - x / weight * (x / weight)); }
  [[nodiscard]] double varianceY() const { return std::max(0.0, yy / weight - y / weight * (y / weight)); }
  [[nodiscard]] double covariance() const { return xy / weight - x / weight * (y / weight); }
};

double correlation(const Sums& s) {
  const double both = s.weight > 0 ? s.varianceX() * s.varianceY() : 0;
  return both > 1e-12 ? s.covariance() / std::sqrt(both) : 0;
}

/// Structural similarity (SSIM; Wang et al. 2004) for a dynamic range of 1, as the mean over all windows that lie
/// wholly on the plate.
double ssimOf(const std::vector<float>& seen, const Tones& picture, std::span<const float> light) {
  constexpr int kRadius = 5;
  constexpr double kC1 = 0.01 * 0.01;
  constexpr double kC2 = 0.03 * 0.03;
  // Gaussian weights exp(-k²/2/1.5²).
  constexpr double kGauss[kRadius + 1] = {1, 0.800737403, 0.411112291, 0.135335283, 0.028565500, 0.003865920};
  double sum = 0;
  std::int64_t count = 0;
  for (int y = kRadius; y < picture.height - kRadius; ++y) {
    for (int x = kRadius; x < picture.width - kRadius; ++x) {
      Sums s;
      bool whole = true;
      for (int j = -kRadius; j <= kRadius && whole; ++j) {
        for (int i = -kRadius; i <= kRadius; ++i) {
          const std::size_t at = indexOf(x + i, y + j, picture.width);
          whole = whole && light[at] >= 0;
          s.add(kGauss[std::abs(i)] * kGauss[std::abs(j)], static_cast<double>(seen[at]),
                static_cast<double>(picture.value[at]));
        }
      }
      if (!whole) continue;
      const double mx = s.x / s.weight;
      const double my = s.y / s.weight;
      sum += (2 * mx * my + kC1) * (2 * s.covariance() + kC2) /
             ((mx * mx + my * my + kC1) * (s.varianceX() + s.varianceY() + kC2));
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

// Sums the codes of the seen light and the tones of a picture over all covered cells.
Sums sumsOf(std::span<const float> light, const Tones& picture) {
  Sums sums;
  for (std::size_t k = 0; k < light.size(); ++k) {
    if (light[k] >= 0) {
      sums.add(1, static_cast<double>(codeOfLight(light[k])), static_cast<double>(picture.value[k]));
    }
  }
  return sums;
}

}  // namespace

PictureMeasures compareTones(std::span<const float> light, const Tones& picture) {
  PictureMeasures out;
  const std::size_t cells = cellCount(picture.width, picture.height);
  if (light.size() != cells || picture.value.size() != cells) return out;
  const Sums sums = sumsOf(light, picture);
  if (!(sums.weight > 0)) return out;
  out.r = correlation(sums);
  const double slope = sums.varianceX() > 1e-12 ? sums.covariance() / sums.varianceX() : 0;
  const double offset = sums.y / sums.weight - slope * sums.x / sums.weight;
  std::vector<float> seen(light.size(), 0);
  std::vector<float> sorted;
  for (std::size_t k = 0; k < light.size(); ++k) {
    if (light[k] < 0) continue;
    seen[k] = static_cast<float>(slope * static_cast<double>(codeOfLight(light[k])) + offset);
    sorted.push_back(light[k]);
  }
  out.ssim = ssimOf(seen, picture, light);
  std::sort(sorted.begin(), sorted.end());
  const float low = sorted[(sorted.size() - 1) / 100];
  const float high = sorted[(sorted.size() - 1) * 99 / 100];
  out.contrast = low > 0 ? static_cast<double>(high) / static_cast<double>(low) : 1;
  return out;
}

Result<SeenCells> seePlate(const Toolpath& toolpath, Vec2 page, std::span<const Lamp> lamps, const Roughness& roughness,
                           const RunContext& run) {
  if (auto defect = toolpathDefect(toolpath, page)) return *std::move(defect);
  if (!(toolpath.spacing >= 1e-3 && toolpath.spacing <= 1e3)) {
    return outOfRange("toolpath.spacing", toolpath.spacing, 1e-3, 1e3, "mm");
  }
  if (auto defect = invalidRoughness(roughness)) return *std::move(defect);
  for (const Lamp& lamp : lamps) {
    if (auto defect = invalidLamp(lamp)) return *std::move(defect);
  }
  // The cells divide the page evenly, and are as near to 2 tau as that allows.
  const auto cellsAlong = [&](double side) {
    return std::max(1.0, std::round(side / (kCellSpacings * toolpath.spacing)));
  };
  const double across = cellsAlong(page.x);
  const double down = cellsAlong(page.y);
  if (across * down * kPointsPerCell * kPointsPerCell > static_cast<double>(kMaxImagePixels)) {
    return refused(ErrorCode::TooLarge, "JudgedTooFine");
  }
  const PictureCells cells{static_cast<int>(across), static_cast<int>(down)};

  std::vector<Lobe> lobes;
  for (const Lamp& lamp : lamps) lobes.push_back(lobeOf(lamp, roughness));
  try {
    LitBeads beads{{}, {}, lamps.size(), cells};
    const Vec2f scale{static_cast<float>(across * kPointsPerCell / page.x),
                      static_cast<float>(down * kPointsPerCell / page.y)};
    const auto height = static_cast<float>(page.y);
    const float reach = static_cast<float>(toolpath.spacing) * (kReach - 0.5f);
    for (const Cycle& cycle : toolpath.cycles) {
      for (std::size_t k = 0; k < cycle.points.size(); ++k) {
        const std::size_t next = (k + 1) % cycle.points.size();
        const Vec2f a = cycle.points[k];
        const Vec2f b = cycle.points[next];
        const float size = length(b - a);
        if (!(size > 0)) continue;
        const float radius = (std::max(cycle.widths[k], cycle.widths[next]) / 2 + reach) * std::max(scale.x, scale.y);
        beads.segments.push_back(
            {{a.x * scale.x, (height - a.y) * scale.y}, {b.x * scale.x, (height - b.y) * scale.y}, radius});
        for (const Lobe& lobe : lobes) beads.light.push_back(lightOf(lobe, (b - a) * (1 / size)));
      }
    }
    Lights lights(lamps.size(), std::vector<float>(cellCount(cells.width, cells.height)));
    constexpr int kBandRows = kBandCells * kPointsPerCell;
    const int bands = (cells.height + kBandCells - 1) / kBandCells;
    std::vector<std::vector<std::uint32_t>> inBand(bands);
    for (std::size_t k = 0; k < beads.segments.size(); ++k) {
      const auto [from, to] = rowsOf(beads.segments[k]);
      const int last = std::min(to / kBandRows, bands - 1);
      for (int band = std::max(0, from / kBandRows); band <= last; ++band) {
        inBand[band].push_back(static_cast<std::uint32_t>(k));
      }
    }
    parallelForEach(run, bands, 1, [&](int band) {
      drawBand(beads, inBand[band], band * kBandCells, std::min(cells.height, (band + 1) * kBandCells), lights);
    });
    if (run.cancelled()) return cancelledRun();
    return SeenCells{cells.width, cells.height, std::move(lights)};
  } catch (const std::bad_alloc&) {
    return needsMoreMemory();
  }
}

std::vector<PictureMeasures> comparePictures(const std::vector<std::vector<float>>& lights,
                                             std::span<const ShownPicture> pictures, int width, int height) {
  std::vector<Tones> asked;
  for (const ShownPicture& picture : pictures) asked.push_back(resampled(picture.tones, width, height));
  std::vector<PictureMeasures> measures;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    measures.push_back(compareTones(lights[k], asked[k]));
    for (const Tones& other : asked) measures.back().others.push_back(correlation(sumsOf(lights[k], other)));
  }
  return measures;
}

}  // namespace sillon
