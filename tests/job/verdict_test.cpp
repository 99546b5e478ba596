// One verdict: no file is made that the check of any file would call faulty, whatever was asked for.
#include <doctest/doctest.h>

#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/gcode_reader/check.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/settings/presets.hpp"

using namespace sillon;

namespace {

// Lines that somebody may have in a block, from usual to mad. None is refused as a line, on every printer.
constexpr std::string_view kEnds[] = {"G91\nG1 Z5\nG90",
                                      "G1 Z{max_print_height+0.5} F600",
                                      "M106 S0\nM84",
                                      "G91\nG1 E-4 F1800\nG90",
                                      "M104 S150\nG4 S1",
                                      "G1 X-4 Y-4 F3000",
                                      "G1 X{print_bed_max[0]+9} F3000",
                                      "M221 S150",
                                      "G28 X"};

Project randomProject(std::mt19937& random) {
  const auto any = [&](int count) { return static_cast<int>(random() % static_cast<std::uint32_t>(count)); };
  Project project;
  project.builtin = any(2) == 0 ? BuiltinShape::Disc : BuiltinShape::Rectangle;
  project.builtinSize = {10.0 + any(4), project.builtin == BuiltinShape::Disc ? 0.0 : 8.0 + any(6)};
  project.layers.emplace_back().as<LayerAngle>()->angle = any(180);
  const std::vector<PrinterProfile> printers = profiles(ProfileKind::Printer);
  project.printer = printers[static_cast<std::size_t>(any(static_cast<int>(printers.size())))].printer;
  Printer& printer = project.printer;
  project.toolpath.spacing = printer.nozzle * (1 + 0.2 * any(3));
  if (any(4) == 0) {
    printer.generalHeatLimits = true;
    printer.nozzleTemperature = 60.0 * any(9);
    printer.bedTemperature = 40.0 * any(6);
  }
  printer.absoluteE = any(3) == 0;
  printer.setPressureAdvance = any(2) == 0;
  printer.zOffset = any(3) == 0 ? 0.1 * any(4) : 0;
  project.print.layers = 1 + any(3);
  project.print.base = any(4);
  project.print.skirt = any(3);
  project.print.rim = any(4) == 0 ? 3 : 0;
  if (any(2) == 0) printer.endGcode = std::string(kEnds[any(std::size(kEnds))]) + "\nM104 S0\nM140 S0 ; ours";
  return project;
}

}  // namespace

TEST_CASE("a plate's G-code is refused just where the check of the file finds an error, for any printer and settings") {
  std::mt19937 random(56);
  const RunContext run(1);
  const auto noFile = [](const std::string& name, const std::string&) {
    return Result<InputFile>(Error{ErrorCode::InvalidFile, name});
  };
  int taken = 0;
  int refused = 0;
  for (int round = 0; round < 40; ++round) {
    CAPTURE(round);
    const Project project = randomProject(random);
    PlateOptions options;
    options.measure = false;
    Result<Plate> plate = makePlate(project, noFile, options, run);
    std::string text;
    const auto keep = [&](std::string_view piece) {
      text += piece;
      return true;
    };
    // A plate that is refused before a file is made needs no verdict.
    if (!plate.ok() || writePlateGcode(plate.value(), {}, keep, run)) continue;
    const std::optional<Error> error = checkPlateGcode(plate.value(), text, run);
    const GcodeCheck check = checkPrint(text).check;
    CAPTURE(project.printer.name);
    CAPTURE(project.printer.endGcode);
    const std::string first = check.findings.empty() ? "" : check.findings.front().message;
    CAPTURE(first);
    CHECK(error.has_value() == (check.errors() > 0));
    // Nothing but what the owner asked for is ever a reason.
    if (error && !project.printer.generalHeatLimits)
      CHECK(project.printer.endGcode.find("; ours") != std::string::npos);
    ++(error ? refused : taken);
  }
  CHECK(taken > 15);
  CHECK(refused > 2);
}
