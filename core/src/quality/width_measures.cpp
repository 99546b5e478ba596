#include "quality/measured_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

namespace sillon {
namespace {

struct WeightedWidth {
  float width;  ///< [mm], > 0
  float share;  ///< length that has this width [mm]
};

// Histogram of widths by the upper bits of their floats, which are in the order of the widths. A quantile only needs
// one bin to be sorted.
class WidthBins {
 public:
  explicit WidthBins(const std::vector<WeightedWidth>& widths) : widths_(widths), length_(1 << 16, 0.0) {
    for (const WeightedWidth& w : widths) length_[binOf(w.width)] += static_cast<double>(w.share);
  }

  // Finds the width below which lies the length `below`; the greatest width if rounding leaves none.
  [[nodiscard]] float quantile(double below) const {
    std::size_t bin = 0;
    double lesser = 0;  // length of all widths below the bin [mm]
    for (std::size_t next = 0; next < length_.size(); ++next) {
      if (length_[next] <= 0) continue;
      if (next > bin) lesser += length_[bin];
      bin = next;
      if (lesser + length_[bin] > below) break;
    }
    std::vector<WeightedWidth> inside;
    for (const WeightedWidth& w : widths_) {
      if (binOf(w.width) == bin) inside.push_back(w);
    }
    std::sort(inside.begin(), inside.end(), [](const WeightedWidth& a, const WeightedWidth& b) {
      return a.width != b.width ? a.width < b.width : a.share < b.share;
    });
    for (const WeightedWidth& w : inside) {
      lesser += static_cast<double>(w.share);
      if (lesser > below) return w.width;
    }
    return inside.back().width;
  }

 private:
  static std::size_t binOf(float width) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &width, sizeof bits);
    return bits >> 16;
  }

  const std::vector<WeightedWidth>& widths_;
  std::vector<double> length_;  ///< length in each bin [mm]
};

}  // namespace

WidthMeasures widthMeasures(const Toolpath& toolpath, const ToolpathParams& params, double totalLength) {
  std::vector<WeightedWidth> widths;
  WidthMeasures out;
  const double spacing = toolpath.spacing;
  for (const Cycle& cycle : toolpath.cycles) {
    const std::size_t n = cycle.points.size();
    float after = n > 0 ? length(cycle.points.front() - cycle.points.back()) : 0;
    for (std::size_t k = 0; k < n; ++k) {
      const float before = after;
      after = length(cycle.points[k + 1 < n ? k + 1 : 0] - cycle.points[k]);
      const float share = 0.5f * (before + after);
      widths.push_back({cycle.widths[k], share});
      const double w = static_cast<double>(cycle.widths[k]) / spacing;
      if (w < 0.5 - 1e-9) out.belowHalf += static_cast<double>(share);
      if (w <= params.minWidth + 1e-3 || w >= params.maxWidth - 1e-3) out.clamped += static_cast<double>(share);
    }
  }
  if (totalLength <= 0) return out;
  const WidthBins bins(widths);
  for (const auto& [q, value] : {std::pair{0.01, &out.p01}, std::pair{0.5, &out.median}, std::pair{0.99, &out.p99}}) {
    *value = static_cast<double>(bins.quantile(q * totalLength)) / spacing;
  }
  out.belowHalf /= totalLength;
  out.clamped /= totalLength;
  return out;
}

}  // namespace sillon
