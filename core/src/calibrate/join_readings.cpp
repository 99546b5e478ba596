#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "base/exact_math.hpp"
#include "base/numbers.hpp"
#include "base/refused.hpp"
#include "calibrate/photo.hpp"
#include "sillon/calibrate/calibrate.hpp"

namespace sillon {
namespace {

constexpr double kLeastShare = 0.01;  // least relative error of a slope
// A photograph is refused if the logarithm of its slope differs from the median's by both of these.
constexpr double kMostApart = 0.4;  // difference that photographs of one spool do not reach
constexpr double kMostBars = 4;     // difference in error bars

constexpr double kSameLamp = 10;  // [degrees] lamps closer than this in azimuth and in elevation count as one

/// A value and its standard deviation.
struct Figure {
  double value = 0, error = 0;
};

/// Median of the values.
double middleOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

/// Error that all photographs of a spool share [degrees]: more photographs do not make it smaller.
/// \param lamp  error of the variance that the lamp's size adds.
double commonErrorOf(double degrees, double lamp) {
  return exact::hypot(slopeErrorOf(degrees, lamp), kModelShare * degrees);
}

/// Mean weighted by inverse variances. Its error grows by the Birge ratio (the root of chi-squared per degree of
/// freedom) where the figures lie farther apart than their own errors explain.
Figure meanOf(const std::vector<Figure>& figures) {
  double weights = 0, sum = 0, off = 0;
  for (const Figure& f : figures) {
    const double weight = 1 / (f.error * f.error);
    weights += weight;
    sum += weight * f.value;
  }
  const double mean = sum / weights;
  for (const Figure& f : figures) off += exact::square((f.value - mean) / f.error);
  const double apart = figures.size() < 2 ? 1 : off / static_cast<double>(figures.size() - 1);
  return {mean, std::sqrt(std::max(1.0, apart) / weights)};
}

/// Index of the first reading under the same lamp, for each reading.
std::vector<std::size_t> lampsOf(const std::vector<CouponReading>& readings) {
  std::vector<std::size_t> first;
  for (const CouponReading& r : readings) {
    std::size_t k = 0;
    for (; k < first.size(); ++k) {
      const CouponReading& other = readings[k];
      const double turn = std::remainder(r.azimuth.value - other.azimuth.value, 360);
      const bool same = std::abs(turn) < kSameLamp && std::abs(r.elevation.value - other.elevation.value) < kSameLamp;
      if (first[k] == k && same) break;
    }
    first.push_back(k);
  }
  return first;
}

/// Joins the figures of each lamp, then those of all lamps. Figures under one lamp share its errors, so that they
/// count as one that is no surer than the surest of them.
/// \param lamps  a number for each figure, equal for figures under the same lamp.
Figure joined(const std::vector<Figure>& figures, const std::vector<std::size_t>& lamps) {
  std::vector<Figure> each;
  for (std::size_t k = 0; k < figures.size(); ++k) {
    if (std::find(lamps.begin(), lamps.begin() + static_cast<std::ptrdiff_t>(k), lamps[k]) !=
        lamps.begin() + static_cast<std::ptrdiff_t>(k)) {
      continue;
    }
    std::vector<Figure> alike;
    double least = figures[k].error;
    for (std::size_t j = k; j < figures.size(); ++j) {
      if (lamps[j] != lamps[k]) continue;
      alike.push_back(figures[j]);
      least = std::min(least, figures[j].error);
    }
    const Figure mean = meanOf(alike);
    each.push_back({mean.value, std::max(mean.error, least)});
  }
  return meanOf(each);
}

}  // namespace

Result<CouponReading> joinReadings(const std::vector<CouponReading>& readings, const PhotoRequest& request) {
  if (readings.empty()) return refusedArgument("NoReadings");
  if (readings.size() == 1) return readings.front();
  CouponReading out = readings.front();
  const std::vector<std::size_t> lamps = lampsOf(readings);
  out.lamps = 0;
  for (std::size_t k = 0; k < lamps.size(); ++k) out.lamps += lamps[k] == k ? 1 : 0;
  const double lamp = lampPartOf(request.lampSlope).error;
  for (const auto slope : {&CouponReading::along, &CouponReading::across}) {
    std::vector<Figure> logs;  // logarithms of slopes, with relative errors
    std::vector<double> values;
    for (const CouponReading& r : readings) {
      const Measured& m = r.*slope;
      const double known = commonErrorOf(m.value, lamp);
      const double own = std::sqrt(std::max(0.0, m.error * m.error - known * known));
      logs.push_back({exact::log(m.value), std::max(kLeastShare, own / m.value)});
      values.push_back(logs.back().value);
    }
    const Figure mean = joined(logs, lamps);
    const double value = exact::exp(mean.value), common = commonErrorOf(value, lamp), middle = middleOf(values);
    for (std::size_t k = 0; k < logs.size(); ++k) {
      const double off = std::abs(logs[k].value - middle);
      if (off < kMostApart || off < kMostBars * exact::hypot(logs[k].error, common / value)) continue;
      return refusedFile("ReadingsApart", {{"photograph", k + 1},
                                           {"value", fixed((readings[k].*slope).value, 1)},
                                           {"middle", fixed(exact::exp(middle), 1)}});
    }
    out.*slope = {value, exact::hypot(value * mean.error, common)};
  }
  std::vector<Figure> widths, flows;
  std::vector<std::size_t> lampsOfFlows;
  std::size_t lower = 0, higher = 0;
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const CouponReading& r = readings[k];
    widths.push_back({r.width.value, std::max(1e-4, r.width.error)});
    lower += r.flowIsLower ? 1 : 0, higher += r.flowIsHigher ? 1 : 0;
    if (!r.flow) continue;
    flows.push_back({r.flow->value, std::max(1e-4, r.flow->error)});
    lampsOfFlows.push_back(lamps[k]);
  }
  const Figure width = joined(widths, lamps);
  out.width = {width.value, width.error};
  out.flow.reset();
  if (flows.size() * 2 >= readings.size()) {
    const Figure flow = joined(flows, lampsOfFlows);
    out.flow = Measured{flow.value, flow.error};
  }
  out.flowIsLower = !out.flow && lower * 2 > readings.size();
  out.flowIsHigher = !out.flow && higher * 2 > readings.size();
  return out;
}

}  // namespace sillon
