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
#include "sillon/pictures/pictures.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/project/project.hpp"
#include "sillon/report/report.hpp"
#include "sillon/settings/presets.hpp"
#include "sillon/text/text.hpp"

namespace sillon::bindings {
namespace {

// These live as long as the module, so that a plate can reuse results of the one before.
Session session;
std::optional<KeptPictures> keptPictures;

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

val generateToolpath(const std::string& projectJson, const val& files, bool measure, bool across, int number,
                     const val& onProgress) {
  return withProject(projectJson, [&](Project& project, RunContext& run) {
    tell(run, onProgress, 0, 1);
    PlateOptions options;
    options.path = across ? PlatePath::Below : PlatePath::Seen;
    options.measure = measure;
    options.countDislocations = measure;
    options.session = &session;
    options.keptPictures = &keptPictures;
    auto made = makePlate(std::move(project), reader(files), options, run);
    if (!made) return failure(made.error());
    Plate& plate = made.value();

    val path = toJs(plate.toolpath());
    path.set("shape", toJs(plate.input.shape));
    path.set("notes", listOf(plateNotes(plate.project.toolpath, plate.measures)));
    if (!plate.pictures().shown.empty()) path.set("look", toJs(plate.project, plate.pictures()));
    val out = object({{"toolpath", path}});
    if (plate.pictures().shown.size() > 1) out.set("conflict", conflictOf(plate.input, plate.pictures()));
    Report report = plate.report();
    report.peakBytes = static_cast<std::int64_t>(emscripten_get_heap_size());
    out.set("report", val(reportJson(report)));
    kept::keep(number, std::move(plate.result.toolpath));
    return success(out);
  });
}

val readShape(const std::string& projectJson, const val& files) {
  return withProject(projectJson, [&](const Project& project, RunContext& run) {
    const auto input = readPlateInput(project, reader(files), run);
    if (!input) return failure(input.error());
    return success(toJs(input.value().shape));
  });
}

val placeLayers(const std::string& projectJson, const val& files) {
  return withProject(projectJson, [&](const Project& project, RunContext& run) {
    const ReadInput read = reader(files);
    const auto input = readPlateInput(project, read, run);
    if (!input) return failure(input.error());
    const auto layerOf = [](const PlacedLayer& layer) {
      val one = object({{"at", toJs(layer.at)}, {"size", toJs(layer.size)}, {"thin", layer.thin}});
      if (layer.problem) one.set("problem", layer.problem->message);
      return one;
    };
    return success(listOf(sillon::placeLayers(project, input.value().shape, read), layerOf));
  });
}

val drawLayers(const std::string& projectJson, const val& files, const val& onProgress) {
  return withProject(projectJson, [&](const Project& project, RunContext& run) {
    tell(run, onProgress, 0, 1);
    const ReadInput read = reader(files);
    auto ground = readPlateInput(project, read, run);
    if (!ground) return failure(ground.error());
    const auto composed = compose(project, std::move(ground).value(), {read, &keptPictures}, run);
    if (!composed) return failure(composed.error());
    const PlateInput laid = composed.value().laid();
    const DirectionMap& directions = laid.directions;
    const ModeMap& modes = laid.modes;
    const int width = std::max(directions.width, modes.width);
    const int height = std::max(directions.height, modes.height);
    const auto angle = stretched(directions.angle, {directions.width, directions.height}, {width, height});
    const auto mode = stretched(modes.mode, {modes.width, modes.height}, {width, height});
    return success(object({{"width", width},
                           {"height", height},
                           {"angle", copied(angle.data(), angle.size())},
                           {"mode", copied(reinterpret_cast<const std::uint8_t*>(mode.data()), mode.size())}}));
  });
}

val makeZones(const std::string& projectJson, const val& files, bool body, const val& params, const val& onProgress) {
  return withProject(projectJson, [&](const Project& project, RunContext& run) {
    tell(run, onProgress, 0, 1);
    ZonesRequest request;
    if (body) request.body = takenFile();
    request.height = params[0].as<double>();
    request.params.most = params[1].as<int>();
    request.params.least = params[2].as<double>();
    request.layerHeight = params[3].as<double>();
    if (!params[4].isUndefined()) {
      request.face = {{params[4].as<double>(), params[5].as<double>()}, params[6].as<double>()};
    }
    const auto made = sillon::makeZones(project, request, reader(files), run);
    if (!made) return failure(made.error());
    const auto zoneOf = [](const DirectionZone& zone) {
      return object({{"degrees", zone.degrees}, {"areaMm2", zone.areaMm2}});
    };
    const ZonesMade& all = made.value();
    return success(object({{"file", copied(all.package)},
                           {"zones", listOf(all.zones.zones, zoneOf)},
                           {"error", all.zones.error},
                           {"openEdges", static_cast<double>(all.openEdges)},
                           {"notes", toJs(all.notes)},
                           {"warnings", toJs(all.warnings)}}));
  });
}

val linesOfDrawing(const val& file) {
  return guarded([&](RunContext&) {
    const std::vector<std::uint8_t> bytes = numbers<std::uint8_t>(file);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return success(listOf(sillon::linesOfDrawing(text)));
  });
}

val paintDrawing(const val& files, const std::string& name) {
  return guarded([&](RunContext&) {
    const auto painted = readPainted(reader(files), name, "drawing");
    if (!painted) return failure(painted.error());
    return success(toJs(painted.value().picture));
  });
}

val decodePicture(const val& file, const std::string& name) {
  return guarded([&](RunContext&) {
    const auto image = decodeImage(numbers<std::uint8_t>(file), name);
    if (!image) return failure(image.error());
    return success(toJs(image.value()));
  });
}

val readProject(const std::string& json) {
  return guarded([&](RunContext&) {
    const auto project = sillon::readProject(json);
    if (!project) return failure(project.error());
    return success(val(sillon::writeProject(project.value())));
  });
}

val writeProject(const std::string& projectJson) {
  return withProject(projectJson,
                     [&](const Project& project, RunContext&) { return success(val(sillon::writeProject(project))); });
}

val profiles() {
  return guarded([&](RunContext&) {
    const auto all = [](ProfileKind kind) {
      return listOf(sillon::profiles(kind), [](const PrinterProfile& preset) {
        return object({{"id", preset.id}, {"project", writePrinter(preset.printer)}});
      });
    };
    return success(object({{"printers", all(ProfileKind::Printer)}, {"filaments", all(ProfileKind::Filament)}}));
  });
}

}  // namespace sillon::bindings
