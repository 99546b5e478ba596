#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "export/zone_parts.hpp"
#include "sillon/base/types.hpp"

namespace sillon {
namespace {

constexpr int kBins = 720;  // bins of a quarter of a degree

// Mean direction of the bins that centre k owns, by doubled angles, because a direction equals its opposite.
double meanDirection(const std::vector<double>& weights, const std::vector<int>& owner, int k) {
  Vec2 sum;
  for (std::size_t bin = 0; bin < weights.size(); ++bin) {
    if (owner[bin] != k) continue;
    const double twice = 2 * std::numbers::pi * (static_cast<double>(bin) + 0.5) / kBins;
    sum = sum + weights[bin] * Vec2{std::cos(twice), std::sin(twice)};
  }
  const double angle = std::atan2(sum.y, sum.x) / (2 * std::numbers::pi) * 180;
  return angle < 0 ? angle + 180 : angle;
}

// Chooses directions by Lloyd's algorithm (k-means) on a histogram. It starts from shares of equal weight at several
// offsets and keeps the result of least error.
std::vector<double> chosenDirections(const DirectionPicture& picture, int most) {
  constexpr int kStarts = 12;
  constexpr int kRounds = 60;
  std::vector<double> weights(kBins, 0);
  double all = 0;
  for (std::size_t k = 0; k < picture.inside.size(); ++k) {
    if (picture.inside[k] == 0) continue;
    weights[toSize(picture.degrees[k] / 180 * kBins) % kBins] += 1;
    all += 1;
  }
  std::vector<double> best;
  double least = std::numeric_limits<double>::infinity();
  for (int start = 0; start < kStarts; ++start) {
    std::vector<double> centres;
    const int first = start * kBins / kStarts;
    double sum = 0;
    for (int bin = 0; bin < kBins; ++bin) {
      const double weight = weights[(first + bin) % kBins];
      const double goal = (static_cast<double>(centres.size()) + 0.5) * all / most;
      sum += weight;
      if (weight > 0 && sum > goal && static_cast<int>(centres.size()) < most) {
        centres.push_back(((first + bin) % kBins + 0.5) * 180 / kBins);
      }
    }
    std::vector<int> owner(kBins, 0);
    double error = 0;
    for (int round = 0; round < kRounds; ++round) {
      error = 0;
      for (int bin = 0; bin < kBins; ++bin) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < centres.size(); ++k) {
          const double off = angleBetween((bin + 0.5) * 180 / kBins, centres[k]);
          if (off >= nearest) continue;
          nearest = off;
          owner[bin] = static_cast<int>(k);
        }
        error += weights[bin] * nearest * nearest;
      }
      bool moved = false;
      for (std::size_t k = 0; k < centres.size(); ++k) {
        const double mean = meanDirection(weights, owner, static_cast<int>(k));
        moved = moved || angleBetween(mean, centres[k]) > 1e-3;
        centres[k] = mean;
      }
      if (!moved) break;
    }
    if (error < least - 1e-9) {
      least = error;
      best = centres;
    }
  }
  return best;
}

// Replaces directions by the means of the cells nearest to them, in whole tenths of a degree, and merges equal ones.
std::vector<double> refined(const DirectionPicture& picture, std::vector<double> directions) {
  std::vector<Vec2> sums(directions.size());
  for (std::size_t k = 0; k < picture.inside.size(); ++k) {
    if (picture.inside[k] == 0) continue;
    const auto angle = static_cast<double>(picture.degrees[k]);
    const auto nearest = std::min_element(directions.begin(), directions.end(), [&](double a, double b) {
      return angleBetween(angle, a) < angleBetween(angle, b);
    });
    const double twice = 2 * angle * std::numbers::pi / 180;
    Vec2& sum = sums[nearest - directions.begin()];
    sum = sum + Vec2{std::cos(twice), std::sin(twice)};
  }
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double angle = std::atan2(sums[k].y, sums[k].x) / (2 * std::numbers::pi) * 180;
    directions[k] = std::fmod(std::round(10 * (angle < 0 ? angle + 180 : angle)) / 10, 180);
  }
  std::sort(directions.begin(), directions.end());
  directions.erase(
      std::unique(directions.begin(), directions.end(), [](double a, double b) { return angleBetween(a, b) < 0.05; }),
      directions.end());
  if (directions.size() > 1 && angleBetween(directions.front(), directions.back()) < 0.05) directions.pop_back();
  return directions;
}

}  // namespace

std::vector<double> zoneDirections(const DirectionPicture& picture, int most) {
  return refined(picture, chosenDirections(picture, most));
}

}  // namespace sillon
