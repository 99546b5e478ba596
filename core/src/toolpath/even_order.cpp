#include "toolpath/even_order.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace sillon {
namespace {

constexpr double kBeforeSearch = 0.3;     ///< share of the stage that joining and switches take
constexpr std::size_t kLeastPath = 1000;  ///< points; shorter paths have no late neighbours

// Walks along the curves as joined and collects each closed path. Swapping the successors of a joint's two middle
// points joins the same curves as the joint itself does, but keeps the pieces that it took out: their points follow the
// joint's ends, so that each point has a place on some path.
std::vector<PathOrder> pathsOf(const Beads& beads, const Joining& joining) {
  const int count = static_cast<int>(beads.curves.points.size());
  // Each made joint is a switch that is on: swap the successors of its middles.
  std::vector<int> after;
  for (int p = 0; p < count; ++p) after.push_back(nextOf(beads.curves, joining.curveOf(p), p));
  for (const Joint& joint : joining.made()) std::swap(after[joint.i], after[joint.j]);
  // Follow the successors round from each point that no path holds yet.
  std::vector<char> seen(after.size(), 0);
  std::vector<PathOrder> paths;
  for (int p = 0; p < count; ++p) {
    if (seen[p] != 0) continue;
    paths.emplace_back();
    for (int q = p; seen[q] == 0; q = after[q]) {
      seen[q] = 1;
      paths.back().points.push_back(q);
    }
  }
  return paths;
}

// Gives each link and each switch to the path that holds both its points. Those between two paths are left out, as a
// move needs both cuts of a switch on one path.
void addNeighbours(const Beads& beads, double stitchAlignment, const Joining& joining, const RunContext& run,
                   std::vector<PathOrder>& paths) {
  // Look-up from a point to its path and its place there.
  std::vector<int> pathOf(beads.curves.points.size());
  std::vector<int> place(beads.curves.points.size());
  for (std::size_t t = 0; t < paths.size(); ++t) {
    for (std::size_t k = 0; k < paths[t].points.size(); ++k) {
      pathOf[paths[t].points[k]] = static_cast<int>(t);
      place[paths[t].points[k]] = static_cast<int>(k);
    }
  }
  // Links become pairs of places, from which a Tour reads delays.
  for (const Link& link : linksBeside(beads, joining, run)) {
    if (pathOf[link.a] == pathOf[link.b]) paths[pathOf[link.a]].links.push_back({place[link.a], place[link.b]});
  }
  // A switch cuts the path after the places of its two middles.
  for (const Switch& one : findSwitches(beads, stitchAlignment, joining, run)) {
    const auto [i, j] = std::pair{one.joint.i, one.joint.j};
    if (pathOf[i] != pathOf[j]) continue;
    paths[pathOf[i]].switches.push_back(one);
    paths[pathOf[i]].cuts.push_back({place[i], place[j]});
  }
}

// Makes the path begin at the border, where a begin hides, at the place from which neighbours are laid soonest after
// one another: the end of a sweep.
void chooseBegin(const Beads& beads, const PathOrder& path, const Tour& tour, Joining& joining) {
  const std::vector<double> lateness = tour.latenessOfBegins(path.links);
  std::vector<int> pointAt(path.points.size());
  for (int k = 0; k < static_cast<int>(path.points.size()); ++k) pointAt[tour.placeNow(k)] = path.points[k];
  // Candidates are points that are still on the path and at most one spacing from the border.
  double least = std::numeric_limits<double>::max();
  int begin = -1;
  for (std::size_t k = 0; k < pointAt.size(); ++k) {
    if (lateness[k] >= least || !joining.onPath(pointAt[k])) continue;
    const Vec2f p = joining.at(pointAt[k]);
    const Vec2 at{static_cast<double>(p.x), static_cast<double>(p.y)};
    if (std::abs(beads.border.nearest(at).distance) > beads.spacing) continue;
    least = lateness[k];
    begin = pointAt[k];
  }
  if (begin >= 0) joining.beginAt(begin);
}

}  // namespace

bool evenOrder(const Beads& beads, const ToolpathParams& params, Joining& joining, const RunContext& run) {
  std::vector<PathOrder> paths = pathsOf(beads, joining);
  addNeighbours(beads, params.stitchAlignment, joining, run, paths);
  // Paths are searched one after the other; each takes a share of the progress in proportion to its points.
  double begin = kBeforeSearch;
  for (PathOrder& path : paths) {
    if (run.cancelled()) return false;
    path.begin = begin;
    path.end = begin +=
        (1 - kBeforeSearch) * static_cast<double>(path.points.size()) / static_cast<double>(beads.curves.points.size());
    if (path.points.size() < kLeastPath) continue;
    const Tour tour = searchOrder(beads, params, path, joining, run);
    chooseBegin(beads, path, tour, joining);
  }
  return !run.cancelled();
}

}  // namespace sillon
