// What printer.zOffset does to a file: PrusaSlicer's z_offset, `prusa-slicer --z-offset 0.3 --export-gcode part.stl`.
#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/gcode/writer.hpp"
#include "support/about.hpp"
#include "support/gcode_job.hpp"

using namespace sillon;
using namespace sillon::test;

namespace {

/// The heights of all moves, and the file with a mark in their place.
struct Heights {
  std::vector<double> z;
  std::string rest;
};

Heights heightsOf(const std::string& text) {
  Heights heights;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    std::string line = text.substr(at, end - at);
    at = end + 1;
    if (line.starts_with("G1 Z")) {
      std::size_t digits = 0;
      heights.z.push_back(std::stod(line.substr(4), &digits));
      line.replace(4, digits, "?");
    }
    if (!line.starts_with("; z_offset = ")) heights.rest += line + "\n";
  }
  return heights;
}

/// All else is as in the file without an offset.
void checkRaised(Job job, double offset) {
  CAPTURE(offset);
  const Written plain = job.write();
  job.printer.zOffset = offset;
  const Written raised = job.write();
  REQUIRE_MESSAGE(plain.result.ok(), plain.result.error().message);
  REQUIRE_MESSAGE(raised.result.ok(), raised.result.error().message);
  const Heights before = heightsOf(plain.text);
  const Heights after = heightsOf(raised.text);
  CHECK(before.rest == after.rest);
  REQUIRE(before.z.size() == after.z.size());
  REQUIRE(before.z.size() > 5);
  for (std::size_t k = 0; k < before.z.size(); ++k) CHECK(after.z[k] == about(before.z[k] + offset, 1e-9));
  CHECK(raised.text.find("\n; z_offset = " + decimal(offset, 3) + "\n") != std::string::npos);
  CHECK(plain.text.find("z_offset") == std::string::npos);
  CHECK(checkGcode(raised.text, job.printer).findings.size() == checkGcode(plain.text, job.printer).findings.size());
  CHECK(checkGcode(raised.text).findings.size() == checkGcode(plain.text).findings.size());
}

std::string problem(const Job& job) {
  const Written written = job.write();
  if (!written.result) CHECK(written.text.empty());
  return written.result ? "" : written.result.error().message;
}

}  // namespace

TEST_CASE("a Z offset raises or lowers every move, and no comment tells of it but z_offset") {
  for (const double offset : {0.3, -0.02, -0.15, 1.8}) {
    for (const GcodeFlavor flavor : {GcodeFlavor::Marlin, GcodeFlavor::Klipper, GcodeFlavor::RepRap}) {
      Job job = plate();
      job.printer.flavor = flavor;
      checkRaised(job, offset);
      job.params.copies = {2, 1};
      job.printer.absoluteE = true;
      job.params.brim = 2;
      checkRaised(job, offset);
    }
  }
}

TEST_CASE("patches keep the Z offset") {
  for (const double offset : {0.3, -0.1}) {
    PatchPlate patches{rectangle(30, 20), {{.layer = 1, .lines = {{{{5, 5}, {25, 5}}, {0.4, 0.4}}}}}};
    Printer printer;
    printer.zOffset = offset;
    PrintParams params;
    params.base = 1;
    std::string text;
    const auto sink = [&](std::string_view piece) {
      text += piece;
      return true;
    };
    REQUIRE(writePatches(patches, printer, params, sink).ok());
    CHECK(text.find("\nG1 Z" + fixed(0.4 + offset, 3)) != std::string::npos);
    CHECK(text.find("\nG1 Z" + fixed(0.4, 3)) == std::string::npos);
  }
}

TEST_CASE("above a print the offset counts from where the print's top is told to be") {
  for (const double offset : {0.3, -0.3}) {
    Job job = plate();
    job.params.startHeight = 5;
    job.printer.zOffset = offset;
    const Written written = job.write();
    REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
    CHECK(written.text.find("\n; start height = " + decimal(5 + offset, 3) + " mm, ") != std::string::npos);
    CHECK(written.text.find("\n;Z:5.2\n") != std::string::npos);
    CHECK(written.text.find("\nG1 Z" + fixed(5.2 + offset, 3)) != std::string::npos);
    CHECK(checkGcode(written.text, job.printer).errors() == 0);
    CHECK(checkGcode(written.text).errors() == 0);
  }
}

TEST_CASE("blocks are given the offset, and the end block must stay above where the plate's top is") {
  Job job = plate();
  job.printer.zOffset = 0.3;
  job.printer.startGcode = "G28\nM109 S{first_layer_temperature}\nG1 Z{z_offset + 5} F600\n";
  job.printer.endGcode = "G1 Z{z_offset+min(max_layer_z+1, max_print_height)} F720\nM104 S0\nM140 S0";
  const std::string text = job.write().text;
  CHECK(text.find("\nG1 Z5.3 F600\n") != std::string::npos);
  CHECK(text.find("\nG1 Z1.9 F720\n") != std::string::npos);
  job.printer.endGcode = "G1 Z0.8 F720\nM104 S0\nM140 S0";  // below 0.6 + 0.3
  CHECK(problem(job).find("line 1 of the end G-code: goes down to Z 0.8 over the plate, which is 0.9 mm high") == 0);
  job.printer.zOffset = 0.1;
  CHECK(problem(job) == "");
}

TEST_CASE("with its offset a job must stay above the bed and below the printer's top") {
  Job job = plate();
  job.printer.zOffset = -0.16;
  CHECK(problem(job) ==
        "printer.zOffset is -0.16 mm; it must be -0.15 to 1.8 for a first layer of 0.2, which would lie at Z 0.04");
  job.params.firstLayerHeight = 0.3;
  CHECK(problem(job) == "");
  job.printer.zOffset = 1.71;
  CHECK(problem(job).find("it must be -0.25 to 1.7 for a first layer of 0.3, which would lie at Z 2.01") !=
        std::string::npos);
  job.params.startHeight = 5;
  CHECK(problem(job) == "");
  job.printer.zOffset = 2.1;
  CHECK(problem(job) == "printer.zOffset is 2.1 mm; it must be -2 to 2");
  job = plate();
  job.printer.maxZ = 1.2;
  job.printer.zOffset = 0.3;
  CHECK(problem(job) == "with the lift of the nozzle the print is 1 mm high; this printer reaches 0.9 mm");
  job.printer.zOffset = 0.2;
  const Written written = job.write();
  REQUIRE(written.result.ok());
  double highest = 0;
  for (const double z : heightsOf(written.text).z) highest = std::max(highest, z);
  CHECK(highest == 1.2);
}
