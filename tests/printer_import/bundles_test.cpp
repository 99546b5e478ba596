// PrusaSlicer's own printers, from their bundles to G-code. Skipped where the slicer is not installed, with a line that
// says so.
#include <doctest/doctest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>

#include "sillon/gcode/writer.hpp"
#include "sillon/printer_import/printer_import.hpp"
#include "support/gcode_job.hpp"

using namespace sillon;
namespace fs = std::filesystem;

TEST_CASE("the printers of PrusaSlicer's bundles print, or say why not") {
  const fs::path folder = "/usr/share/PrusaSlicer/profiles";
  if (!fs::is_directory(folder)) {
    std::puts("skipped: the printers of PrusaSlicer's bundles; prusa-slicer is not installed");
    return;
  }
  const test::Job plate = test::plate(20, 20, 0.4);
  int all = 0;
  int printed = 0;
  std::set<std::string> refusals;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".ini") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string bundle{std::istreambuf_iterator<char>(file), {}};
    std::istringstream lines(bundle);
    for (std::string line; std::getline(lines, line);) {
      const std::string head = "[printer:";
      if (!line.starts_with(head) || line.find('*') != std::string::npos || line.find("SL1") != std::string::npos)
        continue;
      const std::string name = line.substr(head.size(), line.find(']') - head.size());
      CAPTURE(name);
      ++all;
      const Result<ImportedPrinter> printer = importPrinter(bundle, name);
      REQUIRE(printer);
      test::Job job = plate;
      job.printer = printer.value().printer;
      const test::Written written = job.write();
      if (written.result) {
        ++printed;
        continue;
      }
      CHECK(written.text.empty());
      refusals.insert(entry.path().stem().string() + ": " + written.result.error().message);
    }
  }
  std::printf("%d of %d printers of PrusaSlicer's bundles print\n", printed, all);
  for (const std::string& refusal : refusals) std::printf("  %s\n", refusal.c_str());
  CHECK(all > 100);
  CHECK(printed > 0.9 * all);
}
