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
#include "sillon/export/gcode_archive.hpp"
#include "sillon/look/spools.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/project/project.hpp"
#include "sillon/rebrush/rebrush.hpp"

namespace {

using call::guarded;
using call::tell;
using convert::failure;
using convert::success;
using emscripten::val;

/// Converts a surface.
val surfaceOf(const sillon::SlicedSurface& surface) {
  val out = val::object();
  out.set("side", val(surface.side == sillon::SurfaceSide::Top ? "top" : "bottom"));
  out.set("layer", surface.layer);
  out.set("z", surface.z);
  out.set("height", surface.height);
  out.set("object", val(surface.object));
  out.set("tool", surface.tool);
  out.set("region", convert::toJs(surface.region));
  out.set("corner", convert::toJs(surface.corner));
  out.set("areaMm2", surface.areaMm2);
  out.set("width", surface.width);
  out.set("spacing", surface.spacing);
  out.set("volumeMm3", surface.volumeMm3);
  out.set("speed", surface.speed);
  out.set("left", surface.left == sillon::LeftBecause::None ? val("") : val(surfaceReason(surface.left)));
  out.set("reason", val(surfaceReasonName(surface.left)));
  return out;
}

/// Converts the facts of a sliced file.
val fileOf(const sillon::SlicedFile& file) {
  val surfaces = val::array();
  for (const sillon::SlicedSurface& surface : file.surfaces) surfaces.call<void>("push", surfaceOf(surface));
  val out = val::object();
  out.set("slicer", val(slicerName(file.slicer)));
  out.set("program", val(file.program));
  out.set("layers", file.layers);
  out.set("lines", static_cast<double>(file.lines));
  out.set("nozzle", file.nozzle);
  out.set("surfaces", surfaces);
  return out;
}

// The print for the calls below, and its surfaces once they are found.
std::optional<sillon::GcodeContainer> print;
std::optional<sillon::SlicedFile> sliced;

/// Finds the surfaces of the print, unless that is done. Returns an error, or nothing.
std::optional<sillon::Error> findSurfaces(const sillon::RunContext& run) {
  if (sliced) return std::nullopt;
  auto read = sillon::readSlicedFile(print->gcode, run);
  if (!read) return read.error();
  sliced = std::move(read).value();
  return std::nullopt;
}

/// Converts the pictures of a replaced surface, with their measures.
val picturesOf(const sillon::RebrushedSurface& made) {
  val pictures = val::array();
  for (std::size_t k = 0; k < made.pictures.size(); ++k) {
    val out = val::object();
    const auto& [layer, file, lamp, measures] = made.pictures[k];
    out.set("layer", static_cast<double>(layer));
    out.set("lamp", convert::toJs(sillon::Vec2{lamp.azimuth, lamp.elevation}));
    out.set("r", measures.r);
    out.set("ssim", measures.ssim);
    out.set("contrast", measures.contrast);
    if (k < made.leftOut.size()) out.set("leftOut", made.leftOut[k]);
    pictures.call<void>("push", out);
  }
  return pictures;
}

}  // namespace

namespace bindings {

void forgetPrint() {
  print.reset();
  sliced.reset();
}

val readPrint() {
  return guarded([&](sillon::RunContext&) {
    auto container = sillon::readGcodeContainer(call::takenFile());
    if (!container) return failure(container.error());
    print = std::move(container).value();
    return success(val::undefined());
  });
}

val listSurfaces(const val& onProgress) {
  return guarded([&](sillon::RunContext& run) {
    tell(run, onProgress, 0, 1);
    if (const auto problem = findSurfaces(run)) return failure(*problem);
    return success(fileOf(*sliced));
  });
}

val printRelief(int side, const val& onProgress) {
  return guarded([&](sillon::RunContext& run) {
    tell(run, onProgress, 0, 1);
    const auto relief = sillon::printRelief(print->gcode, side, run);
    if (!relief) return failure(relief.error());
    val out = val::object();
    out.set("corner", convert::toJs(relief.value().corner));
    out.set("cell", relief.value().cell);
    out.set("columns", relief.value().columns);
    out.set("rows", relief.value().rows);
    out.set("heights", convert::copied(relief.value().heights.data(), relief.value().heights.size()));
    return success(out);
  });
}

val rebrush(const std::string& projectJson, const val& files, const std::string& sides, const std::string& fit,
            const val& only, const val& onProgress, const val& onPiece) {
  return guarded([&](sillon::RunContext& run) {
    const auto project = call::projectOf(projectJson);
    if (!project) return failure(project.error());
    if (print->plates > 1) return failure(sillon::refusedFile("SeveralPlates", {{"count", print->plates}}));
    sillon::RebrushOptions options;
    options.project = project.value();
    options.read = convert::reader(files);
    options.tops = sides != "bottom";
    options.bottoms = sides != "top";
    options.fit = fit == "object" ? sillon::PictureFit::Object
                  : fit == "bed"  ? sillon::PictureFit::Bed
                  : fit == "all"  ? sillon::PictureFit::All
                                  : sillon::PictureFit::Face;
    for (const double index : convert::numbers<double>(only)) options.only.push_back(static_cast<std::size_t>(index));
    options.onSurface = [&](std::size_t done, std::size_t all) {
      const double share = 1.0 / static_cast<double>(all);
      tell(run, onProgress, static_cast<double>(done) * share, static_cast<double>(done + 1) * share);
    };
    tell(run, onProgress, 0, 0);
    if (const auto problem = findSurfaces(run)) return failure(*problem);
    const auto done = sillon::rebrush(print->gcode, *sliced, options, run);
    if (!done) return failure(done.error());
    val surfaces = val::array();
    for (const sillon::RebrushedSurface& made : done.value().surfaces) {
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
      out.set("cycles", convert::toJs(made.toolpath)["cycles"]);
      surfaces.call<void>("push", out);
    }
    constexpr std::size_t kPiece = std::size_t{4} << 20;  // bytes
    std::string piece;
    const auto give = [&] {
      onPiece(convert::copied(reinterpret_cast<const std::uint8_t*>(piece.data()), piece.size()));
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
    const auto parts = sillon::partsOf(print->gcode, done.value().edits);
    if (const auto problem = sillon::writeGcodeContainer(*print, parts, take)) return failure(*problem);
    give();
    val out = val::object();
    out.set("seconds", done.value().seconds);
    out.set("surfaces", surfaces);
    return success(out);
  });
}

}  // namespace bindings
