// Turns the beads of plates with pictures towards the lines that their layers ask for.
#include "toolpath/relaxation_steps.hpp"

#include <cmath>
#include <cstddef>

#include "base/parallel_for.hpp"
#include "field/hierarchy.hpp"

namespace sillon {
namespace {

/// Cosine of 37 degrees; segments that run further off the line asked for are not turned.
constexpr float kAlike = 0.8f;
/// Largest move of a point [spacings]; two beads that move towards each other cannot cross.
constexpr float kMostMove = 0.5f;

/// Returns the direction asked for the bead at p, interpolated between the four cells around it; (0, 0) if they have
/// no line or disagree.
Vec2f beadAt(const LineField& lines, Vec2f p) {
  const Grid& grid = lines.grid;
  const double u = (static_cast<double>(p.x) - grid.origin.x) / grid.cell - 0.5;
  const double v = (static_cast<double>(p.y) - grid.origin.y) / grid.cell - 0.5;
  const int x0 = static_cast<int>(std::floor(u));
  const int y0 = static_cast<int>(std::floor(v));
  const float right = static_cast<float>(u - x0);
  const float up = static_cast<float>(v - y0);
  // Interpolate lines as z = e^{2i angle}: d and -d are the same line, and must not cancel out.
  Vec2f z{};
  for (int k = 0; k < 4; ++k) {
    const int x = x0 + k % 2;
    const int y = y0 + k / 2;
    if (x < 0 || y < 0 || x >= grid.nx || y >= grid.ny) continue;
    const Vec2f d = lines.direction[grid.index(x, y)];
    if (d == Vec2f{}) continue;
    z = z + lineOf(d) * ((k % 2 == 1 ? right : 1 - right) * (k / 2 == 1 ? up : 1 - up));
  }
  const float size = length(z);
  // A short mean shows that the cells disagree or have no line.
  if (size < 0.5f) return {};
  const Vec2f d = directionOf(z * (1 / size));
  return {-d.y, d.x};  // fields hold the direction across the bead
}

}  // namespace

// Solves a least-squares problem along each curve. It minimises the squared differences between segments and equally
// long ones on the lines asked for, plus `pull` times the squared moves; see docs/internals/pictures.md.
std::vector<Vec2f> movesToLines(const ClosedCurves& curves, const LineField& lines, double spacing, float pull,
                                const RunContext& run) {
  std::vector<Vec2f> moves(curves.points.size());
  std::vector<Vec2f> excess;  // segment asked for minus the segment from point k to the next
  std::vector<char> turned;   // 1 if the segment is to be turned
  std::vector<float> share;   // share of the next point's move in that of point k
  for (int c = 0; c < curves.count(); ++c) {
    const std::size_t first = curves.begin[c];
    const std::size_t n = curves.size(c);
    excess.assign(n, {});
    turned.assign(n, 0);
    share.assign(n, 0);
    parallelForEach(run, static_cast<int>(n), 8192, [&](std::size_t k) {
      const Vec2f a = curves.points[first + k];
      const Vec2f b = curves.points[first + (k + 1) % n];
      const Vec2f step = b - a;
      const Vec2f bead = beadAt(lines, (a + b) * 0.5f);
      const float size = length(step);
      const float along = dot(bead, step);
      if (!(size > 0) || std::abs(along) < kAlike * size) return;
      excess[k] = bead * (along < 0 ? -size : size) - step;
      turned[k] = 1;
    });
    // A symmetric tridiagonal system for each run of points between turned segments, solved by the Thomas algorithm:
    // eliminated forwards, solved backwards. The first point stays, so that a closed curve needs no other treatment.
    for (std::size_t k = 1; k < n; ++k) {
      if (!turned[k - 1] || !turned[k]) continue;  // the point stays: share and move are 0
      const float inverse = 1 / (2 + pull - share[k - 1]);
      share[k] = inverse;
      moves[first + k] = (excess[k - 1] - excess[k] + moves[first + k - 1]) * inverse;
    }
    for (std::size_t k = n - 1; k-- > 1;) moves[first + k] = moves[first + k] + moves[first + k + 1] * share[k];
  }
  const float most = kMostMove * static_cast<float>(spacing);
  for (Vec2f& move : moves) {
    const float size = length(move);
    if (size > most) move = move * (most / size);
  }
  return moves;
}

}  // namespace sillon
