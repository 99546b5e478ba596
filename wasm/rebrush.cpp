// Bindings for prints from slicers.
#include <emscripten/bind.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "bindings.hpp"
#include "call.hpp"
#include "convert.hpp"
#include "sillon/export/export.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/project/project.hpp"
#include "sillon/rebrush/rebrush.hpp"

namespace sillon::bindings {
namespace {

/// Converts a surface.
val surfaceOf(const SlicedSurface& surface) {
  return object({{"side", surface.side == SurfaceSide::Top ? "top" : "bottom"},
                 {"layer", surface.layer},
                 {"z", surface.z},
                 {"height", surface.height},
                 {"object", surface.object},
                 {"tool", surface.tool},
                 {"region", toJs(surface.region)},
                 {"corner", toJs(surface.corner)},
                 {"areaMm2", surface.areaMm2},
                 {"width", surface.width},
                 {"spacing", surface.spacing},
                 {"volumeMm3", surface.volumeMm3},
                 {"speed", surface.speed},
                 {"left", surface.left == LeftBecause::None ? val("") : val(surfaceReason(surface.left))},
                 {"reason", surfaceReasonName(surface.left)}});
}

/// Converts the facts of a sliced file.
val fileOf(const SlicedFile& file) {
  return object({{"slicer", slicerName(file.slicer)},
                 {"program", file.program},
                 {"layers", file.layers},
                 {"lines", static_cast<double>(file.lines)},
                 {"nozzle", file.nozzle},
                 {"surfaces", listOf(file.surfaces, surfaceOf)}});
}

// The print for the calls below, and its surfaces once they are found.
std::optional<GcodeContainer> print;
std::optional<SlicedFile> sliced;

/// Finds the surfaces of the print, unless that is done. Returns an error, or nothing.
std::optional<Error> findSurfaces(const RunContext& run) {
  if (sliced) return std::nullopt;
  auto read = readSlicedFile(print->gcode, run);
  if (!read) return read.error();
  sliced = std::move(read).value();
  return std::nullopt;
}

/// Converts the pictures of a replaced surface, with their measures.
val picturesOf(const RebrushedSurface& made) {
  val pictures = val::array();
  for (std::size_t k = 0; k < made.pictures.size(); ++k) {
    const auto& [layer, file, lamp, measures] = made.pictures[k];
    val out = object({{"layer", static_cast<double>(layer)},
                      {"lamp", toJs(Vec2{lamp.azimuth, lamp.elevation})},
                      {"r", measures.r},
                      {"ssim", measures.ssim},
                      {"contrast", measures.contrast}});
    if (k < made.leftOut.size()) out.set("leftOut", made.leftOut[k]);
    pictures.call<void>("push", out);
  }
  return pictures;
}

}  // namespace

void forgetPrint() {
  print.reset();
  sliced.reset();
}

val readPrint() {
  return guarded([&](RunContext&) {
    auto container = readGcodeContainer(takenFile());
    if (!container) return failure(container.error());
    print = std::move(container).value();
    return success(val::undefined());
  });
}

val listSurfaces(const val& onProgress) {
  return guarded([&](RunContext& run) {
    tell(run, onProgress, 0, 1);
    if (const auto problem = findSurfaces(run)) return failure(*problem);
    return success(fileOf(*sliced));
  });
}

val printRelief(int side, const val& onProgress) {
  return guarded([&](RunContext& run) {
    tell(run, onProgress, 0, 1);
    const auto relief = sillon::printRelief(print->gcode, side, run);
    if (!relief) return failure(relief.error());
    return success(object({{"corner", toJs(relief.value().corner)},
                           {"cell", relief.value().cell},
                           {"columns", relief.value().columns},
                           {"rows", relief.value().rows},
                           {"heights", copied(relief.value().heights.data(), relief.value().heights.size())}}));
  });
}

val rebrush(const std::string& projectJson, const val& files, const std::string& sides, const std::string& fit,
            const val& only, const val& onProgress, const val& onPiece) {
  return withProject(projectJson, [&](const Project& project, RunContext& run) {
    if (print->plates > 1) return failure(refusedFile("SeveralPlates", {{"count", print->plates}}));
    RebrushOptions options;
    options.project = project;
    options.read = reader(files);
    options.tops = sides != "bottom";
    options.bottoms = sides != "top";
    options.fit = fit == "object" ? PictureFit::Object
                  : fit == "bed"  ? PictureFit::Bed
                  : fit == "all"  ? PictureFit::All
                                  : PictureFit::Face;
    for (const double index : numbers<double>(only)) options.only.push_back(toSize(index));
    options.onSurface = [&](std::size_t done, std::size_t all) {
      const double share = 1.0 / static_cast<double>(all);
      tell(run, onProgress, static_cast<double>(done) * share, static_cast<double>(done + 1) * share);
    };
    tell(run, onProgress, 0, 0);
    if (const auto problem = findSurfaces(run)) return failure(*problem);
    const auto done = sillon::rebrush(print->gcode, *sliced, options, run);
    if (!done) return failure(done.error());
    val surfaces = val::array();
    for (const RebrushedSurface& made : done.value().surfaces) {
      val out = surfaceOf(done.value().file.surfaces[made.surface]);
      out.set("index", static_cast<double>(made.surface));
      out.set("left", val(made.why));
      out.set("reason", val(surfaceReasonName(made.because)));
      out.set("replaced", made.replaced);
      out.set("newVolumeMm3", made.volumeMm3);
      out.set("alignment", made.alignment);
      out.set("coverage", made.coverage);
      out.set("beyond", made.beyond);
      out.set("seconds", made.seconds);
      out.set("pictures", picturesOf(made));
      out.set("cycles", toJs(made.toolpath)["cycles"]);
      surfaces.call<void>("push", out);
    }
    constexpr std::size_t kPiece = std::size_t{4} << 20;  // bytes
    std::string piece;
    const auto give = [&] {
      onPiece(copied(piece));
      piece.clear();
    };
    const auto take = [&](std::string_view bytes) {
      while (!bytes.empty()) {
        const std::string_view more = bytes.substr(0, kPiece - piece.size());
        piece += more;
        bytes.remove_prefix(more.size());
        if (piece.size() == kPiece) give();
      }
    };
    const auto parts = partsOf(print->gcode, done.value().edits);
    if (const auto problem = writeGcodeContainer(*print, parts, take)) return failure(*problem);
    give();
    return success(object({{"seconds", done.value().seconds}, {"surfaces", surfaces}}));
  });
}

}  // namespace sillon::bindings
