// Filaments as they look: their colour, and their roughness as measured in Tab. 1 of the paper.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// Roughness of both sides of a layer.
struct SideRoughness {
  Roughness nozzleSide;  ///< roughness of the side that the nozzle passed over
  Roughness bedSide;     ///< roughness of the side that lay on the bed
};

// Nozzles of the measured prints [mm].
inline constexpr double kFineNozzle = 0.4;
inline constexpr double kWideNozzle = 0.8;

/// A filament as it looks.
struct Spool {
  std::string key;                       ///< name in files: "bluePla"
  std::array<std::uint8_t, 3> colour{};  ///< colour of the body, sRGB
  SideRoughness fine;                    ///< roughness when printed with a nozzle of kFineNozzle
  SideRoughness wide;                    ///< roughness when printed with a nozzle of kWideNozzle
};

/// Returns all measured spools, sorted by key.
const std::vector<Spool>& spools();

/// Finds a measured spool.
/// \return nullptr for a key that none of them has.
const Spool* findSpool(std::string_view key);

/// Returns the measured spool of a name.
const Spool& spoolOf(SpoolName name);

/// Reads a person's own spools, sorted by key, from a file as docs/reference/spools.md describes
/// it.
/// \return InvalidFile (which spool, which of its values, the allowed range) or TooLarge (beyond 1
/// MiB).
Result<std::vector<Spool>> readSpools(std::string_view text);

/// Returns the roughness of a spool on one side of a layer.
/// \param nozzle  diameter [mm]. Between the measured nozzles the slopes are interpolated linearly,
/// beyond them they are those of the nearer one.
Roughness roughnessOf(const Spool& spool, double nozzle, bool bedSide);

}  // namespace sillon
