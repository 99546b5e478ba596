// Bindings for plates: their input, and making them.
#include <emscripten/bind.h>
#include <emscripten/heap.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "call.hpp"
#include "convert.hpp"
#include "kept.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/job/zones.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/project/project.hpp"
#include "sillon/report/report.hpp"
#include "sillon/settings/presets.hpp"
#include "sillon/text/text.hpp"

namespace {

using call::guarded;
using call::tell;
using convert::failure;
using convert::success;
using emscripten::val;

// These live as long as the module, so that a plate can reuse results of the one before.
sillon::Session session;
std::optional<sillon::KeptPictures> keptPictures;

struct Sides {
  int width = 0;
  int height = 0;

  friend bool operator==(const Sides&, const Sides&) = default;
};

/// Resamples a raster to other sides. Without layers above it, the lowest layer may have pictures of two sizes, either
/// of which may be a single texel.
template <class T>
std::vector<T> stretched(const std::vector<T>& values, Sides from, Sides to) {
  if (from == to) return values;
  const auto below = [](int k, int count, int own) {
    return sillon::toSize((2 * std::int64_t{k} + 1) * own / (2 * std::int64_t{count}));
  };
  std::vector<std::size_t> columns;
  for (int x = 0; x < to.width; ++x) columns.push_back(below(x, to.width, from.width));
  std::vector<T> out;
  for (int y = 0; y < to.height; ++y) {
    const T* const row = values.data() + below(y, to.height, from.height) * from.width;
    for (const std::size_t column : columns) out.push_back(row[column]);
  }
  return out;
}

}  // namespace

namespace bindings {

val generateToolpath(const std::string& projectJson, const val& files, bool measure, bool across, int number,
                     const val& onProgress) {
  return guarded([&](sillon::RunContext& run) {
    tell(run, onProgress, 0, 1);
    auto project = call::projectOf(projectJson);
    if (!project) return failure(project.error());
    sillon::PlateOptions options;
    options.path = across ? sillon::PlatePath::Below : sillon::PlatePath::Seen;
    options.measure = measure;
    options.countDislocations = measure;
    options.session = &session;
    options.keptPictures = &keptPictures;
    auto made = sillon::makePlate(std::move(project).value(), convert::reader(files), options, run);
    if (!made) return failure(made.error());
    sillon::Plate& plate = made.value();

    val notes = val::array();
    for (const std::string& note : sillon::plateNotes(plate.project.toolpath, plate.measures))
      notes.call<void>("push", val(note));
    val path = convert::toJs(plate.toolpath());
    path.set("shape", convert::toJs(plate.input.shape));
    path.set("notes", notes);
    if (!plate.pictures().shown.empty()) path.set("look", convert::toJs(plate.project, plate.pictures()));
    val out = val::object();
    out.set("toolpath", path);
    if (plate.pictures().shown.size() > 1) out.set("conflict", convert::conflictOf(plate.input, plate.pictures()));
    sillon::Report report = plate.report();
    report.peakBytes = static_cast<std::int64_t>(emscripten_get_heap_size());
    out.set("report", val(sillon::reportJson(report)));
    kept::keep(number, std::move(plate.result.toolpath));
    return success(out);
  });
}

val readShape(const std::string& projectJson, const val& files) {
  return guarded([&](sillon::RunContext& run) {
    const auto project = call::projectOf(projectJson);
    if (!project) return failure(project.error());
    const auto input = sillon::readPlateInput(project.value(), convert::reader(files), run);
    if (!input) return failure(input.error());
    return success(convert::toJs(input.value().shape));
  });
}

val placeLayers(const std::string& projectJson, const val& files) {
  return guarded([&](sillon::RunContext& run) {
    const auto project = call::projectOf(projectJson);
    if (!project) return failure(project.error());
    const sillon::ReadInput read = convert::reader(files);
    const auto input = sillon::readPlateInput(project.value(), read, run);
    if (!input) return failure(input.error());
    const auto placed = sillon::placeLayers(project.value(), input.value().shape, read);
    val out = val::array();
    for (const sillon::PlacedLayer& layer : placed) {
      val one = val::object();
      one.set("at", convert::toJs(layer.at));
      one.set("size", convert::toJs(layer.size));
      one.set("thin", layer.thin);
      if (layer.problem) one.set("problem", layer.problem->message);
      out.call<void>("push", one);
    }
    return success(out);
  });
}

val drawLayers(const std::string& projectJson, const val& files, const val& onProgress) {
  return guarded([&](sillon::RunContext& run) {
    tell(run, onProgress, 0, 1);
    const auto project = call::projectOf(projectJson);
    if (!project) return failure(project.error());
    const sillon::ReadInput read = convert::reader(files);
    auto ground = sillon::readPlateInput(project.value(), read, run);
    if (!ground) return failure(ground.error());
    const auto composed = sillon::compose(project.value(), std::move(ground).value(), {read, &keptPictures}, run);
    if (!composed) return failure(composed.error());
    const sillon::PlateInput laid = composed.value().laid();
    const sillon::DirectionMap& directions = laid.directions;
    const sillon::ModeMap& modes = laid.modes;
    const int width = std::max(directions.width, modes.width);
    const int height = std::max(directions.height, modes.height);
    const auto angle = stretched(directions.angle, {directions.width, directions.height}, {width, height});
    const auto mode = stretched(modes.mode, {modes.width, modes.height}, {width, height});
    val out = val::object();
    out.set("width", width);
    out.set("height", height);
    out.set("angle", convert::copied(angle.data(), angle.size()));
    out.set("mode", convert::copied(reinterpret_cast<const std::uint8_t*>(mode.data()), mode.size()));
    return success(out);
  });
}

val makeZones(const std::string& projectJson, const val& files, bool body, const val& params, const val& onProgress) {
  return guarded([&](sillon::RunContext& run) {
    tell(run, onProgress, 0, 1);
    const auto project = call::projectOf(projectJson);
    if (!project) return failure(project.error());
    sillon::ZonesRequest request;
    if (body) request.body = call::takenFile();
    request.height = params[0].as<double>();
    request.params.most = params[1].as<int>();
    request.params.least = params[2].as<double>();
    request.layerHeight = params[3].as<double>();
    if (!params[4].isUndefined()) {
      request.face = {{params[4].as<double>(), params[5].as<double>()}, params[6].as<double>()};
    }
    const auto made = sillon::makeZones(project.value(), request, convert::reader(files), run);
    if (!made) return failure(made.error());
    val zones = val::array();
    for (const sillon::DirectionZone& zone : made.value().zones.zones) {
      val one = val::object();
      one.set("degrees", zone.degrees);
      one.set("areaMm2", zone.areaMm2);
      zones.call<void>("push", one);
    }
    val out = val::object();
    const std::string& package = made.value().package;
    out.set("file", convert::copied(reinterpret_cast<const std::uint8_t*>(package.data()), package.size()));
    out.set("zones", zones);
    out.set("error", made.value().zones.error);
    out.set("openEdges", static_cast<double>(made.value().openEdges));
    out.set("notes", convert::toJs(made.value().notes));
    out.set("warnings", convert::toJs(made.value().warnings));
    return success(out);
  });
}

val linesOfDrawing(const val& file) {
  return guarded([&](sillon::RunContext&) {
    const std::vector<std::uint8_t> bytes = convert::numbers<std::uint8_t>(file);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    val out = val::array();
    for (const std::string& name : sillon::linesOfDrawing(text)) out.call<void>("push", val(name));
    return success(out);
  });
}

val paintDrawing(const val& files, const std::string& name) {
  return guarded([&](sillon::RunContext&) {
    const auto painted = sillon::readPainted(convert::reader(files), name, "drawing");
    if (!painted) return failure(painted.error());
    return success(convert::toJs(painted.value().picture));
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

val writeProject(const std::string& projectJson) {
  return guarded([&](sillon::RunContext&) {
    const auto project = call::projectOf(projectJson);
    if (!project) return failure(project.error());
    return success(val(sillon::writeProject(project.value())));
  });
}

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

}  // namespace bindings
