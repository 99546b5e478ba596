#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "base/exact_math.hpp"
#include "base/json.hpp"
#include "base/numbers.hpp"
#include "base/parallel_for.hpp"
#include "base/refused.hpp"
#include "calibrate/photo.hpp"
#include "input/map_defect.hpp"
#include "look/rasters.hpp"
#include "sillon/calibrate/calibrate.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/look/inversion.hpp"

namespace sillon {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr std::int64_t kMostPixels = 64'000'000;
constexpr int kLeastSide = 200;       // [pixels] least side of a photograph
constexpr double kUsualFocal = 1.2;   // [longer side] focal length of a phone between no zoom and three times
constexpr double kFocalSpread = 0.6;  // standard deviation of its logarithm: a factor of 1.8
constexpr double kLeastFocal = 0.4, kMostFocal = 6;  // [longer side] range of focal lengths that are tried
constexpr double kMapError = 0.0015;                 // relative error of lengths and right angles in the map
constexpr double kUsuallyStrange = 4;                // deviation that whole pictures still have, in such errors
constexpr double kMostStrange = 15;                  // deviation beyond which no camera takes such a picture
constexpr double kStrangeTurn = 0.005;  // [radians] error of the camera's direction per error beyond kUsuallyStrange
constexpr double kLeastDistanceError = 0.04;  // least standard deviation of the distance's logarithm
constexpr int kRefolds = 3;                   // rounds of folding about the places at which the spirals were found
constexpr double kMostBlur = 0.3;             // [nozzle] largest standard deviation of the blur
constexpr double kMostBurnt = 0.02;           // largest share of burnt pixels in the spirals
constexpr double kLeastContrast = 1.5;        // least ratio of the brightest direction's light to the darkest one's
constexpr double kMostMisfit = 0.05;          // largest RMS residual, relative to the brightest bin's light
constexpr double kMostOff = 0.1;              // largest relative deviation of beads from the width asked for
constexpr double kMostError = 0.4;            // largest relative error of a slope
constexpr double kBentTilt = 1.6;  // factor on the fit's error of the lamp's elevation, found in rendered photographs
constexpr double kElevationError = 2;  // [degrees] error of an elevation that was measured
// A measured elevation is refused if the photograph's differs from it by more than both of these.
constexpr double kMostLampOff = 10;  // [degrees]
constexpr double kMostBars = 3;      // in error bars
constexpr double kSureBars = 2;      // error bars beyond the tried flows from which a flow surely lies outside
constexpr Vec2 kMiddle{kCouponSide / 2, kCouponSide / 2};

/// All spirals of a coupon, as they were asked for.
std::vector<LitSpiral> spiralsOf(const CalibrationPlate& plate) {
  const double nozzle = plate.printer.nozzle;
  std::vector<LitSpiral> all;
  const auto add = [&](const CouponSpiral& spiral, SpiralKind kind, double flow) {
    LitSpiral lit;
    lit.spiral = spiral;
    lit.kind = kind;
    lit.flow = flow;
    lit.width = nozzle;
    lit.height = plate.print.layerHeight;
    all.push_back(lit);
  };
  for (const CouponSpiral& mark : couponMarks(nozzle)) add(mark, SpiralKind::Mark, plate.print.flow);
  for (const CouponSpiral& loose : looseSpirals(nozzle)) add(loose, SpiralKind::Loose, plate.print.flow);
  for (std::size_t k = 0; k < plate.values.size(); ++k) {
    add(flowDisc(static_cast<int>(k), nozzle), SpiralKind::Flow, plate.values[k].value);
  }
  return all;
}

/// Place of a camera of this focal length [pixels], from the coupon's middle [mm].
/// \param h  map from the plate about its middle to pixels about the picture's middle, y up.
Vec3 placeOf(const Mat3& h, double focal) {
  const Mat3 m = Mat3{{1 / focal, 0, 0}, {0, 1 / focal, 0}, {0, 0, 1}} * h;
  const double scale = 2 / (length(m.a) + length(m.b));
  // The axes x right, y up and depth make a left-handed frame.
  const Vec3 a = unit(m.a), b = unit(m.b - dot(m.b, a) * a);
  const Vec3 place = -scale * (Mat3{a, b, cross(b, a)}.transposed() * m.c);
  return {place.x, place.y, std::abs(place.z)};
}

/// Finds the camera from the map alone. The plate's axes are at right angles and equally long, which determines the
/// focal length, the better the more the camera is tilted. A phone's focal length is the prior. The result is the mean
/// of all that are tried, weighted by their probability.
SeenFrom cameraOf(const FoundCoupon& found, int width, int height) {
  constexpr std::size_t kSteps = 160;
  const Mat3 shift{{1, 0, 0}, {0, 1, 0}, {kMiddle.x, kMiddle.y, 1}};
  // The origin moves to the picture's middle, and y points up.
  const Mat3 centred{{1, 0, 0}, {0, -1, 0}, {-width / 2.0, height / 2.0, 1}};
  const Mat3 h = centred * found.map * shift;
  const double side = std::max(width, height);
  const auto costOf = [&](double focal) {
    const auto seen = [&](Vec3 v) { return Vec3{v.x / focal, v.y / focal, v.z}; };
    const Vec3 a = seen(h.a), b = seen(h.b);
    const double skew = 2 * dot(a, b), stretch = dot(a, a) - dot(b, b);
    const double off = exact::hypot(skew, stretch) / (kMapError * (dot(a, a) + dot(b, b)));
    const double unusual = exact::log(focal / (kUsualFocal * side)) / kFocalSpread;
    return off * off + unusual * unusual;
  };
  std::array<double, kSteps> costs{}, logs{};
  for (std::size_t k = 0; k < kSteps; ++k) {
    logs[k] = exact::log(kLeastFocal) + exact::log(kMostFocal / kLeastFocal) * static_cast<double>(k) / (kSteps - 1);
    costs[k] = costOf(side * exact::exp(logs[k]));
  }
  const double least = *std::min_element(costs.begin(), costs.end());
  double weights = 0, mean = 0, square = 0;
  for (std::size_t k = 0; k < kSteps; ++k) {
    const double weight = exact::exp(-0.5 * (costs[k] - least));
    weights += weight, mean += weight * logs[k], square += weight * logs[k] * logs[k];
  }
  mean /= weights;
  SeenFrom camera;
  camera.place = placeOf(h, side * exact::exp(mean));
  camera.strange = std::sqrt(least);
  camera.distanceError = std::max(kLeastDistanceError, std::sqrt(std::max(0.0, square / weights - mean * mean)));
  const auto directionAt = [&](double sign) {
    return unit(placeOf(h, side * exact::exp(mean + sign * camera.distanceError)));
  };
  camera.directionError = exact::hypot(0.5 * length(directionAt(1) - directionAt(-1)),
                                       kStrangeTurn * std::max(0.0, camera.strange - kUsuallyStrange));
  return camera;
}

double errorOf(double variance) { return std::sqrt(std::max(0.0, variance)); }

/// Slope angle of a surface [degrees], from a variance that contains the lamp's.
Measured slopeOf(double variance, double relativeError, const LampPart& lamp) {
  const double degrees = exact::atan(std::sqrt(std::max(1e-6, variance - lamp.variance))) * kDegrees;
  return {degrees, exact::hypot(slopeErrorOf(degrees, exact::hypot(variance * relativeError, lamp.error)),
                                kModelShare * degrees)};
}

/// Refuses a request or photograph that cannot be read, before anything is looked for in it.
std::optional<Error> unfit(const Image& photograph, const PhotoRequest& request) {
  if (request.lampSlope && !(*request.lampSlope >= 0 && *request.lampSlope <= 2)) {
    return outOfRange("lampSize", *request.lampSlope, 0, 2, "");
  }
  if (request.lampElevation && !(*request.lampElevation >= 10 && *request.lampElevation <= 80)) {
    return outOfRange("lampElevation", *request.lampElevation, 10, 80, "degrees");
  }
  if (auto defect = imageDefect(photograph, "photograph")) return defect;
  if (std::min(photograph.width, photograph.height) < kLeastSide) {
    return refusedFile("PhotoTooSmall",
                       {{"width", photograph.width}, {"height", photograph.height}, {"least", kLeastSide}});
  }
  if (std::int64_t{photograph.width} * photograph.height > kMostPixels) {
    return refused(ErrorCode::TooLarge, "PhotoTooLarge", {{"width", photograph.width}, {"height", photograph.height}});
  }
  return std::nullopt;
}

/// Refuses a fit if the coupon was not in focus, under a single lamp that shows its beads.
std::optional<Error> doubtful(const SpiralFit& fit, double blur, double nozzle) {
  if (fit.misfit > kMostMisfit) return refusedFile("ManyLamps");
  if (blur > kMostBlur * nozzle) {
    return refusedFile("Blurred", {{"blur", fixed(blur, 2)}, {"most", fixed(kMostBlur * nozzle, 2)}});
  }
  if (fit.contrast < kLeastContrast) {
    return refusedFile("LowContrast", {{"contrast", fixed(fit.contrast, 2)}});
  }
  if (std::abs(fit.lone - 1) > kMostOff || std::abs(fit.closing - 1) > kMostOff) {
    return refusedFile("OtherWidths", {{"percent", fixed(100 * fit.lone, 0)}});
  }
  return std::nullopt;
}

/// Reports the lamp's azimuth and elevation, which follow from the slope that mirrors it into the camera.
void tellLamp(const SpiralFit& fit, const SeenFrom& camera, CouponReading& out) {
  const Vec3 to = unit(lampOf(fit.tilt, unit(camera.place)));
  const double flat = std::max(0.02, exact::hypot(to.x, to.y));
  double azimuth = exact::atan2(to.y, to.x) * kDegrees;
  if (azimuth < 0) azimuth += 360;
  const double tiltError = std::sqrt(0.5 * (fit.variances[0] + fit.variances[1]));
  const double turn = tiltError * (1 + to.z);
  out.azimuth = {azimuth, std::min(180.0, exact::hypot(turn, camera.directionError) / flat * kDegrees)};
  out.elevation = {exact::asin(std::clamp(to.z, -1.0, 1.0)) * kDegrees,
                   exact::hypot(kBentTilt * turn, camera.directionError) * kDegrees};
}

/// Refuses a measured elevation of the lamp that the photograph contradicts.
std::optional<Error> otherLamp(double measured, const Measured& shown) {
  const double off = std::abs(measured - shown.value);
  if (off <= std::max(kMostLampOff, kMostBars * exact::hypot(shown.error, kElevationError))) return std::nullopt;
  return refusedArgument(
      "OtherElevation",
      {{"elevation", decimal(measured, 1)}, {"seen", fixed(shown.value, 0)}, {"error", fixed(shown.error, 0)}});
}

/// Reports the flow at which beads close if the coupon has tried it, else the side on which it lies.
void tellFlow(const SpiralFit& fit, const std::vector<CalibrationValue>& tried, CouponReading& out) {
  double lowest = 1e9, highest = 0;
  for (const CalibrationValue& value : tried) {
    lowest = std::min(lowest, value.value);
    highest = std::max(highest, value.value);
  }
  const double closing = 1 / fit.closing, error = closing * closing * errorOf(fit.variances[5]);
  // A flow is still reported if it lies beyond the highest disc by up to a third of the range.
  highest += (highest - lowest) / 3;
  if (closing >= lowest && closing <= highest) {
    out.flow = Measured{closing, error};
    return;
  }
  // Another coupon is worth printing only if the flow surely lies outside.
  out.flowIsLower = closing + kSureBars * error < lowest;
  out.flowIsHigher = closing - kSureBars * error > highest;
}

/// Colour of the beads that do not shine: the mean of all places darker than twice the diffuse light, scaled so that
/// its largest channel is 200.
std::array<std::uint8_t, 3> colourOf(const Image& photograph, const Tones& tones, const FoundCoupon& coupon,
                                     double diffuse) {
  std::array<std::uint8_t, 3> colour{};
  double rgb[3] = {0, 0, 0};
  int count = 0;
  const int colours = photograph.channels >= 3 ? 3 : 1;
  for (int j = 0; j < 64; ++j) {
    for (int i = 0; i < 64; ++i) {
      const Vec2 p = coupon.pixelOf({(i + 0.5) * kCouponSide / 64, (j + 0.5) * kCouponSide / 64});
      const int x = std::clamp(static_cast<int>(p.x), 0, photograph.width - 1);
      const int y = std::clamp(static_cast<int>(p.y), 0, photograph.height - 1);
      if (tones.at(x, y) > codeOfLight(static_cast<float>(2 * diffuse))) continue;
      for (int c = 0; c < 3; ++c) {
        rgb[c] +=
            static_cast<double>(lightOfCode(static_cast<float>(photograph.at(x, y, std::min(c, colours - 1))) / 65535));
      }
      ++count;
    }
  }
  const double brightest = std::max({rgb[0], rgb[1], rgb[2], 1e-9});
  for (std::size_t c = 0; c < 3; ++c) {
    const double share = count > 0 ? rgb[c] / brightest : 1;
    colour[c] =
        static_cast<std::uint8_t>(std::lround(200 * static_cast<double>(codeOfLight(static_cast<float>(share)))));
  }
  return colour;
}

}  // namespace

Result<CouponReading> readCouponPhoto(const Image& photograph, const PhotoRequest& request, const RunContext& run) {
  if (auto problem = unfit(photograph, request)) return *problem;
  const Result<CalibrationPlate> plate =
      makeCalibration({CalibrationKind::Coupon, request.from, request.to, request.project}, run);
  if (!plate) return plate.error();
  std::vector<LitSpiral> spirals = spiralsOf(plate.value());
  const double nozzle = plate.value().printer.nozzle;
  std::vector<CouponSpiral> places;
  places.reserve(spirals.size());
  for (const LitSpiral& s : spirals) places.push_back(s.spiral);

  const Tones tones = lumaOf(photograph);
  const Result<FoundCoupon> found = findCoupon(photograph, tones, places, run);
  if (!found) return found.error();
  FoundCoupon coupon = found.value();
  SeenFrom camera = cameraOf(coupon, photograph.width, photograph.height);
  const auto lookAt = [&](LitSpiral& s) {
    s.seen = foldSpiral(s.spiral, coupon, photograph, tones);
    const Vec2 pixel = coupon.pixelOf(s.spiral.centre);
    s.fromAxis = {(2 * pixel.x - photograph.width) / photograph.width,
                  (2 * pixel.y - photograph.height) / photograph.width};
    const FoundCoupon::Steps steps = coupon.stepsAt(s.spiral.centre);
    const double by = 1 / cross(steps.x, steps.y);
    s.blurX = by * Vec2{steps.y.y, -steps.x.y}, s.blurY = by * Vec2{-steps.y.x, steps.x.x};
  };
  int all = 0, burnt = 0;
  for (LitSpiral& s : spirals) {
    if (run.cancelled()) return cancelledRun();
    lookAt(s);
    all += s.seen.pixels;
    burnt += s.seen.burnt;
  }
  if (burnt > kMostBurnt * all) {
    return refusedFile("BurntPhoto", {{"percent", fixed(100.0 * burnt / all, 0)}});
  }
  const Elevation elevation = request.lampElevation ? Elevation{*request.lampElevation, kElevationError} : Elevation{};
  SpiralFit fit = fitSpirals(spirals, camera, elevation, nullptr, run);
  // The map is exact to a fraction of a bead only: bead directions are better about the middles that the fit has found.
  for (int round = 0; round < kRefolds && !run.cancelled(); ++round) {
    refineMap(coupon, spirals, fit);
    camera = cameraOf(coupon, photograph.width, photograph.height);
    for (LitSpiral& s : spirals) lookAt(s);
    fit = fitSpirals(spirals, camera, elevation, &fit, run);
  }
  if (run.cancelled()) return cancelledRun();

  CouponReading out;
  out.pixelsPerMm = coupon.scaleAt(kMiddle);
  out.blur = fit.blur / out.pixelsPerMm;
  out.tilt = exact::acos(std::clamp(unit(camera.place).z, -1.0, 1.0)) * kDegrees;
  if (camera.strange > kMostStrange) return refusedFile("StretchedPhoto");
  if (auto problem = doubtful(fit, out.blur, nozzle)) return *problem;
  const LampPart lamp = lampPartOf(request.lampSlope);
  out.along = slopeOf(fit.alongVariance, errorOf(fit.variances[2]), lamp);
  out.across = slopeOf(fit.acrossVariance, errorOf(fit.variances[3]), lamp);
  for (const Measured* slope : {&out.along, &out.across}) {
    const bool lost = slope->error > kMostError * slope->value;
    if (!lost) continue;
    return refusedFile("SlopesUnclear", {{"value", fixed(slope->value, 1)}, {"error", fixed(slope->error, 1)}});
  }
  if (request.lampElevation) {
    CouponReading free;
    tellLamp(fitSpirals(spirals, camera, Elevation{}, &fit, run), camera, free);
    if (run.cancelled()) return cancelledRun();
    if (auto problem = otherLamp(*request.lampElevation, free.elevation)) return *problem;
  }
  tellLamp(fit, camera, out);
  out.veil = fit.veil;
  out.sharpening = fit.sharpening;
  out.width = {nozzle * plate.value().print.flow * fit.lone,
               nozzle * plate.value().print.flow * errorOf(fit.variances[6])};
  tellFlow(fit, plate.value().values, out);
  out.colour = colourOf(photograph, tones, coupon, fit.diffuse);
  return out;
}

std::string spoolFile(const CouponReading& reading, std::string_view key, std::string_view source) {
  const auto rounded = [](double v) { return std::round(std::clamp(v, 0.1, 45.0) * 100) / 100; };
  const auto pair = [&] {
    return nlohmann::ordered_json::array({rounded(reading.along.value), rounded(reading.across.value)});
  };
  nlohmann::ordered_json spool;
  spool["colour"] = reading.colour;
  spool["fine"] = {{"nozzleSide", pair()}, {"bedSide", pair()}};
  spool["source"] = std::string(source);
  nlohmann::ordered_json root;
  root["version"] = 1;
  root["spools"][std::string(key)] = std::move(spool);
  return root.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace sillon
