// Files around a plate, to write and to read: what JavaScript may call of sillon-files, which is loaded when the first
// is wanted. A visitor's first plate does not wait for it.
#include <emscripten/bind.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "call.hpp"
#include "convert.hpp"
#include "sillon/export/base_solid.hpp"
#include "sillon/export/gcode_archive.hpp"
#include "sillon/export/svg_drawing.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/look/view_file.hpp"
#include "sillon/printer_import/printer_import.hpp"
#include "sillon/project/project.hpp"
#include "sillon/settings/presets.hpp"

namespace {

using call::file;
using call::guarded;
using call::tell;
using convert::failure;
using convert::success;
using emscripten::val;

val listOf(const std::vector<std::string>& texts) {
  val list = val::array();
  for (const std::string& text : texts) list.call<void>("push", val(text));
  return list;
}

/// \param below  a toolpath, or undefined.
val writeGcode(const val& toolpath, const val& below, const std::string& projectJson, const std::string& date,
               const val& onChunk) {
  return guarded([&](sillon::RunContext& run) {
    const auto project = sillon::readProject(projectJson);
    if (!project) return failure(project.error());
    sillon::PrintParams print = project.value().print;
    print.date = date;
    print.notes = emscripten::vecFromJSArray<std::string>(toolpath["notes"]);
    const sillon::Toolpath path = convert::toolpathFrom(toolpath);
    const sillon::Shape shape = convert::shapeFrom(toolpath["shape"]);
    auto thumbnails = sillon::lookThumbnails(path, shape.page, project.value().printer.screenSizes,
                                             convert::lookFrom(toolpath["look"]), run);
    if (!thumbnails) return failure(thumbnails.error());
    print.thumbnails = std::move(thumbnails).value();
    std::optional<sillon::Toolpath> across;
    if (!below.isUndefined()) across = convert::toolpathFrom(below);
    const auto sink = [&](std::string_view piece) {
      const auto* data = reinterpret_cast<const std::uint8_t*>(piece.data());
      return !run.cancelled() && onChunk(convert::copied(data, piece.size())).as<bool>();
    };
    const auto summary =
        sillon::writeGcode(path, shape, project.value().printer, print, sink, across ? &*across : nullptr);
    if (!summary) return failure(summary.error());
    return success(convert::toJs(summary.value()));
  });
}

val writeBaseBody(const val& shape, const std::string& projectJson, bool stl) {
  return guarded([&](sillon::RunContext&) {
    const auto project = sillon::readProject(projectJson);
    if (!project) return failure(project.error());
    const auto mesh = sillon::baseBody(convert::shapeFrom(shape), project.value().printer, project.value().print);
    if (!mesh) return failure(mesh.error());
    const auto bytes = stl ? sillon::writeStl(mesh.value()) : sillon::write3mf(mesh.value());
    if (!bytes) return failure(bytes.error());
    return file(bytes.value());
  });
}

val writeSvg(const val& toolpath) {
  return guarded([&](sillon::RunContext&) {
    const auto svg = sillon::toolpathSvg(convert::toolpathFrom(toolpath), convert::shapeFrom(toolpath["shape"]).page);
    if (!svg) return failure(svg.error());
    return file(svg.value());
  });
}

val renderPreview(const val& toolpath, int width, const val& light, const val& colour, const val& slopes, bool lookOnly,
                  const val& onProgress) {
  return guarded([&](sillon::RunContext& run) {
    tell(run, onProgress, 0, 1);
    sillon::PreviewParams params;
    params.width = width;
    params.look.lamp.azimuth = light[0].as<double>();
    params.look.lamp.elevation = light[1].as<double>();
    for (std::size_t k = 0; k < 3; ++k) params.look.colour[k] = colour[k].as<std::uint8_t>();
    params.look.roughness = {slopes[0].as<double>(), slopes[1].as<double>()};
    const sillon::Toolpath path = convert::toolpathFrom(toolpath);
    const sillon::Vec2 page = convert::shapeFrom(toolpath["shape"]).page;
    const double height = std::min(std::round(width * page.y / page.x), 1e6);
    const auto picture = lookOnly ? sillon::renderLook(path, page, width, static_cast<int>(height), params.look, run)
                                  : sillon::renderPreview(path, page, params, run);
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
    const sillon::ViewParams params{{channel(0), channel(1), channel(2)}, {slopeAlong, slopeAcross}};
    const auto view =
        sillon::viewFile(convert::toolpathFrom(toolpath), convert::shapeFrom(toolpath["shape"]).page, params);
    if (!view) return failure(view.error());
    return success(convert::copied(view.value().data(), view.value().size()));
  });
}

val importPrinter(const std::string& name) {
  return guarded([&](sillon::RunContext&) {
    const auto imported = sillon::importPrinter(call::takenFile(), name);
    if (!imported) return failure(imported.error());
    val out = val::object();
    out.set("project", val(sillon::writePrinter(imported.value().printer)));
    out.set("profile", val(imported.value().profile));
    out.set("source", val(imported.value().source));
    out.set("read", listOf(imported.value().read));
    val notes = val::array();
    for (const sillon::ImportNote& note : imported.value().notRead) notes.call<void>("push", convert::toJs(note));
    out.set("notRead", notes);
    return success(out);
  });
}

/// \param projectJson  whose printer counts; empty: what the file's own settings say.
val checkGcode(const std::string& projectJson) {
  return guarded([&](sillon::RunContext&) {
    std::optional<sillon::Printer> printer;
    if (!projectJson.empty()) {
      const auto project = sillon::readProject(projectJson);
      if (!project) return failure(project.error());
      printer = project.value().printer;
    }
    const auto text = sillon::unpackGcode(call::takenFile());
    if (!text) return failure(text.error());
    return success(
        convert::toJs(sillon::checkGcode(text.value(), printer), sillon::uncheckedIn(text.value(), printer)));
  });
}

val packGcode() {
  return guarded([&](sillon::RunContext&) {
    const auto archive = sillon::packGcode(call::takenFile());
    if (!archive) return failure(archive.error());
    return file(archive.value());
  });
}

/// \param projectJson  whose printer's flavour counts.
val examineBlock(const std::string& block, const std::string& projectJson) {
  return guarded([&](sillon::RunContext&) {
    const auto project = sillon::readProject(projectJson);
    if (!project) return failure(project.error());
    return success(convert::toJs(sillon::examineBlock(block, project.value().printer.flavor)));
  });
}

}  // namespace

EMSCRIPTEN_BINDINGS(files) {
  emscripten::function("writeGcode", &writeGcode);
  emscripten::function("writeBaseBody", &writeBaseBody);
  emscripten::function("writeSvg", &writeSvg);
  emscripten::function("renderPreview", &renderPreview);
  emscripten::function("writeView", &writeView);
  emscripten::function("importPrinter", &importPrinter);
  emscripten::function("checkGcode", &checkGcode);
  emscripten::function("packGcode", &packGcode);
  emscripten::function("examineBlock", &examineBlock);
}
