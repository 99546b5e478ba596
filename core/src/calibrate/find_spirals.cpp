#include "base/exact_math.hpp"
#include "calibrate/photo.hpp"

#include <algorithm>

namespace sillon {
namespace {

constexpr double kStepsPerPitch = 6;  // samples per pitch in the patch in which a spiral is looked for

/// Samples a picture by bilinear interpolation.
float sampled(const Tones& tones, Vec2 pixel) {
  const double x = std::clamp(pixel.x - 0.5, 0.0, tones.width - 1.001);
  const double y = std::clamp(pixel.y - 0.5, 0.0, tones.height - 1.001);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const auto u = static_cast<float>(x - i), v = static_cast<float>(y - j);
  return (tones.at(i, j) * (1 - u) + tones.at(i + 1, j) * u) * (1 - v) +
         (tones.at(i, j + 1) * (1 - u) + tones.at(i + 1, j + 1) * u) * v;
}

/// Subtracts the local mean and divides by the local RMS of the rest, both over squares: only the pattern of the turns
/// remains. \param reach  half a square's side [samples].
void flatten(std::vector<float>& patch, int side, int reach) {
  const auto means = [&](const std::vector<float>& values) {
    std::vector<double> sums(cellCount(side + 1, side + 1), 0);
    const auto at = [&](int x, int y) -> double& { return sums[indexOf(x, y, side + 1)]; };
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        at(x + 1, y + 1) = static_cast<double>(values[y * side + x]) + at(x, y + 1) + at(x + 1, y) - at(x, y);
      }
    }
    std::vector<float> out(values.size());
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const int x0 = std::max(0, x - reach), x1 = std::min(side, x + reach + 1);
        const int y0 = std::max(0, y - reach), y1 = std::min(side, y + reach + 1);
        out[y * side + x] =
            static_cast<float>((at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0)) / ((x1 - x0) * (y1 - y0)));
      }
    }
    return out;
  };
  const std::vector<float> mean = means(patch);
  std::vector<float> squares;
  for (std::size_t k = 0; k < patch.size(); ++k) {
    patch[k] -= mean[k];
    squares.push_back(patch[k] * patch[k]);
  }
  const std::vector<float> power = means(squares);
  for (std::size_t k = 0; k < patch.size(); ++k) patch[k] /= std::sqrt(power[k] + 1e-4f);
}

/// Finds the shift at which the picture correlates most with the complex wave that the spiral's turns should make.
SeenSpiral lookFor(const CouponSpiral& spiral, const FoundCoupon& found, const Tones& tones, double reach, int stride) {
  const double step = spiral.pitch / kStepsPerPitch;
  const int shifts = static_cast<int>(std::ceil(reach / step));
  const int radius = static_cast<int>(spiral.radius / step);
  const int half = radius + shifts;
  const int side = 2 * half + 1;
  std::vector<float> patch;
  patch.reserve(cellCount(side, side));
  for (int j = -half; j <= half; ++j) {
    for (int i = -half; i <= half; ++i) {
      patch.push_back(sampled(tones, found.pixelOf(spiral.centre + Vec2{i * step, j * step})));
    }
  }
  flatten(patch, side, static_cast<int>(kStepsPerPitch));
  // The wave at a place of the patch, counted from its middle.
  struct Sample {
    int i, j;
    float re, im;
  };
  std::vector<Sample> wave;
  for (int j = -radius; j <= radius; ++j) {
    for (int i = -radius; i <= radius; ++i) {
      const double r = std::sqrt(static_cast<double>(i * i + j * j));
      if (r > radius || r < kStepsPerPitch) continue;
      const double phase = 2 * std::numbers::pi * r / kStepsPerPitch - exact::atan2(j, i);
      wave.push_back({i, j, static_cast<float>(exact::cos(phase)), static_cast<float>(exact::sin(phase))});
    }
  }
  // Correlates a whole row of shifts at once: neighbouring shifts read neighbouring samples.
  const auto answers = [&](int dy) {
    std::vector<float> re(2 * shifts + 1, 0), im = re;
    for (const Sample& s : wave) {
      const float* from = patch.data() + (s.j + dy + half) * side + s.i + half - shifts;
      for (std::size_t k = 0; k < re.size(); ++k) {
        re[k] += from[k] * s.re;
        im[k] += from[k] * s.im;
      }
    }
    std::vector<double> out;
    for (std::size_t k = 0; k < re.size(); ++k) {
      out.push_back(std::sqrt(2.0) * std::sqrt(static_cast<double>(re[k] * re[k] + im[k] * im[k])) /
                    static_cast<double>(wave.size()));
    }
    return out;
  };
  SeenSpiral best;
  int bx = 0, by = 0;
  std::vector<double> row;  // clarities of the best shift's row
  for (int dy = -shifts; dy <= shifts; dy += stride) {
    const std::vector<double> now = answers(dy);
    for (int dx = -shifts; dx <= shifts; dx += stride) {
      const double v = now[dx + shifts];
      if (v > best.clarity) best.clarity = v, bx = dx, by = dy, row = now;
    }
  }
  Vec2 at{static_cast<double>(bx), static_cast<double>(by)};
  if (stride == 1 && !row.empty()) {  // the top of the parabola through three neighbours lies between samples
    const auto top = [&](double before, double here, double after) {
      const double bend = before - 2 * here + after;
      return bend < -1e-12 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
    };
    const std::size_t x = bx + shifts;
    if (std::abs(bx) < shifts) at.x += top(row[x - 1], best.clarity, row[x + 1]);
    if (std::abs(by) < shifts) at.y += top(answers(by - 1)[x], best.clarity, answers(by + 1)[x]);
  }
  best.off = step * at;
  return best;
}

}  // namespace

double meanClarity(const std::vector<SeenSpiral>& seen) {
  double sum = 0;
  for (const SeenSpiral& s : seen) sum += s.clarity;
  return sum / static_cast<double>(seen.size());
}

std::vector<SeenSpiral> findSpirals(const std::vector<CouponSpiral>& spirals, const FoundCoupon& found,
                                    const Tones& tones, double reach, int stride) {
  std::vector<SeenSpiral> seen;
  seen.reserve(spirals.size());
  for (const CouponSpiral& spiral : spirals) seen.push_back(lookFor(spiral, found, tones, reach, stride));
  return seen;
}

}  // namespace sillon
