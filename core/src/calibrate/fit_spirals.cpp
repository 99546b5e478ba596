#include "base/exact_math.hpp"
#include "calibrate/photo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace sillon {
namespace {

constexpr std::size_t kCamera = 9;   // of the globals, the first that is no light's: contrast, and then sharpening
constexpr double kUsualCurve = 0.1;  // of telephones
constexpr std::size_t kTerms = 2;  // of the light over the coupon: even, and by the distance from the picture's middle
constexpr std::size_t kVeil = 2 * kTerms;  // where the veil's terms begin: even, to the right, down
constexpr std::size_t kLight = kVeil + 3;
constexpr std::size_t kShared = kGlobals + kLight;  // unknowns,
constexpr std::size_t kOwn = 3;                     // and of each spiral
constexpr int kRounds = 30;
constexpr int kLaterRounds = 12;      // from a fit of the same spirals
constexpr double kTogether = 40;      // bins that are off alike: a guess, see docs/internals/photographs.md
constexpr int kFirstRounds = 5;       // for each beginning, to see which is the best
constexpr double kDoubt = 4;          // bins off by so many medians count half,
constexpr double kLeastDoubt = 0.05;  // or by this of the brightest, or in closed spirals, whose highlights may be
constexpr double kDoubtShare = 0.1;   // narrower than a bin, by this of their own brightness, which is the most
constexpr double kFaintVeil = 0.0025, kClearVeil = 0.01;            // by the brightest beads
constexpr double kFaintSharpening = 0.05, kClearSharpening = 0.15;  // share of what a blur takes off
constexpr double kUsualLobe = 0.15;                                 // [radians]

struct State {
  Globals globals;
  std::array<double, kLight> light{};  // of highlights, of what is sent in all directions, of the veil
  std::vector<Vec2> offsets;           // of the spirals from where the map has them [mm]
  std::vector<double> bases;           // light of what shows between a spiral's turns
};

class Fitter {
 public:
  Fitter(const std::vector<LitSpiral>& spirals, const SeenFrom& camera, const Elevation& elevation)
      : spirals_(spirals),
        camera_(camera),
        elevation_(elevation),
        model_(spirals, camera),
        trust_(spirals.size(), evenly()) {}

  [[nodiscard]] double brightest(double contrast) const { return model_.brightest(contrast); }

  /// Lets spirals move by themselves, by about so much [mm].
  void loosen(double reach) { together_ = kPriorWeight / (reach * reach); }

  /// Holds the tone curve to a telephone's: about wrong middles, it would bend to what does not fit.
  void holdCurve() { curveError_ = 0.02; }

  /// Most photographs have no veil and are not sharpened, others strongly: what is clearly found is held less.
  void expectAsFound(const State& state) {
    const auto held = [](double faint, double clear, double found) {
      return faint * (1 + (found / clear) * (found / clear));
    };
    const double brightest = model_.brightest(kUsualCurve);
    for (std::size_t k = 0; k < veilErrors_.size(); ++k) {
      veilErrors_[k] = held(kFaintVeil, kClearVeil, state.light[kVeil + k] / brightest);
    }
    sharpError_ = held(kFaintSharpening, kClearSharpening, state.globals[10]);
  }

  /// Lets bins count less that are off by far: base between loose turns, dirt, whatever the model does not know.
  void doubt(const State& state) {
    trust_.assign(spirals_.size(), evenly());
    std::vector<double> all;
    std::vector<Rows> off, bright;
    for (std::size_t k = 0; k < spirals_.size(); ++k) {
      const auto [weight, seen] = lightOf(k, state.globals[9]);
      const Rows shown = shownBy(k, state);
      off.emplace_back(), bright.emplace_back();
      for (std::size_t row = 0; row < kRows; ++row) {
        const double model = weight[row] * shown[row];
        off[k][row] = std::abs(model - seen[row]);
        bright[k][row] = std::max(model, seen[row]);
        if (weight[row] > 0) all.push_back(off[k][row]);
      }
    }
    if (all.empty()) return;
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    const double usual = std::max(kLeastDoubt, kDoubt * *middle);
    for (std::size_t k = 0; k < spirals_.size(); ++k) {
      const double share = spirals_[k].kind == SpiralKind::Loose ? 0 : kDoubtShare;
      for (std::size_t row = 0; row < kRows; ++row) {
        const double by = off[k][row] / std::max(share * bright[k][row], usual);
        trust_[k][row] = 1 / std::sqrt(1 + by * by);
      }
    }
  }

  /// Levenberg-Marquardt. \return the cost.
  double descend(State& state, int rounds, const RunContext& run) const {
    double lambda = 1e-2;
    double now = cost(state);
    for (int round = 0; round < rounds && !run.cancelled(); ++round) {
      const NormalEquations normal = assemble(state);
      bool better = false;
      for (int attempt = 0; attempt < 6 && !better; ++attempt) {
        NormalEquations damped = normal;
        for (std::size_t k = 0; k < normal.size; ++k) damped.at(k, k) += lambda * (normal.at(k, k) + 1e-9);
        const State tried = moved(state, damped.solved());
        const double then = cost(tried);
        if (then < now) {
          better = true;
          const bool small = now - then < 1e-5 * now;
          state = tried, now = then, lambda = std::max(1e-6, lambda / 5);
          if (small) return now;
        } else {
          lambda *= 6;
        }
      }
      if (!better) break;
    }
    return now;
  }

  /// Everything that is linear, evenly lit, as it fits best.
  State begin(const Globals& globals) const {
    State state{globals, {}, std::vector<Vec2>(spirals_.size()), {}};
    NormalEquations normal{3};
    for (std::size_t k = 0; k < 3; ++k) normal.at(k, k) = 1e-6;
    for (std::size_t k = 0; k < spirals_.size(); ++k) {
      const auto [weight, seen] = lightOf(k, globals[9]);
      const Basis basis = basisOf(k, globals, state.offsets[k]);
      for (std::size_t row = 0; row < kRows; ++row) {
        const double terms[] = {weight[row] * basis[row].x, weight[row] * basis[row].y, weight[row] * basis[row].z};
        normal.add(terms, seen[row], 1);
      }
    }
    const std::vector<double> gains = normal.solved();
    state.light[0] = gains[0], state.light[kTerms] = gains[1];
    state.bases.assign(spirals_.size(), gains[2]);
    return state;
  }

  /// Of the step that would take all that is left away.
  [[nodiscard]] NormalEquations assemble(const State& state) const {
    constexpr double kStep = 1e-4;
    constexpr std::size_t kColumns = kShared + kOwn;
    NormalEquations normal{kShared + kOwn * spirals_.size()};
    for (std::size_t k = 0; k < spirals_.size(); ++k) {
      const LitSpiral& s = spirals_[k];
      const auto light = lightOf(k, state.globals[9]);
      const SpiralModel::Shape shape = model_.shapeOf(k, state.globals);
      const Basis basis = model_.basisOf(k, shape, state.globals, state.offsets[k]);
      const Vec3 gains = gainsOf(k, state);
      std::vector<std::array<double, kColumns>> jacobian(kRows);  // first of the light on the camera
      Rows sent{};
      const double r = dot(s.fromAxis, s.fromAxis), veil = veilOf(k, state);
      for (std::size_t row = 0; row < kRows; ++row) {
        auto& of = jacobian[row];
        sent[row] = dot(basis[row], gains) + veil;
        of.fill(0);
        of[kGlobals] = basis[row].x, of[kGlobals + 1] = r * basis[row].x;
        of[kGlobals + kTerms] = basis[row].y, of[kGlobals + kTerms + 1] = r * basis[row].y;
        of[kGlobals + kVeil] = 1, of[kGlobals + kVeil + 1] = s.fromAxis.x, of[kGlobals + kVeil + 2] = s.fromAxis.y;
        of[kShared + 2] = basis[row].z;
      }
      const auto differ = [&](std::size_t column, const Basis& then) {
        for (std::size_t row = 0; row < kRows; ++row) {
          jacobian[row][column] = (dot(then[row], gains) + veil - sent[row]) / kStep;
        }
      };
      for (std::size_t p = 0; p < kCamera; ++p) {
        if (p == (s.kind == SpiralKind::Loose ? 5 : 6)) continue;  // the others' width
        Globals other = state.globals;
        other[p] += kStep;
        differ(p, model_.basisOf(k, p == 4 ? shape : model_.shapeOf(k, other), other, state.offsets[k]));
      }
      for (std::size_t p = 0; p < 2; ++p) {
        const Vec2 off = state.offsets[k] + (p == 0 ? Vec2{kStep, 0} : Vec2{0, kStep});
        differ(kShared + p, model_.basisOf(k, shape, state.globals, off));
        for (auto& of : jacobian) of[kGlobals - 2 + p] = of[kShared + p];
      }
      // Then of what the camera shows of it.
      const SpiralModel::Sharpened shown = model_.sharpened(k, sent, state.globals[9], state.globals[10]);
      Rows base{};
      std::vector<std::array<double, kColumns>> ofShown(kRows);
      for (std::size_t row = 0; row < kRows; ++row) {
        base[row] = light.weight[row] * shown.light[row] - light.seen[row];
        ofShown[row].fill(0);
        if (!(light.weight[row] > 0)) continue;
        const std::size_t first = row - row % kPhases;
        for (std::size_t q = 0; q < kPhases; ++q) {
          const double by = light.weight[row] * shown.by[row / kPhases][row % kPhases * kPhases + q];
          for (std::size_t column = 0; column < kColumns; ++column) {
            ofShown[row][column] += by * jacobian[first + q][column];
          }
        }
      }
      for (std::size_t p = kCamera; p < kCamera + 2; ++p) {  // as the weights know it, too
        Globals other = state.globals;
        other[p] += kStep;
        const auto then = lightOf(k, other[9]);
        const SpiralModel::Sharpened shownThen = model_.sharpened(k, sent, other[9], other[10]);
        for (std::size_t row = 0; row < kRows; ++row) {
          ofShown[row][p] = (then.weight[row] * shownThen.light[row] - then.seen[row] - base[row]) / kStep;
        }
      }
      NormalEquations own{kColumns};
      for (std::size_t row = 0; row < kRows; ++row) own.add(ofShown[row].data(), -base[row], 1);
      const auto place = [&](std::size_t column) { return column < kShared ? column : column + kOwn * k; };
      for (std::size_t i = 0; i < kColumns; ++i) {
        for (std::size_t j = 0; j < kColumns; ++j) normal.at(place(i), place(j)) += own.at(i, j);
        normal.right[place(i)] += own.right[i];
      }
      const double held[] = {state.offsets[k].x, state.offsets[k].y, state.bases[k]};
      for (std::size_t p = 0; p < kOwn; ++p) {
        const double weight = p < 2 ? together_ : kBaseWeight;
        normal.at(place(kShared + p), place(kShared + p)) += weight;
        normal.right[place(kShared + p)] -= weight * held[p];
      }
    }
    const Globals usual = usualOnes(), width = priorWidths();
    // What is known before are further equations.
    std::vector<double> terms(normal.size, 0);
    const auto know = [&](double off, double weight) {
      normal.add(terms.data(), -off, weight);
      std::fill(terms.begin(), terms.end(), 0);
    };
    for (std::size_t p = kVeil; p < kLight; ++p) {
      terms[kGlobals + p] = 1;
      know(state.light[p], veilWeight(p));
    }
    for (std::size_t p = 2; p < kGlobals; ++p) {
      terms[p] = 1;
      know(state.globals[p] - usual[p], kPriorWeight / (width[p] * width[p]));
    }
    const double high = offElevation(state.globals);
    for (std::size_t p = 0; p < 2; ++p) {
      Globals other = state.globals;
      other[p] += kStep;
      terms[p] = (offElevation(other) - high) / kStep;
    }
    know(high, kPriorWeight);
    terms[5] = -1, terms[6] = 1;
    know(state.globals[6] - state.globals[5], kPriorWeight / (kAlike * kAlike));
    return normal;
  }

  static Globals usualOnes() { return {0, 0, exact::log(0.01), exact::log(0.08), 0, 1, 1, 0, 1, kUsualCurve, 0, 0, 0}; }

 private:
  static constexpr std::size_t kRows = SpiralModel::kRows;
  static constexpr double kFarthest = 0.25;  // [mm]
  static constexpr double kPriorWeight = 1e-2;
  static constexpr double kBaseWeight = kPriorWeight;  // a base sends at most about as much as the brightest beads
  static constexpr double kAlike = 0.01;               // lone beads and those side by side are laid alike
  using Rows = SpiralModel::Rows;
  using Basis = SpiralModel::Basis;

  /// Of what is known before: a veil is faint, by the brightest beads.
  [[nodiscard]] double veilWeight(std::size_t term) const {
    const double usual = veilErrors_[term - kVeil] * model_.brightest(kUsualCurve);
    return kPriorWeight / (usual * usual);
  }

  static Rows evenly() {
    Rows ones{};
    ones.fill(1);
    return ones;
  }

  /// The lamp's elevation from what is known of it, by that error.
  [[nodiscard]] double offElevation(const Globals& g) const {
    const Vec3 lamp = lampOf({g[0], g[1]}, unit(camera_.place));
    const double degrees = exact::asin(std::clamp(lamp.z, -1.0, 1.0)) * 180 / std::numbers::pi;
    return (degrees - elevation_.value) / elevation_.error;
  }

  [[nodiscard]] Globals priorWidths() const {
    return {1, 1, 2, 1, 0.7, 0.08, 0.08, camera_.distanceError, 1, curveError_, sharpError_, 0.15, 0.15};
  }

  [[nodiscard]] SpiralModel::Light lightOf(std::size_t which, double contrast) const {
    SpiralModel::Light light = model_.lightOf(which, contrast);
    for (std::size_t row = 0; row < kRows; ++row) {
      light.weight[row] *= trust_[which][row];
      light.seen[row] *= trust_[which][row];
    }
    return light;
  }

  Basis basisOf(std::size_t which, const Globals& g, Vec2 off) const {
    return model_.basisOf(which, model_.shapeOf(which, g), g, off);
  }

  [[nodiscard]] double veilOf(std::size_t which, const State& state) const {
    const Vec2 axis = spirals_[which].fromAxis;
    const double* terms = state.light.data() + kVeil;
    return terms[0] + axis.x * terms[1] + axis.y * terms[2];
  }

  /// What the camera shows of a spiral.
  [[nodiscard]] Rows shownBy(std::size_t which, const State& state) const {
    const Basis basis = basisOf(which, state.globals, state.offsets[which]);
    const Vec3 gains = gainsOf(which, state);
    const double veil = veilOf(which, state);
    Rows sent{};
    for (std::size_t row = 0; row < kRows; ++row) sent[row] = dot(basis[row], gains) + veil;
    return model_.sharpened(which, sent, state.globals[9], state.globals[10]).light;
  }

  [[nodiscard]] Vec3 gainsOf(std::size_t which, const State& state) const {
    const double r = dot(spirals_[which].fromAxis, spirals_[which].fromAxis);
    return {state.light[0] + r * state.light[1], state.light[kTerms] + r * state.light[kTerms + 1], state.bases[which]};
  }

  double cost(const State& state) const {
    double sum = 0;
    for (std::size_t k = 0; k < spirals_.size(); ++k) {
      const auto [weight, seen] = lightOf(k, state.globals[9]);
      const Rows shown = shownBy(k, state);
      for (std::size_t row = 0; row < kRows; ++row) {
        const double off = weight[row] * shown[row] - seen[row];
        sum += off * off;
      }
      sum += together_ * dot(state.offsets[k], state.offsets[k]) + kBaseWeight * state.bases[k] * state.bases[k];
    }
    const Globals usual = usualOnes(), width = priorWidths();
    const auto known = [](double off) { return kPriorWeight * off * off; };
    for (std::size_t k = 2; k < kGlobals; ++k) sum += known((state.globals[k] - usual[k]) / width[k]);
    for (std::size_t k = kVeil; k < kLight; ++k) sum += veilWeight(k) * state.light[k] * state.light[k];
    return sum + known(offElevation(state.globals)) + known((state.globals[6] - state.globals[5]) / kAlike);
  }

  static State moved(const State& from, const std::vector<double>& step) {
    State to = from;
    Globals& g = to.globals;
    for (std::size_t p = 0; p < kGlobals; ++p) g[p] += step[p];
    for (std::size_t p = 0; p < kLight; ++p) to.light[p] += step[kGlobals + p];
    for (std::size_t k = 0; k < to.offsets.size(); ++k) {
      Vec2& off = to.offsets[k];
      const double* own = step.data() + kShared + kOwn * k;
      off = off + Vec2{own[0], own[1]};
      to.bases[k] += own[2];
      const double far = length(off);
      if (far > kFarthest) off = (kFarthest / far) * off;
    }
    const double size = exact::hypot(g[0], g[1]);
    if (size > 1.5) g[0] *= 1.5 / size, g[1] *= 1.5 / size;
    g[2] = std::clamp(g[2], exact::log(1e-5), exact::log(2.0));
    g[3] = std::clamp(g[3], exact::log(1e-4), exact::log(4.0));
    g[4] = std::clamp(g[4], exact::log(0.2), exact::log(8.0));
    g[5] = std::clamp(g[5], 0.6, 1.5);
    g[6] = std::clamp(g[6], 0.5, 1.8);
    g[7] = std::clamp(g[7], -1.5, 1.5);
    g[8] = std::clamp(g[8], 0.0, 5.0);
    g[9] = std::clamp(g[9], -0.3, 0.6);
    g[10] = std::clamp(g[10], -0.5, 4.0);
    return to;
  }

  const std::vector<LitSpiral>& spirals_;
  SeenFrom camera_;
  Elevation elevation_;
  SpiralModel model_;
  std::vector<Rows> trust_;  // in each bin
  double curveError_ = 0.15;
  // A veil and its terms by the brightest beads, and sharpening, as long as nobody has seen how strong they are.
  double sharpError_ = 0.5;
  std::array<double, kLight - kVeil> veilErrors_{0.1, 0.05, 0.05};
  double together_ = kPriorWeight / (0.05 * 0.05);  // what holds spirals where the map has them [1/mm²]
};

/// Where the lamp's azimuth must be, up to a half turn: beads shine that run across it.
double azimuthOf(const std::vector<LitSpiral>& spirals, double& contrast) {
  std::array<double, kAngles / 2> light{};
  for (const LitSpiral& s : spirals) {
    if (s.kind == SpiralKind::Loose) continue;
    for (int k = 0; k < kAngles; ++k) {
      for (const auto& bin : s.seen.bins[k]) {
        light[k % (kAngles / 2)] += bin.light;
      }
    }
  }
  double x = 0, y = 0;
  for (int k = 0; k < kAngles / 2; ++k) {
    const double twice = 4 * std::numbers::pi * (k + 0.5) / kAngles;
    x += light[k] * exact::cos(twice);
    y += light[k] * exact::sin(twice);
  }
  const auto [least, most] = std::minmax_element(light.begin(), light.end());
  contrast = *most / std::max(1e-9, *least);
  return 0.5 * exact::atan2(y, x);
}

}  // namespace

SpiralFit fitSpirals(const std::vector<LitSpiral>& spirals, const SeenFrom& camera, const Elevation& elevation,
                     const SpiralFit* before, const RunContext& run) {
  SpiralFit fit;
  const double azimuth = azimuthOf(spirals, fit.contrast);
  Fitter fitter(spirals, camera, elevation);
  double least = 1e300;
  State best;
  if (before != nullptr) {
    Globals g = before->globals;
    g[7] = g[11] = g[12] = 0;  // camera and middles are known better now
    best = fitter.begin(g);
    for (std::size_t k = 0; k < 3; ++k) best.light[kVeil + k] = before->veilTerms[k];
    fitter.expectAsFound(best);
  } else {
    fitter.holdCurve();
    fitter.loosen(0.002);
    for (const double side : {0.0, std::numbers::pi}) {
      for (const double size : {0.2, 0.5}) {
        Globals g = Fitter::usualOnes();
        g[0] = size * exact::cos(azimuth + side), g[1] = size * exact::sin(azimuth + side);
        g[2] = 2 * exact::log(kUsualLobe * size);
        State state = fitter.begin(g);
        const double cost = fitter.descend(state, kFirstRounds, run);
        if (cost < least) least = cost, best = std::move(state);
      }
    }
  }
  fitter.loosen(0.05);
  least = fitter.descend(best, before == nullptr ? kRounds : kLaterRounds, run);
  for (int k = 0; before != nullptr && k < 2; ++k) {
    fitter.doubt(best);
    fitter.expectAsFound(best);
    least = fitter.descend(best, kLaterRounds, run);
  }
  const Globals& found = best.globals;
  fit.globals = found;
  for (const Vec2 off : best.offsets) fit.offsets.push_back(off + Vec2{found[11], found[12]});
  fit.tilt = {found[0], found[1]};
  fit.alongVariance = exact::exp(found[2]);
  fit.acrossVariance = exact::exp(found[3]);
  fit.blur = exact::exp(found[4]);
  fit.closing = found[5];
  fit.lone = found[6];
  NormalEquations normal = fitter.assemble(best);
  for (std::size_t k = 0; k < spirals.size(); ++k) {
    const std::size_t at = kShared + kOwn * k;
    fit.surety.push_back({normal.at(at, at), normal.at(at, at + 1), normal.at(at + 1, at + 1)});
  }
  double rows = 0;
  for (const LitSpiral& s : spirals) {
    for (const auto& row : s.seen.bins) {
      for (const auto& bin : row) rows += bin.count >= 3 ? 1 : 0;
    }
  }
  fit.misfit = std::sqrt(least / std::max(1.0, rows));
  // What is left is no noise: neighbouring bins are off together.
  const double variance = kTogether * least / std::max(1.0, rows);
  for (std::size_t k = 0; k < normal.size; ++k) normal.at(k, k) += 1e-12;
  const std::vector<double> variances = normal.variances(fit.variances.size());
  for (std::size_t k = 0; k < variances.size(); ++k) fit.variances[k] = variance * variances[k];
  fit.diffuse = best.light[kTerms];
  for (std::size_t k = 0; k < 3; ++k) fit.veilTerms[k] = best.light[kVeil + k];
  fit.veil = best.light[kVeil] / fitter.brightest(found[9]);
  fit.sharpening = found[10];
  return fit;
}

}  // namespace sillon
