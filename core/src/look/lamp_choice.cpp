#include "look/inversion_parts.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

#include "base/fast_math.hpp"
#include "look/rasters.hpp"

namespace sillon {
namespace {

constexpr int kTrialCells = 96;     // cells on the longer side of a trial: enough to tell lamps apart
constexpr int kAzimuths = 12;       // azimuths that are tried, 15 degrees apart
constexpr std::size_t kOthers = 2;  // azimuths proposed besides the chosen one
constexpr double kBetter = 0.99;    // factor by which a later choice must be better: equal ones differ by rounding only

/// Number of beads that the directions force to end, in cells: the sum of |divergence|.
double forcedEnds(const ToneCells& cells) {
  double sum = 0;
  for (int y = 1; y < cells.height; ++y) {
    for (int x = 0; x + 1 < cells.width; ++x) {
      if (cells.isOutside(cells.at(x, y))) continue;
      const Vec2f z = cells.z[cells.at(x, y)];
      // Turn of the line from one cell to the next, half the angle between their z.
      const auto turned = [&](std::size_t to) { return atan2Approx(cross(z, cells.z[to]), dot(z, cells.z[to])) / 2; };
      const float across = turned(cells.at(x + 1, y));
      const float up = turned(cells.at(x, y - 1));
      const float angle = atan2Approx(z.y, z.x) / 2;
      const SinCos d = sinCos(angle);
      sum += static_cast<double>(std::abs(d.cos * up - d.sin * across));
    }
  }
  return sum;
}

/// Solves a single picture on the trial grid with the given sides of its lamp, and counts its forced ends.
double endsOf(const LampTrial& trial, const Lamp& lamp, LampSide side, double level) {
  const LampTables tables = tablesOf({lamp}, trial.roughness, side);
  ToneCells cells = cellsOf(trial.tones, trial.inside, tables, level);
  solve(cells, tables, trial.smoothness, trial.run);
  return forcedEnds(cells);
}

/// Chooses the side on which the directions of a single picture force the fewest beads to end.
LampSide sideOf(const LampTrial& trial, const Lamp& lamp, double level) {
  double least = 1e300;
  LampSide best = LampSide::Both;
  for (const LampSide side : {LampSide::Both, LampSide::Left, LampSide::Right}) {
    const double ends = endsOf(trial, lamp, side, level);
    if (ends < kBetter * least) {
      least = ends;
      best = side;
    }
  }
  return best;
}

/// Computes the error of the worst picture: the mean |error| after the best affine fit, divided by the picture's
/// standard deviation. Unlike squares it counts pale traces of the other pictures on large areas for as much as errors
/// at edges.
double errorOf(const ToneCells& cells, const LampTables& tables, const std::vector<Tones>& shown) {
  double worst = 0;
  for (std::size_t p = 0; p < shown.size(); ++p) {
    // Collect the tones shown and asked for, and their moments.
    std::vector<double> seen, wanted;
    double sx = 0;
    double sy = 0;
    double sxx = 0;
    double syy = 0;
    double sxy = 0;
    for (std::size_t k = 0; k < cells.z.size(); ++k) {
      if (cells.isOutside(k)) continue;
      const float turn = atan2Approx(cells.z[k].y, cells.z[k].x) / (2 * kPi) + 1;
      const std::size_t label = toSize(turn * kLabels + 0.5f) % kLabels;
      seen.push_back(static_cast<double>(tables.code[p][label]));
      const double asked = static_cast<double>(shown[p].value[k]);
      wanted.push_back(asked);
      sx += seen.back();
      sy += asked;
      sxx += seen.back() * seen.back();
      syy += asked * asked;
      sxy += seen.back() * asked;
    }
    // Affine fit by least squares, from variances and covariance.
    const auto count = static_cast<double>(std::max<std::size_t>(1, seen.size()));
    const double vx = sxx / count - sx / count * (sx / count);
    const double vy = syy / count - sy / count * (sy / count);
    // A picture of a single tone has no error: there is nothing to see in it.
    if (!(vy > 1e-9)) continue;
    const double slope = vx > 1e-9 ? (sxy / count - sx / count * (sy / count)) / vx : 0;
    const double offset = (sy - slope * sx) / count;
    double error = 0;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      error += std::abs(offset + slope * seen[k] - wanted[k]);
    }
    worst = std::max(worst, error / count / std::sqrt(vy));
  }
  return worst;
}

/// Chooses the azimuth of a single lamp that forces the fewest beads to end while both sides of the lamp are used. The
/// choice's `azimuths` become those with the fewest ends on their better side.
void chooseAzimuth(const LampTrial& trial, LampChoice& choice) {
  double least = 1e300;
  Lamp lamp = choice.lamps[0];
  std::vector<std::pair<double, double>> ends;  // forced ends on the better side, and the azimuth
  for (int k = 0; k < kAzimuths; ++k) {
    // Begin at 60 degrees, the upper right as in the previews, which stays unless another azimuth is better.
    lamp.azimuth = (60 + 180 / kAzimuths * k) % 180;
    const auto endsOn = [&](LampSide side) { return endsOf(trial, lamp, side, choice.level); };
    const double both = endsOn(LampSide::Both);
    ends.emplace_back(std::min({both, endsOn(LampSide::Left), endsOn(LampSide::Right)}), lamp.azimuth);
    if (both < kBetter * least) {
      least = both;
      choice.lamps[0] = lamp;
    }
  }
  std::vector<double>& others = choice.azimuths;
  const auto isTaken = [&](double azimuth) {
    return azimuth == choice.lamps[0].azimuth || std::find(others.begin(), others.end(), azimuth) != others.end();
  };
  // The others are proposed by their better side; whole plates decide between them later.
  while (others.size() < kOthers) {
    const std::pair<double, double>* next = nullptr;
    for (const auto& one : ends) {
      if (!isTaken(one.second) && (next == nullptr || one.first < next->first)) next = &one;
    }
    if (next == nullptr) return;
    others.push_back(next->second);
  }
}

/// Chooses how far several lamps stand apart and how bright white is, as far as both were left open.
void chooseSeparation(const LampTrial& trial, const std::vector<bool>& open, double level, LampChoice& choice) {
  std::vector<Lamp> lamps = choice.lamps;
  const double first = lamps[0].azimuth;
  // The nearer two lamps stand, the more tones of both a direction can show, but the more each shows of the other
  // picture. Lobes of more than two lamps must not overlap.
  std::vector<double> apart{180.0 / static_cast<double>(lamps.size())};
  if (lamps.size() == 2) apart = {40, 35, 30, 25, 50};
  if (std::find(open.begin(), open.end(), true) == open.end()) apart = {0};
  std::vector<double> whites{0.5, 0.7, 1, 0.85, 0.35};
  if (level > 0) whites = {level};
  double least = 1e300;
  choice.level = whites[0];
  // Try every pair of separation and white; the first of equal ones stays.
  for (const double separation : apart) {
    for (std::size_t p = 0; p < lamps.size(); ++p) {
      if (open[p]) lamps[p].azimuth = first + separation * static_cast<double>(p);
    }
    const LampTables tables = tablesOf(lamps, trial.roughness);
    for (const double white : whites) {
      ToneCells cells = cellsOf(trial.tones, trial.inside, tables, white);
      solve(cells, tables, trial.smoothness, trial.run);
      const double error = errorOf(cells, tables, trial.tones);
      if (error < kBetter * least) {
        least = error;
        choice.level = white;
        choice.lamps = lamps;
      }
    }
  }
}

}  // namespace

LampTrial lampTrial(const std::vector<Tones>& tones, const InsideCells& inside, const Roughness& roughness,
                    double smoothness, const RunContext& run) {
  // Small pictures of the same proportions; they are never larger than the given ones.
  const int longer = std::max(tones[0].width, tones[0].height);
  const auto side = [&](int cells) { return std::max(1, cells * std::min(kTrialCells, longer) / longer); };
  LampTrial trial{{}, {}, roughness, smoothness, run};
  for (const Tones& t : tones) trial.tones.push_back(resampled(t, side(t.width), side(t.height)));
  if (inside) trial.inside = inside(trial.tones[0].width, trial.tones[0].height);
  return trial;
}

LampChoice chooseLamps(const LampTrial& trial, std::span<const LitPicture> pictures, double level) {
  LampChoice choice;
  std::vector<bool> open;
  for (const LitPicture& picture : pictures) {
    choice.lamps.push_back(picture.lamp);
    open.push_back(picture.chooseAzimuth);
  }
  // Several pictures: separation and white. One picture: azimuth, then the side of the lamp; white is the whole light.
  if (pictures.size() > 1) {
    chooseSeparation(trial, open, level, choice);
    return choice;
  }
  if (level > 0) choice.level = level;
  if (open[0]) chooseAzimuth(trial, choice);
  choice.side = sideOf(trial, choice.lamps[0], choice.level);
  return choice;
}

}  // namespace sillon
