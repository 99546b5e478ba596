#include "sillon/look/preview.hpp"

#include <cmath>
#include <cstddef>

#include "look/loop_data.hpp"

namespace sillon {
namespace {

/// The shorter way round from a to b [degrees], in [-180, 180): exact for whole numbers, so that it is the same
/// everywhere.
double arc(double a, double b) {
  const double way = b - a + 180;
  return way - 360 * std::floor(way / 360) - 180;
}

/// A lamp on the way from a to b; the azimuth goes the shorter way round.
Lamp between(const Lamp& a, const Lamp& b, double share) {
  return {arc(0, a.azimuth + share * arc(a.azimuth, b.azimuth)), a.elevation + share * (b.elevation - a.elevation),
          a.slope + share * (b.slope - a.slope)};
}

}  // namespace

std::vector<LoopFrame> loopFrames(std::span<const Lamp> lamps) {
  // One lamp goes once round the plate. Several are shown in turn, each held for a while, with a crossing to the next.
  std::vector<LoopFrame> frames;
  if (lamps.size() == 1) {
    for (int k = 0; k < kTurnFramesData; ++k) {
      Lamp lamp = lamps[0];
      lamp.azimuth = arc(0, lamp.azimuth + 360.0 * k / kTurnFramesData);
      frames.push_back({lamp, kTurnTimeData});
    }
    return frames;
  }
  for (std::size_t k = 0; k < lamps.size(); ++k) {
    frames.push_back({lamps[k], kHoldTimeData});
    for (int step = 1; step <= kCrossFramesData; ++step) {
      // The lamp sets off and arrives slowly, as a hand moves it (smoothstep).
      const double t = static_cast<double>(step) / (kCrossFramesData + 1);
      frames.push_back({between(lamps[k], lamps[(k + 1) % lamps.size()], t * t * (3 - 2 * t)), kCrossTimeData});
    }
  }
  return frames;
}

int loopSide() { return kLoopSideData; }

int loopBytes() { return kLoopBytesData; }

// From the best quality down, until a loop fits in loopBytes().
std::vector<int> loopQualities() {
  std::vector<int> qualities;
  for (int quality = kBestQualityData; quality > 0; quality -= kQualityStepData) qualities.push_back(quality);
  return qualities;
}

}  // namespace sillon
