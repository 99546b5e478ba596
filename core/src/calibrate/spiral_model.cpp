#include "calibrate/spiral_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "calibrate/pieces.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/look/tones.hpp"

namespace sillon {
namespace {

constexpr int kFine = 24;  // places across a pitch
constexpr double kGauss = 0.28867513459481287;
constexpr double kInGap = 0.3;        // light of a place in shadow, by what beads send in all directions
constexpr double kLeadSpread = 0.15;  // variance of 1 / r over a spiral, by its mean's square
constexpr double kEdge = 0.9;         // height of what casts a bead's shadow, by the layer's: its edges are round

using Wave = SpiralModel::Wave;
using Pattern = SpiralModel::Pattern;
constexpr int kHarmonics = SpiralModel::kHarmonics;

Wave waveOf(double size, double angle) { return {size * std::cos(angle), size * std::sin(angle)}; }

void addProduct(Wave& sum, const Wave& a, const Wave& b) {
  sum.re += a.re * b.re - a.im * b.im;
  sum.im += a.re * b.im + a.im * b.re;
}

double placeOf(int i) { return (i + 0.5) / kFine - 0.5; }  // outward, from the bead's middle [pitch]

struct Waves {
  std::array<std::array<Wave, kFine>, kHarmonics> fine;     // of place k
  std::array<std::array<Wave, kPhases>, kHarmonics> phase;  // at phase k, averaged over its bin
};

const Waves& waves() {
  static const Waves made = [] {
    Waves w;
    for (int h = 0; h < kHarmonics; ++h) {
      for (int k = 0; k < kFine; ++k) {
        w.fine[static_cast<std::size_t>(h)][static_cast<std::size_t>(k)] =
            waveOf(1.0 / kFine, -2 * std::numbers::pi * h * placeOf(k));
      }
      const double x = std::numbers::pi * h / kPhases;
      const double mean = h == 0 ? 1 : std::sin(x) / x;
      for (int k = 0; k < kPhases; ++k) {
        w.phase[static_cast<std::size_t>(h)][static_cast<std::size_t>(k)] =
            waveOf(h == 0 ? 1 : 2 * mean, 2 * std::numbers::pi * h * (k + 0.5) / kPhases);
      }
    }
    return w;
  }();
  return made;
}

Pattern patternOf(const std::array<double, kFine>& values) {
  Pattern out{};
  for (std::size_t h = 0; h < kHarmonics; ++h) {
    for (std::size_t i = 0; i < kFine; ++i) {
      out[h].re += values[i] * waves().fine[h][i].re;
      out[h].im += values[i] * waves().fine[h][i].im;
    }
  }
  return out;
}

/// Undoes code + contrast (3 code² - 2 code³ - code), by Newton's method. \return light.
double straightened(double code, double contrast) {
  double x = code;
  for (int k = 0; k < 4; ++k) {
    const double off = x + contrast * (x * x * (3 - 2 * x) - x) - code;
    x = std::clamp(x - off / (1 + contrast * (6 * x * (1 - x) - 1)), 0.0, 1.0);
  }
  return static_cast<double>(lightOfCode(static_cast<float>(x)));
}

}  // namespace

Eigen::Vector2d tiltAt(const Eigen::Vector3d& lamp, const Eigen::Vector3d& eye) {
  const Eigen::Vector3d h = lamp + eye;
  return h.head<2>() / std::max(1e-3, h[2]);
}

Eigen::Vector3d lampOf(const Eigen::Vector2d& tilt, const Eigen::Vector3d& eye) {
  const Eigen::Vector3d h = Eigen::Vector3d(tilt[0], tilt[1], 1).normalized();
  return 2 * h.dot(eye) * h - eye;
}

SpiralModel::SpiralModel(const std::vector<LitSpiral>& spirals, const SeenFrom& camera)
    : spirals_(spirals), camera_(camera), profile_(static_cast<double>(lobeOf({}, {}).profile)) {
  for (const LitSpiral& s : spirals) {
    Rows code;
    for (int k = 0; k < kRows; ++k) {
      const auto& bin = s.seen.bins[static_cast<std::size_t>(k / kPhases)][static_cast<std::size_t>(k % kPhases)];
      code[k] = bin.count < 3 ? -1 : static_cast<double>(codeOfLight(static_cast<float>(bin.light)));
      brightest_ = std::max(brightest_, code[k]);
    }
    codes_.push_back(code);
  }
}

SpiralModel::Light SpiralModel::lightOf(std::size_t which, double contrast) const {
  const double most = straightened(brightest_, contrast);
  Light out;
  for (int k = 0; k < kRows; ++k) {
    const double code = codes_[which][k];
    const double light = code < 0 ? 0 : straightened(code, contrast);
    out.weight[k] = code < 0 ? 0 : 1 / std::sqrt(most * (light + 0.02 * most));
    out.seen[k] = out.weight[k] * light;
  }
  return out;
}

SpiralModel::Shape SpiralModel::shapeOf(std::size_t which, const Globals& g) const {
  const LitSpiral& s = spirals_[which];
  const bool loose = s.kind == SpiralKind::Loose;
  const double pitch = s.spiral.pitch;
  const Eigen::Vector3d middle(s.spiral.centre.x - kCouponSide / 2, s.spiral.centre.y - kCouponSide / 2, 0);
  const Eigen::Vector3d from = std::exp(g[7]) * camera_.place;
  const Eigen::Vector3d lamp = lampOf(g.head<2>(), camera_.place.normalized());
  const double va = std::exp(g[2]), vc = std::exp(g[3]);
  const double half = 0.5 * s.flow * (loose ? g[6] : g[5]) * s.width / pitch;  // [pitch]
  const double lead = pitch / (2 * std::numbers::pi) * s.seen.meanInverseRadius;
  // How far a bead hides the gap outward of it from the lamp and from the camera [pitch].
  const Eigen::Vector3d eye = (from - middle).normalized(), ray = (lamp - 1e-3 * g[8] * middle).normalized();
  const Eigen::Vector2d shadow = -kEdge * s.height / pitch / std::max(0.1, ray[2]) * ray.head<2>();
  const Eigen::Vector2d hidden = -kEdge * s.height / pitch / std::max(0.1, eye[2]) * eye.head<2>();
  constexpr double kPiece = 2 * std::numbers::pi / kSpiralSteps;
  const double spread = kPiece * kPiece / 12 + lead * lead * kLeadSpread;
  Shape shape;
  shape.light = 1 / (lamp - 1e-3 * g[8] * middle).squaredNorm();  // falls off with the distance
  std::array<double, kFine> share{};                              // of a place that is bead: smooth in the width
  int first = kFine, last = -1;
  for (int i = 0; i < kFine; ++i) {
    const double here = std::clamp((half - std::abs(placeOf(i))) * kFine + 0.5, 0.0, 1.0);
    share[static_cast<std::size_t>(i)] = here;
    if (here > 0) first = std::min(first, i), last = i;
  }
  shape.body = patternOf(share);
  for (int k = 0; k < 2 * kAngles; ++k) {
    const double angle = 2 * std::numbers::pi * (k / 2 + (k % 2 == 0 ? 0.5 - kGauss : 0.5 + kGauss)) / kAngles;
    const Eigen::Vector2d n(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d t = (Eigen::Vector2d(-n[1], n[0]) + lead * n).normalized();
    const Eigen::Vector3d at = middle + Eigen::Vector3d(n[0], n[1], 0) / s.seen.meanInverseRadius;
    const Eigen::Vector2d m = tiltAt((lamp - 1e-3 * g[8] * at).normalized(), (from - at).normalized());
    const double a = m.dot(t), c = t[0] * m[1] - t[1] * m[0];
    // Directions within a bin differ: a spiral's turns are made of straight pieces, and lead outward less the larger.
    const double wide = va + spread * c * c;
    const double along = std::sqrt(va / wide) * std::exp(-a * a / (2 * wide));
    // The top falls outward: to the left is inward. exp(-(c + slope)²/2vc) at even steps is a product of products,
    // from its largest place on, as it vanishes elsewhere.
    const double rate = profile_ / half;
    const int top = std::clamp(static_cast<int>(std::lround((0.5 - c / rate) * kFine - 0.5)), first, last);
    const double across = c + rate * placeOf(top), step = rate / kFine;
    const double bend = std::exp(-step * step / vc);
    std::array<double, kFine> lit{};
    for (const int way : {1, -1}) {
      double value = along * std::exp(-across * across / (2 * vc));
      double ratio = std::exp(-(2 * way * across * step + step * step) / (2 * vc));
      for (int i = top; i >= first && i <= last; i += way) {
        lit[static_cast<std::size_t>(i)] = share[static_cast<std::size_t>(i)] * value;
        value *= ratio;
        ratio *= bend;
      }
    }
    shape.shine[static_cast<std::size_t>(k)] = patternOf(lit);
    if (!loose) continue;
    std::array<double, kFine> open{};  // the part of the gap that is lit and seen
    const double lowest = half + std::max({0.0, shadow.dot(n), hidden.dot(n)});
    const double highest = 1 - half + std::min({0.0, shadow.dot(n), hidden.dot(n)});
    for (int i = 0; i < kFine; ++i) {
      const double x = placeOf(i), y = x < 0 ? x + 1 : x;
      open[static_cast<std::size_t>(i)] =
          std::clamp((y - lowest) * kFine + 0.5, 0.0, 1.0) * std::clamp((highest - y) * kFine + 0.5, 0.0, 1.0);
    }
    shape.floor[static_cast<std::size_t>(k)] = patternOf(open);
  }
  return shape;
}

SpiralModel::Basis SpiralModel::basisOf(std::size_t which, const Shape& shape, const Globals& g,
                                        const Eigen::Vector2d& off, const Rows& weights) const {
  const LitSpiral& s = spirals_[which];
  const bool loose = s.kind == SpiralKind::Loose;
  const double pitch = s.spiral.pitch, blur = std::exp(g[4]);
  Basis basis;
  for (int k = 0; k < kAngles; ++k) {
    Pattern body{}, shine{}, floor{};
    for (int point = 0; point < 2; ++point) {  // the mean over the bin, by Gauss's two points
      const double angle = 2 * std::numbers::pi * (k + (point == 0 ? 0.5 - kGauss : 0.5 + kGauss)) / kAngles;
      const Eigen::Vector2d n(std::cos(angle), std::sin(angle));
      const double sigma = blur * std::sqrt(n.dot(s.blurShape * n)) / pitch;
      const double shift = (off + g.tail<2>()).dot(n) / pitch;
      const auto at = static_cast<std::size_t>(2 * k + point);
      for (std::size_t h = 0; h < kHarmonics; ++h) {
        const double w = 2 * std::numbers::pi * static_cast<double>(h);
        const Wave move = waveOf(0.5 * std::exp(-0.5 * w * w * sigma * sigma), -w * shift);
        addProduct(body[h], shape.body[h], move);
        addProduct(shine[h], shape.shine[at][h], move);
        if (loose) addProduct(floor[h], shape.floor[at][h], move);
      }
    }
    for (int p = 0; p < kPhases; ++p) {
      double covered = 0, lit = 0, open = 0;
      for (std::size_t h = 0; h < kHarmonics; ++h) {
        const Wave& wave = waves().phase[h][static_cast<std::size_t>(p)];
        covered += body[h].re * wave.re - body[h].im * wave.im;
        lit += shine[h].re * wave.re - shine[h].im * wave.im;
        open += floor[h].re * wave.re - floor[h].im * wave.im;
      }
      const int row = k * kPhases + p;
      const double weight = shape.light * weights[row];
      basis(row, 0) = weight * lit;
      basis(row, 1) = weight * (covered + kInGap * (1 - covered));
      basis(row, 2) = weight * open;
    }
  }
  return basis;
}

}  // namespace sillon
