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

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Findings about G-code: each has a code with values, and an English sentence made from them.

/// One broken rule, however often the file breaks it.
struct GcodeFinding {
  /// One of findingSentences() or printFindingSentences(), such as too-hot
  std::string code;
  /// Group of rules: commands, grammar, homing, heating, modes, bounds, height, extrusion, flow,
  /// speed, rate, retraction, cycle, coverage, settings, totals, layers, end
  std::string rule;
  bool error = false;      ///< the print or the machine is at risk; otherwise it is worth knowing
  std::int64_t line = 0;   ///< first line that breaks the rule, from 1; 0: the file as a whole
  std::int64_t count = 0;  ///< number of lines that break it in this way
  /// Values of the first line, by name, as the sentence shows them
  std::vector<std::pair<std::string, std::string>> values;
  std::string message;  ///< sentence about the first line
};

/// Returns the sentence of each code.
std::span<const Sentence> findingSentences();
/// Returns the sentences of findings that only checkPrint makes.
std::span<const Sentence> printFindingSentences();

// Reads any G-code as a printer would and says what would go wrong. It shares nothing with the
// writer but the grammar.

// Place of a bead's neighbour to one side of it, in shares of the mean of both widths.
/// Least distance of the two middles across the beads
inline constexpr double kNearestNeighbour = 0.6;
/// Greatest distance across; the next bead but one is 2 away
inline constexpr double kFarthestNeighbour = 1.4;
inline constexpr double kNeighbourAlong = 0.6;  ///< greatest distance along the bead

/// Times that beads of the visible layers wait for their neighbours, weighted by length.
///
/// A bead that is squeezed between beads that cooled minutes ago lies higher and shines
/// differently. The wait that counts is the longer one of its two sides, by the lengths and speeds
/// of the moves. A bead leans on a neighbour that was laid before it. A bead between two such
/// neighbours is squeezed; the beads on its two sides lean opposite ways and shine differently.
struct NeighbourDelay {
  double over30 = 0;    ///< share of the length beside a bead laid more than 30 s earlier or later
  double over120 = 0;   ///< the same for more than 120 s
  double most = 0;      ///< wait that 90 % of the length does not exceed [s]
  double squeezed = 0;  ///< share of the length between two beads laid earlier
};

/// Facts about a file and what is wrong with it. Lengths in mm, speeds in mm/s.
struct GcodeCheck {
  std::vector<GcodeFinding> findings;  ///< findings, errors first, each kind by line
  std::int64_t lines = 0;
  std::int64_t moves = 0;
  int layers = 0;           ///< number of layers, by the file's layer comments
  double filamentMm = 0;    ///< filament of moves that extrude while they move
  double pathMm = 0;        ///< length of those moves
  double travelMm = 0;      ///< length of all other moves in the plane
  std::int64_t closed = 0;  ///< paths that end where they begin
  std::int64_t open = 0;
  std::int64_t retractions = 0;
  /// Box of those beads' middles, without start and end blocks where they are marked
  Bounds box;
  double top = 0;  ///< height of the highest bead
  /// Lowest Z of a move along the bed or down, once a Z has been told since homing
  double lowest = std::numeric_limits<double>::infinity();
  double fastest = 0;    ///< greatest speed of a bead
  double slowedMm = 0;   ///< length of oriented beads slower than the fastest of their layer
  double mostFlow = 0;   ///< greatest flow [mm³/s]
  double mostMoves = 0;  ///< greatest rate of moves [1/s], over any 8 of them
  /// Share of the base that each oriented layer covers, in a file of ours; -1 where there is no
  /// base. No file has the outline, so the area that the base layers fill is taken for it.
  std::vector<double> coverage;
  /// Wait for neighbours; unset unless an oriented bead of a file of ours has a neighbour
  std::optional<NeighbourDelay> delay;
  std::string printer;  ///< value of printer_model
  bool homes = false;   ///< all axes are homed before the first bead, or at all where there is none
  bool homesPlane = false;   ///< the same for X and Y, with or without Z
  bool heatsBed = false;     ///< the bed is heated, and waited for
  bool heatsNozzle = false;  ///< the nozzle is heated, and waited for
  double nozzleTarget = 0;   ///< target of the current tool at the end [degrees Celsius]
  double nozzleReady = 0;    ///< temperature that was waited for, or a lower one asked for since
  /// Numbers of other tools whose nozzles have a target at the end
  std::vector<int> otherHotTools;
  double bedTarget = 0;
  double chamberTarget = 0;
  double retracted = 0;            ///< filament drawn back at the end and not returned [mm]
  bool firmwareRetracted = false;  ///< the same, drawn back by G10

  [[nodiscard]] std::int64_t errors() const {
    std::int64_t sum = 0;
    for (const GcodeFinding& finding : findings) sum += finding.error ? finding.count : 0;
    return sum;
  }
};

/// Reads G-code and lists what is wrong with it.
/// \param printer  printer whose bed, height, nozzle, filament and limits count; unset: the file's
/// own settings count, and no limits. Lines that are marked as a start or end block may reach 10 mm
/// over the bed's edge, as makers' own do.
GcodeCheck checkGcode(std::string_view text, const std::optional<Printer>& printer = {});

/// Lists the limits that checkGcode cannot judge because neither `printer` nor the file tells them:
/// any of "bed", "height", "nozzle", "flow" and "speed". It is apart from checkGcode, so that
/// programs that always know the printer can leave it out.
std::vector<std::string> uncheckedIn(std::string_view text,
                                     const std::optional<Printer>& printer = {});

/// The check of a file that somebody is about to print.
struct PrintCheck {
  GcodeCheck check;
  std::vector<std::string> unchecked;  ///< limits that nothing tells, as uncheckedIn lists them
};

/// Checks a whole print. It does what checkGcode does, and also finds what only a whole print
/// shows: settings that change in mid-print; waits, pauses and pushes with the nozzle on fresh
/// plastic; layers that lie too high, too low or beside each other; and fans. Limits that neither
/// `printer` nor the file tells are those of the profile that the file's printer_model names.
PrintCheck checkPrint(std::string_view text, const std::optional<Printer>& printer = {});

// A look at a start or end block, line by line, before it is trusted with a machine.

/// Tells what lines of somebody else's block would do that its reader should know: heat beyond 300
/// degrees Celsius (bed 120), moves below the bed, and commands that outlive the print, reach files
/// or the network, move or heat in ways that nobody can follow, or have no place in a print. It
/// also lists commands that are not known, and macros, whose meaning is not in the block. There is
/// one finding per line and code, in the order of the lines; its count is 1.
/// \param block  text of any size; a template's {names} are read as numbers.
/// \param flavor  firmware, which only decides which commands are unknown: an error is one for
/// every machine.
std::vector<GcodeFinding> examineBlock(std::string_view block, GcodeFlavor flavor);

}  // namespace sillon
