#include "base/exact_math.hpp"
#include "calibrate/photo.hpp"

#include <algorithm>

#include "calibrate/prints.hpp"
#include "look/rasters.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/look/inversion.hpp"

namespace sillon {
namespace {

constexpr int kFine = 24;                       // places across a pitch
constexpr double kGauss = 0.28867513459481287;  // 1/(2√3): distance of Gauss's two points from an interval's middle
constexpr double kInGap = 0.3;                  // light of a place in shadow, relative to the body's
constexpr double kLeadSpread = 0.15;            // variance of 1 / r over a spiral, relative to its mean's square
constexpr double kSharp = 1.5;                  // [pixels] standard deviation of an unsharp mask's blur
constexpr double kEdge = 0.9;  // height of the edge that casts a bead's shadow over the layer's: beads are round

using Amplitude = SpiralModel::Amplitude;
using Pattern = SpiralModel::Pattern;
constexpr std::size_t kHarmonics = SpiralModel::kHarmonics;
constexpr std::size_t kPoints = std::size_t{2} * kAngles;

Amplitude amplitudeOf(double size, double angle) { return {size * exact::cos(angle), size * exact::sin(angle)}; }

Amplitude product(Amplitude a, Amplitude b) { return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re}; }

/// Place i across a bead, outward from its middle [pitch].
double placeOf(int i) { return (i + 0.5) / kFine - 0.5; }

/// Tables of waves and directions, which are the same for all spirals.
struct Waves {
  std::array<Pattern, kFine> fine;      // harmonics at place k, which patternOf sums
  std::array<Pattern, kPhases> phase;   // harmonics at phase k, averaged over its bin
  std::array<Vec2, kPoints> outward{};  // unit vectors towards Gauss's two points of each angle
  std::array<double, kPhases> turn{};   // cosine of phase k
};

const Waves& waves() {
  static const Waves made = [] {
    Waves w;
    for (std::size_t h = 0; h < kHarmonics; ++h) {
      const auto turns = 2 * std::numbers::pi * static_cast<double>(h);
      for (int k = 0; k < kFine; ++k) w.fine[k][h] = amplitudeOf(1.0 / kFine, -turns * placeOf(k));
      const double x = turns / (2 * kPhases);
      const double mean = h == 0 ? 1 : 2 * exact::sin(x) / x;
      for (int k = 0; k < kPhases; ++k) {
        w.phase[k][h] = amplitudeOf(mean, turns * (k + 0.5) / kPhases);
      }
    }
    for (std::size_t k = 0; k < kPhases; ++k) {
      w.turn[k] = exact::cos(2 * std::numbers::pi * static_cast<double>(k) / kPhases);
    }
    for (std::size_t k = 0; k < kPoints; ++k) {
      const double in = k % 2 == 0 ? 0.5 - kGauss : 0.5 + kGauss;
      const double angle = 2 * std::numbers::pi * (static_cast<double>(k / 2) + in) / kAngles;
      w.outward[k] = {exact::cos(angle), exact::sin(angle)};
    }
    return w;
  }();
  return made;
}

/// Fourier coefficients of values across a pitch.
Pattern patternOf(const std::array<double, kFine>& values) {
  const Waves& w = waves();
  Pattern out{};
  for (std::size_t i = 0; i < kFine; ++i) {
    if (values[i] == 0) continue;
    for (std::size_t h = 0; h < kHarmonics; ++h) {
      out[h].re += values[i] * w.fine[i][h].re;
      out[h].im += values[i] * w.fine[i][h].im;
    }
  }
  return out;
}

/// A code, its light, and the derivative of the light with respect to the code.
struct Point {
  double code, light, slope;
};

/// Tone curve of a camera over a code: it adds contrast.
double bent(double x, double contrast) { return x + contrast * (x * x * (3 - 2 * x) - x); }

/// Derivative of light with respect to its sRGB code; the straight part goes on below black.
double slopeOf(double x, double light) { return x > 0.04045 ? 2.4 * light / (x + 0.055) : 1 / 12.92; }

/// Code that the camera gives to light.
Point codeAt(double light, double contrast) {
  const double x =
      light > 0.0031308 ? static_cast<double>(codeOfLight(static_cast<float>(std::min(1.0, light)))) : 12.92 * light;
  return {bent(x, contrast), light, slopeOf(x, light) / (1 + contrast * (6 * x * (1 - x) - 1))};
}

/// Light to which the camera gives a code: the inverse of codeAt, by Newton's method.
Point lightAt(double code, double contrast) {
  double x = code;
  for (int k = 0; k < 4; ++k) {
    x = std::clamp(x - (bent(x, contrast) - code) / (1 + contrast * (6 * x * (1 - x) - 1)), 0.0, 1.0);
  }
  const auto light = static_cast<double>(lightOfCode(static_cast<float>(x)));
  const double slope = code > 0 && code < 1 ? slopeOf(x, light) / (1 + contrast * (6 * x * (1 - x) - 1)) : 0;
  return {code, light, slope};
}

double straightened(double code, double contrast) { return lightAt(code, contrast).light; }

}  // namespace

Vec2 tiltAt(Vec3 lamp, Vec3 eye) {
  const Vec3 h = lamp + eye;
  const double by = 1 / std::max(1e-3, h.z);
  return {by * h.x, by * h.y};
}

Vec3 lampOf(Vec2 tilt, Vec3 eye) {
  const Vec3 h = unit(Vec3{tilt.x, tilt.y, 1});
  return 2 * dot(h, eye) * h - eye;
}

SpiralModel::SpiralModel(const std::vector<LitSpiral>& spirals, const SeenFrom& camera)
    : spirals_(spirals), camera_(camera), profile_(static_cast<double>(lobeOf({}, {}).profile)) {
  for (const LitSpiral& s : spirals) {
    Rows code{};
    for (std::size_t k = 0; k < kRows; ++k) {
      const auto& bin = s.seen.bins[k / kPhases][k % kPhases];
      code[k] = bin.count < 3 ? -1 : static_cast<double>(codeOfLight(static_cast<float>(bin.light)));
      brightest_ = std::max(brightest_, code[k]);
    }
    codes_.push_back(code);
  }
}

double SpiralModel::brightest(double contrast) const { return straightened(brightest_, contrast); }

SpiralModel::Light SpiralModel::lightOf(std::size_t which, double contrast) const {
  const double most = brightest(contrast);
  Light out{};
  for (std::size_t k = 0; k < kRows; ++k) {
    const double code = codes_[which][k];
    const double light = code < 0 ? 0 : straightened(code, contrast);
    out.weight[k] = code < 0 ? 0 : 1 / std::sqrt(most * (light + 0.02 * most));
    out.seen[k] = out.weight[k] * light;
  }
  return out;
}

SpiralModel::Sharpened SpiralModel::sharpened(std::size_t which, const Rows& light, double contrast,
                                              double amount) const {
  const LitSpiral& s = spirals_[which];
  const double w = 2 * std::numbers::pi / s.spiral.pitch;
  Sharpened out;
  for (std::size_t k = 0; k < kAngles; ++k) {
    const double angle = 2 * std::numbers::pi * (static_cast<double>(k) + 0.5) / kAngles;
    const Vec2 n{exact::cos(angle), exact::sin(angle)};
    const double x = dot(n, s.blurX), y = dot(n, s.blurY);
    const double rate = 0.5 * w * w * kSharp * kSharp * (x * x + y * y);
    std::array<double, kPhases> kernel{};  // weight of a phase at each distance [phases]
    for (int h = 0; h < kPhases; ++h) {
      const int turns = std::min(h, kPhases - h);
      const double factor = 1 + amount * (1 - exact::exp(-rate * turns * turns));
      for (std::size_t d = 0; d < kPhases; ++d) kernel[d] += factor * waves().turn[(h * d) % kPhases] / kPhases;
    }
    std::array<Point, kPhases> points;
    for (std::size_t p = 0; p < kPhases; ++p) points[p] = codeAt(light[k * kPhases + p], contrast);
    for (std::size_t p = 0; p < kPhases; ++p) {
      double code = 0;
      for (std::size_t q = 0; q < kPhases; ++q) code += kernel[(p + kPhases - q) % kPhases] * points[q].code;
      const Point there = lightAt(code, contrast);
      out.light[k * kPhases + p] = there.light;
      for (std::size_t q = 0; q < kPhases; ++q) {
        out.by[k][p * kPhases + q] = there.slope * kernel[(p + kPhases - q) % kPhases] / points[q].slope;
      }
    }
  }
  return out;
}

SpiralModel::Unblurred SpiralModel::shapeOf(std::size_t which, const Globals& g) const {
  const LitSpiral& s = spirals_[which];
  const bool loose = s.kind == SpiralKind::Loose;
  const double pitch = s.spiral.pitch;
  const Vec3 middle{s.spiral.centre.x - kCouponSide / 2, s.spiral.centre.y - kCouponSide / 2, 0};
  const Vec3 from = exact::exp(g[7]) * camera_.place;
  const Vec3 lamp = lampOf({g[0], g[1]}, unit(camera_.place));
  const double va = exact::exp(g[2]), vc = exact::exp(g[3]);
  const double half = 0.5 * s.flow * (loose ? g[6] : g[5]) * s.width / pitch;  // [pitch]
  const double lead = pitch / (2 * std::numbers::pi) * s.seen.meanInverseRadius;
  // Reach of a bead that hides the gap outward of it, from the lamp or from the camera [pitch].
  const auto reach = [&](Vec3 towards) {
    const double by = -kEdge * s.height / pitch / std::max(0.1, towards.z);
    return Vec2{by * towards.x, by * towards.y};
  };
  const Vec2 shadow = reach(unit(lamp - 1e-3 * g[8] * middle)), hidden = reach(unit(from - middle));
  constexpr double kPiece = 2 * std::numbers::pi / kSpiralSteps;
  const double spread = kPiece * kPiece / 12 + lead * lead * kLeadSpread;
  Unblurred shape;
  const Vec3 way = lamp - 1e-3 * g[8] * middle;
  shape.light = 1 / dot(way, way);    // the light falls with the square of the distance
  std::array<double, kFine> share{};  // share of each place that the bead covers: smooth in its width
  int first = kFine, last = -1;
  for (int i = 0; i < kFine; ++i) {
    const double here = std::clamp((half - std::abs(placeOf(i))) * kFine + 0.5, 0.0, 1.0);
    share[i] = here;
    if (here > 0) first = std::min(first, i), last = i;
  }
  shape.body = patternOf(share);
  for (std::size_t k = 0; k < kPoints; ++k) {
    const Vec2 n = waves().outward[k];
    const Vec2 ahead = Vec2{-n.y, n.x} + lead * n;
    const Vec2 t = (1 / length(ahead)) * ahead;
    const Vec3 at = middle + (1 / s.seen.meanInverseRadius) * Vec3{n.x, n.y, 0};
    const Vec2 m = tiltAt(unit(lamp - 1e-3 * g[8] * at), unit(from - at));
    const double a = dot(m, t), c = cross(t, m);
    // Directions spread within a bin: turns consist of straight pieces, and larger ones lead outward less.
    const double wide = va + spread * c * c;
    const double along = std::sqrt(va / wide) * exact::exp(-a * a / (2 * wide));
    // The slope across a bead falls outward; left of the bead is inward. At even steps exp(-(c + slope)²/2vc) follows
    // from running products. They start at its largest value, as it may vanish elsewhere.
    const double rate = profile_ / half;
    const int top = std::clamp(static_cast<int>(std::lround((0.5 - c / rate) * kFine - 0.5)), first, last);
    const double across = c + rate * placeOf(top), step = rate / kFine;
    const double bend = exact::exp(-step * step / vc);
    std::array<double, kFine> lit{};
    for (const int way : {1, -1}) {
      double value = along * exact::exp(-across * across / (2 * vc));
      double ratio = exact::exp(-(2 * way * across * step + step * step) / (2 * vc));
      for (int i = top; i >= first && i <= last; i += way) {
        lit[i] = share[i] * value;
        value *= ratio;
        ratio *= bend;
      }
    }
    shape.shine[k] = patternOf(lit);
    std::array<double, kFine> open{};  // share of each place where the base is lit and seen
    const double lowest = half + std::max({0.0, dot(shadow, n), dot(hidden, n)});
    const double highest = 1 - half + std::min({0.0, dot(shadow, n), dot(hidden, n)});
    for (int i = 0; i < kFine && lowest < highest; ++i) {
      const double x = placeOf(i), y = x < 0 ? x + 1 : x;
      const double begin = std::max(lowest, y - 0.5 / kFine), end = std::min(highest, y + 0.5 / kFine);
      open[i] = kFine * std::max(0.0, end - begin);
    }
    shape.floor[k] = patternOf(open);
  }
  return shape;
}

SpiralModel::Basis SpiralModel::basisOf(std::size_t which, const Unblurred& shape, const Globals& g, Vec2 off) const {
  const LitSpiral& s = spirals_[which];
  const double pitch = s.spiral.pitch, blur = exact::exp(g[4]);
  const Vec2 shifted = off + Vec2{g[11], g[12]};
  const auto add = [](Amplitude& sum, Amplitude by) { sum.re += by.re, sum.im += by.im; };
  const Waves& waving = waves();
  Basis basis;
  for (std::size_t k = 0; k < kAngles; ++k) {
    Pattern body{}, shine{}, floor{};
    for (std::size_t at = 2 * k; at < 2 * k + 2; ++at) {  // two points give the mean over the bin
      const Vec2 n = waving.outward[at];
      const double x = dot(n, s.blurX), y = dot(n, s.blurY);
      const double w = 2 * std::numbers::pi / pitch;
      // A Gaussian blur multiplies harmonic h by b^(h²): from one harmonic to the next by b, b³, b⁵ ...
      const double least = exact::exp(-0.5 * w * w * blur * blur * (x * x + y * y));
      const Amplitude turn = amplitudeOf(1, -w * dot(shifted, n));
      Amplitude move{0.5, 0};
      double by = least;
      for (std::size_t h = 0; h < kHarmonics; ++h) {
        add(body[h], product(shape.body[h], move));
        add(shine[h], product(shape.shine[at][h], move));
        add(floor[h], product(shape.floor[at][h], move));
        move = product(move, {by * turn.re, by * turn.im});
        by *= least * least;
      }
    }
    for (std::size_t p = 0; p < kPhases; ++p) {
      double covered = 0, lit = 0, open = 0;
      for (std::size_t h = 0; h < kHarmonics; ++h) {
        const Amplitude wave = waving.phase[p][h];
        covered += body[h].re * wave.re - body[h].im * wave.im;
        lit += shine[h].re * wave.re - shine[h].im * wave.im;
        open += floor[h].re * wave.re - floor[h].im * wave.im;
      }
      const std::size_t row = k * kPhases + p;
      basis[row] = shape.light * Vec3{lit, covered + kInGap * (1 - covered), open};
    }
  }
  return basis;
}

}  // namespace sillon
