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

// Offsets that commands add up, which move what a file prints without its coordinates telling it.

/// The sum of babysteps, G-code offsets, home offsets and workplace origins [mm].
class Offsets {
 public:
  struct Axes {
    double x = 0;
    double y = 0;
    double z = 0;
  };

  /// Runs SET_GCODE_OFFSET, M290, M206 and G10 with L2 or L20; others change nothing.
  /// \return the new sum, if the command changes it.
  std::optional<Axes> run(const GcodeCommand& command, GcodeFlavor flavor);

 private:
  Axes code_;   // SET_GCODE_OFFSET
  Axes baby_;   // M290
  Axes home_;   // M206
  Axes place_;  // G10 L2, L20
};

// Heaters: the temperatures that a file asks for, and those it has waited for.

inline constexpr double kColdest = 170;  ///< [degrees Celsius] of a nozzle that extrudes

/// [degrees Celsius]
struct Heater {
  double target = 0;
  double ready = 0;  ///< that was waited for, or less where less was asked for since: no colder than this

  bool operator==(const Heater&) const = default;
};

/// The bed, the chamber and the nozzles of all tools. Tools that were never told share the heater that was told last,
/// as the filaments of a changer share a nozzle.
class Heaters {
 public:
  /// Runs M104, M109, M140, M190, M141, M191, RepRapFirmware's G10, M568 and M116, TriLAB's G1009, and Klipper's
  /// TURN_OFF_HEATERS, SET_HEATER_TEMPERATURE and TEMPERATURE_WAIT; others change nothing. Less than 0 degrees switch
  /// off. \param tool  the current one. \param klipper  which reads S alone: heaters that are told without it go off.
  void run(const GcodeCommand& command, const GcodeWords& words, int tool, bool klipper);

  /// For what heats in ways of its own, as start macros do.
  void setNozzle(double degrees) { tell(told_) = {degrees, degrees}; }
  void setBed(double degrees) { bed_ = {degrees, degrees}; }

  [[nodiscard]] const Heater& nozzle(int tool) const { return nozzles_[indexOf(tool)]; }
  [[nodiscard]] const Heater& bed() const { return bed_; }
  [[nodiscard]] const Heater& chamber() const { return chamber_; }
  /// Tools beside this one whose nozzle has a target.
  [[nodiscard]] std::vector<int> otherHotTools(int tool) const;

  bool operator==(const Heaters&) const = default;

 private:
  static constexpr std::size_t kTools = 16;

  [[nodiscard]] std::size_t indexOf(int tool) const;
  Heater& tell(std::size_t index);
  void runNamed(const GcodeCommand& command);

  std::array<Heater, kTools> nozzles_{};
  std::array<bool, kTools> known_{};  // that were told
  std::size_t told_ = 0;              // whose nozzle was told last
  bool separate_ = false;             // a tool was told that was not the current one: each has a nozzle of its own
  Heater bed_;
  Heater chamber_;
};

// State of a printer while it runs a file: modes, place, filament, heat. One step per command.

inline constexpr unsigned kAxisX = 1, kAxisY = 2, kAxisZ = 4;
inline constexpr unsigned kPlane = kAxisX | kAxisY;
inline constexpr unsigned kAllAxes = kPlane | kAxisZ;

/// A move as it was understood. Lengths mm, speeds mm/s.
struct MachineMove {
  int code = 0;  ///< 0..3
  Vec2 from;
  Vec2 to;
  double zFrom = 0;
  double z = 0;
  double e = 0;          ///< filament that this move pushes; below 0: pulls
  double length = 0;     ///< in the plane, along the arc
  Vec2 centre;           ///< of an arc
  double turn = 0;       ///< of an arc [rad], counterclockwise above 0
  bool xy = false;       ///< X or Y are written
  bool toldZ = false;    ///< Z is written
  bool toldF = false;    ///< F is written
  bool arc = false;      ///< G2, G3
  bool readable = true;  ///< an arc without a centre, or with a radius that cannot be, is not followed
};

/// A place on an arc that is readable. \param share  of its turn, 0..1.
Vec2 onArc(const MachineMove& arc, double share);

/// What SAVE_GCODE_STATE of Klipper or M120 of RepRapFirmware keeps.
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

/// What is put aside until it is asked for.
struct MachineMemory {
  std::vector<std::pair<std::string, SavedState>> states;  ///< by name; those of M120 have none
  std::vector<std::pair<int, HeldFilament>> tools;         ///< that are not the current one
};

/// All lengths mm, whatever the file's unit; z and at are where the nozzle is: G92 does not move it.
struct MachineState {
  // Modes.
  bool absolute = true;
  bool absoluteE = true;
  bool inches = false;
  bool ruledByG90 = true;   ///< G90 and G91 set E's mode too: Marlin's family
  bool volumetric = false;  ///< E is mm³: M200 D, and Cura's UltiGCode
  bool duet = false;        ///< RepRapFirmware: M120 and M121 keep the modes, G10 S0 heats
  // Place.
  Vec2 at;
  double z = 0;
  Vec2 origin;  ///< written coordinate + origin = place
  double originZ = 0;
  unsigned homedAxes = 0;  ///< of kAxisX, kAxisY, kAxisZ
  unsigned toldAxes = 0;   ///< whose place was told since they homed
  double speed = 0;
  // Filament.
  double e = 0;  ///< as written, in absolute mode
  double retracted = 0;
  bool firmwareRetracted = false;  ///< G10
  int tool = 0;
  std::shared_ptr<const MachineMemory> memory;  ///< shared by copies, of which a reader makes two for each line

  [[nodiscard]] bool told(unsigned axes) const { return (toldAxes & axes) == axes; }
  [[nodiscard]] bool homed(unsigned axes = kAllAxes) const { return (homedAxes & axes) == axes; }

  /// \param flavor  decides what G90 means for E, and what M120 does.
  explicit MachineState(std::optional<GcodeFlavor> flavor = {})
      : ruledByG90(flavor != GcodeFlavor::Klipper && flavor != GcodeFlavor::RepRap),
        duet(flavor == GcodeFlavor::RepRap) {}
};

/// Runs a command of the modes and moves G0-G3, G10, G11, G20, G21, G28, G90-G92, M18, M82-M84, M120, M121, M200, T,
/// SAVE_GCODE_STATE and RESTORE_GCODE_STATE; others change nothing. Reads words only where `words.readable()`. \return
/// the move, if it is one.
std::optional<MachineMove> runCommand(MachineState& state, const GcodeCommand& command, const GcodeWords& words);

/// Does this command have words that the machine or the rules read?
bool readsWords(const GcodeCommand& command);

/// Whether a G10 sets up a tool, as RepRapFirmware's does, instead of drawing filament back.
bool setsTool(const GcodeCommand& command, const GcodeWords& words, bool duet = false);

/// What M200 makes of volumetric extrusion; nothing: it is another command, or leaves it as it is.
std::optional<bool> volumetricBy(const GcodeCommand& command, const GcodeWords& words);

// States that a printer puts aside and takes up again: by name or on a stack, and the filament that each tool holds
// back.

/// \param tool  from 0; others change nothing.
void changeTool(MachineState& state, int tool);

/// M120 and M121 of RepRapFirmware.
void pushModes(MachineState& state);
void popModes(MachineState& state);

/// SAVE_GCODE_STATE and RESTORE_GCODE_STATE of Klipper: modes, origin and what E is written as. \return the way back,
/// where MOVE=1 asks for it.
std::optional<MachineMove> runMemory(MachineState& state, const GcodeCommand& command);

// Begin and end of code that changes a tool or a filament: it cuts, flushes and wipes in ways of its own.

/// \return true: it begins; false: it ends; nothing: the line is something else. PrusaSlicer's comments, and M620 S and
/// M621 S of Bambu's printers.
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

/// The tool or filament that a line of code chooses, from 0: T2, and M620 S2A, M621 S2A or M1020 S2 of Bambu's
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
