// Plates: what JavaScript may call of sillon-st and sillon-mt.
#include <emscripten/bind.h>
#include <emscripten/heap.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "call.hpp"
#include "convert.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/pipeline/session.hpp"
#include "sillon/project/plate_input.hpp"
#include "sillon/project/project.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/quality/picture_measures.hpp"
#include "sillon/report/report.hpp"
#include "sillon/report/warning.hpp"
#include "sillon/settings/presets.hpp"

namespace {

using call::guarded;
using call::tell;
using convert::failure;
using convert::success;
using emscripten::val;

// They live as long as the module: what one plate leaves serves the next.
sillon::Session session;
std::optional<sillon::KeptPictures> keptPictures;

constexpr double kMakingShare = 0.4;  // of making and measuring; wave, one thread
constexpr double kTrialShare = 0.4;   // of making a plate whose lamp is chosen by three
constexpr double kShownShare = 0.8;   // of a plate with pictures and the path across it

/// \param across  the path of the layer below instead, which nothing measures.
val generateToolpath(const std::string& projectJson, const val& files, bool measure, bool across,
                     const val& onProgress) {
  return guarded([&](sillon::RunContext& run) {
    tell(run, onProgress, 0, measure ? kMakingShare : 1);
    const auto project = sillon::readProject(projectJson);
    if (!project) return failure(project.error());
    const sillon::ToolpathParams& params = project.value().toolpath;
    auto input = sillon::readPlateInput(project.value(), convert::reader(files), run);
    if (!input) return failure(input.error());
    const double making = measure ? kMakingShare : across ? kShownShare : 1;
    double tried = 0;  // of the making
    const auto onTrial = [&](int trial, int trials) {
      tried = kTrialShare;
      tell(run, onProgress, making * tried * trial / trials, making * tried * (trial + 1) / trials);
    };
    const auto pictures =
        sillon::solvePictures(project.value(), convert::reader(files), input.value(), run, &keptPictures, onTrial);
    if (!pictures) return failure(pictures.error());
    const sillon::PlateInput& plateInput = input.value();
    const auto make = [&](const sillon::PlateInput& wanted, int round, int rounds) {
      const double share = making * (1 - tried) / rounds;
      tell(run, onProgress, making * tried + share * round, making * tried + share * (round + 1));
      return session.generateToolpath(wanted, params, run, measure);
    };
    const auto generate = [&]() -> sillon::Result<sillon::ToolpathResult> {
      // Corrections of pictures turn the directions that a path across lies across.
      if (!across || !pictures.value().shown.empty()) {
        auto shown = sillon::makeShownPlate(project.value(), pictures.value(), input.value(), make, run);
        if (!shown || !across) return shown;
        tell(run, onProgress, making, 1);
      }
      return sillon::generateAcross(plateInput, params, run);
    };
    const auto plate = generate();
    if (!plate) return failure(plate.error());
    const sillon::Toolpath& toolpath = plate.value().toolpath;

    std::optional<sillon::Measures> measures;
    std::vector<sillon::PictureMeasures> seen;
    if (measure) {
      tell(run, onProgress, kMakingShare, 1);
      const auto measured = sillon::measureToolpath(toolpath, plateInput, params, run, plate.value().dislocations);
      if (!measured) return failure(measured.error());
      measures = measured.value();
      if (!pictures.value().shown.empty()) {
        auto judged = sillon::measurePictures(toolpath, plateInput.shape.page, pictures.value().shown,
                                              pictures.value().roughness, run);
        if (!judged) return failure(judged.error());
        seen = std::move(judged).value();
      }
    }
    val notes = val::array();
    for (const std::string& note : sillon::plateNotes(params, measures)) notes.call<void>("push", val(note));
    val path = convert::toJs(toolpath);
    path.set("shape", convert::toJs(plateInput.shape));
    path.set("notes", notes);
    if (!pictures.value().shown.empty()) path.set("look", convert::toJs(project.value(), pictures.value()));
    val out = val::object();
    out.set("toolpath", path);
    if (pictures.value().shown.size() > 1) out.set("conflict", convert::conflictOf(plateInput, pictures.value()));
    sillon::Report report = sillon::reportOf(plate.value(), measures);
    report.threads = run.threads();
    report.peakBytes = static_cast<std::int64_t>(emscripten_get_heap_size());
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const sillon::ShownPicture& shown = pictures.value().shown[k];
      report.pictures.push_back({shown.file, shown.lamp, seen[k]});
    }
    report.warnings =
        sillon::plateWarnings(plateInput.shape.drawing, plate.value().apart, pictureFacts(pictures.value(), seen),
                              measures, plateInput.shape.page, toolpath.spacing);
    out.set("report", val(sillon::reportJson(report)));
    return success(out);
  });
}

val readShape(const std::string& projectJson, const val& files) {
  return guarded([&](sillon::RunContext& run) {
    const auto project = sillon::readProject(projectJson);
    if (!project) return failure(project.error());
    const auto input = sillon::readPlateInput(project.value(), convert::reader(files), run);
    if (!input) return failure(input.error());
    return success(convert::toJs(input.value().shape));
  });
}

val decodePicture(const val& file, const std::string& name) {
  return guarded([&](sillon::RunContext&) {
    const auto image = sillon::decodeImage(convert::numbers<std::uint8_t>(file), name);
    if (!image) return failure(image.error());
    return success(convert::toJs(image.value()));
  });
}

/// Printers as the text of project files.
val profiles() {
  return guarded([&](sillon::RunContext&) {
    const auto all = [](sillon::ProfileKind kind) {
      val list = val::array();
      for (const sillon::PrinterProfile& preset : sillon::profiles(kind)) {
        val entry = val::object();
        entry.set("id", val(preset.id));
        entry.set("project", val(sillon::writePrinter(preset.printer)));
        list.call<void>("push", entry);
      }
      return list;
    };
    val out = val::object();
    out.set("printers", all(sillon::ProfileKind::Printer));
    out.set("filaments", all(sillon::ProfileKind::Filament));
    return success(out);
  });
}

}  // namespace

EMSCRIPTEN_BINDINGS(plates) {
  emscripten::function("generateToolpath", &generateToolpath);
  emscripten::function("readShape", &readShape);
  emscripten::function("decodePicture", &decodePicture);
  emscripten::function("profiles", &profiles);
}
