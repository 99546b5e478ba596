#include "calibrate.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "files.hpp"
#include "sillon/export/gcode_archive.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/look/spools.hpp"
#include "sillon/look/thumbnails.hpp"

namespace cli {
namespace {

using sillon::CalibrationPlate;
using sillon::CalibrationValue;
using sillon::Error;
using sillon::ErrorCode;
using sillon::Result;

constexpr const char* kExamples =
    "Examples:\n"
    "  sillon calibrate coupon --printer prusa-mk4 --filament pla-silk -o coupon.gcode\n"
    "  sillon calibrate flow mine.json -o flow.gcode --preview flow.png\n"
    "  sillon calibrate advance mine.json --from 0.2 --to 0.6 -o advance.gcode --json\n"
    "\n"
    "docs/guide/calibrate.md shows what to look for on each, and what to type back.";

std::string joined(const std::vector<std::string>& words, const char* between, const char* last) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k) {
    text += (k == 0 ? "" : k + 1 == words.size() ? last : between) + words[k];
  }
  return text;
}

double rounded(double value) { return std::round(value * 1e6) / 1e6; }

std::string table(const CalibrationPlate& plate, const sillon::GcodeSummary& summary) {
  char line[200];
  const std::string unit = plate.unit.empty() ? "value" : plate.unit;
  std::snprintf(line, sizeof line, "%-8s %-16s %s\n", "written", unit.c_str(), "from the lower left");
  std::string out = line;
  for (const CalibrationValue& value : plate.values) {
    std::snprintf(line, sizeof line, "%-8s %-16g %.1f, %.1f mm\n", value.label.c_str(), value.value, value.at.x,
                  value.at.y);
    out += line;
  }
  std::snprintf(line, sizeof line, "prints   %.1f min, %.2f g\n", summary.seconds / 60, summary.filamentGrams);
  return out + line + "look for " + plate.advice + "\ntype it  " + plate.setting + "\n";
}

std::string tableJson(const std::string& kind, const CalibrationPlate& plate, const sillon::GcodeSummary& summary,
                      const std::vector<sillon::GcodeFinding>& findings) {
  nlohmann::ordered_json root{
      {"version", 1}, {"kind", kind}, {"setting", plate.setting}, {"unit", plate.unit}, {"advice", plate.advice}};
  root["values"] = nlohmann::ordered_json::array();
  for (const CalibrationValue& value : plate.values) {
    root["values"].push_back(
        {{"label", value.label}, {"value", rounded(value.value)}, {"at", {rounded(value.at.x), rounded(value.at.y)}}});
  }
  const sillon::Vec2 page = plate.patches.shape.page;
  root["size"] = {rounded(page.x), rounded(page.y)};
  root["seconds"] = std::round(summary.seconds);
  root["grams"] = rounded(summary.filamentGrams);
  root["warnings"] = nlohmann::ordered_json::array();
  for (const sillon::GcodeWarning& warning : summary.warnings) {
    root["warnings"].push_back(sillon::warningSentence(warning));
  }
  root["findings"] = nlohmann::ordered_json::array();
  for (const sillon::GcodeFinding& finding : findings) root["findings"].push_back(finding.message);
  return root.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// As the side looks that the nozzle has passed over.
sillon::LookParams lookOf(const PictureOptions& options, const sillon::Project& project) {
  sillon::LookParams look;
  const sillon::Spool* own = ownSpool(options);
  const sillon::Spool& spool = own != nullptr ? *own : sillon::spoolOf(project.pictures.spool);
  look.colour = spool.colour;
  sillon::Project shown = project;
  shown.print.showSide = sillon::ShowSide::Up;
  look.roughness = own != nullptr ? sillon::roughnessOf(*own, project.printer.nozzle, false) : roughnessOf(shown);
  return look;
}

}  // namespace

void addCalibrate(CLI::App& command, CalibrateArguments& arguments) {
  const char* group = "Calibration";
  const std::string kinds = joined(sillon::calibrationKinds(), ", ", " or ");
  command.footer(kExamples);
  command
      .add_option_function<std::string>(
          "kind",
          [&arguments, kinds](const std::string& text) {
            const std::vector<std::string>& all = sillon::calibrationKinds();
            if (std::find(all.begin(), all.end(), text) == all.end()) {
              throw CLI::ValidationError("kind is \"" + text + "\"; it must be " + kinds,
                                         CLI::ExitCodes::ValidationError);
            }
            arguments.kind = text;
          },
          kinds)
      ->option_text("KIND")
      ->required();
  command.add_option("-o,--output", arguments.out, "G-code; packed if F ends in .gcode.3mf or .bgcode")
      ->option_text("F")
      ->required()
      ->group(group);
  command.add_option("--from", arguments.from, "first value to try [as the kind has it]")
      ->option_text("VALUE")
      ->group(group);
  command.add_option("--to", arguments.to, "last value to try [likewise]")->option_text("VALUE")->group(group);
  command.add_option("--preview", arguments.preview, "picture of directions and look, PNG")
      ->option_text("F")
      ->group(group);
  command.add_option("--preview-width", arguments.previewWidth, "width of each of the picture's two panels [1600]")
      ->option_text("PX")
      ->check(CLI::Range(16, 16384))
      ->group(group);
  command.add_flag("--json", arguments.json, "what is printed, as JSON")->group(group);
}

Result<std::string> runCalibrate(const CalibrateArguments& arguments, const PictureOptions& options,
                                 const sillon::Project& project, const std::string& scene, const std::string& date,
                                 const sillon::RunContext& run) {
  std::vector<std::string> outputs{arguments.out};
  if (!arguments.preview.empty()) outputs.push_back(arguments.preview);
  std::vector<std::string> inputs;
  for (const std::string* name : {&scene, &options.spoolsFile}) {
    if (!name->empty()) inputs.push_back(*name);
  }
  if (const auto problem = checkOutputs(outputs, inputs)) return *problem;
  const std::vector<std::string>& kinds = sillon::calibrationKinds();
  const auto kind =
      static_cast<sillon::CalibrationKind>(std::find(kinds.begin(), kinds.end(), arguments.kind) - kinds.begin());
  Result<CalibrationPlate> made = sillon::makeCalibration({kind, arguments.from, arguments.to, project}, run);
  if (!made) return made.error();
  CalibrationPlate& plate = made.value();
  const sillon::Toolpath shown = sillon::shownCalibration(plate);
  const sillon::Vec2 page = plate.patches.shape.page;
  const sillon::LookParams look = lookOf(options, project);
  auto thumbnails = sillon::lookThumbnails(shown, page, plate.printer.screenSizes, look, run);
  if (!thumbnails) return thumbnails.error();
  plate.print.thumbnails = std::move(thumbnails).value();
  plate.print.date = date;
  std::string gcode;
  const Result<sillon::GcodeSummary> summary = sillon::writeCalibration(plate, [&](std::string_view piece) {
    gcode += piece;
    return !run.cancelled();
  });
  if (!summary) return summary.error();
  const std::vector<sillon::GcodeFinding> findings = sillon::checkGcode(gcode, plate.printer).findings;

  std::vector<OutputFile> files;
  Result<std::string> packed = arguments.out.ends_with(".gcode.3mf") ? sillon::packGcode(gcode)
                               : arguments.out.ends_with(".bgcode")  ? sillon::packBinaryGcode(gcode)
                                                                     : Result<std::string>(gcode);
  if (!packed) return packed.error();
  files.push_back({arguments.out, std::move(packed).value()});
  if (!arguments.preview.empty()) {
    sillon::PreviewParams params;
    params.width = arguments.previewWidth;
    params.look = look;
    const auto picture = sillon::renderPreview(shown, page, params, run);
    if (!picture) return picture.error();
    const sillon::RgbImage& image = picture.value();
    const std::vector<std::uint8_t> png = sillon::encodePng(image.width, image.height, image.rgb);
    files.push_back({arguments.preview, std::string(png.begin(), png.end())});
  }
  if (run.cancelled()) return Error{ErrorCode::Cancelled, "cancelled; nothing was written"};
  if (const auto problem = writeTogether(files)) return *problem;
  if (arguments.json) return tableJson(arguments.kind, plate, summary.value(), findings);
  std::string out = table(plate, summary.value());
  for (const sillon::GcodeWarning& warning : summary.value().warnings) {
    out += "note     " + sillon::warningSentence(warning) + "\n";
  }
  for (const sillon::GcodeFinding& finding : findings) out += "check    " + finding.message + "\n";
  return out;
}

}  // namespace cli
