// Lamps, white and side that were left open, chosen by trying them on small pictures.
#pragma once

#include <span>
#include <vector>

#include "look/direction_solver.hpp"
#include "sillon/look/inversion.hpp"

namespace sillon {

struct LampChoice {
  std::vector<Lamp> lamps;       ///< one per picture, as given or chosen
  std::vector<double> azimuths;  ///< as SolvedDirections
  double level = 1;              ///< as given or chosen
  LampSide side = LampSide::Both;
};

/// Pictures as small as is enough to try lamps and levels, and what they are tried with.
struct LampTrial {
  std::vector<Tones> tones;
  std::vector<char> inside;
  Roughness roughness;
  double smoothness;
  const RunContext& run;
};
/// \param tones  as they will be solved for, all of one size.
LampTrial lampTrial(const std::vector<Tones>& tones, const InsideCells& inside, const Roughness& roughness,
                    double smoothness, const RunContext& run);

/// \param level  light of white; 0: to be chosen.
LampChoice chooseLamps(const LampTrial& trial, std::span<const LitPicture> pictures, double level);

}  // namespace sillon
