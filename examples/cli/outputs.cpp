#include "outputs.hpp"

#include <chrono>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "assemble.hpp"
#include "sillon/base_body.hpp"
#include "sillon/gcode_archive.hpp"
#include "sillon/image_io.hpp"
#include "sillon/preview.hpp"
#include "sillon/report.hpp"
#include "sillon/thumbnails.hpp"
#include "sillon/toolpath_svg.hpp"
#include "sillon/view_file.hpp"

#if defined(__unix__) || defined(__APPLE__)
#include <sys/resource.h>
#endif

namespace cli {
namespace {

using sillon::Error;
using sillon::ErrorCode;
using sillon::Measures;
using sillon::Result;

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

/// The most memory the process held; 0 where the system does not tell.
std::int64_t peakBytes() {
#if defined(__unix__) || defined(__APPLE__)
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#if defined(__APPLE__)
  return static_cast<std::int64_t>(usage.ru_maxrss);
#else
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
#endif
#else
  return 0;
#endif
}

Result<std::string> gcodeText(Job& job, const sillon::RunContext& run) {
  sillon::PrintParams print = job.project.print;
  print.date = job.date;
  print.notes = sillon::plateNotes(job.project.toolpath, job.measures);
  auto thumbnails =
      sillon::lookThumbnails(job.plate.toolpath, job.input.shape.page, job.project.printer.screenSizes, run);
  if (!thumbnails) return thumbnails.error();
  print.thumbnails = std::move(thumbnails).value();
  std::string text;
  auto summary =
      sillon::writeGcode(job.plate.toolpath, job.input.shape, job.project.printer, print, [&](std::string_view piece) {
        text += piece;
        return !run.cancelled();
      });
  if (!summary) return summary.error();
  job.gcode = std::move(summary).value();
  return text;
}

Result<std::string> previewPng(const Job& job, int width, const sillon::RunContext& run) {
  sillon::PreviewParams params;
  params.width = width;
  const auto picture = sillon::renderPreview(job.plate.toolpath, job.input.shape.page, params, run);
  if (!picture) return picture.error();
  const sillon::RgbImage& image = picture.value();
  const std::vector<std::uint8_t> png = sillon::encodePng(image.width, image.height, image.rgb);
  return std::string(png.begin(), png.end());
}

std::string durationText(double seconds) {
  const auto minutes = static_cast<long long>(std::llround(seconds / 60));
  if (minutes < 1) return print("%.0f s", seconds);
  return minutes < 60 ? print("%lld min", minutes) : print("%lld h %02lld min", minutes / 60, minutes % 60);
}

/// What was taken for granted of the input, or left out of it.
std::vector<std::string> inputNotes(const Job& job) {
  const sillon::DrawingFacts& drawing = job.input.shape.drawing;
  const sillon::Project& project = job.project;
  const bool asDrawn = !project.shapeFile.empty() && project.pageWidth == 0;
  std::vector<std::string> notes;
  if (drawing.pixels && asDrawn) {
    notes.emplace_back("the drawing is in pixels, each taken as 1/96 inch; --size sets its width");
  }
  if (project.shapeFile.empty() ? project.builtinSize.x == 0 : asDrawn && !drawing.svg) {
    notes.emplace_back("no size is given, so it is 80 mm wide; --size sets it");
  }
  const auto left = [&](int count, const char* what) {
    if (count == 0) return;
    notes.push_back("the drawing has " + std::to_string(count) + " <" + what +
                    ">, which is left out; convert it to paths in the program that made it");
  };
  left(drawing.texts, "text");
  left(drawing.images, "image");
  return notes;
}

std::string sizeText(std::size_t bytes) {
  const auto size = static_cast<double>(bytes);
  if (size < 1e3) return print("%.0f bytes", size);
  return size < 1e6 ? print("%.1f kB", size / 1e3) : print("%.1f MB", size / 1e6);
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

std::vector<std::string> outputNames(const OutputPaths& paths) {
  std::vector<std::string> names;
  for (const std::string* path :
       {&paths.gcode, &paths.svg, &paths.report, &paths.preview, &paths.view, &paths.body, &paths.project}) {
    if (!path->empty()) names.push_back(*path);
  }
  return names;
}

Result<std::vector<OutputFile>> makeOutputs(Job& job, const OutputPaths& paths, const sillon::RunContext& run) {
  std::vector<OutputFile> files;
  if (!paths.gcode.empty()) {
    Result<std::string> text = gcodeText(job, run);
    if (text && paths.gcode.ends_with(".gcode.3mf")) text = sillon::packGcode(text.value());
    if (!text) return text.error();
    files.push_back({paths.gcode, std::move(text).value()});
  }
  if (!paths.svg.empty()) {
    Result<std::string> svg = sillon::toolpathSvg(job.plate.toolpath, job.input.shape.page);
    if (!svg) return svg.error();
    files.push_back({paths.svg, std::move(svg).value()});
  }
  if (!paths.preview.empty()) {
    Result<std::string> png = previewPng(job, paths.previewWidth, run);
    if (!png) return png.error();
    files.push_back({paths.preview, std::move(png).value()});
  }
  if (!paths.view.empty()) {
    const auto view = sillon::viewFile(job.plate.toolpath, job.input.shape.page, {});
    if (!view) return view.error();
    files.push_back({paths.view, std::string(view.value().begin(), view.value().end())});
  }
  if (!paths.body.empty()) {
    const auto mesh = sillon::baseBody(job.input.shape, job.project.printer, job.project.print);
    if (!mesh) return mesh.error();
    const bool zipped = paths.body.ends_with(".3mf");
    files.push_back({paths.body, zipped ? sillon::write3mf(mesh.value()) : sillon::writeStl(mesh.value())});
  }
  if (!paths.project.empty()) files.push_back({paths.project, projectFor(job.project, paths.project)});
  // Last, so that the peak holds all that came before.
  if (!paths.report.empty() && job.measures) {
    files.push_back({paths.report, sillon::reportJson(job.plate, *job.measures, run.threads(), peakBytes())});
  }
  return files;
}

std::string summary(const Job& job, int threads, const std::vector<OutputFile>& files) {
  const sillon::Plate& plate = job.plate;
  const std::size_t toolpaths = plate.toolpath.cycles.size();
  double seconds = 0;
  for (const sillon::StageTime& stage : plate.time) seconds += stage.seconds;

  std::string out = print("plate      %.2f x %.2f mm, spacing %g mm\n", job.input.shape.page.x, job.input.shape.page.y,
                          plate.toolpath.spacing);
  for (const std::string& note : inputNotes(job)) out += "note       " + note + "\n";
  out += print("toolpath   %lld cycles joined to %zu toolpath%s", static_cast<long long>(plate.contourCycles),
               toolpaths, toolpaths == 1 ? "" : "s");
  if (job.measures) out += print(", %.2f m", job.measures->lengthMm / 1000);
  out += "\n";
  if (job.measures) {
    const Measures& m = *job.measures;
    out += print("quality    alignment %.3f (interior %.3f), coverage %.1f %%, overlap %.2f %%, crossings %lld\n",
                 m.alignment, m.alignmentInterior, m.coverage, m.overlap, static_cast<long long>(m.crossings));
  }
  out += print("time       %.2f s on %d thread%s\n", seconds, threads, threads == 1 ? "" : "s");
  if (job.gcode) {
    out += print("print      %s, %.2f m filament, %.1f g\n", durationText(job.gcode->seconds).c_str(),
                 job.gcode->filamentMm / 1000, job.gcode->filamentGrams);
    if (job.gcode->curveSlowedMm > 0) {
      out += print("curves     %.2f m of the oriented path slower than the rest\n", job.gcode->curveSlowedMm / 1000);
    }
  }
  for (const OutputFile& file : files) out += "wrote      " + file.path + " (" + sizeText(file.bytes.size()) + ")\n";
  if (job.gcode) {
    for (const std::string& warning : job.gcode->warnings) out += "warning    " + warning + "\n";
  }
  return out;
}

}  // namespace cli
