#include "base/numbers.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

using sillon::toWhole;

namespace {

// std::llround itself is wrong in some libraries: MinGW's makes 1 of 0.49999999999999994.
long long nearest(double value) {
  const double down = std::trunc(value);
  return static_cast<long long>(down) + (value - down >= 0.5 ? 1 : 0);
}

TEST_CASE("the nearest whole number, of halves the one away from 0, and of their neighbours") {
  for (const double whole : {0.0, 1.0, 2.0, 3.0, 41.0, 1e6, 123456789.0, 4503599627370495.0, 9007199254740993.0}) {
    for (const double half : {0.0, 0.25, 0.5, 0.75}) {
      for (const double value : {whole + half, std::nextafter(whole + half, 0), std::nextafter(whole + half, 1e300)}) {
        CAPTURE(value);
        CHECK(toWhole(value) == nearest(value));
        CHECK(toWhole(-value) == -nearest(value));
      }
    }
  }
}

}  // namespace
