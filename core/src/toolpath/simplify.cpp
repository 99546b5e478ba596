#include "toolpath/path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "base/parallel_for.hpp"
#include "geometry/closed_curves.hpp"

namespace sillon {
namespace {

constexpr float kMaxSegment = 2;      ///< longest segment [mm], so that widths and speeds can follow
constexpr float kSpill = 0.0005f;     ///< width that may spill, from rounding: half a µm on either side [mm]
constexpr int kMaxSkipped = 64;       ///< most points left out in a row, which bounds the work
constexpr std::size_t kPiece = 8192;  ///< points of a curve that are walked in one go

// Whole micrometres: down for widths that the border limits, to the nearest for all others.
float floored(float v) { return static_cast<float>(std::floor(static_cast<double>(v) * 1000) / 1000); }
float rounded(float v) {
  return static_cast<float>(static_cast<double>(std::llround(static_cast<double>(v) * 1000)) / 1000);
}

// A closed curve after rounding.
struct Curve {
  std::vector<Vec2f> points;
  std::vector<float> widths;
  std::vector<float> limits;  ///< widths above these would spill
};

// Tells whether the straight bead from `a` to `b` stands for all points between them: none is farther from it than the
// tolerance, its width there differs by no more, and it spills nowhere.
bool standsFor(const Curve& curve, std::size_t a, std::size_t b, float tolerance) {
  const Vec2f p = curve.points[a];
  const Vec2f q = curve.points[b % curve.points.size()];
  const float wp = curve.widths[a];
  const float wq = curve.widths[b % curve.points.size()];
  const Vec2f along = q - p;
  const float size2 = dot(along, along);
  // A point beyond either end, or too far from the line, forbids the straight bead.
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

// Finds the next point to keep after `at`, as far away as one bead can stand for (greedy). Points marked in `keep`
// stay.
std::size_t keptAfter(const Curve& curve, std::size_t at, float tolerance, const std::vector<char>& keep) {
  std::size_t next = at + 1;
  while (next < curve.points.size() && !keep[next] && next - at < kMaxSkipped &&
         standsFor(curve, at, next + 1, tolerance))
    ++next;
  return next;
}

// Finds the points of each curve that are kept, from the first on. The points kept after one depend on nothing before
// it. So pieces of a curve are walked at the same time, and the walk that comes from the piece before goes on until it
// meets a point of the next piece's walk, mostly within a few points; from there on both are the same.
std::vector<std::vector<std::size_t>> keptPoints(const std::vector<Curve>& curves, float tolerance,
                                                 const std::vector<std::vector<char>>& keep, const RunContext& run) {
  struct CurvePiece {
    std::size_t curve;
    std::size_t begin;
    std::size_t end;
    std::vector<std::size_t> walk;
  };
  // Each piece is walked as if its first point were kept.
  std::vector<CurvePiece> pieces;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    for (std::size_t begin = 0; begin < curves[c].points.size(); begin += kPiece)
      pieces.push_back({c, begin, std::min(begin + kPiece, curves[c].points.size()), {}});
  }
  parallelForEach(run, static_cast<int>(pieces.size()), 1, [&](int k) {
    CurvePiece& piece = pieces[k];
    for (std::size_t at = piece.begin; at < piece.end;
         at = keptAfter(curves[piece.curve], at, tolerance, keep[piece.curve]))
      piece.walk.push_back(at);
  });
  // Put the walks together: go on from the piece before, one point at a time, until its walk and this piece's meet.
  std::vector<std::vector<std::size_t>> kept(curves.size());
  if (run.cancelled()) return kept;
  std::size_t at = 0;
  for (const CurvePiece& piece : pieces) {
    std::vector<std::size_t>& all = kept[piece.curve];
    if (piece.begin == 0) at = 0;
    auto own = piece.walk.begin();
    while (at < piece.end) {
      own = std::lower_bound(own, piece.walk.end(), at);
      if (own != piece.walk.end() && *own == at) {
        all.insert(all.end(), own, piece.walk.end());
        at = piece.walk.back();
      } else {
        all.push_back(at);
      }
      at = keptAfter(curves[piece.curve], at, tolerance, keep[piece.curve]);
    }
  }
  // A cycle that is smaller than the tolerance stays as it is, as it would vanish.
  for (std::size_t c = 0; c < curves.size(); ++c) {
    if (kept[c].size() >= 3) continue;
    kept[c].resize(curves[c].points.size());
    std::iota(kept[c].begin(), kept[c].end(), std::size_t{0});
  }
  return kept;
}

// Rounds a curve to whole micrometres, and removes points that coincide then.
Curve roundedCurve(const ClosedCurves& curves, const BeadWidths& widths, int c) {
  Curve out;
  for (int k = curves.begin[c]; k < curves.begin[c + 1]; ++k) {
    const std::size_t i = k;
    const Vec2f p{rounded(curves.points[i].x), rounded(curves.points[i].y)};
    if (!out.points.empty() && out.points.back() == p) continue;
    out.points.push_back(p);
    out.widths.push_back(
        std::max(0.001f, widths.width[i] < widths.limit[i] ? rounded(widths.width[i]) : floored(widths.width[i])));
    out.limits.push_back(widths.limit[i]);
  }
  // The last points may coincide with the first.
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
  // Round before simplifying, so that all checks see what is written.
  std::vector<Curve> full;
  std::vector<std::vector<char>> keep;
  for (int c = 0; c < curves.count(); ++c) {
    full.push_back(roundedCurve(curves, widths, c));
    keep.emplace_back(full.back().points.size(), char{0});
  }
  // Simplify, look for crossings, and keep all points around them in the next attempt. The last attempt has no
  // tolerance.
  constexpr int kAttempts = 6;
  for (int attempt = 0;; ++attempt) {
    ClosedCurves path;
    const std::vector<std::vector<std::size_t>> kept =
        keptPoints(full, attempt < kAttempts ? tolerance : 0.0f, keep, run);
    if (run.cancelled()) return cancelledRun();
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
    if (run.cancelled()) return cancelledRun();  // some crossings may not have been found
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
    // Keep the points that the crossing segments stood for, and eight more on either side.
    for (const auto& [a, b] : crossings) {
      for (const int segment : {a, b}) {
        const auto [c, k] = source[segment];
        const std::size_t n = full[c].points.size();
        for (std::size_t step = 0; step <= kMaxSkipped + 8; ++step) keep[c][(k + step) % n] = 1;
        for (std::size_t step = 1; step <= 8; ++step) keep[c][(k + n - step % n) % n] = 1;
      }
    }
  }
}

}  // namespace sillon
