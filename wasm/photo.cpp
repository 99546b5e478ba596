// Photographs of calibration coupons: what JavaScript may call of sillon-photo, which is loaded when the first is
// wanted.
#include <emscripten/bind.h>

#include <string>

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

/// \param picture  as imageFrom takes it. \param projectJson  that the coupon was made with.
val readCoupon(const val& picture, const std::string& projectJson, const val& from, const val& to, const val& lampSize,
               const val& lampElevation) {
  return guarded([&](sillon::RunContext& run) {
    const auto project = sillon::readProject(projectJson);
    if (!project) return failure(project.error());
    const auto image = convert::imageFrom(picture, "photograph");
    if (!image) return failure(image.error());
    const sillon::PhotoRequest request{project.value(), optionalOf(from), optionalOf(to), optionalOf(lampSize),
                                       optionalOf(lampElevation)};
    const auto reading = sillon::readCouponPhoto(image.value(), request, run);
    if (!reading) return failure(reading.error());
    const sillon::CouponReading& read = reading.value();
    val out = val::object();
    out.set("along", measuredOf(read.along));
    out.set("across", measuredOf(read.across));
    out.set("flow", read.flow ? measuredOf(*read.flow) : val::null());
    out.set("allDiscsClosed", read.flowIsLower);
    out.set("width", measuredOf(read.width));
    out.set("widthAsked", project.value().printer.nozzle * project.value().print.flow);
    out.set("azimuth", measuredOf(read.azimuth));
    out.set("elevation", measuredOf(read.elevation));
    out.set("tilt", read.tilt);
    out.set("pixelsPerMm", read.pixelsPerMm);
    out.set("blur", read.blur);
    out.set("spools",
            val(sillon::spoolFile(read, "measured", "photograph of a coupon; only the nozzle's side was measured")));
    return success(out);
  });
}

}  // namespace

EMSCRIPTEN_BINDINGS(photo) { emscripten::function("readCoupon", &readCoupon); }
