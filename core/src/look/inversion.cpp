// Iterated conditional modes on a hierarchy: each cell in turn takes the best of 64 directions given its neighbours,
// cells of one of four colours at a time, from coarse to fine.
#include "sillon/look/inversion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "base/cancelled.hpp"
#include "base/fast_math.hpp"
#include "base/parallel_for.hpp"
#include "base/simd.hpp"
#include "toolpath/toolpath_check.hpp"

namespace sillon {
namespace {

constexpr int kLabels = 64;   // directions that are tried: steps of 2.8 degrees, refined at the end
constexpr int kCodes = 256;   // steps of the tones asked for
constexpr int kCoarsest = 8;  // cells on the longer side
constexpr int kMostCells = 4096;
constexpr int kCoarseSweeps = 4;
constexpr int kFineSweeps = 1;      // more change nothing that can be seen
constexpr float kIsotropy = 0.25f;  // of the gradient against the divergence
constexpr double kLeastContrast = 1.5;
constexpr int kTrialCells = 96;  // on the longer side, where lamps and levels are tried
constexpr int kAzimuths = 12;
constexpr std::size_t kOthers = 2;  // azimuths besides the chosen one
constexpr double kQuarrel = 3;      // several pictures ask for many more turns

/// One level of the hierarchy.
struct Grid {
  int width = 0;
  int height = 0;
  std::vector<std::vector<float>> asked;  // per picture: code of the light asked for
  std::vector<float> weight;              // share of each cell that is shape; empty: all of it
  std::vector<Vec2f> z;                   // e^{2i angle}

  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// What depends on the lamps alone.
struct Tables {
  std::vector<std::vector<float>> code;   // per picture: of each label's light
  std::vector<std::vector<float>> error;  // per picture: [code asked for][label], squared
  float cos2[kLabels], sin2[kLabels], cos4[kLabels], sin4[kLabels];
};

/// Where a single lamp's directions may lie: each tone but the brightest and the darkest is shown by two, one on either
/// side of the lamp. Both make fewer bends; where they meet beads must end.
enum class Side { Both, Left, Right };

Tables tablesOf(const std::vector<Lamp>& lamps, const Roughness& roughness, Side side = Side::Both) {
  Tables t;
  for (const Lamp& lamp : lamps) {
    std::vector<float> code = lightTable(lobeOf(lamp, roughness), kLabels);
    for (float& v : code) v = codeOfLight(v);
    std::vector<float> error;
    error.reserve(static_cast<std::size_t>(kCodes) * kLabels);
    for (int asked = 0; asked < kCodes; ++asked) {
      for (const float v : code) {
        const float off = v - static_cast<float>(asked) / (kCodes - 1);
        error.push_back(off * off);
      }
    }
    t.code.push_back(std::move(code));
    t.error.push_back(std::move(error));
  }
  if (side != Side::Both) {
    constexpr float kNever = 100;  // more than any tone is off
    const double azimuth = lamps[0].azimuth / 180 * kLabels;
    for (int k = 0; k < kLabels; ++k) {
      const double turned = k - azimuth;
      const double from = turned - kLabels * std::floor(turned / kLabels);  // labels left of the lamp
      const bool left = from <= kLabels / 2 + 0.5, right = from >= kLabels / 2 - 0.5 || from < 0.5;
      if (side == Side::Left ? left : right) continue;
      for (std::size_t row = 0; row < kCodes; ++row) t.error[0][row * kLabels + static_cast<std::size_t>(k)] += kNever;
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

/// Energy of a cell by its neighbours: a0 + a1 cos 2a + b1 sin 2a + a2 cos 4a + b2 sin 4a of its own direction a, but
/// for a0.
struct Harmonics {
  float a1 = 0, b1 = 0, a2 = 0, b2 = 0;

  /// Neighbours opposite each other, at 0, 45, 90 or 135 degrees. With n the bead's normal and d towards them, their
  /// weight (n.d)² - 1/4 + isotropy makes the sum over all four pairs the squared divergence and a little of the
  /// gradient. \param sum  of their z. \param count  of them, fewer at borders.
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

Harmonics neighboursOf(const Grid& grid, int x, int y) {
  const std::size_t here = grid.at(x, y), row = static_cast<std::size_t>(grid.width);
  const bool left = x > 0, right = x + 1 < grid.width, up = y > 0, down = y + 1 < grid.height;
  const Vec2f* z = grid.z.data();
  const auto pair = [&](bool one, std::size_t first, bool other, std::size_t second, int at45, float weight,
                        Harmonics& h) {
    const Vec2f sum = (one ? z[first] : Vec2f{}) + (other ? z[second] : Vec2f{});
    h.addPair(at45, sum, static_cast<float>(static_cast<int>(one) + static_cast<int>(other)), weight);
  };
  Harmonics h;
  pair(left, here - 1, right, here + 1, 0, 1, h);
  pair(right && up, here + 1 - row, left && down, here - 1 + row, 1, 0.5f, h);  // rows go down, y goes up
  pair(up, here - row, down, here + row, 2, 1, h);
  pair(left && up, here - 1 - row, right && down, here + 1 + row, 3, 0.5f, h);
  return h;
}

/// Energies of a cell's labels. \return the label of the least, the first of equal ones.
int energiesOf(const Grid& grid, const Tables& t, int x, int y, float toneWeight, float* energy) {
  const Harmonics h = neighboursOf(grid, x, y);
  const std::size_t here = grid.at(x, y), pictures = t.error.size();
  const float* error[kMaxPictures];
  for (std::size_t p = 0; p < pictures; ++p) {
    const auto asked = static_cast<int>(grid.asked[p][here] * (kCodes - 1) + 0.5f);
    error[p] = &t.error[p][static_cast<std::size_t>(std::clamp(asked, 0, kCodes - 1)) * kLabels];
  }
  if (!grid.weight.empty()) toneWeight *= grid.weight[here];
  const F4 a1 = splat(h.a1), b1 = splat(h.b1), a2 = splat(h.a2), b2 = splat(h.b2), weight = splat(toneWeight);
  F4 least = splat(std::numeric_limits<float>::infinity());
  I4 labels{0, 1, 2, 3}, best = labels;
  for (int k = 0; k < kLabels; k += 4) {
    F4 sum = a1 * load4(t.cos2 + k) + b1 * load4(t.sin2 + k) + a2 * load4(t.cos4 + k) + b2 * load4(t.sin4 + k);
    for (std::size_t p = 0; p < pictures; ++p) sum = sum + weight * load4(error[p] + k);
    store4(energy + k, sum);
    const I4 less = sum < least;
    least = select4(less, sum, least);
    best = (less & labels) | (~less & best);
    labels = labels + splatInt(4);
  }
  int found = best[0];
  for (int lane = 1; lane < 4; ++lane) {
    const int k = best[lane];
    if (energy[k] < energy[found] || (energy[k] == energy[found] && k < found)) found = k;
  }
  return found;
}

/// Cells of one colour have no neighbours of it: the order within it does not matter.
void sweep(Grid& grid, const Tables& t, float toneWeight, const RunContext& run) {
  for (int colour = 0; colour < 4; ++colour) {
    const int x0 = colour & 1, y0 = colour >> 1;
    parallelFor(run, (grid.height - y0 + 1) / 2, 4, [&](int begin, int end) {
      float energy[kLabels];
      for (int y = y0 + 2 * begin; y < y0 + 2 * end; y += 2) {
        for (int x = x0; x < grid.width; x += 2) {
          const int k = energiesOf(grid, t, x, y, toneWeight, energy);
          grid.z[grid.at(x, y)] = {t.cos2[k], t.sin2[k]};
        }
      }
    });
  }
}

Grid coarser(const Grid& fine) {
  Grid coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}, {}, {}};
  // Calls take(the four cells of each coarse one).
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
      float sum = 0, weighted = 0, weights = 0;
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

/// Fills z.
void solve(Grid& finest, const Tables& tables, double smoothness, const RunContext& run) {
  std::vector<Grid> levels{std::move(finest)};
  while (std::max(levels.back().width, levels.back().height) > kCoarsest) levels.push_back(coarser(levels.back()));
  // One picture: the same weight on every level, so that coarse ones choose the side of the lobe for smoothness.
  // Several: a coarse cell stands for many fine ones, else small parts of one picture are given up for the smoothness
  // of another.
  const float growth = tables.code.size() > 1 ? 2 : 1;
  auto toneWeight = static_cast<float>(1 / smoothness);
  for (std::size_t k = 1; k < levels.size(); ++k) toneWeight *= growth;
  for (std::size_t l = levels.size(); l-- > 0; toneWeight /= growth) {
    Grid& grid = levels[l];
    grid.z.resize(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
    if (l + 1 < levels.size()) {
      const Grid& above = levels[l + 1];
      for (int y = 0; y < grid.height; ++y) {
        for (int x = 0; x < grid.width; ++x) grid.z[grid.at(x, y)] = above.z[above.at(x / 2, y / 2)];
      }
    }
    for (int k = l == 0 ? kFineSweeps : kCoarseSweeps; k > 0; --k) sweep(grid, tables, toneWeight, run);
  }
  finest = std::move(levels[0]);
}

/// The best direction of each cell between the labels, by a parabola through the least energy and its neighbours.
DirectionMap refined(const Grid& grid, const Tables& t, double smoothness, const RunContext& run) {
  DirectionMap map{grid.width, grid.height, {}};
  map.angle.resize(grid.z.size());
  parallelFor(run, grid.height, 4, [&](int begin, int end) {
    float energy[kLabels];
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        const int k = energiesOf(grid, t, x, y, static_cast<float>(1 / smoothness), energy);
        const float before = energy[(k + kLabels - 1) % kLabels], after = energy[(k + 1) % kLabels];
        const float bend = before - 2 * energy[k] + after;
        const float off = bend > 0 ? std::clamp((before - after) / (2 * bend), -0.5f, 0.5f) : 0;
        float turn = (static_cast<float>(k) + off) / kLabels + 0.5f;  // half turns from -90 degrees
        turn -= std::floor(turn);
        map.angle[grid.at(x, y)] = static_cast<std::uint16_t>(turn * 65535 + 0.5f);
      }
    }
  });
  return map;
}

// ---- tones

void blurLine(float* first, std::size_t step, std::size_t count, float share, std::vector<float>& line) {
  line.resize(count);
  float v = first[0];
  for (std::size_t k = 0; k < count; ++k) line[k] = v += share * (first[step * k] - v);
  for (std::size_t k = count; k-- > 0;) first[step * k] = v += share * (line[k] - v);
}

/// Nearly Gaussian of `sigma` cells: two exponentials there and back along each axis.
std::vector<float> blurred(std::vector<float> values, int width, int height, float sigma) {
  const float share = (std::sqrt(1 + 4 * sigma * sigma) - 1) / (2 * sigma * sigma);
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  std::vector<float> line;
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t y = 0; y < rows; ++y) blurLine(&values[y * columns], 1, columns, share, line);
    for (std::size_t x = 0; x < columns; ++x) blurLine(&values[x], columns, rows, share, line);
  }
  return values;
}

void raiseDetails(std::vector<float>& values, int width, int height, double amount, double sigma) {
  if (!(amount > 0)) return;
  const std::vector<float> soft = blurred(values, width, height, static_cast<float>(sigma));
  for (std::size_t k = 0; k < values.size(); ++k) {
    values[k] = std::clamp(values[k] + static_cast<float>(amount) * (values[k] - soft[k]), 0.0f, 1.0f);
  }
}

/// Codes to ask for, per picture: its tones between the darkest direction and white at `level`.
Grid gridOf(const std::vector<Tones>& shown, const std::vector<char>& inside, const Tables& tables, double level) {
  Grid grid{shown[0].width, shown[0].height, {}, {}, {}};
  for (const char in : inside) grid.weight.push_back(in != 0 ? 1.0f : 0.0f);
  for (std::size_t p = 0; p < shown.size(); ++p) {
    const float low = *std::min_element(tables.code[p].begin(), tables.code[p].end());
    const float high = std::max(low, codeOfLight(static_cast<float>(level)));
    std::vector<float> asked = shown[p].value;
    for (float& v : asked) v = low + (high - low) * v;
    grid.asked.push_back(std::move(asked));
  }
  return grid;
}

// ---- what was not given

/// Pictures as small as is enough to try lamps and levels.
struct Trial {
  std::vector<Tones> tones;
  std::vector<char> inside;
};

Trial trialOf(const std::vector<Tones>& tones, const InsideCells& inside) {
  const int longer = std::max(tones[0].width, tones[0].height);
  const auto side = [&](int cells) { return std::max(1, cells * std::min(kTrialCells, longer) / longer); };
  Trial trial;
  for (const Tones& t : tones) trial.tones.push_back(resampled(t, side(t.width), side(t.height)));
  if (inside) trial.inside = inside(trial.tones[0].width, trial.tones[0].height);
  return trial;
}

/// How many beads the directions force to end, in cells: the sum of |divergence|.
double forcedEnds(const Grid& grid) {
  double sum = 0;
  for (int y = 1; y < grid.height; ++y) {
    for (int x = 0; x + 1 < grid.width; ++x) {
      if (!grid.weight.empty() && grid.weight[grid.at(x, y)] == 0) continue;
      const Vec2f z = grid.z[grid.at(x, y)];
      const auto turned = [&](std::size_t to) { return atan2Approx(cross(z, grid.z[to]), dot(z, grid.z[to])) / 2; };
      const float across = turned(grid.at(x + 1, y)), up = turned(grid.at(x, y - 1));
      const float angle = atan2Approx(z.y, z.x) / 2;
      const SinCos d = sinCos(angle);
      sum += static_cast<double>(std::abs(d.cos * up - d.sin * across));
    }
  }
  return sum;
}

/// The forced ends of a single picture on a side of its lamp.
double endsOf(const Trial& trial, const std::vector<Lamp>& lamps, Side side, const Roughness& roughness, double level,
              double smoothness, const RunContext& run) {
  const Tables tables = tablesOf(lamps, roughness, side);
  Grid grid = gridOf(trial.tones, trial.inside, tables, level);
  solve(grid, tables, smoothness, run);
  return forcedEnds(grid);
}

/// The side on which the directions of a single picture force the fewest beads to end.
Side sideOf(const Trial& trial, const std::vector<Lamp>& lamps, const Roughness& roughness, double level,
            double smoothness, const RunContext& run) {
  if (lamps.size() > 1) return Side::Both;
  double least = 1e300;
  Side best = Side::Both;
  for (const Side side : {Side::Both, Side::Left, Side::Right}) {
    const double ends = endsOf(trial, lamps, side, roughness, level, smoothness, run);
    if (ends < 0.99 * least) {
      least = ends;
      best = side;
    }
  }
  return best;
}

/// Of the worst picture: the mean |error| after the best affine fit, by the picture's standard deviation. Unlike
/// squares it counts pale traces of the other pictures on large areas for as much as errors at edges.
double errorOf(const Grid& grid, const Tables& tables, const std::vector<Tones>& shown) {
  double worst = 0;
  for (std::size_t p = 0; p < shown.size(); ++p) {
    std::vector<double> seen, wanted;
    double sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
    for (std::size_t k = 0; k < grid.z.size(); ++k) {
      if (!grid.weight.empty() && grid.weight[k] == 0) continue;
      const float turn = atan2Approx(grid.z[k].y, grid.z[k].x) / (2 * kPi) + 1;
      const auto label = static_cast<std::size_t>(turn * kLabels + 0.5f) % kLabels;
      seen.push_back(static_cast<double>(tables.code[p][label]));
      const double asked = static_cast<double>(shown[p].value[k]);
      wanted.push_back(asked);
      sx += seen.back();
      sy += asked;
      sxx += seen.back() * seen.back();
      syy += asked * asked;
      sxy += seen.back() * asked;
    }
    const auto count = static_cast<double>(std::max<std::size_t>(1, seen.size()));
    const double vx = sxx / count - sx / count * (sx / count), vy = syy / count - sy / count * (sy / count);
    if (!(vy > 1e-9)) continue;
    const double slope = vx > 1e-9 ? (sxy / count - sx / count * (sy / count)) / vx : 0;
    const double offset = (sy - slope * sx) / count;
    double error = 0;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      error += std::abs(offset + slope * seen[k] - wanted[k]);
    }
    worst = std::max(worst, error / count / std::sqrt(vy));
  }
  return worst;
}

/// Of the azimuths of a single lamp the one that forces the fewest beads to end, both sides of the lamp being used.
/// \param others  receives those with the fewest ends on their better side.
void chooseAzimuth(Lamp& lamp, std::vector<double>& others, const Trial& trial, const Roughness& roughness,
                   double level, double smoothness, const RunContext& run) {
  double least = 1e300;
  Lamp best = lamp;
  std::vector<std::pair<double, double>> ends;  // of either side, azimuth
  for (int k = 0; k < kAzimuths; ++k) {
    // 60 degrees, from the upper right as in the previews, unless another azimuth is better.
    lamp.azimuth = (60 + 180 / kAzimuths * k) % 180;
    const auto endsOn = [&](Side side) { return endsOf(trial, {lamp}, side, roughness, level, smoothness, run); };
    const double both = endsOn(Side::Both);
    ends.emplace_back(std::min({both, endsOn(Side::Left), endsOn(Side::Right)}), lamp.azimuth);
    if (both < 0.99 * least) {
      least = both;
      best = lamp;
    }
  }
  lamp = best;
  const auto isTaken = [&](double azimuth) {
    return azimuth == lamp.azimuth || std::find(others.begin(), others.end(), azimuth) != others.end();
  };
  while (others.size() < kOthers) {
    const std::pair<double, double>* next = nullptr;
    for (const auto& one : ends) {
      if (!isTaken(one.second) && (next == nullptr || one.first < next->first)) next = &one;
    }
    if (next == nullptr) return;
    others.push_back(next->second);
  }
}

/// Sets azimuths and level that were left open. \param others  as chooseAzimuth.
double choose(std::vector<Lamp>& lamps, const std::vector<bool>& open, std::vector<double>& others, const Trial& trial,
              const Roughness& roughness, const InversionParams& params, const RunContext& run) {
  if (lamps.size() == 1) {
    const double level = params.level > 0 ? params.level : 1;
    if (open[0]) chooseAzimuth(lamps[0], others, trial, roughness, level, params.smoothness, run);
    return level;
  }
  const bool anyOpen = std::find(open.begin(), open.end(), true) != open.end();
  const double first = lamps[0].azimuth;
  // The nearer two lamps stand, the more tones of both a direction can show, and the more each shows of the other
  // picture; lobes of more lamps must not overlap.
  std::vector<double> apart{180.0 / static_cast<double>(lamps.size())};
  if (lamps.size() == 2) apart = {40, 35, 30, 25, 50};
  if (!anyOpen) apart = {0};
  std::vector<double> whites{0.5, 0.7, 1, 0.85, 0.35};
  if (params.level > 0) whites = {params.level};
  double least = 1e300, level = whites[0];
  std::vector<Lamp> best = lamps;
  for (const double separation : apart) {
    for (std::size_t p = 0; p < lamps.size(); ++p) {
      if (open[p]) lamps[p].azimuth = first + separation * static_cast<double>(p);
    }
    const Tables tables = tablesOf(lamps, roughness);
    for (const double white : whites) {
      Grid grid = gridOf(trial.tones, trial.inside, tables, white);
      solve(grid, tables, params.smoothness, run);
      const double error = errorOf(grid, tables, trial.tones);
      if (error < 0.99 * least) {
        least = error;
        level = white;
        best = lamps;
      }
    }
  }
  lamps = best;
  return level;
}

std::string defectOf(std::span<const LitPicture> pictures, const Roughness& roughness, Vec2 page, double spacing,
                     const InversionParams& params) {
  const auto within = [](double v, double low, double high) { return v >= low && v <= high; };
  if (pictures.empty() || pictures.size() > kMaxPictures) {
    return std::to_string(pictures.size()) + " pictures are asked for; there must be 1 to 4";
  }
  if (std::string defect = pageDefect(page); !defect.empty()) return defect;
  if (!within(spacing, 1e-3, 1e3)) return "spacing is outside its range of 0.001 to 1000 mm";
  if (!within(params.smoothness, 0.001, 10)) return "smoothness is outside its range of 0.001 to 10";
  if (!within(params.sharpness, 0, 2)) return "sharpness is outside its range of 0 to 2";
  if (!within(params.localContrast, 0, 2)) return "local contrast is outside its range of 0 to 2";
  if (params.level != 0 && !within(params.level, 0.05, 1)) return "level is outside its range of 0.05 to 1, or 0";
  if (std::string defect = invalidRoughness(roughness); !defect.empty()) return defect;
  for (const LitPicture& picture : pictures) {
    const Tones& tones = picture.tones;
    if (tones.width < 1 || tones.height < 1 ||
        tones.value.size() != static_cast<std::size_t>(tones.width) * static_cast<std::size_t>(tones.height)) {
      return "a picture has no pixels";
    }
    if (std::any_of(tones.value.begin(), tones.value.end(), [](float tone) { return !std::isfinite(tone); })) {
      return "a picture has a tone that is not a number";
    }
    if (std::string defect = invalidLamp(picture.lamp); !defect.empty()) return defect;
    if (contrastOf(lobeOf(picture.lamp, roughness)) < kLeastContrast) {
      return "the lamp makes no direction of this spool more than 1.5 times as bright as another; choose a lower or a "
             "smaller lamp, or a glossier spool";
    }
  }
  return {};
}

}  // namespace

Result<SolvedDirections> solveDirections(std::span<const LitPicture> pictures, const Roughness& roughness, Vec2 page,
                                         double spacing, const InversionParams& params, const RunContext& run,
                                         const InsideCells& inside) {
  if (std::string defect = defectOf(pictures, roughness, page, spacing, params); !defect.empty()) {
    return Error{ErrorCode::InvalidArgument, std::move(defect)};
  }
  const double cell = std::max(spacing / 2, std::max(page.x, page.y) / kMostCells);
  const auto cells = [&](double side) { return std::max(1, static_cast<int>(std::floor(side / cell + 0.5))); };
  const int width = cells(page.x), height = cells(page.y);

  SolvedDirections solved;
  const std::vector<char> shape = inside ? inside(width, height) : std::vector<char>();
  std::vector<Tones> raised;
  std::vector<bool> open;
  for (const LitPicture& picture : pictures) {
    solved.lamps.push_back(picture.lamp);
    open.push_back(picture.chooseAzimuth);
    solved.shown.push_back(levelled(resampled(picture.tones, width, height), shape));
    raised.push_back(solved.shown.back());
    raiseDetails(raised.back().value, width, height, params.localContrast, 0.05 * std::max(width, height));
    // Several pictures quarrel over details already.
    if (pictures.size() == 1) raiseDetails(raised.back().value, width, height, params.sharpness, spacing / cell);
  }
  InversionParams smoothed = params;
  if (pictures.size() > 1) smoothed.smoothness *= kQuarrel;
  const Trial trial = trialOf(raised, inside);
  solved.level = choose(solved.lamps, open, solved.azimuths, trial, roughness, smoothed, run);
  const Side side = sideOf(trial, solved.lamps, roughness, solved.level, smoothed.smoothness, run);
  const Tables tables = tablesOf(solved.lamps, roughness, side);
  Grid grid = gridOf(raised, shape, tables, solved.level);
  solve(grid, tables, smoothed.smoothness, run);
  solved.directions = refined(grid, tables, smoothed.smoothness, run);
  if (run.cancelled()) return cancelledRun();
  return solved;
}

}  // namespace sillon
