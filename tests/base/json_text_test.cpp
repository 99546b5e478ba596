#include "base/json.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace sillon;

TEST_CASE("a JSON string escapes what JSON must, and replaces what is no UTF-8") {
  CHECK(jsonString("plain") == "\"plain\"");
  CHECK(jsonString("a \"b\" \\ \n\x01") == R"("a \"b\" \\ \n\u0001")");
  CHECK(jsonString("gr\xc3\xbc\xc3\x9f") == "\"gr\xc3\xbc\xc3\x9f\"");
  CHECK(jsonString("\xff") == "\"\xef\xbf\xbd\"");  // U+FFFD
}

TEST_CASE("a JSON number is the shortest text that reads back as itself, or null") {
  CHECK(jsonNumber(0.1) == "0.1");
  CHECK(jsonNumber(100) == "100.0");
  CHECK(parseJson(jsonNumber(1.0 / 3)).get<double>() == 1.0 / 3);
  CHECK(jsonNumber(std::numeric_limits<double>::quiet_NaN()) == "null");
  CHECK(jsonNumber(std::numeric_limits<double>::infinity()) == "null");
}

TEST_CASE("what is no JSON is discarded, not thrown") {
  CHECK(parseJson("{\"a\": 1}")["a"] == 1);
  CHECK(parseJson("{\"a\": ").is_discarded());
  CHECK(parseJson("").is_discarded());
}
