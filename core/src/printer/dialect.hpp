// Commands that differ between firmwares. Facts and sources: docs/reference/gcode.md.
#pragma once

#include <string>

#include "base/numbers.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// Name of a dialect in slicers and viewers.
inline const char* dialectName(GcodeFlavor flavor) {
  if (flavor == GcodeFlavor::Klipper) return "klipper";
  if (flavor == GcodeFlavor::RepRap) return "reprapfirmware";
  return flavor == GcodeFlavor::Bambu ? "marlin" : "marlin2";
}

/// Sets the acceleration of prints and travels [mm/s²]. Klipper and Bambu read S only.
inline std::string accelerationCommand(GcodeFlavor flavor, double acceleration) {
  const std::string value = fixed(acceleration, 0);
  if (flavor == GcodeFlavor::Klipper || flavor == GcodeFlavor::Bambu) return "M204 S" + value + "\n";
  return "M204 P" + value + " T" + value + "\n";
}

/// Sets the speed of right-angled corners [mm/s]. Jerk is twice that; RepRapFirmware takes it in mm/min.
inline std::string cornerSpeedCommand(GcodeFlavor flavor, double speed) {
  if (flavor == GcodeFlavor::Klipper) return "SET_VELOCITY_LIMIT SQUARE_CORNER_VELOCITY=" + fixed(speed, 2) + "\n";
  const bool reprap = flavor == GcodeFlavor::RepRap;
  const std::string jerk = fixed(reprap ? 120 * speed : 2 * speed, reprap ? 0 : 2);
  return (reprap ? "M566 X" : "M205 X") + jerk + " Y" + jerk + "\n";
}

/// Sets pressure (or linear) advance [s].
inline std::string pressureAdvanceCommand(GcodeFlavor flavor, double seconds) {
  const std::string value = seconds > 0 ? fixed(seconds, 4) : "0";
  if (flavor == GcodeFlavor::Klipper) return "SET_PRESSURE_ADVANCE ADVANCE=" + value + "\n";
  if (flavor == GcodeFlavor::RepRap) return "M572 D0 S" + value + "\n";
  return (flavor == GcodeFlavor::PrusaBuddy ? "M572 S" : "M900 K") + value + "\n";
}

}  // namespace sillon
