// Bindings for files around a plate, to write and to read.
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

#include "bindings.hpp"
#include "call.hpp"
#include "convert.hpp"
#include "kept.hpp"
#include "sillon/export/export.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/printer_import/printer_import.hpp"
#include "sillon/project/project.hpp"
#include "sillon/settings/presets.hpp"

namespace sillon::bindings {

constexpr double kMostKeptText = 64 << 20;  // [bytes]

val writeGcode(const val& toolpath, const val& below, const std::string& projectJson, const std::string& date,
               int number, const val& onChunk) {
  return withProject(projectJson, [&](const Project& project, RunContext& run) {
    const Shape shape = shapeFrom(toolpath["shape"]);
    const PathToWrite path{kept::toolpathOf(toolpath),
                           shape,
                           below.isUndefined() ? nullptr : &kept::toolpathOf(below),
                           lookFrom(toolpath["look"]),
                           emscripten::vecFromJSArray<std::string>(toolpath["notes"]),
                           date};
    std::optional<std::string> text;
    if (number > 0) text.emplace();
    const double mostKept = std::min(kMostKeptText, freeMemory() / 8);
    const auto sink = [&](std::string_view piece) {
      if (text && static_cast<double>(text->size() + piece.size()) > mostKept) text.reset();
      if (text) *text += piece;
      return onChunk(copied(piece)).as<bool>();
    };
    const auto summary = writePathGcode(path, project.printer, project.print, sink, run);
    if (!summary) return failure(summary.error());
    if (text) kept::keep(number, std::move(*text));
    return success(toJs(summary.value()));
  });
}

val writeBaseBody(const val& shape, const std::string& projectJson, bool stl) {
  return withProject(projectJson, [&](const Project& project, RunContext&) {
    const auto mesh = baseBody(shapeFrom(shape), project.printer, project.print);
    if (!mesh) return failure(mesh.error());
    const auto bytes = stl ? writeStl(mesh.value()) : write3mf(mesh.value());
    if (!bytes) return failure(bytes.error());
    return success(copied(bytes.value()));
  });
}

val writeSvg(const val& toolpath) {
  return guarded([&](RunContext&) {
    const auto svg = toolpathSvg(kept::toolpathOf(toolpath), shapeFrom(toolpath["shape"]).page);
    if (!svg) return failure(svg.error());
    return success(copied(svg.value()));
  });
}

val renderPreview(const val& toolpath, int width, const val& light, const val& colour, const val& slopes, bool lookOnly,
                  const val& onProgress) {
  return guarded([&](RunContext& run) {
    tell(run, onProgress, 0, 1);
    PreviewParams params;
    params.width = width;
    params.look.lamp.azimuth = light[0].as<double>();
    params.look.lamp.elevation = light[1].as<double>();
    for (std::size_t k = 0; k < 3; ++k) params.look.colour[k] = colour[k].as<std::uint8_t>();
    params.look.roughness = {slopes[0].as<double>(), slopes[1].as<double>()};
    const Toolpath& path = kept::toolpathOf(toolpath);
    const Vec2 page = shapeFrom(toolpath["shape"]).page;
    const double height = std::min(std::round(width * page.y / page.x), 1e6);
    const auto picture = lookOnly ? renderLook(path, page, width, static_cast<int>(height), params.look, run)
                                  : sillon::renderPreview(path, page, params, run);
    if (!picture) return failure(picture.error());
    const RgbImage& image = picture.value();
    const std::vector<std::uint8_t> png = encodePng(image.width, image.height, image.rgb);
    if (png.empty()) throw std::bad_alloc();
    return success(copied(png.data(), png.size()));
  });
}

val writeView(const val& toolpath, const val& colour, double slopeAlong, double slopeAcross) {
  return guarded([&](RunContext&) {
    const auto channel = [&colour](int k) { return colour[k].as<std::uint8_t>(); };
    const ViewParams params{{channel(0), channel(1), channel(2)}, {slopeAlong, slopeAcross}};
    const auto view = viewFile(kept::toolpathOf(toolpath), shapeFrom(toolpath["shape"]).page, params);
    if (!view) return failure(view.error());
    return success(copied(view.value().data(), view.value().size()));
  });
}

val importPrinter(const std::string& name) {
  return guarded([&](RunContext&) {
    const auto imported = sillon::importPrinter(takenFile(), name);
    if (!imported) return failure(imported.error());
    return success(object({{"project", writePrinter(imported.value().printer)},
                           {"profile", imported.value().profile},
                           {"source", imported.value().source},
                           {"read", listOf(imported.value().read)},
                           {"notRead", toJs(imported.value().notRead)}}));
  });
}

val checkGcode(const std::string& projectJson, int number) {
  return guarded([&](RunContext&) {
    std::optional<Printer> printer;
    if (!projectJson.empty()) {
      const auto project = projectOf(projectJson);
      if (!project) return failure(project.error());
      printer = project.value().printer;
    }
    const auto checked = [&](std::string_view text) {
      return success(toJs(sillon::checkGcode(text, printer), uncheckedIn(text, printer)));
    };
    if (number > 0) return checked(kept::gcodeOf(number));
    const auto text = unpackGcode(takenFile());
    if (!text) return failure(text.error());
    return checked(text.value());
  });
}

val packGcode(int number) {
  return guarded([&](RunContext&) {
    const auto archive = sillon::packGcode(number > 0 ? kept::gcodeOf(number) : takenFile());
    if (!archive) return failure(archive.error());
    return success(copied(archive.value()));
  });
}

val examineBlock(const std::string& block, const std::string& projectJson) {
  return withProject(projectJson, [&](const Project& project, RunContext&) {
    return success(toJs(sillon::examineBlock(block, project.printer.flavor)));
  });
}

}  // namespace sillon::bindings
