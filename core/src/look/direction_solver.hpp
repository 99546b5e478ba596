// The directions that show pictures under given lamps: the solver behind inversion.hpp.
#pragma once

#include <vector>

#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/input/direction_map.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/look/tones.hpp"

namespace sillon {

/// Directions that are tried: steps of 2.8 degrees, refined at the end.
inline constexpr int kLabels = 64;

/// A single lamp shows each tone but the brightest and the darkest by two directions, one on either side of it. These
/// are the sides that may be used. Both make fewer bends; where they meet beads must end.
enum class LampSide { Both, Left, Right };

/// Tables that depend on the lamps alone.
struct LampTables {
  std::vector<std::vector<float>> code;   ///< per picture: the code of each label's light
  std::vector<std::vector<float>> error;  ///< per picture: [code asked for][label], squared
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

  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] bool isOutside(std::size_t k) const { return !weight.empty() && weight[k] == 0; }
};

/// Cells that ask for the tones of each picture, between the darkest direction and white at `level`.
ToneCells cellsOf(const std::vector<Tones>& shown, const std::vector<char>& inside, const LampTables& tables,
                  double level);

/// Finds `z` of all cells.
void solve(ToneCells& cells, const LampTables& tables, double smoothness, const RunContext& run);

/// The best direction of each solved cell between the labels.
DirectionMap refined(const ToneCells& cells, const LampTables& tables, double smoothness, const RunContext& run);

}  // namespace sillon
