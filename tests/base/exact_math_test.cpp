#include "base/exact_math.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>

namespace exact = sillon::exact;

namespace {

std::uint64_t bitsOf(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

struct Values {
  std::mt19937_64 random{46};
  double next(double low, double high) { return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53; }
};

bool near(double a, double b, double relative) { return std::abs(a - b) <= relative * std::max(std::abs(b), 1e-300); }

TEST_CASE("functions of doubles agree with the system's to the last digits") {
  Values values;
  for (int k = 0; k < 200000; ++k) {
    const double x = values.next(-700, 700);
    CAPTURE(x);
    CHECK(near(exact::exp(x), std::exp(x), 5e-16));
    CHECK(near(exact::exp(x / 1000), std::exp(x / 1000), 5e-16));
    const double positive = std::exp(values.next(-600, 600));
    CHECK(std::abs(exact::log(positive) - std::log(positive)) <= 5e-16 * std::max(1.0, std::abs(std::log(positive))));
    const double angle = values.next(-1e4, 1e4);
    CHECK(std::abs(exact::sin(angle) - std::sin(angle)) <= 4e-16);
    CHECK(std::abs(exact::cos(angle) - std::cos(angle)) <= 4e-16);
    const double y = values.next(-3, 3);
    CHECK(near(exact::atan(y), std::atan(y), 1e-15));
    CHECK(near(exact::atan2(y, x / 700), std::atan2(y, x / 700), 1e-15));
    const double unit = values.next(-1, 1);
    CHECK(std::abs(exact::asin(unit) - std::asin(unit)) <= 1e-15);
    CHECK(std::abs(exact::acos(unit) - std::acos(unit)) <= 1e-15);
    CHECK(near(exact::tan(unit), std::tan(unit), 1e-15));
    CHECK(near(exact::hypot(x, y), std::hypot(x, y), 5e-16));
  }
}

TEST_CASE("functions of doubles are what they must be at their ends") {
  CHECK(exact::exp(0) == 1);
  CHECK(exact::exp(-1000) == 0);
  CHECK(std::isinf(exact::exp(1000)));
  CHECK(std::isnan(exact::exp(std::nan(""))));
  CHECK(near(exact::exp(709.69), std::exp(709.69), 5e-16));
  CHECK(exact::log(1) == 0);
  CHECK(std::isinf(exact::log(0)));
  CHECK(std::isnan(exact::log(-1)));
  CHECK(exact::sin(0) == 0);
  CHECK(exact::cos(0) == 1);
  CHECK(exact::atan2(0, 0) == 0);
  CHECK(near(exact::atan2(0, -1), std::atan2(0, -1), 1e-15));
  CHECK(near(exact::atan2(-1, 0), std::atan2(-1, 0), 1e-15));
  CHECK(near(exact::atan2(1, -1e-3), std::atan2(1, -1e-3), 1e-15));
  CHECK(exact::asin(1) == doctest::Approx(std::asin(1)));
  CHECK(exact::acos(-1) == doctest::Approx(std::acos(-1)));
}

TEST_CASE("functions of doubles have the same bits on every machine") {
  Values values;
  std::uint64_t sum = 0;
  const auto add = [&](double value) { sum = sum * 0x9e3779b97f4a7c15ull + bitsOf(value); };
  for (int k = 0; k < 10000; ++k) {
    const double x = values.next(-50, 50);
    add(exact::exp(x));
    add(exact::log(x * x + 1e-9));
    add(exact::sin(x));
    add(exact::cos(x));
    add(exact::atan2(x, values.next(-50, 50)));
    add(exact::asin(x / 50));
  }
  CHECK(sum == 15239117982419248566ull);
}

}  // namespace
