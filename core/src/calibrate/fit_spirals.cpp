#include "base/exact_math.hpp"
#include "calibrate/photo.hpp"

#include <algorithm>

namespace sillon {
namespace {

constexpr std::size_t kCamera = 9;   // index of the first global that acts on codes: contrast, then sharpening
constexpr double kUsualCurve = 0.1;  // contrast of a telephone's tone curve
// A light over the coupon has two terms: an even one, and one by the squared distance from the picture's middle.
constexpr std::size_t kTerms = 2;
constexpr std::size_t kVeil = 2 * kTerms;  // index of the veil's first term: even, to the right, down
constexpr std::size_t kLight = kVeil + 3;
constexpr std::size_t kShared = kGlobals + kLight;  // unknowns that all spirals share
constexpr std::size_t kOwn = 3;                     // unknowns of each spiral: its offset, and the light of its base
constexpr int kRounds = 30;                         // largest number of steps of the first fit
constexpr int kLaterRounds = 12;                    // largest number of steps that start from a fit of the same spirals
constexpr double kTogether = 40;  // bins whose residuals count as one: a guess, see docs/internals/photographs.md
constexpr int kFirstRounds = 5;   // steps from each starting point, before the best is chosen
// A bin counts half if its residual reaches the largest of these.
constexpr double kDoubt = 4;          // multiple of the median residual
constexpr double kLeastDoubt = 0.05;  // share of the brightest bin's light
constexpr double kDoubtShare = 0.1;  // share of its own light, in closed spirals: highlights may be narrower than a bin
// Veil and sharpening have priors around 0: the standard deviation where none is found, and the strength that
// doubles it.
constexpr double kFaintVeil = 0.0025, kClearVeil = 0.01;            // relative to the brightest beads' light
constexpr double kFaintSharpening = 0.05, kClearSharpening = 0.15;  // share of what a blur takes off
constexpr double kUsualLobe = 0.15;                                 // [radians] lobe width at the start, in bead angle

/// Values of all unknowns.
struct Unknowns {
  Globals globals;
  std::array<double, kLight> light{};  // terms of the highlights, of the light sent in all directions, of the veil
  std::vector<Vec2> offsets;           // offsets of the spirals from their places in the map [mm]
  std::vector<double> bases;           // light of the base that shows between a spiral's turns
};

/// Fits the appearance model to all bins at once, by weighted least squares with priors.
class Fitter {
 public:
  Fitter(const std::vector<LitSpiral>& spirals, const SeenFrom& camera, const Elevation& elevation)
      : spirals_(spirals),
        camera_(camera),
        elevation_(elevation),
        model_(spirals, camera),
        trust_(spirals.size(), evenly()) {}

  [[nodiscard]] double brightest(double contrast) const { return model_.brightest(contrast); }

  /// Sets how far a spiral may move on its own: the standard deviation of its offset's prior [mm].
  void loosen(double reach) { together_ = kPriorWeight / (reach * reach); }

  /// Holds the tone curve close to a telephone's. As long as the spirals' middles are wrong, a free curve would bend
  /// to fit their errors.
  void holdCurve() { curveError_ = 0.02; }

  /// Sets the priors of veil and sharpening by the values found. Most photographs have neither and some have much, so
  /// that the prior of a value that is clearly there is wide.
  void expectAsFound(const Unknowns& state) {
    const auto held = [](double faint, double clear, double found) {
      return faint * (1 + (found / clear) * (found / clear));
    };
    const double brightest = model_.brightest(kUsualCurve);
    for (std::size_t k = 0; k < veilErrors_.size(); ++k) {
      veilErrors_[k] = held(kFaintVeil, kClearVeil, state.light[kVeil + k] / brightest);
    }
    sharpError_ = held(kFaintSharpening, kClearSharpening, state.globals[10]);
  }

  /// Gives less weight to bins with large residuals: base between loose turns, dirt, anything that the model does not
  /// describe.
  void doubt(const Unknowns& state) {
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

  /// Minimises the cost by the method of Levenberg and Marquardt. \return the cost that is reached.
  double descend(Unknowns& state, int rounds, const RunContext& run) const {
    double lambda = 1e-2;
    double now = cost(state);
    for (int round = 0; round < rounds && !run.cancelled(); ++round) {
      const NormalEquations normal = assemble(state);
      bool better = false;
      for (int attempt = 0; attempt < 6 && !better; ++attempt) {
        NormalEquations damped = normal;
        for (std::size_t k = 0; k < normal.size; ++k) damped.at(k, k) += lambda * (normal.at(k, k) + 1e-9);
        const Unknowns tried = moved(state, damped.solved());
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

  /// Starts from given globals: solves for the light of highlight, body and base, which is linear, under even light.
  Unknowns begin(const Globals& globals) const {
    Unknowns state{globals, {}, std::vector<Vec2>(spirals_.size()), {}};
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

  /// Normal equations of the Gauss-Newton step, which would remove all residuals if the model were linear.
  [[nodiscard]] NormalEquations assemble(const Unknowns& state) const {
    constexpr double kStep = 1e-4;
    constexpr std::size_t kColumns = kShared + kOwn;
    NormalEquations normal{kShared + kOwn * spirals_.size()};
    for (std::size_t k = 0; k < spirals_.size(); ++k) {
      const LitSpiral& s = spirals_[k];
      const auto light = lightOf(k, state.globals[9]);
      const SpiralModel::Unblurred shape = model_.shapeOf(k, state.globals);
      const Basis basis = model_.basisOf(k, shape, state.globals, state.offsets[k]);
      const Vec3 gains = gainsOf(k, state);
      std::vector<std::array<double, kColumns>> jacobian(kRows);  // derivatives of the light that falls on the camera
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
        if (p == (s.kind == SpiralKind::Loose ? 5 : 6)) continue;  // a width of the other kind of spirals
        Globals other = state.globals;
        other[p] += kStep;
        differ(p, model_.basisOf(k, p == 4 ? shape : model_.shapeOf(k, other), other, state.offsets[k]));
      }
      for (std::size_t p = 0; p < 2; ++p) {
        const Vec2 off = state.offsets[k] + (p == 0 ? Vec2{kStep, 0} : Vec2{0, kStep});
        differ(kShared + p, model_.basisOf(k, shape, state.globals, off));
        // The offset that all spirals share acts as each one's own.
        for (auto& of : jacobian) of[kGlobals - 2 + p] = of[kShared + p];
      }
      // The chain rule leads to the derivatives of the light that the camera shows, after its unsharp mask.
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
      for (std::size_t p = kCamera; p < kCamera + 2; ++p) {  // the weights depend on the contrast, too
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
    // Prior knowledge enters as further equations.
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
  static constexpr double kFarthest = 0.25;            // [mm] largest offset of a spiral from its place in the map
  static constexpr double kPriorWeight = 1e-2;         // weight of a prior that is off by one standard deviation
  static constexpr double kBaseWeight = kPriorWeight;  // prior: a base sends at most about the brightest beads' light
  static constexpr double kAlike = 0.01;  // prior: lone beads are as wide as those side by side, within 1 %
  using Rows = SpiralModel::Rows;
  using Basis = SpiralModel::Basis;

  /// Weight of the prior that a veil is faint compared with the brightest beads.
  [[nodiscard]] double veilWeight(std::size_t term) const {
    const double usual = veilErrors_[term - kVeil] * model_.brightest(kUsualCurve);
    return kPriorWeight / (usual * usual);
  }

  static Rows evenly() {
    Rows ones{};
    ones.fill(1);
    return ones;
  }

  /// Deviation of the lamp's elevation from its prior, in standard deviations.
  [[nodiscard]] double offElevation(const Globals& g) const {
    const Vec3 lamp = lampOf({g[0], g[1]}, unit(camera_.place));
    const double degrees = exact::asin(std::clamp(lamp.z, -1.0, 1.0)) * 180 / std::numbers::pi;
    return (degrees - elevation_.value) / elevation_.error;
  }

  /// Standard deviations of the globals' priors. Those of the tilt are unused: its prior is the lamp's elevation.
  [[nodiscard]] Globals priorWidths() const {
    return {1, 1, 2, 1, 0.7, 0.08, 0.08, camera_.distanceError, 1, curveError_, sharpError_, 0.15, 0.15};
  }

  /// Light that the camera has seen, weighted by the trust in each bin.
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

  /// Light of the veil at a spiral's place.
  [[nodiscard]] double veilOf(std::size_t which, const Unknowns& state) const {
    const Vec2 axis = spirals_[which].fromAxis;
    const double* terms = state.light.data() + kVeil;
    return terms[0] + axis.x * terms[1] + axis.y * terms[2];
  }

  /// Light of a spiral as the camera shows it, with its unsharp mask.
  [[nodiscard]] Rows shownBy(std::size_t which, const Unknowns& state) const {
    const Basis basis = basisOf(which, state.globals, state.offsets[which]);
    const Vec3 gains = gainsOf(which, state);
    const double veil = veilOf(which, state);
    Rows sent{};
    for (std::size_t row = 0; row < kRows; ++row) sent[row] = dot(basis[row], gains) + veil;
    return model_.sharpened(which, sent, state.globals[9], state.globals[10]).light;
  }

  /// Light of highlight, body and base at a spiral's place: the factors of its Basis.
  [[nodiscard]] Vec3 gainsOf(std::size_t which, const Unknowns& state) const {
    const double r = dot(spirals_[which].fromAxis, spirals_[which].fromAxis);
    return {state.light[0] + r * state.light[1], state.light[kTerms] + r * state.light[kTerms + 1], state.bases[which]};
  }

  /// Sum of the weighted squares of all residuals and priors.
  double cost(const Unknowns& state) const {
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

  /// Takes a step, and keeps every unknown within its range.
  static Unknowns moved(const Unknowns& from, const std::vector<double>& step) {
    Unknowns to = from;
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
  std::vector<Rows> trust_;   // factor on each bin's residual, 0..1
  double curveError_ = 0.15;  // standard deviation of the contrast's prior
  // Standard deviations of the priors of sharpening and of the veil's terms, the latter relative to the brightest
  // beads' light. They are wide until expectAsFound sets them.
  double sharpError_ = 0.5;
  std::array<double, kLight - kVeil> veilErrors_{0.1, 0.05, 0.05};
  double together_ = kPriorWeight / (0.05 * 0.05);  // weight that holds spirals at their places in the map [1/mm²]
};

/// Azimuth of the tilt, up to half a turn: beads that run across it shine most.
/// \param[out] contrast  ratio of the brightest direction's light to the darkest one's.
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
  Unknowns best;
  if (before != nullptr) {
    Globals g = before->globals;
    g[7] = g[11] = g[12] = 0;  // camera and middles are better known now, so these start from 0
    best = fitter.begin(g);
    for (std::size_t k = 0; k < 3; ++k) best.light[kVeil + k] = before->veilTerms[k];
    fitter.expectAsFound(best);
  } else {
    fitter.holdCurve();
    fitter.loosen(0.002);
    // The azimuth is known up to half a turn only, and the size of the tilt is not: the best of four starts goes on.
    for (const double side : {0.0, std::numbers::pi}) {
      for (const double size : {0.2, 0.5}) {
        Globals g = Fitter::usualOnes();
        g[0] = size * exact::cos(azimuth + side), g[1] = size * exact::sin(azimuth + side);
        g[2] = 2 * exact::log(kUsualLobe * size);
        Unknowns state = fitter.begin(g);
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
  // Residuals are not independent noise: neighbouring bins are off together.
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
