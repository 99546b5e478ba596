#include "sillon/base_body.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "gcode_checks.hpp"
#include "gcode_job.hpp"
#include "sillon/outline.hpp"
#include "sort_key.hpp"
#include "stored_zip.hpp"
#include "text.hpp"
#include "triangulate.hpp"
#include "turned.hpp"

namespace sillon {
namespace {

using Rings = std::vector<std::vector<std::uint32_t>>;

struct Edge {
  PointUm a;
  PointUm b;
};

bool less(PointUm a, PointUm b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

// Whether direction b comes before direction c when a is turned to the left, starting from a itself.
bool comesBefore(PointUm a, PointUm b, PointUm c) {
  const auto half = [&](PointUm d) { return cross(a, d) > 0 || (cross(a, d) == 0 && dot(a, d) > 0) ? 0 : 1; };
  return half(b) != half(c) ? half(b) < half(c) : cross(b, c) > 0;
}

// Border pieces on the grid of the file. What lies on each other in opposite directions there bounds nothing.
std::vector<Edge> edgesOf(const Outline& outline, PointUm offset) {
  const auto rounded = [&](Vec2 p) { return PointUm{std::llround(p.x * 1000), std::llround(p.y * 1000)} + offset; };
  const auto key = [](PointUm a, PointUm b, bool back) { return SortKey{{a.x, a.y, b.x, b.y}, back ? 1U : 0U}; };
  std::vector<SortKey> pieces;  // all the same way, and whether that is back
  for (const BorderSegment& piece : outline.segments) {
    const PointUm a = rounded(piece.a);
    const PointUm b = rounded(piece.b);
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
Rings ringsOf(const std::vector<Edge>& edges, std::vector<PointUm>& points) {
  Rings rings;
  std::vector<char> used(edges.size(), 0);
  const auto from = [&](PointUm p) {
    const auto at =
        std::lower_bound(edges.begin(), edges.end(), p, [](const Edge& e, PointUm q) { return less(e.a, q); });
    return static_cast<std::size_t>(at - edges.begin());
  };
  for (std::size_t first = 0; first < edges.size(); ++first) {
    if (used[first]) continue;
    std::vector<PointUm> ring;
    std::size_t edge = first;
    for (;;) {
      used[edge] = 1;
      ring.push_back(edges[edge].a);
      const PointUm here = edges[edge].b;
      if (here == edges[first].a) break;
      const PointUm back = edges[edge].a - here;
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
    for (const PointUm p : ring) {
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

std::array<double, 3> normal(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const auto& p = mesh.points[triangle[0]];
  std::array<double, 3> u{};
  std::array<double, 3> v{};
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = mesh.points[triangle[1]][k] - p[k];
    v[k] = mesh.points[triangle[2]][k] - p[k];
  }
  std::array<double, 3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (double& value : n) value = size > 0 ? value / size : 0;
  return n;
}

}  // namespace

Result<Mesh> baseBody(const Shape& given, const Printer& printer, const PrintParams& params) {
  if (auto error = checkPlateInput(given, printer, params)) return *error;
  if (params.base == 0) {
    return Error{ErrorCode::InvalidArgument, "base is 0; it must be at least 1 for a body of the base layers"};
  }
  PrintParams turning = params;
  if (params.showSide == ShowSide::Bed) turning.mirror = !params.mirror;
  const Turn turn(turning, given.page);
  const Shape& shape = turn.none() ? given : turn.apply(given);
  const Bounds box = sillon::bounds(shape);
  if (box.empty()) return Error{ErrorCode::EmptyShape, "the shape has no points; there is nothing to print"};
  const Result<Outline> outline = resolveOutline(shape);
  if (!outline) return outline.error();

  std::vector<PointUm> points;
  const Rings rings = ringsOf(edgesOf(outline.value(), placement(box, printer, params)), points);
  const Triangulation flat = triangulate(points, rings);
  if (!flat.complete) {
    return Error{ErrorCode::TooLarge, "the outline has " + std::to_string(points.size()) +
                                          " points, too entangled to cut into triangles; it must be simpler"};
  }
  if (flat.triangles.empty()) {
    return Error{ErrorCode::EmptyShape, "the shape has no area at 0.001 mm; there is no body of it"};
  }
  // Rings that did not close, or cross by more than rounding, would make another body than the shape's.
  double area = 0;
  for (const Triangle& t : flat.triangles) {
    area += static_cast<double>(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]])) / 2e6;
  }
  double border = 0;
  for (const BorderSegment& piece : outline.value().segments) border += length(piece.b - piece.a);
  if (std::abs(area - outline.value().area) > 0.001 * border + 1e-6) {
    return Error{ErrorCode::InvalidFile, "the outline does not close at 0.001 mm; there is no body of it"};
  }
  const int below = params.showSide == ShowSide::Up ? 0 : params.layers;  // oriented layers on the bed
  const double bottom = below == 0 ? params.startHeight : layerTop(params, below - 1);
  const double top = layerTop(params, below + params.base - 1);
  Mesh mesh;
  const auto count = static_cast<std::uint32_t>(points.size());
  for (const PointUm copy : copyPlaces(box, printer, params)) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const double z : {bottom, top}) {
      for (const PointUm p : points) {
        mesh.points.push_back({static_cast<double>((p + copy).x) / 1000, static_cast<double>((p + copy).y) / 1000, z});
      }
    }
    extrude(flat, count, first, mesh);
  }
  return mesh;
}

std::string writeStl(const Mesh& mesh) {
  std::string out = "base body by Sillon, mm";  // must not begin with "solid", the other kind's first word
  out.resize(80, ' ');
  append(out, mesh.triangles.size(), 4);
  const auto number = [&](double value) {
    const auto narrow = static_cast<float>(value);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &narrow, sizeof bits);
    append(out, bits, 4);
  };
  for (const auto& triangle : mesh.triangles) {
    for (const double value : normal(mesh, triangle)) number(value);
    for (const std::uint32_t k : triangle) {
      for (const double value : mesh.points[k]) number(value);
    }
    append(out, 0, 2);
  }
  return out;
}

std::string write3mf(const Mesh& mesh) {
  std::string model =
      std::string(kXml) +
      "<model unit=\"millimeter\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
      " <metadata name=\"Application\">Sillon</metadata>\n"
      " <resources>\n  <object id=\"1\" type=\"model\">\n   <mesh>\n    <vertices>\n";
  for (const auto& p : mesh.points) {
    model +=
        "     <vertex x=\"" + decimal(p[0], 3) + "\" y=\"" + decimal(p[1], 3) + "\" z=\"" + decimal(p[2], 6) + "\"/>\n";
  }
  model += "    </vertices>\n    <triangles>\n";
  for (const auto& t : mesh.triangles) {
    model += "     <triangle v1=\"" + std::to_string(t[0]) + "\" v2=\"" + std::to_string(t[1]) + "\" v3=\"" +
             std::to_string(t[2]) + "\"/>\n";
  }
  model +=
      "    </triangles>\n   </mesh>\n  </object>\n </resources>\n <build>\n  <item objectid=\"1\"/>\n </build>\n"
      "</model>\n";
  Zip zip;
  addPackageParts(zip);
  zip.add("3D/3dmodel.model", model);
  return zip.finish();
}

}  // namespace sillon
