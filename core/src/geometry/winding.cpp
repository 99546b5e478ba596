#include "geometry/outline_steps.hpp"

namespace sillon {

std::vector<PathEdge> edgesOf(const std::vector<FilledPath>& paths, const std::vector<char>& without) {
  std::vector<PathEdge> edges;
  for (std::size_t path = 0; path < paths.size(); ++path) {
    if (!without.empty() && without[path] != 0) continue;
    for (const Ring& ring : paths[path].rings) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vec2 a = ring[k];
        const Vec2 b = ring[k + 1 < ring.size() ? k + 1 : 0];
        if (!(a == b)) edges.push_back({a, b, static_cast<int>(path)});
      }
    }
  }
  return edges;
}

}  // namespace sillon
