// Iterated conditional modes on a hierarchy: each cell in turn takes the best of 64 directions given its neighbours,
// cells of one of four colours at a time, from coarse to fine.
#include "look/inversion_parts.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/fast_math.hpp"
#include "base/parallel_for.hpp"
#include "look/rasters.hpp"

namespace sillon {
namespace {

constexpr int kCodes = 256;   // steps of the tones asked for
constexpr int kCoarsest = 8;  // cells on the longer side of the coarsest level
// Sweeps over the cells of each level; on the finest, more than one changes nothing that can be seen.
constexpr int kCoarseSweeps = 4;
constexpr int kFineSweeps = 1;
constexpr float kIsotropy = 0.25f;  // weight of the gradient against the divergence

/// Energy of a cell against its neighbours, as a trigonometric polynomial of its own direction a: a0 + a1 cos 2a + b1
/// sin 2a + a2 cos 4a + b2 sin 4a, without the constant a0. So the energies of all labels are four products each.
struct Harmonics {
  float a1 = 0;
  float b1 = 0;
  float a2 = 0;
  float b2 = 0;

  /// Adds two neighbours opposite each other, at 0, 45, 90 or 135 degrees. With n the bead's normal and d towards them,
  /// their weight (n.d)² - 1/4 + isotropy makes the sum over all four pairs the squared divergence and a little of the
  /// gradient. \param sum  sum of their z. \param count  number of them, fewer at borders.
  void addPair(int at45, Vec2f sum, float count, float distanceWeight) {
    const float a = (0.25f + kIsotropy) * distanceWeight;
    const float b = (at45 < 2 ? 0.5f : -0.5f) * distanceWeight;  // (n.d)² = (1 - cos or sin 2a)/2, or plus
    a1 -= a * sum.x;
    b1 -= a * sum.y;
    if (at45 % 2 == 0) {
      a1 -= b * count;
      a2 += b * sum.x / 2;
      b2 += b * sum.y / 2;
    } else {
      b1 -= b * count;
      a2 -= b * sum.y / 2;
      b2 += b * sum.x / 2;
    }
  }
};

/// Collects the smoothness term of a cell from its eight neighbours, as four pairs.
Harmonics neighboursOf(const ToneCells& cells, int x, int y) {
  const std::size_t here = cells.at(x, y);
  const std::size_t row = cells.width;
  const bool left = x > 0;
  const bool right = x + 1 < cells.width;
  const bool up = y > 0;
  const bool down = y + 1 < cells.height;
  const Vec2f* z = cells.z.data();
  Harmonics h;
  struct Neighbour {
    bool exists;
    std::size_t at;
  };
  // Neighbours beyond the raster's edge do not exist and add nothing.
  const auto addPair = [&](Neighbour one, Neighbour other, int at45, float weight) {
    const Vec2f sum = (one.exists ? z[one.at] : Vec2f{}) + (other.exists ? z[other.at] : Vec2f{});
    h.addPair(at45, sum, static_cast<float>(static_cast<int>(one.exists) + static_cast<int>(other.exists)), weight);
  };
  addPair({left, here - 1}, {right, here + 1}, 0, 1);
  addPair({right && up, here + 1 - row}, {left && down, here - 1 + row}, 1, 0.5f);  // rows go down, y goes up
  addPair({up, here - row}, {down, here + row}, 2, 1);
  addPair({left && up, here - 1 - row}, {right && down, here + 1 + row}, 3, 0.5f);
  return h;
}

/// Computes the energies of a cell's labels: smoothness plus the squared errors of all pictures. \return the label of
/// the least, the first of equal ones.
int energiesOf(const ToneCells& cells, const LampTables& t, int x, int y, float toneWeight, float* energy) {
  const Harmonics h = neighboursOf(cells, x, y);
  const std::size_t here = cells.at(x, y);
  const std::size_t pictures = t.error.size();
  const float* error[kMaxPictures];
  for (std::size_t p = 0; p < pictures; ++p) {
    const auto asked = static_cast<int>(cells.asked[p][here] * (kCodes - 1) + 0.5f);
    error[p] = &t.error[p][std::clamp(asked, 0, kCodes - 1) * kLabels];
  }
  // Cells outside of the shape have no tone, and only follow their neighbours.
  if (!cells.weight.empty()) toneWeight *= cells.weight[here];
  // Look up the row of errors for the code that each picture asks for, and spread the coefficients over the lanes.
  const F4 a1 = splat(h.a1);
  const F4 b1 = splat(h.b1);
  const F4 a2 = splat(h.a2);
  const F4 b2 = splat(h.b2);
  const F4 weight = splat(toneWeight);
  F4 least = splat(std::numeric_limits<float>::infinity());
  I4 labels{0, 1, 2, 3};
  I4 best = labels;
  // Four labels at a time; each lane keeps its own best.
  for (int k = 0; k < kLabels; k += 4) {
    F4 sum = a1 * load4(t.cos2 + k) + b1 * load4(t.sin2 + k) + a2 * load4(t.cos4 + k) + b2 * load4(t.sin4 + k);
    for (std::size_t p = 0; p < pictures; ++p) sum = sum + weight * load4(error[p] + k);
    store4(energy + k, sum);
    const I4 less = sum < least;
    least = select4(less, sum, least);
    best = (less & labels) | (~less & best);
    labels = labels + splatInt(4);
  }
  // Best of the four lanes; the lower label of two as good.
  int found = best[0];
  for (int lane = 1; lane < 4; ++lane) {
    const int k = best[lane];
    if (energy[k] < energy[found] || (energy[k] == energy[found] && k < found)) found = k;
  }
  return found;
}

/// Sweeps once: each cell in turn takes its best label. Cells of one colour have no neighbours of the same colour, so
/// that the order within it does not matter.
void sweep(ToneCells& cells, const LampTables& t, float toneWeight, const RunContext& run) {
  for (int colour = 0; colour < 4; ++colour) {
    const int x0 = colour & 1;
    const int y0 = colour >> 1;
    parallelFor(run, (cells.height - y0 + 1) / 2, 4, [&](int begin, int end) {
      float energy[kLabels];
      for (int y = y0 + 2 * begin; y < y0 + 2 * end; y += 2) {
        for (int x = x0; x < cells.width; x += 2) {
          const int k = energiesOf(cells, t, x, y, toneWeight, energy);
          cells.z[cells.at(x, y)] = {t.cos2[k], t.sin2[k]};
        }
      }
    });
  }
}

/// Makes the next coarser level: means of four cells, weighted by the share of each that is shape.
ToneCells coarser(const ToneCells& fine) {
  ToneCells coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}, {}, {}};
  // Calls take(four) with the indices of the four fine cells of each coarse one.
  const auto forEachFour = [&](auto&& take) {
    for (int y = 0; y < coarse.height; ++y) {
      const int below = std::min(2 * y + 1, fine.height - 1);
      for (int x = 0; x < coarse.width; ++x) {
        const int right = std::min(2 * x + 1, fine.width - 1);
        take(std::array{fine.at(2 * x, 2 * y), fine.at(right, 2 * y), fine.at(2 * x, below), fine.at(right, below)});
      }
    }
  };
  if (!fine.weight.empty()) {
    forEachFour([&](const std::array<std::size_t, 4>& four) {
      float sum = 0;
      for (const std::size_t k : four) sum += fine.weight[k];
      coarse.weight.push_back(sum / 4);
    });
  }
  for (const std::vector<float>& asked : fine.asked) {
    std::vector<float> mean;
    forEachFour([&](const std::array<std::size_t, 4>& four) {
      float sum = 0;
      float weighted = 0;
      float weights = 0;
      for (const std::size_t k : four) {
        const float weight = fine.weight.empty() ? 1 : fine.weight[k];
        sum += asked[k];
        weighted += weight * asked[k];
        weights += weight;
      }
      mean.push_back(weights > 0 && !fine.weight.empty() ? weighted / weights : sum / 4);
    });
    coarse.asked.push_back(std::move(mean));
  }
  return coarse;
}

}  // namespace

LampTables tablesOf(const std::vector<Lamp>& lamps, const Roughness& roughness, LampSide side) {
  LampTables t;
  for (const Lamp& lamp : lamps) {
    // The code that each label shows under this lamp, and its squared error against every code that may be asked for.
    std::vector<float> code = lightTable(lobeOf(lamp, roughness), kLabels);
    for (float& v : code) v = codeOfLight(v);
    std::vector<float> error;
    error.reserve(kCodes * kLabels);
    for (int asked = 0; asked < kCodes; ++asked) {
      for (const float v : code) {
        const float off = v - static_cast<float>(asked) / (kCodes - 1);
        error.push_back(off * off);
      }
    }
    t.code.push_back(std::move(code));
    t.error.push_back(std::move(error));
  }
  // To use one side of the lamp only, the labels on the other side get an error that no tone can make up for.
  if (side != LampSide::Both) {
    constexpr float kNever = 100;  // larger than any error of a tone
    // Labels count in half turns from 0 degrees; both sides include the labels next to the lamp's line.
    const double azimuth = lamps[0].azimuth / 180 * kLabels;
    for (int k = 0; k < kLabels; ++k) {
      const double turned = k - azimuth;
      const double from = turned - kLabels * std::floor(turned / kLabels);  // labels to the left of the lamp
      const bool left = from <= kLabels / 2 + 0.5;
      const bool right = from >= kLabels / 2 - 0.5 || from < 0.5;
      if (side == LampSide::Left ? left : right) continue;
      for (std::size_t row = 0; row < kCodes; ++row) t.error[0][row * kLabels + k] += kNever;
    }
  }
  for (int k = 0; k < kLabels; ++k) {
    const SinCos two = sinCos(2 * kPi * static_cast<float>(k) / kLabels);
    t.cos2[k] = two.cos;
    t.sin2[k] = two.sin;
    t.cos4[k] = two.cos * two.cos - two.sin * two.sin;
    t.sin4[k] = 2 * two.cos * two.sin;
  }
  return t;
}

void solve(ToneCells& finest, const LampTables& tables, double smoothness, const RunContext& run) {
  std::vector<ToneCells> levels{std::move(finest)};
  while (std::max(levels.back().width, levels.back().height) > kCoarsest) levels.push_back(coarser(levels.back()));
  // With one picture, the weight is the same on every level, so that coarse levels choose the side of the lobe for
  // smoothness. With several, a coarse cell counts for the many fine ones that it stands for; otherwise small parts of
  // one picture would be given up for the smoothness of another.
  const float growth = tables.code.size() > 1 ? 2 : 1;
  auto toneWeight = static_cast<float>(1 / smoothness);
  for (std::size_t k = 1; k < levels.size(); ++k) toneWeight *= growth;
  // From coarse to fine: begin with the parent's direction, then sweep.
  for (std::size_t l = levels.size(); l-- > 0; toneWeight /= growth) {
    ToneCells& cells = levels[l];
    cells.z.resize(cellCount(cells.width, cells.height));
    if (l + 1 < levels.size()) {
      const ToneCells& above = levels[l + 1];
      for (int y = 0; y < cells.height; ++y) {
        for (int x = 0; x < cells.width; ++x) cells.z[cells.at(x, y)] = above.z[above.at(x / 2, y / 2)];
      }
    }
    for (int k = l == 0 ? kFineSweeps : kCoarseSweeps; k > 0; --k) sweep(cells, tables, toneWeight, run);
  }
  finest = std::move(levels[0]);
}

/// Finds the best direction of each cell between the labels, by a parabola through the least energy and its neighbours.
DirectionMap refined(const ToneCells& cells, const LampTables& t, double smoothness, const RunContext& run) {
  DirectionMap map{cells.width, cells.height, {}};
  map.angle.resize(cells.z.size());
  parallelFor(run, cells.height, 4, [&](int begin, int end) {
    float energy[kLabels];
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < cells.width; ++x) {
        const int k = energiesOf(cells, t, x, y, static_cast<float>(1 / smoothness), energy);
        const float before = energy[(k + kLabels - 1) % kLabels];
        const float after = energy[(k + 1) % kLabels];
        // The parabola's vertex, at most half a label away.
        const float bend = before - 2 * energy[k] + after;
        const float off = bend > 0 ? std::clamp((before - after) / (2 * bend), -0.5f, 0.5f) : 0;
        float turn = (static_cast<float>(k) + off) / kLabels + 0.5f;  // half turns from -90 degrees
        turn -= std::floor(turn);
        map.angle[cells.at(x, y)] = static_cast<std::uint16_t>(turn * 65535 + 0.5f);
      }
    }
  });
  return map;
}

/// Codes that each picture asks for: its tones between the darkest direction and white at `level`.
ToneCells cellsOf(const std::vector<Tones>& shown, const std::vector<char>& inside, const LampTables& tables,
                  double level) {
  ToneCells cells{shown[0].width, shown[0].height, {}, {}, {}};
  for (const char in : inside) cells.weight.push_back(in != 0 ? 1.0f : 0.0f);
  for (std::size_t p = 0; p < shown.size(); ++p) {
    const float low = *std::min_element(tables.code[p].begin(), tables.code[p].end());
    const float high = std::max(low, codeOfLight(static_cast<float>(level)));
    std::vector<float> asked = shown[p].value;
    for (float& v : asked) v = low + (high - low) * v;
    cells.asked.push_back(std::move(asked));
  }
  return cells;
}

}  // namespace sillon
