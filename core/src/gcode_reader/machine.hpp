// The state of a machine while it reads G-code.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gcode_reader/parser.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Offsets that commands add up. They shift a print, although its coordinates do not show it.

/// The sum of babysteps, G-code offsets, home offsets and workplace origins [mm].
class Offsets {
 public:
  struct Axes {
    double x = 0;
    double y = 0;
    double z = 0;
  };

  /// Runs SET_GCODE_OFFSET, M290, M206, and G10 with L1, L2, or P alone; others change nothing.
  /// \return the new sum, if the command changes it.
  std::optional<Axes> run(const GcodeCommand& command, GcodeFlavor flavor);

 private:
  Axes code_;   // offset by SET_GCODE_OFFSET
  Axes baby_;   // babysteps by M290
  Axes home_;   // home offset by M206
  Axes place_;  // offset of a tool or workplace by G10
};

// Heaters: the temperatures that a file asks for, and those it has waited for.

inline constexpr double kColdest = 170;  ///< [degrees Celsius], coolest nozzle that extrudes

/// Temperatures of a heater [degrees Celsius].
struct Heater {
  double target = 0;
  double ready = 0;  ///< target that was waited for, lowered by later targets; the heater is no colder

  bool operator==(const Heater&) const = default;
};

/// The bed, the chamber and the nozzles of all tools. Tools whose temperature was never set share the nozzle that was
/// set last, as the filaments of a changer share one.
class Heaters {
 public:
  /// Runs M104, M109, M140, M190, M141, M191, RepRapFirmware's G10, M568 and M116, TriLAB's G1009, and Klipper's
  /// TURN_OFF_HEATERS, SET_HEATER_TEMPERATURE and TEMPERATURE_WAIT; others change nothing. Less than 0 degrees switch
  /// off. \param tool  the current one. \param klipper  reads S alone, and switches heaters off without it.
  void run(const GcodeCommand& command, const GcodeWords& words, int tool, bool klipper);

  /// Sets a temperature that is reached, for commands that heat in their own way, as start macros do.
  void setNozzle(double degrees) { tell(told_) = {degrees, degrees}; }
  void setBed(double degrees) { bed_ = {degrees, degrees}; }

  [[nodiscard]] const Heater& nozzle(int tool) const { return nozzles_[indexOf(tool)]; }
  [[nodiscard]] const Heater& bed() const { return bed_; }
  [[nodiscard]] const Heater& chamber() const { return chamber_; }
  /// Other tools whose nozzle has a target.
  [[nodiscard]] std::vector<int> otherHotTools(int tool) const;

  bool operator==(const Heaters&) const = default;

 private:
  static constexpr std::size_t kTools = 16;

  [[nodiscard]] std::size_t indexOf(int tool) const;
  Heater& tell(std::size_t index);
  void runNamed(const GcodeCommand& command);

  std::array<Heater, kTools> nozzles_{};
  std::array<bool, kTools> known_{};  // nozzles whose temperature was set
  std::size_t told_ = 0;              // nozzle that was set last
  bool separate_ = false;             // each tool has its own nozzle: one was set that was not the current tool's
  Heater bed_;
  Heater chamber_;
};

// State of a printer while it runs a file: modes, place and filament. One step per command.

inline constexpr unsigned kAxisX = 1, kAxisY = 2, kAxisZ = 4;
inline constexpr unsigned kPlane = kAxisX | kAxisY;
inline constexpr unsigned kAllAxes = kPlane | kAxisZ;

/// A move as it was understood; lengths in mm.
struct MachineMove {
  int code = 0;  ///< number of the command, 0..3
  Vec2 from;
  Vec2 to;
  double zFrom = 0;
  double z = 0;
  double e = 0;          ///< filament that the move pushes; below 0: pulls back
  double length = 0;     ///< length in the plane, along the arc if it is one
  Vec2 centre;           ///< centre of an arc
  double turn = 0;       ///< turn of an arc [rad], counterclockwise above 0
  bool xy = false;       ///< X or Y is written
  bool toldF = false;    ///< F is written
  bool arc = false;      ///< the move is G2 or G3
  bool readable = true;  ///< false: an arc without a centre or with an impossible radius, which is not followed
};

/// Place on an arc that is readable. \param share  share of its turn up to the place, 0..1.
Vec2 onArc(const MachineMove& arc, double share);

/// State that Klipper's SAVE_GCODE_STATE or RepRapFirmware's M120 keeps; members as in MachineState.
struct SavedState {
  bool absolute = true;
  bool absoluteE = true;
  bool inches = false;
  double speed = 0;
  Vec2 at;
  double z = 0;
  Vec2 origin;
  double originZ = 0;
  double e = 0;
};

/// Filament that a tool holds back.
struct HeldFilament {
  double retracted = 0;
  bool firmwareRetracted = false;
};

/// States and filament that are put aside until they are asked for.
struct MachineMemory {
  std::vector<std::pair<std::string, SavedState>> states;  ///< states by name; those of M120 have none
  std::vector<std::pair<int, HeldFilament>> tools;         ///< filament of the tools that are not the current one
};

/// State of a printer. Lengths are in mm, whatever the file's unit, and speeds in mm/s; `at` and `z` are the place of
/// the nozzle, which G92 does not move.
struct MachineState {
  // Modes.
  bool absolute = true;
  bool absoluteE = true;
  bool inches = false;
  bool ruledByG90 = true;   ///< G90 and G91 set the mode of E, too, as in Marlin and its kin
  bool volumetric = false;  ///< E is in mm³, by M200 D or in Cura's UltiGCode
  bool duet = false;        ///< RepRapFirmware, where M120 and M121 keep the modes and G10 S0 heats
  // Place.
  Vec2 at;
  double z = 0;
  Vec2 origin;  ///< written coordinate + origin = place
  double originZ = 0;
  unsigned homedAxes = 0;  ///< homed axes, bits of kAxisX, kAxisY, kAxisZ
  unsigned toldAxes = 0;   ///< axes with an absolute coordinate since they homed
  double speed = 0;
  // Filament.
  double e = 0;  ///< last E as written, in absolute mode
  double retracted = 0;
  bool firmwareRetracted = false;  ///< G10 holds filament back, until G11
  int tool = 0;
  std::shared_ptr<const MachineMemory> memory;  ///< shared by copies: a reader makes two for each line

  [[nodiscard]] bool told(unsigned axes) const { return (toldAxes & axes) == axes; }
  [[nodiscard]] bool homed(unsigned axes = kAllAxes) const { return (homedAxes & axes) == axes; }

  /// A printer at rest. \param flavor  decides whether G90 sets the mode of E, and what M120 does.
  explicit MachineState(std::optional<GcodeFlavor> flavor = {})
      : ruledByG90(flavor != GcodeFlavor::Klipper && flavor != GcodeFlavor::RepRap),
        duet(flavor == GcodeFlavor::RepRap) {}
};

/// Runs a command of modes or moves: G0-G3, G10, G11, G20, G21, G28, G90-G92, G161, G162, M18, M82-M84, M120, M121,
/// M200, T, SAVE_GCODE_STATE and RESTORE_GCODE_STATE; others change nothing. Reads words only if `words.readable()`.
/// \return the move, if it is one.
std::optional<MachineMove> runCommand(MachineState& state, const GcodeCommand& command, const GcodeWords& words);

/// Tells whether a command has words that the machine or the rules read.
bool readsWords(const GcodeCommand& command);

/// Tells whether a command is a G10 that sets up a tool, as RepRapFirmware's does, instead of drawing filament back.
bool setsTool(const GcodeCommand& command, const GcodeWords& words, bool duet = false);

/// Tells whether M200 switches volumetric extrusion on or off; nothing for an M200 that does neither, and for others.
std::optional<bool> volumetricBy(const GcodeCommand& command, const GcodeWords& words);

// States that a printer puts aside and takes up again, by name or on a stack, and the filament that each tool holds
// back.

/// Changes to a tool and the filament that it holds back. \param tool  from 0; numbers below change nothing.
void changeTool(MachineState& state, int tool);

/// Runs RepRapFirmware's M120, which pushes the modes on a stack, or M121, which takes them back.
void pushModes(MachineState& state);
void popModes(MachineState& state);

/// Runs Klipper's SAVE_GCODE_STATE or RESTORE_GCODE_STATE, which keep the modes, the origin and the last E. \return the
/// move back, if MOVE=1 asks for it.
std::optional<MachineMove> runMemory(MachineState& state, const GcodeCommand& command);

// Beginning and end of code that changes a tool or a filament, which cuts, flushes and wipes in ways of its own.

/// Tells whether a line marks the beginning or the end of such code: PrusaSlicer's comments, and M620 S and M621 S of
/// Bambu's printers. \return true: it begins; false: it ends; nothing: the line is something else.
inline std::optional<bool> toolChangeMark(const GcodeParts& parts) {
  if (parts.code.empty()) {
    if (parts.comment == "CP TOOLCHANGE START" || parts.comment == "CP PRIMING START") return true;
    const bool ends = parts.comment == "CP TOOLCHANGE END" || parts.comment == "CP PRIMING END";
    return ends ? std::optional(false) : std::nullopt;
  }
  if (!parts.code.starts_with("M62")) return std::nullopt;
  const GcodeCommand command = commandOf(parts.code);
  const bool begins = command.is('M', 620);
  if (!begins && !command.is('M', 621)) return std::nullopt;
  const std::size_t word = command.rest.find_first_not_of(" \t");
  return word != std::string_view::npos && command.rest[word] == 'S' ? std::optional(begins) : std::nullopt;
}

/// Tool or filament that a line of code chooses, from 0, by T2, or by M620 S2A, M621 S2A or M1020 S2 of Bambu's
/// printers, whose numbers from 255 on are no filaments.
inline std::optional<int> chosenFilament(std::string_view code) {
  constexpr int kNoFilament = 255;
  if (code.empty() || (code[0] != 'T' && !code.starts_with("M62") && !code.starts_with("M1020"))) return std::nullopt;
  const GcodeCommand command = commandOf(code);
  int number = command.letter == 'T' && command.sub == 0 ? command.code : -1;
  if (command.is('M', 620) || command.is('M', 621) || command.is('M', 1020)) {
    const GcodeWords words = wordsOf(command.rest);
    if (words.has('S')) number = static_cast<int>(std::clamp<double>(words.at('S'), -1, kNoFilament));
  }
  return number >= 0 && number < kNoFilament ? std::optional(number) : std::nullopt;
}

}  // namespace sillon
