#include "export/prism.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/sort_key.hpp"

namespace sillon {
namespace {

struct Edge {
  PrismPoint a;
  PrismPoint b;
};

bool less(PrismPoint a, PrismPoint b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

// Whether direction b comes before direction c when a is turned to the left, starting from a itself.
bool comesBefore(PrismPoint a, PrismPoint b, PrismPoint c) {
  const auto half = [&](PrismPoint d) { return cross(a, d) > 0 || (cross(a, d) == 0 && dot(a, d) > 0) ? 0 : 1; };
  return half(b) != half(c) ? half(b) < half(c) : cross(b, c) > 0;
}

// Border pieces on the grid of the file. What lies on each other in opposite directions there bounds nothing.
std::vector<Edge> edgesOf(const Outline& outline, PrismPoint offset) {
  const auto rounded = [&](Vec2 p) { return PrismPoint{std::llround(p.x * 1000), std::llround(p.y * 1000)} + offset; };
  const auto key = [](PrismPoint a, PrismPoint b, bool back) { return SortKey{{a.x, a.y, b.x, b.y}, back ? 1U : 0U}; };
  std::vector<SortKey> pieces;  // all the same way, and whether that is back
  for (const BorderSegment& piece : outline.segments) {
    const PrismPoint a = rounded(piece.a);
    const PrismPoint b = rounded(piece.b);
    if (a != b) pieces.push_back(less(a, b) ? key(a, b, false) : key(b, a, true));
  }
  std::sort(pieces.begin(), pieces.end());
  std::vector<SortKey> kept;
  for (std::size_t i = 0; i < pieces.size();) {
    const auto& [x0, y0, x1, y1] = pieces[i].first;
    int sum = 0;
    std::size_t k = i;
    for (; k < pieces.size() && pieces[k].first == pieces[i].first; ++k) sum += pieces[k].second == 0 ? 1 : -1;
    for (; sum > 0; --sum) kept.push_back(key({x0, y0}, {x1, y1}, false));
    for (; sum < 0; ++sum) kept.push_back(key({x1, y1}, {x0, y0}, false));
    i = k;
  }
  std::sort(kept.begin(), kept.end());
  std::vector<Edge> edges;
  for (const auto& [ends, back] : kept) edges.push_back({{ends[0], ends[1]}, {ends[2], ends[3]}});
  return edges;
}

// Rings of edges with the inside on the left. Where several meet in a point, each goes on with the edge that bounds the
// same corner of the inside. What does not come back is left out.
PrismRings ringsOf(const std::vector<Edge>& edges, std::vector<PrismPoint>& points) {
  PrismRings rings;
  std::vector<char> used(edges.size(), 0);
  const auto from = [&](PrismPoint p) {
    const auto at =
        std::lower_bound(edges.begin(), edges.end(), p, [](const Edge& e, PrismPoint q) { return less(e.a, q); });
    return static_cast<std::size_t>(at - edges.begin());
  };
  for (std::size_t first = 0; first < edges.size(); ++first) {
    if (used[first]) continue;
    std::vector<PrismPoint> ring;
    std::size_t edge = first;
    for (;;) {
      used[edge] = 1;
      ring.push_back(edges[edge].a);
      const PrismPoint here = edges[edge].b;
      if (here == edges[first].a) break;
      const PrismPoint back = edges[edge].a - here;
      std::size_t next = edges.size();
      for (std::size_t k = from(here); k < edges.size() && edges[k].a == here; ++k) {
        if (used[k]) continue;
        // The inside lies to the right of the way back: the last direction on the way round to the left bounds it.
        if (next == edges.size() || comesBefore(back, edges[next].b - here, edges[k].b - here)) next = k;
      }
      if (next == edges.size()) break;
      edge = next;
    }
    if (ring.size() < 3 || edges[edge].b != edges[first].a) continue;
    std::vector<std::uint32_t> indices;
    for (const PrismPoint p : ring) {
      indices.push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back(p);
    }
    rings.push_back(std::move(indices));
  }
  return rings;
}

// From the triangles of the top: the same below, and walls along the rings.
void extrude(const Triangulation& flat, std::uint32_t count, std::uint32_t first, Mesh& mesh) {
  const auto top = [&](std::uint32_t k) { return first + count + k; };
  const auto bottom = [&](std::uint32_t k) { return first + k; };
  for (const Triangle& t : flat.triangles) {
    mesh.triangles.push_back({top(t[0]), top(t[1]), top(t[2])});
    mesh.triangles.push_back({bottom(t[2]), bottom(t[1]), bottom(t[0])});
  }
  for (const std::vector<std::uint32_t>& ring : flat.rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::uint32_t a = ring[k];
      const std::uint32_t b = ring[k + 1 < ring.size() ? k + 1 : 0];
      mesh.triangles.push_back({bottom(a), bottom(b), top(b)});
      mesh.triangles.push_back({bottom(a), top(b), top(a)});
    }
  }
}

}  // namespace

PrismRings ringsOn(const Outline& outline, PrismPoint offset, std::vector<PrismPoint>& points) {
  return ringsOf(edgesOf(outline, offset), points);
}

void addPrism(const Triangulation& flat, const std::vector<PrismPoint>& points, PrismPoint offset, double bottom,
              double top, Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (const double z : {bottom, top}) {
    for (const PrismPoint p : points) {
      const PrismPoint place = p + offset;
      mesh.points.push_back({static_cast<double>(place.x) / 1000, static_cast<double>(place.y) / 1000, z});
    }
  }
  extrude(flat, static_cast<std::uint32_t>(points.size()), first, mesh);
}

}  // namespace sillon
