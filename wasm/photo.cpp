// Bindings for photographs of calibration coupons.
#include <emscripten/bind.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "call.hpp"
#include "convert.hpp"
#include "sillon/calibrate/calibrate.hpp"
#include "sillon/project/project.hpp"

namespace sillon::bindings {
namespace {

val measuredOf(const Measured& measured) { return object({{"value", measured.value}, {"error", measured.error}}); }

Measured measuredFrom(const val& js) { return {js["value"].as<double>(), js["error"].as<double>()}; }

/// Converts a reading. \param widthAsked  width of the coupon's beads by its project [mm].
val readingOf(const CouponReading& read, double widthAsked) {
  return object(
      {{"along", measuredOf(read.along)},
       {"across", measuredOf(read.across)},
       {"flow", read.flow ? measuredOf(*read.flow) : val::null()},
       {"allDiscsClosed", read.flowIsLower},
       {"noDiscClosed", read.flowIsHigher},
       {"width", measuredOf(read.width)},
       {"widthAsked", widthAsked},
       {"azimuth", measuredOf(read.azimuth)},
       {"elevation", measuredOf(read.elevation)},
       {"tilt", read.tilt},
       {"pixelsPerMm", read.pixelsPerMm},
       {"blur", read.blur},
       {"spools", spoolFile(read, "measured", "photograph of a coupon; only the nozzle's side was measured")}});
}

/// Reads back a reading. \param js  result of readingOf(), with the spool's colour added.
CouponReading readingFrom(const val& js) {
  CouponReading read;
  read.along = measuredFrom(js["along"]);
  read.across = measuredFrom(js["across"]);
  if (!js["flow"].isNull()) read.flow = measuredFrom(js["flow"]);
  read.flowIsLower = js["allDiscsClosed"].as<bool>();
  read.flowIsHigher = js["noDiscClosed"].as<bool>();
  read.width = measuredFrom(js["width"]);
  read.azimuth = measuredFrom(js["azimuth"]);
  read.elevation = measuredFrom(js["elevation"]);
  read.tilt = js["tilt"].as<double>();
  read.pixelsPerMm = js["pixelsPerMm"].as<double>();
  read.blur = js["blur"].as<double>();
  for (std::size_t c = 0; c < 3; ++c) read.colour[c] = js["colour"][c].as<std::uint8_t>();
  return read;
}

}  // namespace

val readCoupon(const val& picture, const std::string& projectJson, const val& from, const val& to, const val& lampSize,
               const val& lampElevation) {
  return withProject(projectJson, [&](const Project& project, RunContext& run) {
    const auto image = imageFrom(picture, "photograph");
    if (!image) return failure(image.error());
    const PhotoRequest request{project, optionalOf(from), optionalOf(to), optionalOf(lampSize),
                               optionalOf(lampElevation)};
    const auto reading = readCouponPhoto(image.value(), request, run);
    if (!reading) return failure(reading.error());
    return success(readingOf(reading.value(), project.printer.nozzle * project.print.flow));
  });
}

val joinReadings(const val& readings, const val& lampSize) {
  return guarded([&](RunContext&) {
    std::vector<CouponReading> each;
    const auto count = readings["length"].as<std::size_t>();
    for (std::size_t k = 0; k < count; ++k) each.push_back(readingFrom(readings[k]));
    PhotoRequest request;
    request.lampSlope = optionalOf(lampSize);
    const auto joined = sillon::joinReadings(each, request);
    if (!joined) return failure(joined.error());
    return success(readingOf(joined.value(), readings[0]["widthAsked"].as<double>()));
  });
}

}  // namespace sillon::bindings
