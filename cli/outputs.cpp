#include "outputs.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string_view>
#include <utility>

#include "assemble.hpp"
#include "findings.hpp"
#include "previews.hpp"
#include "sillon/export/export.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/report/report.hpp"
#include "words.hpp"

#if defined(__unix__) || defined(__APPLE__)
#include <sys/resource.h>
#elif defined(_WIN32)
#define NOMINMAX
#include <windows.h>
// Must follow windows.h, which it needs.
#include <psapi.h>
#endif

namespace sillon::cli {
namespace {

#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
std::string
print(const char* format, ...) {
  char text[512];
  std::va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  return text;
}

/// Returns the peak of memory of the process [bytes]; 0 if the system does not tell.
std::int64_t peakBytes() {
#if defined(__unix__) || defined(__APPLE__)
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#if defined(__APPLE__)
  return static_cast<std::int64_t>(usage.ru_maxrss);
#else
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
#endif
#elif defined(_WIN32)
  PROCESS_MEMORY_COUNTERS counters{};
  // This name is exported by kernel32, so that no further library is linked.
  return ::K32GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof counters) == 0
             ? 0
             : static_cast<std::int64_t>(counters.PeakWorkingSetSize);
#else
  return 0;
#endif
}

/// Returns the colour of the chosen spool if it is one of the user's own.
std::optional<std::array<std::uint8_t, 3>> colourOf(const PictureOptions& options) {
  const Spool* own = ownSpool(options);
  return own == nullptr ? std::nullopt : std::optional(own->colour);
}

/// Writes the G-code of a plate and checks it.
Result<std::string> gcodeText(Job& job, const RunContext& run) {
  std::string text;
  const auto keep = [&text](std::string_view piece) {
    text += piece;
    return true;
  };
  if (const auto error = writePlateGcode(job.plate, {job.date, colourOf(job.pictureOptions)}, keep, run)) {
    return *error;
  }
  if (const auto error = checkPlateGcode(job.plate, text, run)) return *error;
  return text;
}

/// Renders each picture under its lamp, or a plate without pictures under one lamp.
Result<std::vector<OutputFile>> previews(const Job& job, const OutputPaths& paths, const RunContext& run) {
  const Plate& plate = job.plate;
  std::vector<LookParams> looks;
  for (std::size_t k = 0; k < std::max<std::size_t>(1, plate.pictures().shown.size()); ++k) {
    looks.push_back(previewLook(job.pictureOptions, plate.project, plate.pictures(), k));
  }
  return previewFiles(paths.preview, plate.toolpath(), plate.input.shape.page, looks, paths.previewWidth, run);
}

/// Adds a picture for each of the plate's pictures that shows which tones the others take from it.
std::optional<Error> addConflicts(const Plate& plate, const std::string& path, std::vector<OutputFile>& files) {
  constexpr int kSide = 800;  // [pixels]
  const PlatePictures& pictures = plate.pictures();
  const PictureConflict conflict =
      conflictOf(plate.input.directions, pictures.shown, pictures.roughness, pictures.level);
  for (std::size_t k = 0; k < pictures.shown.size(); ++k) {
    Result<std::string> png = pngFile(conflictImage(conflict, k, pictures.shown[k].tones, kSide));
    if (!png) return png.error();
    files.push_back({previewName(path, k), std::move(png).value()});
  }
  return std::nullopt;
}

std::string durationText(double seconds) {
  const auto minutes = static_cast<long long>(std::llround(seconds / 60));
  if (minutes < 1) return print("%.0f s", seconds);
  return minutes < 60 ? print("%lld min", minutes) : print("%lld h %02lld min", minutes / 60, minutes % 60);
}

std::string sizeText(std::size_t bytes) {
  const auto size = static_cast<double>(bytes);
  if (size < 1e3) return print("%.0f bytes", size);
  return size < 1e6 ? print("%.1f kB", size / 1e3) : print("%.1f MB", size / 1e6);
}

/// Packs the G-code into the kind of file that its name asks for.
Result<std::string> packed(std::string gcode, const OutputPaths& paths) {
  if (paths.container.empty()) return packedAs(paths.gcode, std::move(gcode));
  const bool package = endsWith(paths.gcode, ".gcode.3mf");
  const bool binary = endsWith(paths.gcode, ".bgcode");
  Result<std::string> bytes = readFile(paths.container, "file of a slicer", kMaxInputBytes);
  if (!bytes) return bytes.error();
  const Result<GcodeContainer> container = readGcodeContainer(std::move(bytes).value());
  if (!container) return container.error();
  const auto kind = package  ? GcodeContainerKind::Package3mf
                    : binary ? GcodeContainerKind::Binary
                             : GcodeContainerKind::Text;
  if (kind == GcodeContainerKind::Text || container.value().kind != kind) {
    return Error{ErrorCode::InvalidArgument, "--container " + paths.container + " and --gcode " + paths.gcode +
                                                 " must both be .gcode.3mf or both .bgcode"};
  }
  if (container.value().plates > 1) return severalPlates(paths.container, container.value().plates);
  return writeGcodeContainer(container.value(), std::move(gcode));
}

}  // namespace

Result<std::string> runDate() {
  std::int64_t seconds = 0;
  if (const char* given = std::getenv("SOURCE_DATE_EPOCH"); given != nullptr && *given != '\0') {
    const std::string text = given;
    const bool digits = text.find_first_not_of("0123456789") == std::string::npos && text.size() <= 12;
    seconds = digits ? std::strtoll(given, nullptr, 10) : -1;
    if (seconds < 0 || seconds > 253402300799) {  // the last second of the year 9999
      return Error{ErrorCode::InvalidArgument,
                   "SOURCE_DATE_EPOCH is \"" + text + "\"; it must be whole seconds from 0 to 253402300799"};
    }
  } else {
    seconds =
        std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  }
  const std::int64_t days = seconds / 86400;
  const std::int64_t rest = seconds % 86400;
  const std::chrono::year_month_day date{std::chrono::sys_days{std::chrono::days{days}}};
  return print("%04d-%02u-%02u at %02d:%02d:%02d UTC", static_cast<int>(date.year()),
               static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), static_cast<int>(rest / 3600),
               static_cast<int>(rest / 60 % 60), static_cast<int>(rest % 60));
}

std::vector<std::string> outputNames(const OutputPaths& paths, std::size_t pictures) {
  std::vector<std::string> names;
  for (const std::string* path :
       {&paths.gcode, &paths.svg, &paths.report, &paths.conflict, &paths.view, &paths.body, &paths.project}) {
    if (!path->empty()) names.push_back(*path);
  }
  for (std::size_t k = 1; k < pictures && !paths.conflict.empty(); ++k) names.push_back(previewName(paths.conflict, k));
  for (std::string& name : previewNames(paths.preview, std::max<std::size_t>(1, pictures))) {
    names.push_back(std::move(name));
  }
  return names;
}

Result<std::string> packedAs(const std::string& path, std::string gcode) {
  if (endsWith(path, ".gcode.3mf")) return packGcode(gcode);
  if (endsWith(path, ".bgcode")) return packBinaryGcode(gcode);
  if (endsWith(path, ".gz")) return gzipGcode(gcode);
  if (endsWith(path, ".3mf")) {
    return Error{ErrorCode::InvalidArgument,
                 "\"" + path + "\" would be taken for a model; G-code in a 3MF must end in .gcode.3mf"};
  }
  return gcode;
}

std::optional<Error> packageProblem(const std::string& path, GcodeFlavor flavor, const std::string& command,
                                    const std::string& container) {
  if (!endsWith(path, ".gcode.3mf") || flavor == GcodeFlavor::Bambu) return std::nullopt;
  const std::string donor = container.empty() ? "your.gcode.3mf" : container;
  const bool plate = command == "generate";
  return Error{
      ErrorCode::InvalidArgument,
      "\"" + path +
          "\" is for a Bambu Lab printer, but the project's printer is not; take the printer from a file of your "
          "slicer, \"sillon import " +
          donor + " > mine.json\", and go on with \"sillon " + command + " mine.json ..." +
          (plate ? " --gcode " : " -o ") + path + (plate ? " --container " + donor : "") + "\""};
}

Result<std::vector<OutputFile>> makeOutputs(Job& job, const OutputPaths& paths, const RunContext& run) {
  std::vector<OutputFile> files;
  const Plate& plate = job.plate;
  const Project& project = plate.project;
  if (!paths.gcode.empty()) {
    Result<std::string> text = gcodeText(job, run);
    if (!text) return text.error();
    text = packed(std::move(text).value(), paths);
    if (!text) return text.error();
    files.push_back({paths.gcode, std::move(text).value()});
    run.report(paths.preview.empty() ? 1 : 0.25);
  }
  if (!paths.svg.empty()) {
    Result<std::string> svg = toolpathSvg(plate.toolpath(), plate.input.shape.page);
    if (!svg) return svg.error();
    files.push_back({paths.svg, std::move(svg).value()});
  }
  if (!paths.preview.empty()) {
    Result<std::vector<OutputFile>> made = previews(job, paths, run);
    if (!made) return made.error();
    std::move(made.value().begin(), made.value().end(), std::back_inserter(files));
  }
  if (!paths.conflict.empty()) {
    if (const auto error = addConflicts(plate, paths.conflict, files)) return *error;
  }
  if (!paths.view.empty()) {
    const LookParams look = previewLook(job.pictureOptions, project, plate.pictures(), 0);
    const auto view = viewFile(plate.toolpath(), plate.input.shape.page, {look.colour, look.roughness});
    if (!view) return view.error();
    files.push_back({paths.view, std::string(view.value().begin(), view.value().end())});
  }
  if (!paths.body.empty()) {
    const auto mesh = baseBody(plate.input.shape, project.printer, project.print);
    if (mesh) {
      const bool zipped = endsWith(paths.body, ".3mf");
      Result<std::string> bytes = zipped ? write3mf(mesh.value()) : writeStl(mesh.value());
      if (!bytes) return bytes.error();
      files.push_back({paths.body, std::move(bytes).value()});
    } else {
      job.bodyRefused = Error{mesh.error().code, "\"" + paths.body + "\" is not written: " + mesh.error().message};
    }
  }
  if (!paths.project.empty()) files.push_back({paths.project, projectFor(project, paths.project)});
  // The report comes last, so that its peak of memory includes all other outputs.
  if (!paths.report.empty()) {
    Report report = plate.report();
    report.peakBytes = peakBytes();
    files.push_back({paths.report, sillon::reportJson(report)});
  }
  return files;
}

std::string summary(const Plate& plate, const std::vector<OutputFile>& files) {
  const std::size_t toolpaths = plate.toolpath().cycles.size();
  double seconds = 0;
  for (const StageTime& stage : plate.result.time) seconds += stage.seconds;

  std::string out = print("plate      %.2f x %.2f mm, spacing %g mm\n", plate.input.shape.page.x,
                          plate.input.shape.page.y, plate.toolpath().spacing);
  for (const InputNote& note : plate.notes()) out += "note       " + note.message + "\n";
  out += "toolpath   " + plural(plate.result.contourCycles, "cycle") + " joined to " + plural(toolpaths, "toolpath");
  if (plate.measures) out += print(", %.2f m", plate.measures->lengthMm / 1000);
  out += "\n";
  if (plate.measures) {
    const Measures& m = *plate.measures;
    out += print("quality    alignment %.3f (interior %.3f), coverage %.1f %%, overlap %.2f %%, crossings %lld\n",
                 m.alignment, m.alignmentInterior, m.coverage, m.overlap, static_cast<long long>(m.crossings));
  }
  if (!plate.input.shape.kept.empty()) {
    double area = 0;
    for (const ThinPlace& place : plate.input.shape.kept) area += place.areaMm2;
    out += print("kept       %.2f mm2 in %s narrower than a bead, widened to one\n", area,
                 plural(plate.input.shape.kept.size(), "place").c_str());
  }
  out += pictureLines(plate);
  out += print("time       %.2f s on %s\n", seconds, plural(plate.threads, "thread").c_str());
  if (plate.gcode) {
    out += print("print      %s, %.2f m filament, %.1f g\n", durationText(plate.gcode->seconds).c_str(),
                 plate.gcode->filamentMm / 1000, plate.gcode->filamentGrams);
    if (plate.gcode->curveSlowedMm > 0) {
      out += print("curves     %.2f m of the oriented path slower than the rest\n", plate.gcode->curveSlowedMm / 1000);
    }
  }
  if (plate.delay) out += delayLine(*plate.delay);
  for (const OutputFile& file : files) out += "wrote      " + file.path + " (" + sizeText(file.bytes.size()) + ")\n";
  const std::vector<Warning> warnings = plate.warnings();
  for (const Warning& warning : warnings) {
    out += "warning    " + warning.message + "\n";
  }
  if (plate.gcode) {
    for (const GcodeFinding& finding : plate.findings) {
      // Lines of the owner's start or end code are reported as warnings already, with their place in that code.
      if (std::any_of(warnings.begin(), warnings.end(), [&finding](const Warning& warning) {
            const NamedValue* what = warning.value("what");
            return what != nullptr && what->text == finding.message;
          })) {
        continue;
      }
      out += (finding.error ? "error      " : "warning    ") + finding.rule + ": " + finding.message;
      out += finding.line > 0 ? " (line " + std::to_string(finding.line) + " of the file)\n" : "\n";
    }
  }
  return out;
}

}  // namespace sillon::cli
