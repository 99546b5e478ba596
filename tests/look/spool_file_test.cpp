#include <doctest/doctest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "sillon/look/appearance.hpp"
#include "support/damaged.hpp"

using namespace sillon;

namespace {

constexpr const char* kFine = R"("fine": {"nozzleSide": [8.9, 15.6], "bedSide": [2.4, 9.7]})";

std::string file(const std::string& spool, const std::string& key = "mySilk") {
  return R"({"version": 1, "spools": {")" + key + "\": " + spool + "}}";
}

std::string refused(const std::string& text) {
  const Result<std::vector<Spool>> read = readSpools(text);
  return read ? "read" : read.error().message;
}

bool has(const std::string& text, const std::string& part) {
  CAPTURE(text);
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a spool of one's own has colour and slopes, of the fine nozzle for all where there is no wide one") {
  const auto read = readSpools(file(std::string(R"({"colour": [201, 148, 46], "source": "me", )") + kFine + "}"));
  REQUIRE(read.ok());
  REQUIRE(read.value().size() == 1);
  const Spool& spool = read.value()[0];
  CHECK(spool.key == "mySilk");
  CHECK(spool.colour == std::array<std::uint8_t, 3>{201, 148, 46});
  for (const double nozzle : {0.2, 0.4, 0.6, 0.8, 1.2}) {
    CHECK(roughnessOf(spool, nozzle, false).along == doctest::Approx(8.9));
    CHECK(roughnessOf(spool, nozzle, false).across == doctest::Approx(15.6));
    CHECK(roughnessOf(spool, nozzle, true).along == doctest::Approx(2.4));
    CHECK(roughnessOf(spool, nozzle, true).across == doctest::Approx(9.7));
  }
  const auto wide = readSpools(file(std::string(R"({"colour": [0, 0, 0], "wide": {"nozzleSide": [4.9, 5.6],
    "bedSide": [1, 2]}, )") + kFine +
                                    "}"));
  REQUIRE(wide.ok());
  CHECK(roughnessOf(wide.value()[0], 0.6, false).along == doctest::Approx(6.9));
}

TEST_CASE("the table that comes with the program is in the same format, under names of its own") {
  std::ifstream stream(std::string(SILLON_SOURCE_DIR) + "/core/data/spools.json");
  std::stringstream text;
  text << stream.rdbuf();
  CHECK(has(refused(text.str()), "spools[\"bluePla\"] is one that comes with the program"));
  std::string renamed = text.str();
  for (const Spool& spool : spools()) {
    const std::size_t at = renamed.find("\"" + spool.key + "\"");
    REQUIRE(at != std::string::npos);
    renamed.insert(at + 1, "my-");
  }
  const auto read = readSpools(renamed);
  REQUIRE_MESSAGE(read.ok(), read.error().message);
  REQUIRE(read.value().size() == spools().size());
  for (std::size_t k = 0; k < spools().size(); ++k) {
    CHECK(read.value()[k].key == "my-" + spools()[k].key);
    CHECK(read.value()[k].colour == spools()[k].colour);
    CHECK(read.value()[k].wide.bedSide.across == spools()[k].wide.bedSide.across);
  }
}

TEST_CASE("what is wrong with a file of spools is said in a sentence that names the spool") {
  const std::string colour = R"("colour": [1, 2, 3], )";
  const std::string fine = kFine;
  CHECK(has(refused(""), "JSON"));
  CHECK(has(refused("[1]"), "{\"version\": 1, \"spools\": {...}}"));
  CHECK(has(refused(R"({"version": 2, "spools": {}})"), "of the form {\"version\": 1, "));
  CHECK(has(refused(R"({"spools": {}})"), "of the form {\"version\": 1, "));
  CHECK(has(refused(R"({"version": 1, "spools": {}, "x": 1})"), "of the form {\"version\": 1, "));
  CHECK(has(refused(file("{" + colour + fine + "}", "my silk")), "letters, digits, - and _"));
  CHECK(has(refused(file("{" + colour + fine + "}", "")), "1 to 40"));
  CHECK(has(refused(file("{" + colour + fine + "}", "goldPla")), "call yours otherwise"));
  CHECK(has(refused(file("3")), "must have the form {\"colour\": "));
  CHECK(has(refused(file("{" + fine + "}")), "spools[\"mySilk\"].colour must have the form [0 ... 255, "));
  CHECK(has(refused(file(R"({"colour": [1, 2, 256], )" + fine + "}")), ".colour must have the form"));
  CHECK(has(refused(file(R"({"colour": [1, 2, -3], )" + fine + "}")), ".colour must have the form"));
  CHECK(has(refused(file(R"({"colour": [1, 2.5, 3], )" + fine + "}")), ".colour must have the form"));
  CHECK(has(refused(file(R"({"colour": [1, 2, 3]})")), ".fine must have the form {\"nozzleSide\": "));
  CHECK(has(refused(file("{" + colour + R"("fine": [1, 2]})")), ".fine must have the form"));
  CHECK(has(refused(file("{" + colour + R"("fine": {"nozzleSide": [1, 2]}})")),
            ".fine.bedSide must have the form [0.1 ... 45, 0.1 ... 45]"));
  CHECK(has(refused(file("{" + colour + R"("fine": {"nozzleSide": [1, 46], "bedSide": [1, 2]}})")),
            ".fine.nozzleSide[1] is 46 degrees; it must be 0.1 to 45"));
  CHECK(has(refused(file("{" + colour + R"("fine": {"nozzleSide": [0, 4], "bedSide": [1, 2]}})")), "[0] is 0 degrees"));
  CHECK(has(refused(file("{" + colour + fine + R"(, "wide": {"nozzleSide": [1, 2], "bedSide": ["a", 2]}})")),
            ".wide.bedSide must have the form"));
  CHECK(has(refused(file("{" + colour + fine + R"(, "gloss": 3})")), "has the key \"gloss\""));
  CHECK(has(refused(file("{" + colour + fine + R"(, "source": 3})")), ".source must have the form \"...\""));
  CHECK(has(refused(file("{" + colour + colour + fine + "}")), "key \"colour\" is given twice"));
  CHECK(has(refused(std::string((1 << 20) + 1, ' ')), "has 2 MiB; it may have at most 1"));
  std::string many = R"({"version": 1, "spools": {)";
  for (int k = 0; k <= 1000; ++k) many += (k == 0 ? "\"s" : ",\"s") + std::to_string(k) + "\": 1";
  CHECK(has(refused(many + "}}"), "1001 spools; it may have at most 1000"));
}

TEST_CASE("any bytes end in spools or an error") {
  scenes::Random random(7);
  const std::string good = file(std::string(R"({"colour": [201, 148, 46], )") + kFine + "}");
  for (int k = 0; k < 3000; ++k) {
    const auto read = readSpools(scenes::damaged(good, random, 1 + random.index(4), 12));
    if (!read) CHECK(!read.error().message.empty());
  }
  CHECK(!readSpools(std::string(500000, '[')).ok());
  std::string deep;
  for (int k = 0; k < 100000; ++k) deep += "{\"a\":";
  CHECK(!readSpools(deep).ok());
}
