// Bindings for calibration prints.
#include "sillon/calibrate/calibrate.hpp"

#include <emscripten/bind.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#include <string_view>
#include <utility>

#include "bindings.hpp"
#include "call.hpp"
#include "convert.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/project/project.hpp"

namespace sillon::bindings {
namespace {

/// Returns the look of the side that the nozzle has passed over, as in the command line.
/// \param filament  {colour, slopes}; undefined for the project's spool.
LookParams lookOf(const val& filament, const Project& project) {
  LookParams look;
  if (filament.isUndefined()) {
    Project shown = project;
    shown.print.showSide = ShowSide::Up;
    look.colour = spoolOf(project.pictures.spool).colour;
    look.roughness = roughnessOf(shown);
    return look;
  }
  for (std::size_t k = 0; k < 3; ++k) look.colour[k] = filament["colour"][k].as<std::uint8_t>();
  look.roughness = {filament["slopes"][0].as<double>(), filament["slopes"][1].as<double>()};
  return look;
}

/// Converts the values of a print, with their labels and places.
val valuesOf(const CalibrationPlate& plate) {
  return listOf(plate.values, [](const CalibrationValue& value) {
    return object({{"label", value.label}, {"value", std::round(value.value * 1e6) / 1e6}, {"at", toJs(value.at)}});
  });
}

/// Renders the look of the plate's upper layer to a PNG. \param side  longer side [pixels], 64 to 1024.
Result<std::vector<std::uint8_t>> pictureOf(const Toolpath& shown, Vec2 page, int side, const LookParams& look,
                                            const RunContext& run) {
  const double scale = side / std::max(page.x, page.y);
  const auto pixels = [scale](double mm) { return static_cast<int>(std::max(16.0, std::round(scale * mm))); };
  const auto picture = renderLook(shown, page, pixels(page.x), pixels(page.y), look, run);
  if (!picture) return picture.error();
  const RgbImage& image = picture.value();
  std::vector<std::uint8_t> png = encodePng(image.width, image.height, image.rgb);
  if (png.empty()) throw std::bad_alloc();
  return png;
}

}  // namespace

val calibrate(const std::string& kind, const val& from, const val& to, const std::string& projectJson,
              const val& filament, const std::string& date, int pictureSide) {
  return withProject(projectJson, [&](const Project& project, RunContext& run) {
    const std::vector<std::string>& kinds = calibrationKinds();
    const auto found = std::find(kinds.begin(), kinds.end(), kind);
    if (found == kinds.end()) {
      std::string choices;
      for (const std::string& one : kinds) choices += (choices.empty() ? "" : ", ") + one;
      return failure(
          refusedArgument("NotChoice", {{"setting", "kind"}, {"value", inQuotes(kind)}, {"choices", choices}}));
    }
    auto made = makeCalibration(
        {static_cast<CalibrationKind>(found - kinds.begin()), optionalOf(from), optionalOf(to), project}, run);
    if (!made) return failure(made.error());
    CalibrationPlate& plate = made.value();
    const Toolpath shown = shownCalibration(plate);
    const Vec2 page = plate.patches.shape.page;
    const LookParams look = lookOf(filament, project);
    auto thumbnails = lookThumbnails(shown, page, plate.printer.screenSizes, look, run);
    if (!thumbnails) return failure(thumbnails.error());
    plate.print.thumbnails = std::move(thumbnails).value();
    plate.print.date = date;
    std::string gcode;
    const auto summary = writeCalibration(plate, [&](std::string_view piece) {
      gcode += piece;
      return !run.cancelled();
    });
    if (!summary) return failure(summary.error());

    val out = object({{"bytes", copied(gcode)},
                      {"summary", toJs(summary.value())},
                      {"check", toJs(sillon::checkGcode(gcode, plate.printer))},
                      {"setting", plate.setting},
                      {"unit", plate.unit},
                      {"advice", plate.advice},
                      {"values", valuesOf(plate)},
                      {"page", toJs(page)}});
    if (pictureSide > 0) {
      const auto png = pictureOf(shown, page, pictureSide, look, run);
      if (!png) return failure(png.error());
      out.set("png", copied(png.value().data(), png.value().size()));
    }
    return success(out);
  });
}

}  // namespace sillon::bindings
