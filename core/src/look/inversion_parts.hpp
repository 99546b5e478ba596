// Parts of the inversion: the exponential of highlights, the solver, the choice of lamps, and pictures on pages.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "base/simd.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// The exponential of highlights, the same on every platform.

/// e^-x for x >= 0, with a relative error below 5e-5 up to 60; from 80 on it stays constant. A Taylor polynomial at
/// x/256 is squared eight times.
inline float decay(float x) {
  const float y = std::min(x, 80.0f) * (1.0f / 256);
  float v = 1 - y * (1 - y * (1.0f / 2) * (1 - y * (1.0f / 3) * (1 - y * (1.0f / 4) * (1 - y * (1.0f / 5)))));
  for (int k = 0; k < 8; ++k) v *= v;
  return v;
}

/// Decays of four values, one per SIMD lane, each the same as decay(float) to the last bit.
inline F4 decay(F4 x) {
  const F4 one = splat(1);
  const F4 y = min4(splat(80.0f), x) * splat(1.0f / 256);
  const F4 fourth = one - y * splat(1.0f / 4) * (one - y * splat(1.0f / 5));
  F4 v = one - y * (one - y * splat(1.0f / 2) * (one - y * splat(1.0f / 3) * fourth));
  for (int k = 0; k < 8; ++k) v = v * v;
  return v;
}

// The directions that show pictures under given lamps: the solver behind inversion.hpp.

/// Number of directions that are tried, in steps of 2.8 degrees; the result is refined at the end.
inline constexpr int kLabels = 64;

/// Sides of the lamp that may be used. A single lamp shows each tone but the brightest and the darkest by two
/// directions, one on either side of it. With both sides there are fewer bends, but beads must end where the sides
/// meet.
enum class LampSide { Both, Left, Right };

/// Tables that depend on the lamps alone.
struct LampTables {
  std::vector<std::vector<float>> code;   ///< per picture: code of each label's light
  std::vector<std::vector<float>> error;  ///< per picture: squared error by [code asked for][label]
  float cos2[kLabels];
  float sin2[kLabels];
  float cos4[kLabels];
  float sin4[kLabels];
};
LampTables tablesOf(const std::vector<Lamp>& lamps, const Roughness& roughness, LampSide side = LampSide::Both);

/// The cells of one level of the hierarchy, row 0 on top.
struct ToneCells {
  int width = 0;
  int height = 0;
  std::vector<std::vector<float>> asked;  ///< per picture: code of the light asked for
  std::vector<float> weight;              ///< share of each cell that is shape; empty: all of it
  std::vector<Vec2f> z;                   ///< e^{2i angle}

  [[nodiscard]] std::size_t at(int x, int y) const { return indexOf(x, y, width); }
  [[nodiscard]] bool isOutside(std::size_t k) const { return !weight.empty() && weight[k] == 0; }
};

/// Makes cells that ask for the tones of each picture, between the darkest direction and white at `level`.
ToneCells cellsOf(const std::vector<Tones>& shown, const std::vector<char>& inside, const LampTables& tables,
                  double level);

/// Finds `z` of all cells by iterated conditional modes. \param smoothness  weight of the gradient against the tones.
void solve(ToneCells& cells, const LampTables& tables, double smoothness, const RunContext& run);

/// Refines the direction of each solved cell between the labels.
DirectionMap refined(const ToneCells& cells, const LampTables& tables, double smoothness, const RunContext& run);

// Lamps, white and side that were left open, chosen by trying them on small pictures.

/// Lamps, white and side, as given or as chosen.
struct LampChoice {
  std::vector<Lamp> lamps;       ///< one per picture, as given or chosen
  std::vector<double> azimuths;  ///< other azimuths worth a try, as SolvedDirections
  double level = 1;              ///< light of white, as given or chosen
  LampSide side = LampSide::Both;
};

/// Pictures just large enough to try lamps and levels on, and what they are tried with.
struct LampTrial {
  std::vector<Tones> tones;
  std::vector<char> inside;
  Roughness roughness;
  double smoothness;
  const RunContext& run;
};
/// Makes small pictures for trials. \param tones  tones as they will be solved for, all of one size.
LampTrial lampTrial(const std::vector<Tones>& tones, const InsideCells& inside, const Roughness& roughness,
                    double smoothness, const RunContext& run);

/// Chooses lamps, white and side as far as they were left open. \param level  light of white; 0: to be chosen.
LampChoice chooseLamps(const LampTrial& trial, std::span<const LitPicture> pictures, double level);

// A picture as it is laid on a page of other proportions.

/// Cuts a picture to the page's proportions, as much on either side. \param leftOut  receives the share of the picture
/// that lies beyond the page, 0..1.
Tones pageTones(Tones tones, Vec2 page, PictureProportions proportions, double& leftOut);

/// Most pictures that are solved for together.
inline constexpr int kMaxPictures = 4;

}  // namespace sillon
