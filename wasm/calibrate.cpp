// Bindings for calibration prints.
#include "sillon/calibrate/calibrate.hpp"

#include <emscripten/bind.h>

#include <algorithm>
#include <cmath>
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
#include "sillon/gcode_reader/check.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/look/spools.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/project/project.hpp"

namespace {

using call::guarded;
using call::optionalOf;
using convert::failure;
using convert::success;
using emscripten::val;

/// Returns the look of the side that the nozzle has passed over, as in the command line.
/// \param filament  {colour, slopes}; undefined for the project's spool.
sillon::LookParams lookOf(const val& filament, const sillon::Project& project) {
  sillon::LookParams look;
  if (filament.isUndefined()) {
    sillon::Project shown = project;
    shown.print.showSide = sillon::ShowSide::Up;
    look.colour = sillon::spoolOf(project.pictures.spool).colour;
    look.roughness = sillon::roughnessOf(shown);
    return look;
  }
  for (std::size_t k = 0; k < 3; ++k) look.colour[k] = filament["colour"][k].as<std::uint8_t>();
  look.roughness = {filament["slopes"][0].as<double>(), filament["slopes"][1].as<double>()};
  return look;
}

/// Converts the values of a print, with their labels and places.
val valuesOf(const sillon::CalibrationPlate& plate) {
  val values = val::array();
  for (const sillon::CalibrationValue& value : plate.values) {
    val out = val::object();
    out.set("label", val(value.label));
    out.set("value", std::round(value.value * 1e6) / 1e6);
    out.set("at", convert::toJs(value.at));
    values.call<void>("push", out);
  }
  return values;
}

/// Renders the look of the plate's upper layer to a PNG. \param side  longer side [pixels], 64 to 1024.
sillon::Result<std::vector<std::uint8_t>> pictureOf(const sillon::Toolpath& shown, sillon::Vec2 page, int side,
                                                    const sillon::LookParams& look, const sillon::RunContext& run) {
  const double scale = side / std::max(page.x, page.y);
  const auto pixels = [scale](double mm) { return static_cast<int>(std::max(16.0, std::round(scale * mm))); };
  const auto picture = sillon::renderLook(shown, page, pixels(page.x), pixels(page.y), look, run);
  if (!picture) return picture.error();
  const sillon::RgbImage& image = picture.value();
  std::vector<std::uint8_t> png = sillon::encodePng(image.width, image.height, image.rgb);
  if (png.empty()) throw std::bad_alloc();
  return png;
}

}  // namespace

namespace bindings {

val calibrate(const std::string& kind, const val& from, const val& to, const std::string& projectJson,
              const val& filament, const std::string& date, int pictureSide) {
  return guarded([&](sillon::RunContext& run) {
    const auto project = call::projectOf(projectJson);
    if (!project) return failure(project.error());
    const std::vector<std::string>& kinds = sillon::calibrationKinds();
    const auto found = std::find(kinds.begin(), kinds.end(), kind);
    if (found == kinds.end()) {
      std::string choices;
      for (const std::string& one : kinds) choices += (choices.empty() ? "" : ", ") + one;
      return failure(sillon::refusedArgument(
          "NotChoice", {{"setting", "kind"}, {"value", sillon::inQuotes(kind)}, {"choices", choices}}));
    }
    auto made = sillon::makeCalibration({static_cast<sillon::CalibrationKind>(found - kinds.begin()), optionalOf(from),
                                         optionalOf(to), project.value()},
                                        run);
    if (!made) return failure(made.error());
    sillon::CalibrationPlate& plate = made.value();
    const sillon::Toolpath shown = sillon::shownCalibration(plate);
    const sillon::Vec2 page = plate.patches.shape.page;
    const sillon::LookParams look = lookOf(filament, project.value());
    auto thumbnails = sillon::lookThumbnails(shown, page, plate.printer.screenSizes, look, run);
    if (!thumbnails) return failure(thumbnails.error());
    plate.print.thumbnails = std::move(thumbnails).value();
    plate.print.date = date;
    std::string gcode;
    const auto summary = sillon::writeCalibration(plate, [&](std::string_view piece) {
      gcode += piece;
      return !run.cancelled();
    });
    if (!summary) return failure(summary.error());

    val out = val::object();
    out.set("bytes", convert::copied(reinterpret_cast<const std::uint8_t*>(gcode.data()), gcode.size()));
    out.set("summary", convert::toJs(summary.value()));
    out.set("check", convert::toJs(sillon::checkGcode(gcode, plate.printer)));
    out.set("setting", val(plate.setting));
    out.set("unit", val(plate.unit));
    out.set("advice", val(plate.advice));
    out.set("values", valuesOf(plate));
    out.set("page", convert::toJs(page));
    if (pictureSide > 0) {
      const auto png = pictureOf(shown, page, pictureSide, look, run);
      if (!png) return failure(png.error());
      out.set("png", convert::copied(png.value().data(), png.value().size()));
    }
    return success(out);
  });
}

}  // namespace bindings
