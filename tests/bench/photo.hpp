// Photographs of coupons with known truth, read back: how far off each figure is.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "sillon/calibrate/calibrate.hpp"
#include "support/coupon_photo.hpp"

namespace bench {

/// One figure's errors, by what was asked, and by the error bars that came with them.
struct PhotoErrors {
  std::vector<double> off, bars;

  void add(double value, double error, double truth, double unit) {
    off.push_back((value - truth) / unit);
    bars.push_back(std::abs(value - truth) / std::max(1e-12, error));
  }
  void print(const char* name, double asked) const {
    if (off.empty()) return;
    std::vector<double> sorted, size;
    int within = 0, oneBar = 0, twoBars = 0;
    for (std::size_t k = 0; k < off.size(); ++k) {
      sorted.push_back(off[k]);
      size.push_back(std::abs(off[k]));
      within += size[k] <= asked ? 1 : 0;
      oneBar += bars[k] <= 1 ? 1 : 0;
      twoBars += bars[k] <= 2 ? 1 : 0;
    }
    std::sort(sorted.begin(), sorted.end());
    std::sort(size.begin(), size.end());
    const auto part = [](const std::vector<double>& v, double share) {
      return v[static_cast<std::size_t>(share * static_cast<double>(v.size() - 1))];
    };
    const auto n = static_cast<double>(off.size());
    std::printf("%-14s %8.3f %8.3f %8.3f %8.3f   %6g %5.0f %%   %5.0f %% %5.0f %%\n", name, part(sorted, 0.5),
                part(size, 0.5), part(size, 0.9), size.back(), asked, 100 * within / n, 100 * oneBar / n,
                100 * twoBars / n);
  }
};

struct PhotoBench {
  int count = 100;  ///< of coupons
  std::uint64_t seed = 0;
  bool elevationKnown = false;  ///< as one measures it: within 1.5 degrees
  bool lampKnown = false;       ///< its size
  int together = 1;             ///< photographs of each coupon, lamp and hand elsewhere
};

/// The same spool and coupon under the same lamp, taken again.
inline photo::Truth again(const photo::Truth& of, scenes::Random& random) {
  photo::Truth truth = photo::randomTruth(random);
  truth.slopes = of.slopes;
  truth.extrusion = of.extrusion;
  truth.filament = of.filament;
  truth.diffuse = of.diffuse;
  truth.lamp.slope = of.lamp.slope;
  truth.curve = of.curve;
  return truth;
}

inline void photographs(const PhotoBench& bench) {
  const sillon::RunContext run(1);
  const auto plate = sillon::makeCalibration({sillon::CalibrationKind::Coupon, {}, {}, {}}, run);
  if (!plate) return;
  PhotoErrors along, across, flow, width, azimuth, elevation;
  std::map<std::string, int> refused;
  int read = 0, noFlow = 0;
  scenes::Random random(bench.seed);
  for (int k = 0; k < bench.count; ++k) {
    const photo::Truth truth = photo::randomTruth(random);
    std::vector<sillon::CouponReading> readings;
    sillon::PhotoRequest request;
    if (bench.lampKnown) request.lampSlope = truth.lamp.slope;
    for (int shot = 0; shot < bench.together; ++shot) {
      const photo::Truth taken = shot == 0 ? truth : again(truth, random);
      const auto bytes = photo::taken(plate.value(), taken);
      const auto image = sillon::decodeImage(bytes, "photograph");
      if (!image) continue;
      if (bench.elevationKnown) request.lampElevation = taken.lamp.elevation + 1.5 * photo::gauss(random);
      const auto one = sillon::readCouponPhoto(image.value(), request, run);
      one ? readings.push_back(one.value()) : void(++refused[one.error().message.substr(0, 60)]);
    }
    if (readings.empty()) continue;
    const auto reading = sillon::joinReadings(readings, request);
    if (!reading) {
      ++refused[reading.error().message.substr(0, 60)];
      continue;
    }
    ++read;
    const sillon::CouponReading& r = reading.value();
    along.add(r.along.value, r.along.error, truth.slopes.along, truth.slopes.along / 100);
    across.add(r.across.value, r.across.error, truth.slopes.across, truth.slopes.across / 100);
    r.flow ? flow.add(100 * r.flow->value, 100 * r.flow->error, 100 / truth.extrusion, 1) : void(++noFlow);
    const double bead = truth.extrusion * plate.value().print.flow * plate.value().printer.nozzle;
    width.add(r.width.value, r.width.error, bead, 1);
    const double turn = r.azimuth.value - truth.lamp.azimuth;
    if (bench.together == 1) azimuth.add(turn - 360 * std::round(turn / 360), r.azimuth.error, 0, 1);
    if (bench.together > 1) continue;  // the lamp is another in each
    elevation.add(r.elevation.value, r.elevation.error, truth.lamp.elevation, 1);
    if (std::getenv("SILLON_PHOTO_ALL") != nullptr) {
      std::printf(
          "%d: along %.2f (%.2f) across %.2f (%.2f) width %.3f (%.3f) tilt %.0f curve %d lamp %.3f el %.0f (%.0f)\n", k,
          r.along.value, truth.slopes.along, r.across.value, truth.slopes.across, r.width.value, bead, truth.tilt,
          static_cast<int>(truth.curve), truth.lamp.slope, r.elevation.value, truth.lamp.elevation);
    }
  }
  std::printf("%d coupons, %d read, of %d photographs each\n", bench.count, read, bench.together);
  std::printf("%-14s %8s %8s %8s %8s   %6s %7s   %7s %7s\n", "error of", "median", "|median|", "|90 %|", "|most|",
              "asked", "within", "1 bar", "2 bars");
  along.print("along [%]", 10);
  across.print("across [%]", 10);
  flow.print("flow [%]", 1);
  width.print("width [mm]", 0.02);
  azimuth.print("azimuth [deg]", 10);
  elevation.print("elevation", 10);
  if (noFlow > 0) std::printf("%d without a flow: all discs closed, or none\n", noFlow);
  for (const auto& [why, times] : refused) std::printf("%d refused: %s...\n", times, why.c_str());
}

/// A photograph as the guide asks for one. \return whether the file is written.
inline bool photograph(const std::string& path) {
  const auto plate = sillon::makeCalibration({sillon::CalibrationKind::Coupon, {}, {}, {}}, sillon::RunContext(1));
  if (!plate) return false;
  const std::vector<std::uint8_t> bytes = photo::taken(plate.value(), photo::good());
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return static_cast<bool>(out.flush());
}

}  // namespace bench
