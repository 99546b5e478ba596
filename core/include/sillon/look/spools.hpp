// Filaments as they look: colour, and roughness as Tab. 1 of the paper measured it.
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
  Roughness nozzleSide;  ///< that the nozzle passed over
  Roughness bedSide;     ///< that lay on the bed
};

// Nozzles of the measured prints [mm].
inline constexpr double kFineNozzle = 0.4;
inline constexpr double kWideNozzle = 0.8;

struct Spool {
  std::string key;                       ///< "bluePla"
  std::array<std::uint8_t, 3> colour{};  ///< of the body, sRGB
  SideRoughness fine;                    ///< printed with a nozzle of kFineNozzle
  SideRoughness wide;                    ///< and of kWideNozzle
};

/// All measured spools, sorted by key.
const std::vector<Spool>& spools();

/// \return nullptr for a key that is none of them.
const Spool* findSpool(std::string_view key);

const Spool& spoolOf(SpoolName name);

/// A person's own spools, sorted by key, out of a file as docs/reference/spools.md describes it.
/// \return InvalidFile (which spool, what of it, what is allowed) or TooLarge (beyond 1 MiB).
Result<std::vector<Spool>> readSpools(std::string_view text);

/// \param nozzle  diameter [mm]; between those measured in proportion, beyond them as the nearer
/// one.
Roughness roughnessOf(const Spool& spool, double nozzle, bool bedSide);

}  // namespace sillon
