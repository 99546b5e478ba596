// The toolpath as a printer reads it from the file: after rounding, width limits and the retelling as filament.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/gcode/writer.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/geometry/shape.hpp"
#include "support/gcode_check.hpp"

namespace bench {

/// A written path twice: `path` with one point per vertex, for crossings and turns; `beads` with two points at each
/// vertex, of the widths of the moves that meet there, for areas: a move has one width from end to end.
struct Written {
  sillon::Toolpath path;
  sillon::Toolpath beads;
  std::optional<sillon::NeighbourDelay> delay;
  std::string error;  ///< why nothing was written; else empty
};

/// Writes one oriented layer for a machine with a nozzle as wide as the spacing, at most 2 mm, and reads it again.
/// \param nozzle  another share of the spacing.
/// A move's width is what its filament fills: dE A_f / (flow h L).
inline Written writtenToolpath(const sillon::Toolpath& toolpath, const sillon::Shape& shape, double nozzle = 1) {
  Written written;
  sillon::Printer printer;
  printer.bedMax = {400, 400};
  printer.nozzle = std::min(nozzle * toolpath.spacing, 2.0);
  sillon::PrintParams params;
  params.layerHeight = 0.5 * printer.nozzle;
  params.basePattern = sillon::BasePattern::Concentric;
  params.base = 1;  // the first layer is printed slowly, and its widths may change faster
  params.place = sillon::Vec2{50, 50};
  printer.maxFlow = std::max(10.0, 10 * params.layerHeight * 1.6 * printer.nozzle);
  std::string text;
  const auto summary = sillon::writeGcode(toolpath, shape, printer, params, [&](std::string_view piece) {
    text += piece;
    return true;
  });
  if (!summary) {
    written.error = summary.error().message;
    return written;
  }
  written.delay = sillon::checkGcode(text, printer).delay;
  const double filament = std::numbers::pi / 4 * printer.filamentDiameter * printer.filamentDiameter;  // [mm²]
  const double perMm = params.flow * params.layerHeight / filament;  // of a bead 1 mm wide
  written.path.spacing = written.beads.spacing = toolpath.spacing;
  for (const sillon::test::ReadPath& path : sillon::test::readGcode(text).paths) {
    if (path.role != "Top solid infill") continue;
    sillon::Cycle plain;
    sillon::Cycle doubled;
    for (const sillon::test::ReadMove& move : path.moves) {
      const auto width = static_cast<float>(static_cast<double>(move.e) * 1e-5 / (perMm * move.length()));
      const auto at = [&](std::int64_t x, std::int64_t y) {
        return sillon::Vec2f{static_cast<float>(static_cast<double>(x - 50000) / 1000),
                             static_cast<float>(static_cast<double>(y - 50000) / 1000)};
      };
      plain.points.push_back(at(move.x0, move.y0));
      plain.widths.push_back(width);
      doubled.points.push_back(at(move.x0, move.y0));
      doubled.points.push_back(at(move.x1, move.y1));
      doubled.widths.insert(doubled.widths.end(), {width, width});
    }
    written.path.cycles.push_back(std::move(plain));
    written.beads.cycles.push_back(std::move(doubled));
  }
  return written;
}

}  // namespace bench
