// Reads any G-code as a printer would and says what would go wrong. Shares nothing with the writer but the grammar.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/types.hpp"
#include "sillon/gcode_reader/finding.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

/// What the file does. Lengths mm, speeds mm/s.
struct GcodeCheck {
  std::vector<GcodeFinding> findings;  ///< errors first, each sort by line
  std::int64_t lines = 0;
  std::int64_t moves = 0;
  int layers = 0;           ///< by its layer comments
  double filamentMm = 0;    ///< of moves that extrude while they move
  double pathMm = 0;        ///< length of those
  double travelMm = 0;      ///< of all others in the plane
  std::int64_t closed = 0;  ///< paths whose end is their beginning
  std::int64_t open = 0;
  std::int64_t retractions = 0;
  Bounds box;      ///< of those beads' middles; start and end blocks left out where they are marked
  double top = 0;  ///< highest bead
  double lowest =
      std::numeric_limits<double>::infinity();  ///< move along the bed or down, where a Z was told since homing
  double fastest = 0;                           ///< of beads
  double slowedMm = 0;                          ///< of oriented beads slower than the fastest of their layer
  double mostFlow = 0;                          ///< [mm³/s]
  double mostMoves = 0;                         ///< [1/s], over any 8 moves
  double noise = -1;  ///< 99 % of the vertices of oriented beads zigzag by no more [mm]; -1: there are none
  /// Share of the base that each oriented layer covers, in a file of ours; -1 where there is no base. The outline is in
  /// no file; what the base layers fill is taken for it.
  std::vector<double> coverage;
  std::string printer;      ///< printer_model
  bool homes = false;       ///< all axes before the first bead, or at all where there is none
  bool homesPlane = false;  ///< X and Y, with Z or without
  bool heatsBed = false;    ///< and waits
  bool heatsNozzle = false;
  double nozzleTarget = 0;         ///< of the current tool, at the end [degrees Celsius]
  double nozzleReady = 0;          ///< that was waited for, or less where less was asked for since
  std::vector<int> otherHotTools;  ///< whose nozzles have a target at the end, beside the current one's
  double bedTarget = 0;
  double chamberTarget = 0;
  double retracted = 0;            ///< filament drawn back at the end and not returned [mm]
  bool firmwareRetracted = false;  ///< the same by G10

  [[nodiscard]] std::int64_t errors() const {
    std::int64_t sum = 0;
    for (const GcodeFinding& finding : findings) sum += finding.error ? finding.count : 0;
    return sum;
  }
};

/// \param printer  whose bed, height, nozzle, filament and limits count; unset: what the file's own settings say, and
/// no limits. Lines that are marked as a start or end block may reach 10 mm over the bed's edge, as makers' own do.
GcodeCheck checkGcode(std::string_view text, const std::optional<Printer>& printer = {});

/// What checkGcode cannot judge, as neither `printer` nor the file itself tells the limits: of "bed", "height",
/// "nozzle", "flow" and "speed". Apart from checkGcode, so that those who always know the printer go without.
std::vector<std::string> uncheckedIn(std::string_view text, const std::optional<Printer>& printer = {});

}  // namespace sillon
