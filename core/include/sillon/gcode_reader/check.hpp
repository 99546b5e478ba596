// Reads any G-code and lists what is wrong with it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sillon/base/sentence.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Findings about G-code: a code with values, and the English sentence made from them.

/// One rule that was broken, however often.
struct GcodeFinding {
  /// One of findingSentences() or printFindingSentences(), such as too-hot
  std::string code;
  /// Group of rules: commands, grammar, homing, heating, modes, bounds, height, extrusion, flow,
  /// speed, rate, retraction, cycle, coverage, settings, totals, layers, end
  std::string rule;
  bool error = false;      ///< the print or the machine is at risk; else worth knowing
  std::int64_t line = 0;   ///< the first, from 1; 0: the file as a whole
  std::int64_t count = 0;  ///< lines that break it in this way
  /// Values of the first line, by name, as the sentence shows them
  std::vector<std::pair<std::string, std::string>> values;
  std::string message;  ///< about the first
};

/// The sentence of each code.
std::span<const Sentence> findingSentences();
/// Findings that checkPrint alone tells.
std::span<const Sentence> printFindingSentences();

// Reads any G-code as a printer would and says what would go wrong. Shares nothing with the writer
// but the grammar.

// A bead's neighbour lies to one side of it, in shares of the mean of both widths.
inline constexpr double kNearestNeighbour = 0.6;   ///< least distance of the two middles across
inline constexpr double kFarthestNeighbour = 1.4;  ///< greatest; the next bead but one is 2 away
inline constexpr double kNeighbourAlong = 0.6;     ///< greatest distance along the bead

/// Times that beads of the visible layers wait for their neighbours, weighed by length.
///
/// A bead that is squeezed between beads that cooled minutes ago lies higher and shines
/// differently. Counted is the longer of the waits on its two sides, by the lengths and speeds of
/// the moves. A bead leans on the neighbour that was there before it: one that has both is
/// squeezed, and there the sense changes in which beads lean, and with it the shine.
struct NeighbourDelay {
  double over30 = 0;    ///< share of the length beside a bead laid more than 30 s earlier or later
  double over120 = 0;   ///< more than 120 s
  double most = 0;      ///< 90 % of the length wait no longer [s]
  double squeezed = 0;  ///< share of the length between two beads laid earlier
};

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
  /// Move along the bed or down, where a Z was told since homing
  double lowest = std::numeric_limits<double>::infinity();
  double fastest = 0;    ///< of beads
  double slowedMm = 0;   ///< of oriented beads slower than the fastest of their layer
  double mostFlow = 0;   ///< [mm³/s]
  double mostMoves = 0;  ///< [1/s], over any 8 moves
  /// Share of the base that each oriented layer covers, in a file of ours; -1 where there is no
  /// base. The outline is in no file; what the base layers fill is taken for it.
  std::vector<double> coverage;
  std::optional<NeighbourDelay>
      delay;                ///< none where no oriented bead of a file of ours has a neighbour
  std::string printer;      ///< printer_model
  bool homes = false;       ///< all axes before the first bead, or at all where there is none
  bool homesPlane = false;  ///< X and Y, with Z or without
  bool heatsBed = false;    ///< and waits
  bool heatsNozzle = false;
  double nozzleTarget = 0;  ///< of the current tool, at the end [degrees Celsius]
  double nozzleReady = 0;   ///< that was waited for, or less where less was asked for since
  /// Whose nozzles have a target at the end, beside the current one's
  std::vector<int> otherHotTools;
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

/// \param printer  whose bed, height, nozzle, filament and limits count; unset: what the file's own
/// settings say, and no limits. Lines that are marked as a start or end block may reach 10 mm over
/// the bed's edge, as makers' own do.
GcodeCheck checkGcode(std::string_view text, const std::optional<Printer>& printer = {});

/// Lists what checkGcode cannot judge, as neither `printer` nor the file tells the limits: of
/// "bed", "height", "nozzle", "flow" and "speed". Apart from checkGcode, so that those who always
/// know the printer go without.
std::vector<std::string> uncheckedIn(std::string_view text,
                                     const std::optional<Printer>& printer = {});

/// A file that somebody is about to print.
struct PrintCheck {
  GcodeCheck check;
  std::vector<std::string> unchecked;  ///< as uncheckedIn lists, of what nothing told
};

/// checkGcode, and what only a whole print shows: settings that change in mid-print, waits, pauses
/// and pushes with the nozzle on what it lays, layers that lie too high, too low or beside each
/// other, fans. Limits that neither `printer` nor the file tells are those of the profile that the
/// file's printer_model names.
PrintCheck checkPrint(std::string_view text, const std::optional<Printer>& printer = {});

// Looks at a start or end block line by line, before it is trusted with a machine.

/// Tells what lines of somebody else's block would do that its reader should know: heat beyond 300
/// degrees Celsius (bed 120), moves below the bed, commands that outlive the print, reach files or
/// the network, move or heat in ways that nobody can follow, or have no place in a print; and
/// commands that are not in the list of known ones, and macros, whose meaning is not in the block.
/// One finding per line and code, in the order of the lines; count is 1.
/// \param block  up to any size; a template's {names} are read as numbers.
/// \param flavor  only tells which commands are unknown: what is an error is one for every machine.
std::vector<GcodeFinding> examineBlock(std::string_view block, GcodeFlavor flavor);

}  // namespace sillon
