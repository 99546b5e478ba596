// What JavaScript may call. Every function returns {value} or {error: {code, message}}; no exception leaves.
#include <emscripten/bind.h>
#include <emscripten/heap.h>

#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "convert.hpp"
#include "sillon/base_body.hpp"
#include "sillon/gcode_archive.hpp"
#include "sillon/gcode_check.hpp"
#include "sillon/measure.hpp"
#include "sillon/pipeline.hpp"
#include "sillon/plate_input.hpp"
#include "sillon/presets.hpp"
#include "sillon/preview.hpp"
#include "sillon/printer_import.hpp"
#include "sillon/project.hpp"
#include "sillon/report.hpp"
#include "sillon/session.hpp"
#include "sillon/thumbnails.hpp"
#include "sillon/toolpath_svg.hpp"
#include "sillon/version.hpp"
#include "sillon/view_file.hpp"

namespace {

using convert::failure;
using convert::success;
using emscripten::val;
using sillon::Error;
using sillon::ErrorCode;
using sillon::Result;

// Both live as long as the module: threads are started once, with it, and what one plate leaves serves the next.
std::unique_ptr<sillon::RunContext> context;
sillon::Session session;

/// Runs one call in a fresh state and turns whatever it throws into an error.
template <class Body>
val guarded(const Body& body) {
  try {
    if (context == nullptr) context = std::make_unique<sillon::RunContext>(1);
    context->cancelFlag().store(false);
    context->onProgress({});
    return body(*context);
  } catch (const std::bad_alloc&) {
    return failure("OutOfMemory",
                   "the engine ran out of memory at " + std::to_string(emscripten_get_heap_size() >> 20) + " MiB");
  } catch (const std::exception& problem) {
    return failure("Internal", problem.what());
  } catch (...) {
    return failure("Internal", "something that is no exception was thrown");
  }
}

/// Tells JavaScript how far a job is. \param begin, end  the part of the whole call that the job is, in [0, 1].
void tell(sillon::RunContext& run, const val& onProgress, double begin, double end) {
  run.onProgress([=](std::string_view stage, double fraction) {
    onProgress(convert::toJs(stage), begin + (end - begin) * fraction);
  });
}

constexpr double kMakingShare = 0.4;  // of making and measuring; wave, one thread

/// \param poll  () => boolean, for RunContext::onPoll; null where memory is shared.
val start(int threads, const val& poll) {
  return guarded([&](sillon::RunContext&) {
    context = std::make_unique<sillon::RunContext>(threads);
    if (!poll.isNull()) context->onPoll([poll] { return poll().as<bool>(); });
    val out = val::object();
    out.set("version", convert::toJs(sillon::kVersion));
    out.set("cancelFlag", reinterpret_cast<std::uintptr_t>(&context->cancelFlag()));
    return success(out);
  });
}

val generateToolpath(const std::string& projectJson, const val& files, bool measure, const val& onProgress) {
  return guarded([&](sillon::RunContext& run) {
    tell(run, onProgress, 0, measure ? kMakingShare : 1);
    const auto project = sillon::readProject(projectJson);
    if (!project) return failure(project.error());
    const sillon::ToolpathParams& params = project.value().toolpath;
    const auto input = sillon::readPlateInput(project.value(), convert::reader(files));
    if (!input) return failure(input.error());
    const sillon::PlateInput& plateInput = input.value();
    const auto plate = session.generateToolpath(plateInput, params, run, measure);
    if (!plate) return failure(plate.error());
    const sillon::Toolpath& toolpath = plate.value().toolpath;

    std::optional<sillon::Measures> measures;
    if (measure) {
      tell(run, onProgress, kMakingShare, 1);
      const auto measured = sillon::measureToolpath(toolpath, plateInput.shape, plateInput.directions, plateInput.modes,
                                                    params, run, plate.value().dislocations);
      if (!measured) return failure(measured.error());
      measures = measured.value();
    }
    val notes = val::array();
    for (const std::string& note : sillon::plateNotes(params, measures)) notes.call<void>("push", val(note));
    val path = convert::toJs(toolpath);
    path.set("shape", convert::toJs(plateInput.shape));
    path.set("notes", notes);
    val out = val::object();
    out.set("toolpath", path);
    out.set("report", val(sillon::reportJson(plate.value(), measures, run.threads(),
                                             static_cast<std::int64_t>(emscripten_get_heap_size()))));
    return success(out);
  });
}

val writeGcode(const val& toolpath, const std::string& projectJson, const std::string& date, const val& onChunk) {
  return guarded([&](sillon::RunContext& run) {
    const auto project = sillon::readProject(projectJson);
    if (!project) return failure(project.error());
    sillon::PrintParams print = project.value().print;
    print.date = date;
    print.notes = emscripten::vecFromJSArray<std::string>(toolpath["notes"]);
    const sillon::Toolpath path = convert::toolpathFrom(toolpath);
    const sillon::Shape shape = convert::shapeFrom(toolpath["shape"]);
    auto thumbnails = sillon::lookThumbnails(path, shape.page, project.value().printer.screenSizes, run);
    if (!thumbnails) return failure(thumbnails.error());
    print.thumbnails = std::move(thumbnails).value();
    const auto summary = sillon::writeGcode(path, shape, project.value().printer, print, [&](std::string_view piece) {
      const auto* data = reinterpret_cast<const std::uint8_t*>(piece.data());
      return !run.cancelled() && onChunk(convert::copied(data, piece.size())).as<bool>();
    });
    if (!summary) return failure(summary.error());
    return success(convert::toJs(summary.value()));
  });
}

val file(const std::string& bytes) {
  return success(convert::copied(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
}

val writeBaseBody(const val& shape, const std::string& projectJson, bool stl) {
  return guarded([&](sillon::RunContext&) {
    const auto project = sillon::readProject(projectJson);
    if (!project) return failure(project.error());
    const auto mesh = sillon::baseBody(convert::shapeFrom(shape), project.value().printer, project.value().print);
    if (!mesh) return failure(mesh.error());
    return file(stl ? sillon::writeStl(mesh.value()) : sillon::write3mf(mesh.value()));
  });
}

val writeSvg(const val& toolpath) {
  return guarded([&](sillon::RunContext&) {
    const auto svg = sillon::toolpathSvg(convert::toolpathFrom(toolpath), convert::shapeFrom(toolpath["shape"]).page);
    if (!svg) return failure(svg.error());
    return file(svg.value());
  });
}

val renderPreview(const val& toolpath, int width, double lightAzimuth, double lightElevation, const val& onProgress) {
  return guarded([&](sillon::RunContext& run) {
    tell(run, onProgress, 0, 1);
    sillon::PreviewParams params;
    params.width = width;
    params.lightAzimuth = lightAzimuth;
    params.lightElevation = lightElevation;
    const auto picture =
        sillon::renderPreview(convert::toolpathFrom(toolpath), convert::shapeFrom(toolpath["shape"]).page, params, run);
    if (!picture) return failure(picture.error());
    const sillon::RgbImage& image = picture.value();
    const std::vector<std::uint8_t> png = sillon::encodePng(image.width, image.height, image.rgb);
    if (png.empty()) throw std::bad_alloc();
    return success(convert::copied(png.data(), png.size()));
  });
}

val writeView(const val& toolpath, const val& colour, double slopeAlong, double slopeAcross) {
  return guarded([&](sillon::RunContext&) {
    const auto channel = [&colour](int k) { return colour[k].as<std::uint8_t>(); };
    const sillon::ViewParams params{{channel(0), channel(1), channel(2)}, slopeAlong, slopeAcross};
    const auto view =
        sillon::viewFile(convert::toolpathFrom(toolpath), convert::shapeFrom(toolpath["shape"]).page, params);
    if (!view) return failure(view.error());
    return success(convert::copied(view.value().data(), view.value().size()));
  });
}

val readShape(const std::string& projectJson, const val& files) {
  return guarded([&](sillon::RunContext&) {
    const auto project = sillon::readProject(projectJson);
    if (!project) return failure(project.error());
    const auto input = sillon::readPlateInput(project.value(), convert::reader(files));
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

val readProject(const std::string& json) {
  return guarded([&](sillon::RunContext&) {
    const auto project = sillon::readProject(json);
    if (!project) return failure(project.error());
    return success(val(sillon::writeProject(project.value())));
  });
}

val listOf(const std::vector<std::string>& texts) {
  val list = val::array();
  for (const std::string& text : texts) list.call<void>("push", val(text));
  return list;
}

/// Printers as the text of project files.
val presets() {
  return guarded([&](sillon::RunContext&) {
    const auto all = [](sillon::PresetKind kind) {
      val list = val::array();
      for (const sillon::Preset& preset : sillon::presets(kind)) {
        val entry = val::object();
        entry.set("id", val(preset.id));
        entry.set("project", val(sillon::writePrinter(preset.printer)));
        list.call<void>("push", entry);
      }
      return list;
    };
    val out = val::object();
    out.set("printers", all(sillon::PresetKind::Printer));
    out.set("filaments", all(sillon::PresetKind::Filament));
    return success(out);
  });
}

val importPrinter(const val& file, const std::string& name) {
  return guarded([&](sillon::RunContext&) {
    const auto imported = sillon::importPrinter(convert::bytes(file), name);
    if (!imported) return failure(imported.error());
    val out = val::object();
    out.set("project", val(sillon::writePrinter(imported.value().printer)));
    out.set("source", val(imported.value().source));
    out.set("read", listOf(imported.value().read));
    out.set("notRead", listOf(imported.value().notRead));
    return success(out);
  });
}

/// \param projectJson  whose printer counts; empty: what the file's own settings say.
val checkGcode(const val& file, const std::string& projectJson) {
  return guarded([&](sillon::RunContext&) {
    std::optional<sillon::Printer> printer;
    if (!projectJson.empty()) {
      const auto project = sillon::readProject(projectJson);
      if (!project) return failure(project.error());
      printer = project.value().printer;
    }
    const auto text = sillon::unpackGcode(convert::bytes(file));
    if (!text) return failure(text.error());
    return success(convert::toJs(sillon::checkGcode(text.value(), printer)));
  });
}

val packGcode(const val& gcode) {
  return guarded([&](sillon::RunContext&) {
    const auto archive = sillon::packGcode(convert::bytes(gcode));
    if (!archive) return failure(archive.error());
    return file(archive.value());
  });
}

}  // namespace

EMSCRIPTEN_BINDINGS(sillon) {
  emscripten::function("start", &start);
  emscripten::function("generateToolpath", &generateToolpath);
  emscripten::function("writeGcode", &writeGcode);
  emscripten::function("writeBaseBody", &writeBaseBody);
  emscripten::function("writeSvg", &writeSvg);
  emscripten::function("renderPreview", &renderPreview);
  emscripten::function("writeView", &writeView);
  emscripten::function("readShape", &readShape);
  emscripten::function("decodePicture", &decodePicture);
  emscripten::function("readProject", &readProject);
  emscripten::function("presets", &presets);
  emscripten::function("importPrinter", &importPrinter);
  emscripten::function("checkGcode", &checkGcode);
  emscripten::function("packGcode", &packGcode);
}
