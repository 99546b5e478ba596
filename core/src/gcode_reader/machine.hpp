// What a printer knows while it runs a file: modes, place, filament, heat. One step per command.
#pragma once

#include <optional>

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

/// All lengths mm, whatever the file's unit; z and at are where the nozzle is: G92 does not move it.
struct MachineState {
  // Modes.
  bool absolute = true;
  bool absoluteE = true;
  bool inches = false;
  bool ruledByG90 = true;   ///< G90 and G91 set E's mode too: Marlin's family
  bool volumetric = false;  ///< E is mm³: M200 D, and Cura's UltiGCode
  // Place.
  Vec2 at;
  double z = 0;
  Vec2 origin;  ///< written coordinate + origin = place
  double originZ = 0;
  unsigned homedAxes = 0;  ///< of kAxisX, kAxisY, kAxisZ
  bool zKnown = false;     ///< told since the last homing
  double speed = 0;
  // Filament.
  double e = 0;  ///< as written, in absolute mode
  double retracted = 0;
  bool firmwareRetracted = false;  ///< G10
  int tool = 0;

  [[nodiscard]] bool homed(unsigned axes = kAllAxes) const { return (homedAxes & axes) == axes; }

  /// \param flavor  decides what G90 means for E.
  explicit MachineState(std::optional<GcodeFlavor> flavor = {})
      : ruledByG90(flavor != GcodeFlavor::Klipper && flavor != GcodeFlavor::RepRap) {}
};

/// Runs a command of the modes and moves G0-G3, G10, G11, G20, G21, G28, G90-G92, M18, M82-M84, M200, T; others change
/// nothing. Reads words only where `words.readable()`. \return the move, if it is one.
std::optional<MachineMove> runCommand(MachineState& state, const GcodeCommand& command, const GcodeWords& words);

/// Does this command have words that the machine or the rules read?
bool readsWords(const GcodeCommand& command);

}  // namespace sillon
