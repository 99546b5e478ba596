// The report of a plate, and its warnings.
#include <doctest/doctest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sillon/pipeline/pipeline.hpp"
#include "sillon/report/report.hpp"
#include "support/report_keys.hpp"

using namespace sillon;
using Json = nlohmann::json;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

ToolpathResult somePlate() {
  ToolpathResult plate;
  plate.toolpath.cycles.resize(1);
  plate.toolpath.cycles[0].points = {{0, 0}, {1, 0}, {0, 1}};
  plate.toolpath.cycles[0].widths = {0.4f, 0.4f, 0.4f};
  plate.toolpath.spacing = 0.4;
  plate.nx = 331;
  plate.ny = 269;
  plate.parts = 1;
  plate.contourCycles = 125;
  plate.longestJointMm = 0.41238;
  plate.unjoined = 2;
  plate.time = {{"sdf", 0.25}, {"line field", 0.5}};
  return plate;
}

}  // namespace

TEST_CASE("the report is JSON with every key and the values it was given") {
  Measures measures;
  measures.lengthMm = 5310.1234;
  measures.alignment = -0.94217;
  measures.coverage = 97.65432;
  measures.crossings = 2;
  measures.uTurns = 523;
  measures.kinks = 11;
  measures.fillRatio = 1.00312;
  measures.width = {0.51, 1, 1.49, 0.00001, 0.02};
  measures.digest = "0123456789abcdef";
  Report made = reportOf(somePlate(), measures);
  made.threads = 3;
  made.peakBytes = 123456789012;
  const std::string text = reportJson(made);
  const Json report = Json::parse(text, nullptr, false);
  REQUIRE(report.is_object());
  checkReportKeys(report);
  CHECK(report["grid"] == Json::array({331, 269}));
  CHECK(report["parts"] == 1);
  CHECK(report["cycles"] == 125);
  CHECK(report["toolpaths"] == 1);
  CHECK(report["lengthMm"] == 5310.123);
  CHECK(report["alignment"] == -0.9422);
  CHECK(report["coverage"] == 97.654);
  CHECK(report["crossings"] == 2);
  CHECK(report["uTurns"] == 523);
  CHECK(report["kinks"] == 11);
  CHECK(report["fillRatio"] == 1.0031);
  CHECK(report["longestJointMm"] == 0.4124);
  CHECK(report["unjoined"] == 2);
  CHECK(report["width"]["p01"] == 0.51);
  CHECK(report["width"]["belowHalf"] == 0.00001);
  CHECK(report["time"]["line field"] == 0.5);
  CHECK(report["time"]["total"] == 0.75);
  CHECK(report["peakBytes"] == 123456789012);
  CHECK(report["threads"] == 3);
  CHECK(report["digest"] == "0123456789abcdef");
  CHECK(has(text, "\"coverage\": 97.654,"));
  CHECK_FALSE(has(text, "-0.0000"));
}

TEST_CASE("an unmeasured plate reports its facts and its digest, and no measure") {
  const Json report = Json::parse(reportJson(reportOf(somePlate(), std::nullopt)), nullptr, false);
  REQUIRE(report.is_object());
  CHECK(report.contains("points"));
  CHECK(report["digest"] == digestOf(somePlate().toolpath));
  for (const char* key : {"lengthMm", "alignment", "coverage", "uTurns", "width"}) CHECK(!report.contains(key));
}

TEST_CASE("the notes say what made a plate, and how good it is where that is known") {
  ToolpathParams params;
  params.seed = 9;
  CHECK(plateNotes(params, std::nullopt) == std::vector<std::string>{"seed = 9, perimeters = 1"});
  params.perimeterMode = PerimeterMode::Soft;
  Measures measures;
  measures.alignment = -0.94217;
  measures.coverage = 97.656;
  measures.overlap = 0.25;
  measures.crossings = 2;
  measures.digest = "0123456789abcdef";
  CHECK(plateNotes(params, measures) ==
        std::vector<std::string>{"seed = 9, perimeters = soft",
                                 "alignment = -0.9422, coverage = 97.66, overlap = 0.25, crossings = 2",
                                 "toolpath digest = 0123456789abcdef"});
}

TEST_CASE("pictures, the print and the warnings stand at the end of a report, in this order") {
  Report report = reportOf(somePlate(), std::nullopt);
  CHECK_FALSE(has(reportJson(report), "\"pictures\""));
  CHECK_FALSE(has(reportJson(report), "\"print\""));
  CHECK(has(reportJson(report), ",\n  \"warnings\": []\n}\n"));
  PictureMeasures measures{0.91234, 0.5, 12.345, {0.91234, -0.25}};
  report.pictures.push_back({1, "\xFF.png", {60, 45, 0.05}, measures});
  measures.others = {0.5, 0.75};
  report.pictures.push_back({3, "b.png", {60, 45, 0.05}, measures});
  report.pictures.push_back({3, "c.png", {60, 45, 0.05}, measures});
  report.fromGcode = true;
  report.print = PrintTotals{59.6, 1234.5678, 3.14159};
  report.warnings.push_back({WarningCode::DrawingUnread, {{"what", "a\"b"}}});
  report.warnings.emplace_back(WarningCode::MirroredUp);
  const std::string text = reportJson(report);
  CHECK(text.find("\"pictures\"") < text.find("\"print\""));
  CHECK(has(text, R"(  "print": {"seconds":60.0,"filamentMm":1234.57,"grams":3.14},)"));
  const Json read = Json::parse(text, nullptr, false);
  REQUIRE(read.is_object());
  REQUIRE(read["pictures"].size() == 3);
  CHECK(read["pictures"][0] ==
        Json::parse(R"({"layer": 1, "file": "\ufffd.png", "lamp": [60, 45], "r": 0.9123, "ssim": 0.5,
                                             "contrast": 12.35, "others": [-0.25], "from": "gcode"})"));
  // The others of a layer, without the picture itself.
  CHECK(read["pictures"][1]["layer"] == 3);
  CHECK(read["pictures"][1]["others"] == Json::array({0.75}));
  CHECK(read["pictures"][2]["others"] == Json::array({0.5}));
  REQUIRE(read["warnings"].size() == 2);
  CHECK(read["warnings"][0]["code"] == "DrawingUnread");
  CHECK(read["warnings"][0]["values"] == Json{{"what", "a\"b"}});
  CHECK(read["warnings"][0]["message"] == report.warnings[0].message);
  CHECK(read["warnings"][1]["values"] == Json::object());
}

TEST_CASE("a report of nothing and of what is no number is JSON too") {
  CHECK(Json::parse(reportJson(reportOf(ToolpathResult{}, Measures{})), nullptr, false).is_object());
  Measures measures;
  measures.coverage = std::numeric_limits<double>::quiet_NaN();
  measures.digest = "a\"\\\n";
  const Json report = Json::parse(reportJson(reportOf(somePlate(), measures)), nullptr, false);
  REQUIRE(report.is_object());
  CHECK(report["coverage"].is_null());
  CHECK(report["digest"] == "a\"\\\n");
}
