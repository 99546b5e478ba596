#include "sillon/toolpath/simplify.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel_for.hpp"
#include "geometry/closed_curves.hpp"

namespace sillon {
namespace {

constexpr float kMaxSegment = 2;   ///< [mm]
constexpr float kSpill = 0.0005f;  ///< half a µm on either side, the rounding [mm]
constexpr int kMaxSkipped = 64;    ///< points left out in a row, which bounds the work

float floored(float v) { return static_cast<float>(std::floor(static_cast<double>(v) * 1000) / 1000); }
float rounded(float v) {
  return static_cast<float>(static_cast<double>(std::llround(static_cast<double>(v) * 1000)) / 1000);
}

struct Curve {
  std::vector<Vec2f> points;
  std::vector<float> widths;
  std::vector<float> limits;  ///< widths that would spill
};

// Whether the straight bead from `a` to `b` stands for all points between them.
bool standsFor(const Curve& curve, std::size_t a, std::size_t b, float tolerance) {
  const Vec2f p = curve.points[a];
  const Vec2f q = curve.points[b % curve.points.size()];
  const float wp = curve.widths[a];
  const float wq = curve.widths[b % curve.points.size()];
  const Vec2f along = q - p;
  const float size2 = dot(along, along);
  if (size2 > kMaxSegment * kMaxSegment || size2 <= 0) return false;
  for (std::size_t k = a + 1; k < b; ++k) {
    const Vec2f to = curve.points[k] - p;
    const float t = dot(to, along) / size2;
    if (t < 0 || t > 1) return false;
    const Vec2f off = to - along * t;
    if (dot(off, off) > tolerance * tolerance) return false;
    const float width = wp + (wq - wp) * t;
    if (std::abs(width - curve.widths[k]) > tolerance) return false;
    if (width > curve.limits[k] + kSpill ||
        width + 2 * length(off) > std::max(curve.limits[k], curve.widths[k]) + kSpill)
      return false;
  }
  return true;
}

// Greedy: from each kept point as far as one bead can stand for. `keep` forces points to stay.
std::vector<std::size_t> keptPoints(const Curve& curve, float tolerance, const std::vector<char>& keep,
                                    const RunContext& run) {
  const std::size_t n = curve.points.size();
  std::vector<std::size_t> kept;
  for (std::size_t at = 0; at < n;) {
    if (kept.size() % 1024 == 0 && run.cancelled()) break;
    kept.push_back(at);
    std::size_t next = at + 1;
    while (next < n && !keep[next] && next - at < kMaxSkipped && standsFor(curve, at, next + 1, tolerance)) ++next;
    at = next;
  }
  return kept;
}

// Removes points that coincide after rounding.
Curve roundedCurve(const ClosedCurves& curves, const BeadWidths& widths, int c) {
  Curve out;
  for (int k = curves.begin[static_cast<std::size_t>(c)]; k < curves.begin[static_cast<std::size_t>(c) + 1]; ++k) {
    const std::size_t i = static_cast<std::size_t>(k);
    const Vec2f p{rounded(curves.points[i].x), rounded(curves.points[i].y)};
    if (!out.points.empty() && out.points.back() == p) continue;
    out.points.push_back(p);
    out.widths.push_back(
        std::max(0.001f, widths.width[i] < widths.limit[i] ? rounded(widths.width[i]) : floored(widths.width[i])));
    out.limits.push_back(widths.limit[i]);
  }
  while (out.points.size() > 1 && out.points.front() == out.points.back()) {
    out.points.pop_back();
    out.widths.pop_back();
    out.limits.pop_back();
  }
  return out;
}

}  // namespace

Result<Toolpath> finishToolpath(const ClosedCurves& curves, const BeadWidths& widths, const ToolpathParams& params,
                                const RunContext& run) {
  const float tolerance = static_cast<float>(params.simplifyTolerance);
  std::vector<Curve> full;
  std::vector<std::vector<char>> keep;
  for (int c = 0; c < curves.count(); ++c) {
    full.push_back(roundedCurve(curves, widths, c));
    keep.emplace_back(full.back().points.size(), char{0});
  }
  constexpr int kAttempts = 6;
  for (int attempt = 0;; ++attempt) {
    ClosedCurves path;
    std::vector<std::vector<std::size_t>> kept(full.size());
    parallelFor(run, static_cast<int>(full.size()), 1, [&](int begin, int end) {
      for (int c = begin; c < end; ++c) {
        const std::size_t i = static_cast<std::size_t>(c);
        kept[i] = keptPoints(full[i], attempt < kAttempts ? tolerance : 0.0f, keep[i], run);
      }
    });
    if (run.cancelled()) return Error{ErrorCode::Cancelled, "the run was cancelled"};
    std::vector<std::pair<std::size_t, std::size_t>> source;  // curve and point of each point kept
    for (std::size_t c = 0; c < full.size(); ++c) {
      path.begin.push_back(static_cast<int>(path.points.size()));
      for (const std::size_t k : kept[c]) {
        path.points.push_back(full[c].points[k]);
        source.emplace_back(c, k);
      }
    }
    path.begin.push_back(static_cast<int>(path.points.size()));
    const auto crossings = findCrossings(path, run);
    if (crossings.empty() || attempt == kAttempts) {
      Toolpath toolpath;
      toolpath.spacing = params.spacing;
      for (std::size_t c = 0; c < full.size(); ++c) {
        if (kept[c].size() < 3) continue;
        Cycle cycle;
        for (const std::size_t k : kept[c]) {
          cycle.points.push_back(full[c].points[k]);
          cycle.widths.push_back(full[c].widths[k]);
        }
        toolpath.cycles.push_back(std::move(cycle));
      }
      return toolpath;
    }
    for (const auto& [a, b] : crossings) {
      for (const int segment : {a, b}) {
        const auto [c, k] = source[static_cast<std::size_t>(segment)];
        const std::size_t n = full[c].points.size();
        for (std::size_t step = 0; step <= kMaxSkipped + 8; ++step) keep[c][(k + step) % n] = 1;
        for (std::size_t step = 1; step <= 8; ++step) keep[c][(k + n - step % n) % n] = 1;
      }
    }
  }
}

}  // namespace sillon
