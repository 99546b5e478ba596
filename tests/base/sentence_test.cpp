#include "base/sentence.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

using namespace sillon;

TEST_CASE("a sentence says all its values, but those that it marks as unsaid") {
  constexpr Sentence kHot{"Hot", "{what} is {degrees} degrees", "rule"};
  const std::vector<NamedValue> values{{"degrees", 480.25}, {"what", std::string("the bed")}};
  CHECK(filled(kHot, values) == "the bed is 480.25 degrees");
  using Pairs = std::vector<std::pair<std::string, std::string>>;
  CHECK(filled(kHot, Pairs{{"what", "it"}, {"degrees", "{what}"}, {"rule", "heating"}}) == "it is {what} degrees");
  CHECK(saysAll(kHot, values));
  CHECK_FALSE(saysAll(kHot, Pairs{{"what", "it"}}));
  CHECK_FALSE(saysAll(kHot, Pairs{{"what", "it"}, {"degrees", "9"}, {"limit", "8"}}));
  CHECK(saysAll(Sentence{"Cold", "it is cold"}, Pairs{}));
}
