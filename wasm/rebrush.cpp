// Other people's prints: what JavaScript may call of sillon-rebrush, which is loaded when the first is wanted. It makes
// plates and reads files, so neither of the other modules has to do both.
#include <emscripten/bind.h>

#include <string>
#include <utility>

#include "call.hpp"
#include "convert.hpp"
#include "sillon/export/gcode_archive.hpp"
#include "sillon/project/plate_input.hpp"
#include "sillon/project/project.hpp"
#include "sillon/rebrush/rebrush.hpp"

namespace {

using call::guarded;
using call::tell;
using convert::failure;
using convert::success;
using emscripten::val;

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
  return out;
}

val fileOf(const sillon::SlicedFile& file) {
  val surfaces = val::array();
  for (const sillon::SlicedSurface& surface : file.surfaces) surfaces.call<void>("push", surfaceOf(surface));
  val out = val::object();
  out.set("slicer", val(slicerName(file.slicer)));
  out.set("program", val(file.program));
  out.set("layers", file.layers);
  out.set("lines", static_cast<double>(file.lines));
  out.set("surfaces", surfaces);
  return out;
}

val listSurfaces(const val& file) {
  return guarded([&](sillon::RunContext&) {
    const auto container = sillon::readGcodeContainer(convert::bytes(file));
    if (!container) return failure(container.error());
    const auto read = sillon::readSlicedFile(container.value().gcode);
    if (!read) return failure(read.error());
    return success(fileOf(read.value()));
  });
}

/// \param projectJson  whose directions, modes and toolpath count. \param sides, fit  as sillon.d.ts names them.
val rebrush(const val& file, const std::string& projectJson, const val& files, const std::string& sides,
            const std::string& fit, const val& onProgress) {
  return guarded([&](sillon::RunContext& run) {
    tell(run, onProgress, 0, 1);
    auto project = sillon::readProject(projectJson);
    if (!project) return failure(project.error());
    // The shapes are those of the surfaces; maps are laid over any.
    project.value().builtin = sillon::BuiltinShape::Rectangle;
    project.value().builtinSize = {1, 1};
    auto input = sillon::readPlateInput(project.value(), convert::reader(files));
    if (!input) return failure(input.error());
    const auto container = sillon::readGcodeContainer(convert::bytes(file));
    if (!container) return failure(container.error());
    if (container.value().plates > 1) {
      return failure("InvalidFile", "file holds " + std::to_string(container.value().plates) +
                                        " plates; export them one by one, so that none is forgotten");
    }
    sillon::RebrushOptions options;
    options.toolpath = project.value().toolpath;
    options.directions = std::move(input.value().directions);
    options.modes = std::move(input.value().modes);
    options.tops = sides != "bottom";
    options.bottoms = sides != "top";
    options.fit = fit == "object" ? sillon::PictureFit::Object
                  : fit == "bed"  ? sillon::PictureFit::Bed
                  : fit == "all"  ? sillon::PictureFit::All
                                  : sillon::PictureFit::Face;
    const auto done = sillon::rebrush(container.value().gcode, options, run);
    if (!done) return failure(done.error());
    const auto packed = sillon::writeGcodeContainer(container.value(), done.value().gcode);
    if (!packed) return failure(packed.error());
    val surfaces = val::array();
    for (const sillon::RebrushedSurface& made : done.value().surfaces) {
      val out = surfaceOf(done.value().file.surfaces[made.surface]);
      out.set("left", val(made.why));
      out.set("replaced", made.replaced);
      out.set("newVolumeMm3", made.volumeMm3);
      out.set("alignment", made.alignment);
      out.set("coverage", made.coverage);
      out.set("beyond", made.beyond);
      out.set("seconds", made.seconds);
      surfaces.call<void>("push", out);
    }
    const std::string& bytes = packed.value();
    val out = val::object();
    out.set("bytes", convert::copied(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
    out.set("seconds", done.value().seconds);
    out.set("surfaces", surfaces);
    return success(out);
  });
}

}  // namespace

EMSCRIPTEN_BINDINGS(rebrush) {
  emscripten::function("listSurfaces", &listSurfaces);
  emscripten::function("rebrush", &rebrush);
}
