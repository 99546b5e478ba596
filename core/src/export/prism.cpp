#include "export/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/numbers.hpp"
#include "base/refused.hpp"
#include "export/zones.hpp"
#include "geometry/outline.hpp"
#include "sillon/export/export.hpp"

namespace sillon {
namespace {

struct PrismEdge {
  PrismPoint a;
  PrismPoint b;
};

bool less(PrismPoint a, PrismPoint b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

// Tells whether direction b comes before direction c when turning left, counter-clockwise, from a.
bool comesBefore(PrismPoint a, PrismPoint b, PrismPoint c) {
  const auto half = [&](PrismPoint d) { return cross(a, d) > 0 || (cross(a, d) == 0 && dot(a, d) > 0) ? 0 : 1; };
  return half(b) != half(c) ? half(b) < half(c) : cross(b, c) > 0;
}

// Rounds the segments of an outline to µm and sorts them by their starts.
std::vector<PrismEdge> edgesOf(const Outline& outline, PrismPoint offset) {
  const auto exact = [&](Vec2 p) { return PrismPoint{std::llround(p.x * 1000), std::llround(p.y * 1000)} + offset; };
  std::vector<PrismEdge> edges;
  for (const BorderSegment& piece : outline.segments) edges.push_back({exact(piece.a), exact(piece.b)});
  std::sort(edges.begin(), edges.end(),
            [](const PrismEdge& e, const PrismEdge& f) { return e.a != f.a ? less(e.a, f.a) : less(e.b, f.b); });
  return edges;
}

// Joins edges into rings with the inside on their left; as many edges must leave each point as reach it. Where several
// meet in a point, a ring goes on with the edge that bounds the same corner of the inside, so that holes that touch
// become one ring.
PrismRings ringsOf(const std::vector<PrismEdge>& edges, std::vector<PrismPoint>& points) {
  PrismRings rings;
  std::vector<char> used(edges.size(), 0);
  const auto from = [&](PrismPoint p) {
    const auto at =
        std::lower_bound(edges.begin(), edges.end(), p, [](const PrismEdge& e, PrismPoint q) { return less(e.a, q); });
    return at - edges.begin();
  };
  for (std::size_t first = 0; first < edges.size(); ++first) {
    if (used[first]) continue;
    std::vector<std::uint32_t> ring;
    std::size_t edge = first;
    do {
      used[edge] = 1;
      ring.push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back(edges[edge].a);
      const PrismPoint here = edges[edge].b;
      const PrismPoint back = edges[edge].a - here;
      std::size_t next = edges.size();
      for (std::size_t k = from(here); k < edges.size() && edges[k].a == here; ++k) {
        if (used[k] && k != first) continue;
        // The inside lies to the right of the way back, so the last direction when turning left bounds it.
        if (next == edges.size() || comesBefore(back, edges[next].b - here, edges[k].b - here)) next = k;
      }
      edge = next;
    } while (edge != first && edge != edges.size());
    if (edge == first && ring.size() >= 3) rings.push_back(std::move(ring));
  }
  return rings;
}

// Adds the triangles of the top, the same reversed at the bottom, and walls along the rings.
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

Result<FlatBody> flatBody(const Shape& shape, PrismPoint offset) {
  const Result<Outline> outline = outlineOnGrid(shape);
  if (!outline) return outline.error();
  FlatBody flat;
  const PrismRings rings = ringsOf(edgesOf(outline.value(), offset), flat.points);
  Triangulation cut = triangulate(flat.points, rings);
  // The areas are summed without sign; otherwise reversed triangles would cancel the surplus of others.
  double area = 0;
  for (const Triangle& t : cut.triangles) {
    const PrismPoint a = flat.points[t[0]];
    area += std::abs(static_cast<double>(cross(flat.points[t[1]] - a, flat.points[t[2]] - a))) / 2e6;
  }
  if (!cut.complete || std::abs(area - outline.value().area) > 1e-9 * (1 + outline.value().area)) {
    return refused(ErrorCode::TooLarge, "Entangled", {{"points", flat.points.size()}});
  }
  flat.triangulation = std::move(cut);
  return flat;
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

Result<Mesh> prismOf(const Shape& shape, double height) {
  constexpr double kLeast = 0.05;  // [mm], least height
  constexpr double kMost = 5000;   // [mm], greatest height
  if (!(height >= kLeast && height <= kMost)) return outOfRange("height", height, kLeast, kMost, "mm");
  const Result<FlatBody> flat = flatBody(shape, {});
  if (!flat) return flat.error();
  Mesh mesh;
  addPrism(flat.value().triangulation, flat.value().points, {}, 0, height, mesh);
  return mesh;
}

}  // namespace sillon
