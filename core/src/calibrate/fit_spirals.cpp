#include "calibrate/fit_spirals.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "calibrate/spiral_model.hpp"

namespace sillon {
namespace {

constexpr int kNumeric = 10;         // of the globals, the derivatives that are differences
constexpr double kUsualCurve = 0.1;  // of telephones
constexpr int kTerms = 2;  // of the light over the coupon: even, and by the distance from the picture's middle
constexpr int kGaps = kLooseSpirals;  // the base shines differently under each
constexpr int kLight = 2 * kTerms + kGaps;
constexpr int kRounds = 30;
constexpr int kLaterRounds = 12;      // from a fit of the same spirals
constexpr double kTogether = 40;      // bins that are off alike: a guess, see docs/internals/photographs.md
constexpr int kFirstRounds = 5;       // for each beginning, to see which is the best
constexpr double kDoubt = 4;          // bins off by so many medians count half,
constexpr double kLeastDoubt = 0.05;  // or by this of the brightest, or in closed spirals, whose highlights may be
constexpr double kDoubtShare = 0.1;   // narrower than a bin, by this of their own brightness, which is the most
constexpr double kUsualLobe = 0.15;   // [radians]

struct State {
  Globals globals;
  Eigen::Matrix<double, kLight, 1> light;  // of highlights, of what is sent in all directions, between loose turns
  std::vector<Eigen::Vector2d> offsets;    // of the spirals from where the map has them [mm]
};

class Fitter {
 public:
  Fitter(const std::vector<LitSpiral>& spirals, const SeenFrom& camera, const Elevation& elevation)
      : spirals_(spirals),
        camera_(camera),
        elevation_(elevation),
        model_(spirals, camera),
        trust_(spirals.size(), Rows::Ones()) {}

  /// Lets spirals move by themselves, by about so much [mm].
  void loosen(double reach) { together_ = kPriorWeight / (reach * reach); }

  /// Lets bins count less that are off by far: base between loose turns, dirt, whatever the model does not know.
  void doubt(const State& state) {
    for (Rows& trust : trust_) trust.setOnes();
    std::vector<double> all;
    std::vector<Rows> off, bright;
    for (std::size_t k = 0; k < spirals_.size(); ++k) {
      const auto [weight, seen] = lightOf(k, state.globals[9]);
      const Rows model = basisOf(k, state.globals, state.offsets[k], weight) * gainsOf(k, state);
      off.push_back((model - seen).cwiseAbs());
      bright.push_back(model.cwiseMax(seen));
      for (int row = 0; row < kRows; ++row) {
        if (weight[row] > 0) all.push_back(off.back()[row]);
      }
    }
    if (all.empty()) return;
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    const double usual = std::max(kLeastDoubt, kDoubt * *middle);
    for (std::size_t k = 0; k < spirals_.size(); ++k) {
      const double share = spirals_[k].kind == SpiralKind::Loose ? 0 : kDoubtShare;
      const Rows by = off[k].cwiseQuotient((share * bright[k]).cwiseMax(usual));
      trust_[k] = (1 + by.array().square()).rsqrt().matrix();
    }
  }

  /// Levenberg-Marquardt. \return the cost.
  double descend(State& state, int rounds, const RunContext& run) const {
    double lambda = 1e-2;
    double now = cost(state);
    for (int round = 0; round < rounds && !run.cancelled(); ++round) {
      Eigen::MatrixXd normal;
      Eigen::VectorXd right;
      assemble(state, normal, right);
      bool better = false;
      for (int attempt = 0; attempt < 6 && !better; ++attempt) {
        Eigen::MatrixXd damped = normal;
        damped.diagonal() += lambda * (normal.diagonal().array() + 1e-9).matrix();
        const State tried = moved(state, damped.ldlt().solve(-right));
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
    State state{globals, {}, std::vector<Eigen::Vector2d>(spirals_.size(), Eigen::Vector2d::Zero())};
    Eigen::Matrix3d normal = 1e-6 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < spirals_.size(); ++k) {
      const auto [weight, seen] = lightOf(k, globals[9]);
      const Basis basis = basisOf(k, globals, state.offsets[k], weight);
      normal += basis.transpose() * basis;
      right += basis.transpose() * seen;
    }
    const Eigen::Vector3d gains = normal.ldlt().solve(right);
    state.light.setZero();
    state.light[0] = gains[0], state.light[kTerms] = gains[1], state.light.tail<kGaps>().setConstant(gains[2]);
    return state;
  }

  void assemble(const State& state, Eigen::MatrixXd& normal, Eigen::VectorXd& right) const {
    constexpr double kStep = 1e-4;
    constexpr int kShared = kGlobals + kLight;
    const Eigen::Index size = kShared + 2 * static_cast<Eigen::Index>(spirals_.size());
    normal = Eigen::MatrixXd::Zero(size, size);
    right = Eigen::VectorXd::Zero(size);
    for (std::size_t k = 0; k < spirals_.size(); ++k) {
      const Eigen::Vector3d gains = gainsOf(k, state);
      const auto [weight, seen] = lightOf(k, state.globals[9]);
      const SpiralModel::Shape shape = model_.shapeOf(k, state.globals);
      const Basis basis = model_.basisOf(k, shape, state.globals, state.offsets[k], weight);
      const Rows base = basis * gains - seen;
      Eigen::Matrix<double, kRows, kShared + 2> jacobian;
      for (int p = 0; p < kNumeric; ++p) {
        Globals other = state.globals;
        other[p] += kStep;
        const bool idle = p == (spirals_[k].kind == SpiralKind::Loose ? 5 : 6);  // the others' width
        if (idle) {
          jacobian.col(p).setZero();
        } else if (p == 9) {  // as the weights know it, too
          const auto [weightThen, seenThen] = lightOf(k, other[p]);
          jacobian.col(p) =
              (model_.basisOf(k, shape, other, state.offsets[k], weightThen) * gains - seenThen - base) / kStep;
        } else {
          const SpiralModel::Shape bent = p == 4 ? shape : model_.shapeOf(k, other);
          jacobian.col(p) = (model_.basisOf(k, bent, other, state.offsets[k], weight) * gains - seen - base) / kStep;
        }
      }
      jacobian.col(kGlobals) = basis.col(0);
      jacobian.col(kGlobals + 1) = spirals_[k].fromAxis * basis.col(0);
      jacobian.col(kGlobals + kTerms) = basis.col(1);
      jacobian.col(kGlobals + kTerms + 1) = spirals_[k].fromAxis * basis.col(1);
      jacobian.middleCols<kGaps>(kGlobals + 2 * kTerms).setZero();
      jacobian.col(kGlobals + 2 * kTerms + spirals_[k].gap) = basis.col(2);
      for (int p = 0; p < 2; ++p) {
        Eigen::Vector2d off = state.offsets[k];
        off[p] += kStep;
        jacobian.col(kShared + p) =
            (model_.basisOf(k, shape, state.globals, off, weight) * gains - seen - base) / kStep;
        jacobian.col(kNumeric + p) = jacobian.col(kShared + p);
      }
      const Eigen::Matrix<double, kShared + 2, kShared + 2> square = jacobian.transpose() * jacobian;
      const Eigen::Matrix<double, kShared + 2, 1> slope = jacobian.transpose() * base;
      const auto at = kShared + 2 * static_cast<Eigen::Index>(k);
      normal.topLeftCorner<kShared, kShared>() += square.topLeftCorner<kShared, kShared>();
      normal.block<kShared, 2>(0, at) += square.topRightCorner<kShared, 2>();
      normal.block<2, kShared>(at, 0) += square.bottomLeftCorner<2, kShared>();
      normal.block<2, 2>(at, at) += square.bottomRightCorner<2, 2>();
      right.head<kShared>() += slope.head<kShared>();
      right.segment<2>(at) += slope.tail<2>();
      normal.block<2, 2>(at, at).diagonal().array() += together_;
      right.segment<2>(at) += together_ * state.offsets[k];
    }
    const Globals usual = usualOnes(), width = priorWidths();
    for (int p = 2; p < kGlobals; ++p) {
      normal(p, p) += kPriorWeight / (width[p] * width[p]);
      right[p] += kPriorWeight * (state.globals[p] - usual[p]) / (width[p] * width[p]);
    }
    Eigen::Vector2d bend;
    for (int p = 0; p < 2; ++p) {
      Globals other = state.globals;
      other[p] += kStep;
      bend[p] = (offElevation(other) - offElevation(state.globals)) / kStep;
    }
    normal.topLeftCorner<2, 2>() += kPriorWeight * bend * bend.transpose();
    right.head<2>() += kPriorWeight * offElevation(state.globals) * bend;
    const double alike = kPriorWeight / (kAlike * kAlike), apart = state.globals[6] - state.globals[5];
    normal(5, 5) += alike, normal(6, 6) += alike, normal(5, 6) -= alike, normal(6, 5) -= alike;
    right[5] -= alike * apart, right[6] += alike * apart;
  }

  static Globals usualOnes() {
    Globals g;
    g << 0, 0, std::log(0.01), std::log(0.08), std::log(1.0), 1, 1, 0, 1, kUsualCurve, 0, 0;
    return g;
  }

 private:
  static constexpr int kRows = SpiralModel::kRows;
  static constexpr double kFarthest = 0.25;  // [mm]
  static constexpr double kPriorWeight = 1e-2;
  static constexpr double kAlike = 0.01;  // lone beads and those side by side are laid alike
  using Rows = SpiralModel::Rows;
  using Basis = SpiralModel::Basis;

  /// The lamp's elevation from what is known of it, by that error.
  [[nodiscard]] double offElevation(const Globals& g) const {
    const Eigen::Vector3d lamp = lampOf(g.head<2>(), camera_.place.normalized());
    const double degrees = std::asin(std::clamp(lamp[2], -1.0, 1.0)) * 180 / std::numbers::pi;
    return (degrees - elevation_.value) / elevation_.error;
  }

  [[nodiscard]] Globals priorWidths() const {
    Globals w;
    w << 1, 1, 2, 1, 0.7, 0.08, 0.08, camera_.distanceError, 1, 0.15, 0.15, 0.15;
    return w;
  }

  [[nodiscard]] SpiralModel::Light lightOf(std::size_t which, double contrast) const {
    SpiralModel::Light light = model_.lightOf(which, contrast);
    light.weight = light.weight.cwiseProduct(trust_[which]);
    light.seen = light.seen.cwiseProduct(trust_[which]);
    return light;
  }

  Basis basisOf(std::size_t which, const Globals& g, const Eigen::Vector2d& off, const Rows& weight) const {
    return model_.basisOf(which, model_.shapeOf(which, g), g, off, weight);
  }

  Eigen::Vector3d gainsOf(std::size_t which, const State& state) const {
    const double r = spirals_[which].fromAxis;
    return {state.light[0] + r * state.light[1], state.light[kTerms] + r * state.light[kTerms + 1],
            state.light[2 * kTerms + spirals_[which].gap]};
  }

  double cost(const State& state) const {
    double sum = 0;
    for (std::size_t k = 0; k < spirals_.size(); ++k) {
      const auto [weight, seen] = lightOf(k, state.globals[9]);
      sum += (basisOf(k, state.globals, state.offsets[k], weight) * gainsOf(k, state) - seen).squaredNorm();
      sum += together_ * state.offsets[k].squaredNorm();
    }
    const Globals usual = usualOnes(), width = priorWidths();
    for (int k = 2; k < kGlobals; ++k) sum += kPriorWeight * std::pow((state.globals[k] - usual[k]) / width[k], 2);
    sum += kPriorWeight * std::pow(offElevation(state.globals), 2);
    return sum + kPriorWeight * std::pow((state.globals[6] - state.globals[5]) / kAlike, 2);
  }

  static State moved(const State& from, const Eigen::VectorXd& step) {
    constexpr int kShared = kGlobals + kLight;
    State to = from;
    to.globals += step.head<kGlobals>();
    to.light += step.segment<kLight>(kGlobals);
    for (std::size_t k = 0; k < to.offsets.size(); ++k) {
      Eigen::Vector2d& off = to.offsets[k];
      off += step.segment<2>(kShared + 2 * static_cast<Eigen::Index>(k));
      if (off.norm() > kFarthest) off *= kFarthest / off.norm();
    }
    Globals& g = to.globals;
    const double size = g.head<2>().norm();
    if (size > 1.5) g.head<2>() *= 1.5 / size;
    g[2] = std::clamp(g[2], std::log(1e-5), std::log(2.0));
    g[3] = std::clamp(g[3], std::log(1e-4), std::log(4.0));
    g[4] = std::clamp(g[4], std::log(0.2), std::log(8.0));
    g[5] = std::clamp(g[5], 0.6, 1.5);
    g[6] = std::clamp(g[6], 0.5, 1.8);
    g[7] = std::clamp(g[7], -1.5, 1.5);
    g[8] = std::clamp(g[8], 0.0, 5.0);
    g[9] = std::clamp(g[9], -0.3, 0.6);
    return to;
  }

  const std::vector<LitSpiral>& spirals_;
  SeenFrom camera_;
  Elevation elevation_;
  SpiralModel model_;
  std::vector<Rows> trust_;                         // in each bin
  double together_ = kPriorWeight / (0.05 * 0.05);  // what holds spirals where the map has them [1/mm²]
};

/// Where the lamp's azimuth must be, up to a half turn: beads shine that run across it.
double azimuthOf(const std::vector<LitSpiral>& spirals, double& contrast) {
  std::array<double, kAngles / 2> light{};
  for (const LitSpiral& s : spirals) {
    if (s.kind == SpiralKind::Loose) continue;
    for (int k = 0; k < kAngles; ++k) {
      for (const auto& bin : s.seen.bins[static_cast<std::size_t>(k)]) {
        light[static_cast<std::size_t>(k % (kAngles / 2))] += bin.light;
      }
    }
  }
  double x = 0, y = 0;
  for (int k = 0; k < kAngles / 2; ++k) {
    const double twice = 4 * std::numbers::pi * (k + 0.5) / kAngles;
    x += light[static_cast<std::size_t>(k)] * std::cos(twice);
    y += light[static_cast<std::size_t>(k)] * std::sin(twice);
  }
  const auto [least, most] = std::minmax_element(light.begin(), light.end());
  contrast = *most / std::max(1e-9, *least);
  return 0.5 * std::atan2(y, x);
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
    g.tail<2>().setZero();
    best = fitter.begin(g);
  } else {
    fitter.loosen(0.002);
    for (const double side : {0.0, std::numbers::pi}) {
      for (const double size : {0.2, 0.5}) {
        Globals g = Fitter::usualOnes();
        g.head<2>() = size * Eigen::Vector2d(std::cos(azimuth + side), std::sin(azimuth + side));
        g[2] = 2 * std::log(kUsualLobe * size);
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
    least = fitter.descend(best, kLaterRounds, run);
  }
  const Globals& found = best.globals;
  fit.globals = found;
  for (const Eigen::Vector2d& off : best.offsets) fit.offsets.emplace_back(off + found.tail<2>());
  fit.tilt = found.head<2>();
  fit.alongVariance = std::exp(found[2]);
  fit.acrossVariance = std::exp(found[3]);
  fit.blur = std::exp(found[4]);
  fit.closing = found[5];
  fit.lone = found[6];
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
  fitter.assemble(best, normal, right);
  double rows = 0;
  for (const LitSpiral& s : spirals) {
    for (const auto& row : s.seen.bins) {
      for (const auto& bin : row) rows += bin.count >= 3 ? 1 : 0;
    }
  }
  fit.misfit = std::sqrt(least / std::max(1.0, rows));
  // What is left is no noise: neighbouring bins are off together.
  const double variance = kTogether * least / std::max(1.0, rows);
  normal.diagonal().array() += 1e-12;
  fit.covariance = (variance * normal.inverse()).topLeftCorner<7, 7>();
  fit.gain = best.light[0];
  fit.diffuse = best.light[kTerms];
  return fit;
}

}  // namespace sillon
