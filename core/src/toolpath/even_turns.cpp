#include <algorithm>
#include <array>

#include "toolpath/even_order.hpp"

namespace sillon {
namespace {

constexpr int kTurnReach = 16;  ///< points on either side of a joint's end, within which its turns end
constexpr int kMeans = 5;       ///< rounds of smoothing; after five, as many turns are left as on the relaxed path

// Resamples the line in place in equal steps, so that headings a fixed number of points apart are comparable.
void equalSteps(std::vector<Vec2f>& line, float step) {
  std::vector<Vec2f> out{line.front()};
  out.reserve(line.size() + line.size() / 4);
  float need = step;
  for (std::size_t k = 1; k < line.size(); ++k) {
    Vec2f from = line[k - 1];
    float left = length(line[k] - from);
    while (left >= need) {
      from = from + (line[k] - from) * (need / left);
      out.push_back(from);
      left -= need;
      need = step;
    }
    need -= left;
  }
  line.swap(out);
}

// One round of binomial smoothing (1, 2, 1) / 4; the two ends stay.
void meanOfNeighbours(std::vector<Vec2f>& line) {
  Vec2f last = line.front();
  for (std::size_t k = 1; k + 1 < line.size(); ++k) {
    const Vec2f here = line[k];
    line[k] = here * 0.5f + (last + line[k + 1]) * 0.25f;
    last = here;
  }
}

// Walks over the path around the four ends of two joints. Ends near to each other share one walk, so that no turn is
// counted twice.
class Surroundings {
 public:
  Surroundings(const Joining& joining, const Joint& a, const Joint& b) : joining_(joining) {
    const auto [a0, a1] = joining.beginsOf(a);
    const auto [b0, b1] = joining.beginsOf(b);
    const int beyondA = kTurnReach + (a.on ? 1 : a.span);
    const int beyondB = kTurnReach + (b.on ? 1 : b.span);
    ends_ = {{{a0, beyondA}, {a1, beyondA}, {b0, beyondB}, {b1, beyondB}}};
    // Two joints that exclude each other lie side by side: the one that is on has taken out ends of the other.
    for (std::size_t k = 0; k < ends_.size(); ++k) passed_[k] = !joining.onPath(ends_[k].point);
  }

  /// Fills `line` with the points around the next end that no walk has passed; empty after the last.
  void next(const Beads& beads, std::vector<Vec2f>& line) {
    line.clear();
    while (at_ < ends_.size() && passed_[at_]) ++at_;
    if (at_ == ends_.size()) return;
    // Walk forwards. Each further end on the way prolongs the walk beyond itself and is ticked off.
    int p = beginOfWalk(ends_[at_].point);
    const int from = p;
    int left = 2 * kTurnReach;
    do {
      for (std::size_t k = 0; k < ends_.size(); ++k) {
        if (ends_[k].point != p) continue;
        passed_[k] = true;
        left = std::max(left, ends_[k].beyond);
      }
      line.push_back(beads.curves.points[p]);
      p = joining_.after(p);
    } while (left-- > 0 && p != from);
  }

 private:
  struct End {
    int point;
    int beyond;  ///< points to walk after it
  };

  // Steps back from an end until no other end lies within kTurnReach points, so that the walk takes in all of them.
  [[nodiscard]] int beginOfWalk(int point) const {
    int p = point;
    for (int left = kTurnReach; left > 0; --left) {
      p = joining_.before(p);
      if (p == point) break;
      for (const End& end : ends_) left = end.point == p ? kTurnReach + 1 : left;
    }
    return p;
  }

  const Joining& joining_;
  std::array<End, 4> ends_;
  std::array<bool, 4> passed_{};
  std::size_t at_ = 0;
};

}  // namespace

int uTurnsOf(std::vector<Vec2f>& line, float spacing, std::vector<Vec2f>* places) {
  constexpr int kApart = 6;  // steps of tau/4 between the headings that are compared
  // Smooth the line as relaxation will. Smoothing shortens steps, so resample once more before headings are compared.
  if (line.empty()) return 0;
  equalSteps(line, 0.25f * spacing);
  for (int k = 0; k < kMeans; ++k) meanOfNeighbours(line);
  equalSteps(line, 0.25f * spacing);
  // The report's rule: a U-turn is a run of places at which the heading turns by at least 120 degrees (cosine -0.5)
  // over six steps of tau/4, or 1.5 tau. A run counts once.
  int turns = 0;
  bool before = false;
  for (std::size_t k = 0; k + kApart + 1 < line.size(); ++k) {
    // Compare two headings; only the first place of a run counts.
    const Vec2f u = line[k + 1] - line[k];
    const Vec2f v = line[k + kApart + 1] - line[k + kApart];
    const bool turning = dot(u, v) <= -0.5f * length(u) * length(v);
    if (turning && !before) {
      ++turns;
      if (places != nullptr) places->push_back(line[k + kApart / 2]);
    }
    before = turning;
  }
  return turns;
}

int uTurnsNear(const Beads& beads, const Joining& joining, const Joint& a, const Joint& b) {
  Surroundings surroundings(joining, a, b);
  std::vector<Vec2f> line;
  int turns = 0;
  for (surroundings.next(beads, line); !line.empty(); surroundings.next(beads, line))
    turns += uTurnsOf(line, beads.spacing);
  return turns;
}

}  // namespace sillon
