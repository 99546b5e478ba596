// What a file asks of the heaters, and what it has waited for.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "gcode_reader/parser.hpp"

namespace sillon {

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
  /// Runs M104, M109, M140, M190, M141, M191, RepRapFirmware's G10, M568 and M116, and Klipper's TURN_OFF_HEATERS,
  /// SET_HEATER_TEMPERATURE and TEMPERATURE_WAIT; others change nothing. Less than 0 degrees switch off.
  /// \param tool  the current one.
  void run(const GcodeCommand& command, const GcodeWords& words, int tool);

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

}  // namespace sillon
