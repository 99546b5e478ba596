// Offsets that commands add up, which move what a file prints without its coordinates telling it.
#pragma once

#include <optional>

#include "gcode_reader/parser.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

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
  Axes code_;   // SET_GCODE_OFFSET, M290
  Axes home_;   // M206
  Axes place_;  // G10 L2, L20
};

}  // namespace sillon
