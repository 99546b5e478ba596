#include "base/numbers.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

using sillon::toWhole;

namespace {

TEST_CASE("the nearest whole number is llround's, halves and their neighbours included") {
  for (const double whole : {0.0, 1.0, 2.0, 3.0, 41.0, 1e6, 123456789.0, 4503599627370495.0, 9007199254740993.0}) {
    for (const double half : {0.0, 0.25, 0.5, 0.75}) {
      for (const double value : {whole + half, std::nextafter(whole + half, 0), std::nextafter(whole + half, 1e300)}) {
        CAPTURE(value);
        CHECK(toWhole(value) == std::llround(value));
        CHECK(toWhole(-value) == std::llround(-value));
      }
    }
  }
}

}  // namespace
