// sillon calibrate: test prints for finding a setting, and readings of their photographs.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands/commands.hpp"
#include "files.hpp"
#include "findings.hpp"
#include "outputs.hpp"
#include "previews.hpp"
#include "project_arguments.hpp"
#include "run.hpp"
#include "sillon/calibrate/calibrate.hpp"
#include "sillon/export/export.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/look/appearance.hpp"
#include "words.hpp"

namespace sillon::cli {
namespace {

constexpr const char* kReadPhotograph = "read";

struct Arguments {
  std::string kind;                ///< a name of calibrationKinds, or kReadPhotograph
  std::vector<std::string> files;  ///< a project; for kReadPhotograph, photographs of one coupon
  ProjectArguments project;
  std::optional<double> from;
  std::optional<double> to;
  std::string out;       ///< G-code, packed according to its ending; for a photograph, a file of spools
  std::string preview;   ///< PNG or WebP
  int previewWidth = 0;  ///< see previewFiles()
  bool json = false;
  std::string name = "mySpool";         ///< name for the spool in a photograph
  std::optional<double> lampElevation;  ///< [degrees]
  std::string lampSize;                 ///< size of the photograph's lamp; empty if unknown
  int threads = 1;
};

double rounded(double value) { return std::round(value * 1e6) / 1e6; }

/// Returns the line that tells what to do with the value that was found.
std::string whatToSet(const CalibrationPlate& plate) {
  if (plate.kind == CalibrationKind::Swatch) return "keep     the card with the spool\n";
  const bool several = plate.setting.find(',') != std::string::npos;
  return "set      " + plate.setting + " in the project to the best " + (several ? "values" : "value") + "\n";
}

/// Formats the values of a print with their places, its cost, and what to look for.
std::string table(const CalibrationPlate& plate, const GcodeSummary& summary) {
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
  return out + line + "look for " + plate.advice + "\n" + whatToSet(plate);
}

/// Formats the same as JSON, with warnings and findings.
std::string tableJson(const std::string& kind, const CalibrationPlate& plate, const GcodeSummary& summary,
                      const std::vector<GcodeFinding>& findings) {
  nlohmann::ordered_json root{
      {"version", 1}, {"kind", kind}, {"setting", plate.setting}, {"unit", plate.unit}, {"advice", plate.advice}};
  root["values"] = nlohmann::ordered_json::array();
  for (const CalibrationValue& value : plate.values) {
    root["values"].push_back(
        {{"label", value.label}, {"value", rounded(value.value)}, {"at", {rounded(value.at.x), rounded(value.at.y)}}});
  }
  const Vec2 page = plate.patches.shape.page;
  root["size"] = {rounded(page.x), rounded(page.y)};
  root["seconds"] = std::round(summary.seconds);
  root["grams"] = rounded(summary.filamentGrams);
  root["warnings"] = nlohmann::ordered_json::parse(warningsJson(summary.warnings));
  root["findings"] = findingsJson(findings);
  return root.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// Returns the look of the side that the nozzle has passed over.
LookParams lookOf(const PictureOptions& options, const Project& project) {
  LookParams look;
  const Spool* own = ownSpool(options);
  const Spool& spool = own != nullptr ? *own : spoolOf(project.pictures.spool);
  look.colour = spool.colour;
  Project shown = project;
  shown.print.showSide = ShowSide::Up;
  look.roughness = own != nullptr ? sillon::roughnessOf(*own, project.printer.nozzle, false) : roughnessOf(shown);
  return look;
}

double hundredths(double value) { return std::round(value * 100) / 100; }
double thousandths(double value) { return std::round(value * 1000) / 1000; }

/// Formats the reading of a coupon for the terminal, with notes on its photographs.
std::string readingText(const CouponReading& r, const std::vector<CouponReading>& each,
                        const std::vector<std::string>& refused, bool lampKnown, double closest,
                        const std::string& name, const std::string& file) {
  constexpr double kUnsure = 0.1;
  std::string out;
  const auto add = [&](const char* format, auto... values) {
    char line[240];
    std::snprintf(line, sizeof line, format, values...);
    out += line;
  };
  add("slopes   %.2f +- %.2f degrees along the beads, %.2f +- %.2f across them\n", r.along.value, r.along.error,
      r.across.value, r.across.error);
  if (r.flow) {
    add("flow     %.3f +- %.3f is the lowest that closes the surface\n", r.flow->value, r.flow->error);
  } else if (r.flowIsLower) {
    out += "flow     all discs are closed; print a coupon with lower values (--from, --to)\n";
  } else if (r.flowIsHigher) {
    out += "flow     no disc is closed; print a coupon with higher values (--from, --to)\n";
  } else {
    out += "flow     cannot be told: the light shows the gaps too poorly; move the lamp, and take another photograph\n";
  }
  add("width    %.3f +- %.3f mm for a bead of %.3f mm\n", r.width.value, r.width.error, closest);
  for (const CouponReading& one : each) {
    add("lamp     at %.0f +- %.0f degrees, %.0f +- %.0f degrees high\n", one.azimuth.value, one.azimuth.error,
        one.elevation.value, one.elevation.error);
    add("picture  %.1f pixels per mm, blurred by %.2f mm, camera tilted by %.0f degrees\n", one.pixelsPerMm, one.blur,
        one.tilt);
  }
  constexpr double kSharpened = 0.2, kVeiled = 0.03;  // above these, results change by more than their errors
  const auto any = [&](double CouponReading::*field, double most) {
    return std::any_of(each.begin(), each.end(), [&](const CouponReading& one) { return one.*field > most; });
  };
  if (any(&CouponReading::sharpening, kSharpened)) {
    out +=
        "note     the photograph is sharpened, which hides how sharp the highlights are; switch sharpening and HDR "
        "off, "
        "or develop a raw file without them\n";
  }
  if (any(&CouponReading::veil, kVeiled)) {
    out += "note     stray light lies over the photograph; shade the lens from the lamp, and darken the room\n";
  }
  if (each.size() > 1 && r.lamps < static_cast<int>(each.size())) {
    add("note     the lamp stands in %d %s in these photographs, and those under one count as one; move it between "
        "photographs\n",
        r.lamps, r.lamps == 1 ? "place" : "places");
  }
  for (const std::string& sentence : refused) out += "refused  " + sentence + "\n";
  if (!lampKnown && r.along.error > kUnsure * r.along.value) {
    out += "note     the slope along the beads is unsure: nobody has said how large the lamp is; --lamp-size does\n";
  }
  out += "spool    " + name;
  const std::string use = "use it with --spools " + (file.empty() ? "FILE" : file) + " --spool " + name + "\n";
  return out + (file.empty() ? "; keep it with -o FILE, and " : "; wrote " + file + "; ") + use;
}

/// Formats the reading of a coupon as JSON.
std::string readingJson(const CouponReading& r, const std::vector<CouponReading>& each,
                        const std::vector<std::string>& refused, double asked, const std::string& name) {
  const auto measured = [](const Measured& m, double (*round)(double)) {
    return nlohmann::ordered_json{{"value", round(m.value)}, {"error", round(m.error)}};
  };
  nlohmann::ordered_json root{{"version", 1}, {"spool", name}};
  root["along"] = measured(r.along, hundredths);
  root["across"] = measured(r.across, hundredths);
  root["flow"] = r.flow ? measured(*r.flow, thousandths) : nlohmann::ordered_json(nullptr);
  root["allDiscsClosed"] = r.flowIsLower;
  root["noDiscClosed"] = r.flowIsHigher;
  root["width"] = measured(r.width, thousandths);
  root["width"]["asked"] = thousandths(asked);
  root["lamp"] = {{"azimuth", measured(r.azimuth, hundredths)}, {"elevation", measured(r.elevation, hundredths)}};
  root["photographs"] = each.size();
  root["lamps"] = r.lamps;
  root["refused"] = refused;
  root["colour"] = r.colour;
  root["camera"] = {{"tilt", hundredths(r.tilt)},
                    {"pixelsPerMm", hundredths(r.pixelsPerMm)},
                    {"blur", thousandths(r.blur)},
                    {"sharpening", hundredths(r.sharpening)},
                    {"veil", thousandths(r.veil)}};
  return root.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// Makes a calibration print, and its preview if one is asked for.
Result<Outcome> makePrint(const Arguments& arguments, const Project& project, const std::string& date,
                          const RunContext& run) {
  if (arguments.out.empty()) return Error{ErrorCode::InvalidArgument, "--output is required; it names the G-code"};
  if (!arguments.lampSize.empty() || arguments.lampElevation) {
    return Error{ErrorCode::InvalidArgument,
                 "--lamp-size and --lamp-elevation belong to a photograph; only calibrate read takes them"};
  }
  const PictureOptions& options = arguments.project.pictures;
  std::vector<std::string> outputs{arguments.out};
  if (!arguments.preview.empty()) outputs.push_back(arguments.preview);
  std::vector<std::string> inputs;
  for (const std::string* name : {&arguments.project.scene, &options.spoolsFile}) {
    if (!name->empty()) inputs.push_back(*name);
  }
  if (const auto problem = checkOutputs(outputs, inputs, {arguments.preview})) return *problem;
  if (const auto problem = previewProblem(arguments.preview, arguments.previewWidth)) return *problem;
  if (auto problem = packageProblem(arguments.out, project.printer.flavor, "calibrate " + arguments.kind)) {
    return *std::move(problem);
  }
  const std::vector<std::string>& kinds = calibrationKinds();
  const auto kind = static_cast<CalibrationKind>(std::find(kinds.begin(), kinds.end(), arguments.kind) - kinds.begin());
  Result<CalibrationPlate> made = makeCalibration({kind, arguments.from, arguments.to, project}, run);
  if (!made) return made.error();
  CalibrationPlate& plate = made.value();
  const Toolpath shown = shownCalibration(plate);
  const Vec2 page = plate.patches.shape.page;
  const LookParams look = lookOf(options, project);
  auto thumbnails = lookThumbnails(shown, page, plate.printer.screenSizes, look, run);
  if (!thumbnails) return thumbnails.error();
  plate.print.thumbnails = std::move(thumbnails).value();
  plate.print.date = date;
  std::string gcode;
  const Result<GcodeSummary> summary = writeCalibration(plate, [&](std::string_view piece) {
    gcode += piece;
    return !run.cancelled();
  });
  if (!summary) return summary.error();
  const std::vector<GcodeFinding> findings = checkGcode(gcode, plate.printer).findings;

  std::vector<OutputFile> files;
  Result<std::string> packed = packedAs(arguments.out, std::move(gcode));
  if (!packed) return packed.error();
  files.push_back({arguments.out, std::move(packed).value()});
  if (!arguments.preview.empty()) {
    auto preview = previewFiles(arguments.preview, shown, page, {look}, arguments.previewWidth, run);
    if (!preview) return preview.error();
    files.push_back(std::move(preview).value().front());
  }
  if (arguments.json) {
    return Outcome{std::move(files), tableJson(arguments.kind, plate, summary.value(), findings), true};
  }
  std::string out = table(plate, summary.value());
  for (const Warning& warning : summary.value().warnings) {
    out += "note     " + warning.message + "\n";
  }
  for (const GcodeFinding& finding : findings) out += "check    " + finding.message + "\n";
  return Outcome{std::move(files), std::move(out)};
}

/// Reads the photographs of a coupon and joins the readings; fails only if none of them can be read.
Result<Outcome> readPhotographs(const Arguments& arguments, const Project& project, const RunContext& run) {
  const std::vector<std::string>& photographs = arguments.files;
  if (photographs.empty()) {
    return Error{ErrorCode::InvalidArgument, "no photograph is given; sillon calibrate read PHOTO reads one"};
  }
  if (!arguments.preview.empty()) {
    return Error{ErrorCode::InvalidArgument, "--preview shows a print; calibrate read has none"};
  }
  std::vector<std::string> outputs;
  if (!arguments.out.empty()) outputs.push_back(arguments.out);
  if (const auto problem = checkOutputs(outputs, photographs)) return *problem;
  PhotoRequest request{project, arguments.from, arguments.to, {}, arguments.lampElevation};
  if (!arguments.lampSize.empty()) {
    request.lampSlope = lampSlopeOf(arguments.lampSize);
    if (!request.lampSlope) {
      return Error{ErrorCode::InvalidArgument,
                   "--lamp-size is \"" + arguments.lampSize + "\"; it must be " + lampSizeRange()};
    }
  }
  std::vector<CouponReading> readings;
  std::vector<std::string> refused;
  std::optional<Error> first;
  for (const std::string& photograph : photographs) {
    const Result<std::string> bytes = readFile(photograph, "photograph", kMaxInputBytes);
    if (!bytes) return bytes.error();
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.value().data());
    const Result<Image> image = decodeImage({data, bytes.value().size()}, photograph);
    if (!image) return image.error();
    const Result<CouponReading> reading = readCouponPhoto(image.value(), request, run);
    if (reading) {
      readings.push_back(reading.value());
      continue;
    }
    const Error error{reading.error().code, "\"" + photograph + "\": " + reading.error().message};
    if (error.code != ErrorCode::InvalidFile) return error;
    if (!first) first = error;
    refused.push_back(error.message);
  }
  if (readings.empty()) return *first;
  const Result<CouponReading> reading = joinReadings(readings, request);
  if (!reading) return reading.error();
  std::string file =
      spoolFile(reading.value(), arguments.name, "photograph of a coupon; only the nozzle's side was measured");
  const auto spools = readSpools(file);
  if (!spools) return spools.error();  // the name is invalid
  Outcome outcome;
  if (!arguments.out.empty()) outcome.files.push_back({arguments.out, std::move(file)});
  const double asked = project.printer.nozzle * project.print.flow;
  outcome.textIsAsked = arguments.json;
  outcome.text = arguments.json ? readingJson(reading.value(), readings, refused, asked, arguments.name)
                                : readingText(reading.value(), readings, refused, request.lampSlope.has_value(), asked,
                                              arguments.name, arguments.out);
  return outcome;
}

/// Takes the file as a project, unless photographs are read.
std::optional<Error> takeProject(Arguments& arguments) {
  if (arguments.kind == kReadPhotograph) return std::nullopt;
  for (const std::string& file : arguments.files) {
    if (looksLikePicture(file)) {
      return Error{ErrorCode::InvalidArgument, "\"" + file + "\" is a picture; calibrate takes a project file"};
    }
    if (&file != &arguments.files.front()) {
      return Error{ErrorCode::InvalidArgument,
                   "unexpected file \"" + file + "\"; only calibrate read takes several files"};
    }
    arguments.project.scene = file;
  }
  return std::nullopt;
}

int run(Arguments& arguments) {
  Run run(arguments.threads);
  if (const auto problem = takeProject(arguments)) return fail(*problem);
  const Result<std::string> date = runDate();
  if (!date) return fail(date.error());
  const Result<Project> project = readProject(arguments.project);
  if (!project) return fail(project.error());
  return commit(arguments.kind == kReadPhotograph ? readPhotographs(arguments, project.value(), run.context())
                                                  : makePrint(arguments, project.value(), date.value(), run.context()),
                run);
}

/// Tells whether a setting is one of the printer's that calibration plates do not choose themselves.
bool isOfCalibrations(const Setting& row) {
  if (row.section == Section::Printer) return true;
  const std::vector<std::string> own = splitWords(
      "layers base basePattern showSide constantFlow coast scarf copies copyGap startHeight rotate mirror strict "
      "place");
  return row.section == Section::Print && std::find(own.begin(), own.end(), row.key) == own.end();
}

Action add(Options& options) {
  const auto arguments = std::make_shared<Arguments>();
  std::vector<std::string> kinds = calibrationKinds();
  kinds.emplace_back(kReadPhotograph);
  options.word("KIND", "print to make: " + listed(calibrationKinds()) + "; or read, for a photograph of the coupon",
               kinds, arguments->kind);
  options.files("FILES", "project to begin with; after read, photographs of one coupon", arguments->files, false);
  options.group("Calibration");
  options.text("-o,--output", "F",
               "G-code, packed if F ends in .gcode.3mf, .bgcode or .gz; after read, a file for --spools",
               arguments->out);
  options.number("--from", "VALUE", "first value to try [the kind's own]", arguments->from);
  options.number("--to", "VALUE", "last value to try [the kind's own]", arguments->to);
  options.text("--preview", "F", "picture of directions and look, PNG; a loop of moving light if F ends in .webp",
               arguments->preview);
  options.previewWidth(arguments->previewWidth);
  options.flag("--json", "print the values as JSON", arguments->json);
  options.group("After read");
  options.text("--name", "KEY", "name for the spool [mySpool]", arguments->name);
  options.text("--lamp-size", "SIZE", "size of the lamp: " + lampSizeRange() + " [unknown, small]",
               arguments->lampSize);
  options.number("--lamp-elevation", "DEG", "height of the lamp, measured within 2 degrees [47 within 9]",
                 arguments->lampElevation);
  options.group("Calibration");
  addSpools(options, arguments->project.pictures);
  addPrinter(options, arguments->project.changes);
  options.settings(arguments->project.changes, isOfCalibrations);
  options.group("Run");
  options.threads(arguments->threads);
  return [arguments] { return run(*arguments); };
}

}  // namespace

const Command calibrateCommand{
    "calibrate",
    "write calibration prints, or read a photograph of one",
    "KIND [FILES]",
    "--output --from --to --preview --json --name --lamp-size --lamp-elevation --printer --filament",
    "Examples:\n"
    "  sillon calibrate coupon --printer prusa-mk4 -o coupon.gcode\n"
    "  sillon calibrate flow mine.json -o flow.gcode --preview flow.png\n"
    "  sillon calibrate read photograph.jpg --name mySilk -o mine.json\n"
    "  sillon calibrate read left.jpg right.jpg back.jpg\n\n"
    "Several photographs show one coupon, each with the lamp elsewhere. docs/guide/calibrate.md shows what to look for "
    "on each print, and where to enter the value.",
    add};

}  // namespace sillon::cli
