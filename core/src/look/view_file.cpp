// Writes the small file that <sillon-view> shows. Each segment is a capsule that marks samples of the texels it covers;
// a texel's direction is the mean, in doubled angles, of the capsules that reach it.
#include "base/refused.hpp"
#include "sillon/look/preview.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <string>

#include "base/fast_math.hpp"
#include "sillon/input/image_io.hpp"
#include "toolpath/path.hpp"

namespace sillon {
namespace {

constexpr double kFewestPerBead = 1.5;         // texels: coarser ones would mix beads that have nothing in common
constexpr double kMostPerBead = 4;             // texels per bead, at most
constexpr double kUsualTexels = 100e3;         // texels of a usual view, as far as the two limits above allow
constexpr double kMostTexels = 1 << 18;        // texels of any view, at most
constexpr std::size_t kMostBytes = 200 << 10;  // size of the file, at most
constexpr int kSamples = 4;                    // samples per texel and axis: one bit each
constexpr int kGapless = 12;                   // samples from which a texel counts as covered
constexpr int kWidthSteps = 8;                 // steps of width per spacing: finer ones would only make the file larger

// A texel while capsules are drawn.
struct DrawnTexel {
  Vec2f z;                    // sum of unit directions of doubled angle, weighted by samples
  float width = 0;            // sum of widths, weighted by samples
  float weight = 0;           // samples, counted once for each bead
  std::uint16_t covered = 0;  // one bit per sample
};

// The texels of the page.
struct Raster {
  int width = 0;
  int height = 0;
  double texelsPerMm = 0;
  std::vector<DrawnTexel> texels;  // row 0 on top
};

/// Chooses the resolution: about kUsualTexels, 1.5 to 4 texels per bead, and never more than the limit.
/// \param most  texels in all.
Raster emptyRaster(Vec2 page, double spacing, double most) {
  Raster raster;
  const double usual = std::sqrt(kUsualTexels / (page.x * page.y));
  raster.texelsPerMm = std::min(std::clamp(usual, kFewestPerBead / spacing, kMostPerBead / spacing),
                                std::sqrt(most / (page.x * page.y)));
  const auto side = [&](double length) {
    return static_cast<int>(std::clamp(std::ceil(length * raster.texelsPerMm), 1.0, 4096.0));
  };
  raster.width = side(page.x);
  raster.height = side(page.y);
  raster.texels.resize(cellCount(raster.width, raster.height));
  return raster;
}

/// A piece of bead in texels, y down.
struct BeadCapsule {
  Vec2f a;
  Vec2f b;
  float radiusA = 0;
  float radiusB = 0;
  Vec2f z;          // doubled angle of the bead's direction, y up
  float width = 0;  // [mm]
};

/// Samples of the texel (x, y) that lie within the capsule, as bits.
std::uint16_t samplesWithin(const BeadCapsule& capsule, int x, int y) {
  const Vec2f d = capsule.b - capsule.a;
  const float squared = dot(d, d);
  std::uint16_t bits = 0;
  for (int k = 0; k < kSamples * kSamples; ++k) {
    const Vec2f p{static_cast<float>(x) + (static_cast<float>(k % kSamples) + 0.5f) / kSamples,
                  static_cast<float>(y) + (static_cast<float>(k / kSamples) + 0.5f) / kSamples};
    const float t = squared > 0 ? std::clamp(dot(p - capsule.a, d) / squared, 0.0f, 1.0f) : 0.0f;
    const Vec2f off = p - capsule.a - d * t;
    const float radius = capsule.radiusA + (capsule.radiusB - capsule.radiusA) * t;
    if (dot(off, off) < radius * radius) bits = static_cast<std::uint16_t>(bits | (1u << k));
  }
  return bits;
}

int countOf(std::uint16_t bits) {
  int count = 0;
  for (unsigned rest = bits; rest != 0; rest &= rest - 1) ++count;
  return count;
}

/// Adds a capsule to the texels that it covers, weighted by samples.
void draw(const BeadCapsule& capsule, Raster& raster) {
  const float reach = std::max(capsule.radiusA, capsule.radiusB);
  const auto first = [&](float p, float q) { return static_cast<int>(std::max(0.0f, std::min(p, q) - reach)); };
  const auto last = [&](float p, float q, int count) {
    return static_cast<int>(std::min(static_cast<float>(count - 1), std::max(p, q) + reach));
  };
  const int x1 = last(capsule.a.x, capsule.b.x, raster.width);
  const int y1 = last(capsule.a.y, capsule.b.y, raster.height);
  for (int y = first(capsule.a.y, capsule.b.y); y <= y1; ++y) {
    for (int x = first(capsule.a.x, capsule.b.x); x <= x1; ++x) {
      const std::uint16_t bits = samplesWithin(capsule, x, y);
      if (bits == 0) continue;
      const auto count = static_cast<float>(countOf(bits));
      DrawnTexel& texel = raster.texels[indexOf(x, y, raster.width)];
      // Doubled angles, so that beads in opposite senses add up.
      texel.z = texel.z + capsule.z * count;
      texel.width += capsule.width * count;
      texel.weight += count;
      texel.covered = static_cast<std::uint16_t>(texel.covered | bits);
    }
  }
}

/// Draws all segments of a cycle.
void drawCycle(const Cycle& cycle, Vec2 page, Raster& raster) {
  const auto scale = static_cast<float>(raster.texelsPerMm);
  const auto height = static_cast<float>(page.y);
  const std::size_t count = cycle.points.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t next = (k + 1) % count;
    const Vec2f a = cycle.points[k];
    const Vec2f b = cycle.points[next];
    const Vec2f d = b - a;
    const float squared = dot(d, d);
    if (!(squared > 0)) continue;
    draw({{a.x * scale, (height - a.y) * scale},
          {b.x * scale, (height - b.y) * scale},
          cycle.widths[k] * scale / 2,
          cycle.widths[next] * scale / 2,
          Vec2f{d.x * d.x - d.y * d.y, 2 * d.x * d.y} * (1 / squared),
          (cycle.widths[k] + cycle.widths[next]) / 2},
         raster);
  }
}

/// Encodes texels as colours. Red: direction, 256 per half turn; green: share covered; blue: width, 128 per spacing.
std::vector<std::uint8_t> pixelsOf(const Raster& raster, double spacing) {
  std::vector<std::uint8_t> rgb(raster.texels.size() * 3);
  const auto byte = [](float v) { return static_cast<std::uint8_t>(std::clamp(v + 0.5f, 0.0f, 255.0f)); };
  for (std::size_t k = 0; k < raster.texels.size(); ++k) {
    const DrawnTexel& texel = raster.texels[k];
    std::uint8_t* pixel = &rgb[3 * k];
    if (texel.weight == 0) {
      // An empty texel takes its neighbour's values: that costs nothing in the file, and is smooth where pages
      // interpolate.
      if (k > 0) std::copy_n(pixel - 3, 3, pixel);
      pixel[1] = 0;
      continue;
    }
    const float turn = atan2Approx(texel.z.y, texel.z.x) / (2 * kPi) * 256;  // (-128, 128]
    pixel[0] = static_cast<std::uint8_t>(static_cast<int>(std::floor(turn + 0.5f)) & 255);
    const int covered = countOf(texel.covered);
    // Gaps between beads are finer than a page shows, and would be most of the file.
    pixel[1] = covered >= kGapless ? 255 : byte(static_cast<float>(covered) / (kSamples * kSamples) * 255);
    const float ratio = texel.width / texel.weight / static_cast<float>(spacing);
    // Widths up to 1.9 spacings, in steps that compress well.
    pixel[2] = byte(std::floor(std::clamp(ratio, 0.0f, 1.9f) * kWidthSteps + 0.5f) * (128.0f / kWidthSteps));
  }
  return rgb;
}

/// Text that goes with the pixels, in whole numbers only: µm, hundredths of a degree.
std::string noteOf(Vec2 page, double spacing, const ViewParams& params) {
  const auto whole = [](double v) { return std::to_string(std::llround(v)); };
  std::string note = "sillon-view 1 page " + whole(page.x * 1000) + " " + whole(page.y * 1000) + " spacing " +
                     whole(spacing * 1000) + " colour";
  for (const std::uint8_t channel : params.colour) note.append(1, ' ').append(std::to_string(channel));
  return note + " slopes " + whole(params.roughness.along * 100) + " " + whole(params.roughness.across * 100);
}

}  // namespace

Result<std::vector<std::uint8_t>> viewFile(const Toolpath& toolpath, Vec2 page, const ViewParams& params) {
  if (!(toolpath.spacing >= 1e-3 && toolpath.spacing <= 1e3)) {
    return outOfRange("toolpath.spacing", toolpath.spacing, 1e-3, 1e3, "mm");
  }
  if (auto defect = invalidRoughness(params.roughness)) return *std::move(defect);
  if (auto defect = toolpathDefect(toolpath, page)) return *std::move(defect);
  const std::string note = noteOf(page, toolpath.spacing, params);
  try {
    // Try again with fewer texels until the file is small enough.
    for (double most = kMostTexels;; most *= 0.7) {
      Raster raster = emptyRaster(page, toolpath.spacing, most);
      for (const Cycle& cycle : toolpath.cycles) drawCycle(cycle, page, raster);
      std::vector<std::uint8_t> png = encodePng(raster.width, raster.height, pixelsOf(raster, toolpath.spacing), note);
      if (png.empty()) break;
      if (png.size() <= kMostBytes) return png;
    }
  } catch (const std::bad_alloc&) {
    // told below
  }
  return needsMoreMemory();
}

}  // namespace sillon
