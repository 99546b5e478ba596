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
#include "sillon/export/base_solid.hpp"
#include "sillon/export/gcode_archive.hpp"
#include "sillon/export/svg_drawing.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/job/path_gcode.hpp"
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

constexpr double kMostKeptText = 64 << 20;  // [bytes]

val listOf(const std::vector<std::string>& texts) {
  val list = val::array();
  for (const std::string& text : texts) list.call<void>("push", val(text));
  return list;
}

}  // namespace

namespace bindings {

val writeGcode(const val& toolpath, const val& below, const std::string& projectJson, const std::string& date,
               int number, const val& onChunk) {
  return guarded([&](sillon::RunContext& run) {
    const auto project = call::projectOf(projectJson);
    if (!project) return failure(project.error());
    const sillon::Shape shape = convert::shapeFrom(toolpath["shape"]);
    const sillon::PathToWrite path{kept::toolpathOf(toolpath),
                                   shape,
                                   below.isUndefined() ? nullptr : &kept::toolpathOf(below),
                                   convert::lookFrom(toolpath["look"]),
                                   emscripten::vecFromJSArray<std::string>(toolpath["notes"]),
                                   date};
    std::optional<std::string> text;
    if (number > 0) text.emplace();
    const double mostKept = std::min(kMostKeptText, call::freeMemory() / 8);
    const auto sink = [&](std::string_view piece) {
      const auto* data = reinterpret_cast<const std::uint8_t*>(piece.data());
      if (text && static_cast<double>(text->size() + piece.size()) > mostKept) text.reset();
      if (text) *text += piece;
      return onChunk(convert::copied(data, piece.size())).as<bool>();
    };
    const auto summary = sillon::writePathGcode(path, project.value().printer, project.value().print, sink, run);
    if (!summary) return failure(summary.error());
    if (text) kept::keep(number, std::move(*text));
    return success(convert::toJs(summary.value()));
  });
}

val writeBaseBody(const val& shape, const std::string& projectJson, bool stl) {
  return guarded([&](sillon::RunContext&) {
    const auto project = call::projectOf(projectJson);
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
    const auto svg = sillon::toolpathSvg(kept::toolpathOf(toolpath), convert::shapeFrom(toolpath["shape"]).page);
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
    const sillon::Toolpath& path = kept::toolpathOf(toolpath);
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
    const auto view = sillon::viewFile(kept::toolpathOf(toolpath), convert::shapeFrom(toolpath["shape"]).page, params);
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

val checkGcode(const std::string& projectJson, int number) {
  return guarded([&](sillon::RunContext&) {
    std::optional<sillon::Printer> printer;
    if (!projectJson.empty()) {
      const auto project = call::projectOf(projectJson);
      if (!project) return failure(project.error());
      printer = project.value().printer;
    }
    const auto checked = [&](std::string_view text) {
      return success(convert::toJs(sillon::checkGcode(text, printer), sillon::uncheckedIn(text, printer)));
    };
    if (number > 0) return checked(kept::gcodeOf(number));
    const auto text = sillon::unpackGcode(call::takenFile());
    if (!text) return failure(text.error());
    return checked(text.value());
  });
}

val packGcode(int number) {
  return guarded([&](sillon::RunContext&) {
    const auto archive = sillon::packGcode(number > 0 ? kept::gcodeOf(number) : call::takenFile());
    if (!archive) return failure(archive.error());
    return file(archive.value());
  });
}

val examineBlock(const std::string& block, const std::string& projectJson) {
  return guarded([&](sillon::RunContext&) {
    const auto project = call::projectOf(projectJson);
    if (!project) return failure(project.error());
    return success(convert::toJs(sillon::examineBlock(block, project.value().printer.flavor)));
  });
}

}  // namespace bindings
