// Photographs as anybody might take them: any spool, lamp, hand and telephone that the guide allows.
#include <doctest/doctest.h>

#include <cmath>

#include "sillon/calibrate/calibrate.hpp"
#include "support/coupon_photo.hpp"

using namespace sillon;

TEST_CASE("anybody's photographs are read as well as asked, or as their error bars say") {
  const auto coupon = makeCalibration({CalibrationKind::Coupon, {}, {}, {}}, RunContext(1));
  REQUIRE(coupon.ok());
  constexpr int kPhotographs = 15;
  photo::Random random(20);
  int read = 0, along = 0, across = 0, flows = 0, flow = 0;
  for (int k = 0; k < kPhotographs; ++k) {
    CAPTURE(k);
    const photo::Truth truth = photo::randomTruth(random);
    const auto reading = photo::readBack(coupon.value(), truth);
    if (!reading) {
      MESSAGE(k << ": " << reading.error().message);
      continue;
    }
    ++read;
    const CouponReading& r = reading.value();
    MESSAGE(k << ": along " << r.along.value << " +- " << r.along.error << " of " << truth.slopes.along << ", across "
              << r.across.value << " +- " << r.across.error << " of " << truth.slopes.across << ", width "
              << r.width.value << " +- " << r.width.error << " of " << 0.38 * truth.extrusion << ", flow "
              << (r.flow ? r.flow->value : -1) << " of " << 1 / truth.extrusion);
    CHECK(std::abs(r.along.value - truth.slopes.along) < 3 * r.along.error);
    CHECK(std::abs(r.across.value - truth.slopes.across) < 3 * r.across.error);
    CHECK(std::abs(r.width.value - 0.38 * truth.extrusion) < 0.012);
    along += std::abs(r.along.value / truth.slopes.along - 1) < 0.1 ? 1 : 0;
    across += std::abs(r.across.value / truth.slopes.across - 1) < 0.1 ? 1 : 0;
    if (!r.flow) continue;
    CHECK(std::abs(r.flow->value - 1 / truth.extrusion) < 3 * r.flow->error);
    ++flows;
    flow += std::abs(r.flow->value - 1 / truth.extrusion) < 0.01 ? 1 : 0;
  }
  MESSAGE(read << " read; within what was asked: along " << along << ", across " << across << ", flow " << flow
               << " of " << flows);
  CHECK(read >= 13);
  CHECK(along >= read - 1);
  CHECK(across >= read - 1);
  CHECK(flow >= flows - 3);
}
