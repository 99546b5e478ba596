// Bindings for photographs of calibration coupons.
#include <emscripten/bind.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "call.hpp"
#include "convert.hpp"
#include "sillon/calibrate/read_photo.hpp"
#include "sillon/project/project.hpp"

namespace {

using call::guarded;
using call::optionalOf;
using convert::failure;
using convert::success;
using emscripten::val;

val measuredOf(const sillon::Measured& measured) {
  val out = val::object();
  out.set("value", measured.value);
  out.set("error", measured.error);
  return out;
}

sillon::Measured measuredFrom(const val& js) { return {js["value"].as<double>(), js["error"].as<double>()}; }

/// Converts a reading. \param widthAsked  width of the coupon's beads by its project [mm].
val readingOf(const sillon::CouponReading& read, double widthAsked) {
  val out = val::object();
  out.set("along", measuredOf(read.along));
  out.set("across", measuredOf(read.across));
  out.set("flow", read.flow ? measuredOf(*read.flow) : val::null());
  out.set("allDiscsClosed", read.flowIsLower);
  out.set("noDiscClosed", read.flowIsHigher);
  out.set("width", measuredOf(read.width));
  out.set("widthAsked", widthAsked);
  out.set("azimuth", measuredOf(read.azimuth));
  out.set("elevation", measuredOf(read.elevation));
  out.set("tilt", read.tilt);
  out.set("pixelsPerMm", read.pixelsPerMm);
  out.set("blur", read.blur);
  out.set("spools",
          val(sillon::spoolFile(read, "measured", "photograph of a coupon; only the nozzle's side was measured")));
  return out;
}

/// Reads back a reading. \param js  result of readingOf(), with the spool's colour added.
sillon::CouponReading readingFrom(const val& js) {
  sillon::CouponReading read;
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

namespace bindings {

val readCoupon(const val& picture, const std::string& projectJson, const val& from, const val& to, const val& lampSize,
               const val& lampElevation) {
  return guarded([&](sillon::RunContext& run) {
    const auto project = call::projectOf(projectJson);
    if (!project) return failure(project.error());
    const auto image = convert::imageFrom(picture, "photograph");
    if (!image) return failure(image.error());
    const sillon::PhotoRequest request{project.value(), optionalOf(from), optionalOf(to), optionalOf(lampSize),
                                       optionalOf(lampElevation)};
    const auto reading = sillon::readCouponPhoto(image.value(), request, run);
    if (!reading) return failure(reading.error());
    return success(readingOf(reading.value(), project.value().printer.nozzle * project.value().print.flow));
  });
}

val joinReadings(const val& readings, const val& lampSize) {
  return guarded([&](sillon::RunContext&) {
    std::vector<sillon::CouponReading> each;
    const auto count = readings["length"].as<std::size_t>();
    for (std::size_t k = 0; k < count; ++k) each.push_back(readingFrom(readings[k]));
    sillon::PhotoRequest request;
    request.lampSlope = optionalOf(lampSize);
    const auto joined = sillon::joinReadings(each, request);
    if (!joined) return failure(joined.error());
    return success(readingOf(joined.value(), readings[0]["widthAsked"].as<double>()));
  });
}

}  // namespace bindings
