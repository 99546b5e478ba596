#include "sillon/base/words.hpp"

#include <doctest/doctest.h>

using sillon::suggestion;

namespace {

TEST_CASE("what was meant: names that hold the word first, then names that are spelled nearly so") {
  const std::vector<std::string> printers{"voron-0",    "voron-2-4-300",    "ender-3",
                                          "ender-3-v2", "creality-ender-3", "mini"};
  CHECK(suggestion("Voron 2.4", printers) == "did you mean \"voron-2-4-300\"?");
  CHECK(suggestion("ender3", printers) == "did you mean \"ender-3\" or \"ender-3-v2\" or \"creality-ender-3\"?");
  CHECK(suggestion("mimi", printers) == "did you mean \"mini\"?");
  CHECK(suggestion("vorom-0", printers) == "did you mean \"voron-0\"?");
  CHECK(suggestion("anything else", {"one", "two"}) == "known are one, two");
}

TEST_CASE("a long word is not compared to its end") {
  CHECK(suggestion(std::string(100000, 'x'), {"one", "two"}) == "known are one, two");
}

}  // namespace
