// What a printer knows while it runs a file: modes, place, filament, heat. One step per command.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gcode_reader/parser.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

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

}  // namespace sillon
