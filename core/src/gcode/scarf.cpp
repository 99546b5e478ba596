#include "gcode/motion.hpp"

#include <algorithm>
#include <cmath>

namespace sillon {
namespace {

constexpr double kSteps = 8;  // least number of steps in the flow along a scarf

// Appends the part of segment i of `motion` from the share `begin` to the share `end` of its length.
void append(const Motion& motion, std::size_t i, double begin, double end, Motion& out) {
  const PointUm from = motion.points[i];
  const PointUm d = motion.points[i + 1] - from;
  const auto at = [&](double share) {
    return from +
           PointUm{std::llround(share * static_cast<double>(d.x)), std::llround(share * static_cast<double>(d.y))};
  };
  out.points.push_back(at(begin));
  out.widths.push_back(motion.widths[i] + begin * (motion.widths[i + 1] - motion.widths[i]));
  out.lengths.push_back(lengthMm(at(end) - at(begin)));
  out.areas.push_back(motion.areas[i] * (end - begin));
}

}  // namespace

void addScarf(Motion& motion, std::vector<double>& speeds, double length) {
  double total = 0;
  for (const double piece : motion.lengths) total += piece;
  length = std::min(length, total / 4);

  // Cut the path where the scarf ends, and the scarf into steps.
  Motion cut;
  std::vector<double> cutSpeeds;
  std::size_t ramp = 0;  // number of segments in the scarf
  double along = 0;
  for (std::size_t i = 0; i < motion.lengths.size(); ++i) {
    const double piece = motion.lengths[i];
    const double inside = std::clamp((length - along) / piece, 0.0, 1.0);
    along += piece;
    const int steps = std::max(1, static_cast<int>(std::ceil(inside * piece * kSteps / length)));
    if (inside * piece < 0.001) {
      append(motion, i, 0, 1, cut);
    } else {
      // A remainder of less than a micrometre could not be written, so it joins the last step.
      const double end = (1 - inside) * piece < 0.001 ? 1 : inside;
      for (int k = 0; k < steps; ++k) append(motion, i, end * k / steps, end * (k + 1) / steps, cut);
      ramp = cut.lengths.size();
      if (end < 1) append(motion, i, end, 1, cut);
    }
    cutSpeeds.resize(cut.lengths.size(), speeds[i]);
  }
  cut.points.push_back(motion.points.back());
  cut.widths.push_back(motion.widths.back());

  double rampLength = 0;
  for (std::size_t i = 0; i < ramp; ++i) rampLength += cut.lengths[i];
  along = 0;
  for (std::size_t i = 0; i < ramp; ++i) {
    const double up = cut.areas[i] * (along + cut.lengths[i] / 2) / rampLength;
    along += cut.lengths[i];
    cut.points.push_back(cut.points[i + 1]);
    cut.widths.push_back(cut.widths[i + 1]);
    cut.lengths.push_back(cut.lengths[i]);
    cut.areas.push_back(cut.areas[i] - up);
    cut.areas[i] = up;
    cutSpeeds.push_back(cutSpeeds[i]);
  }
  cut.beads = cut.lengths.size();
  cut.segmentSlowedMm = motion.segmentSlowedMm;
  cut.curveSlowedMm = motion.curveSlowedMm;
  motion = std::move(cut);
  speeds = std::move(cutSpeeds);
}

}  // namespace sillon
