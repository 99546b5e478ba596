#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "base/refused.hpp"
#include "export/packing.hpp"
#include "export/zones.hpp"
#include "sillon/export/export.hpp"

namespace sillon {
namespace {

constexpr std::size_t kHeader = 84;
constexpr std::size_t kFacet = 50;
constexpr std::size_t kMostFacets = 10'000'000;
constexpr double kLargest = 10000;  // [mm], largest coordinate

using Corner = std::array<double, 3>;

// Reads the corners of a binary STL.
Result<std::vector<Corner>> cornersOfBytes(std::string_view bytes, std::size_t facets) {
  std::vector<Corner> corners;
  corners.reserve(3 * facets);
  for (std::size_t facet = 0; facet < facets; ++facet) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Corner& p = corners.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto bits =
            static_cast<std::uint32_t>(number(bytes, kHeader + facet * kFacet + 12 * (corner + 1) + 4 * axis, 4));
        float value = 0;
        std::memcpy(&value, &bits, sizeof value);
        p[axis] = static_cast<double>(value);
      }
    }
  }
  return corners;
}

// Reads the corners of a text STL.
Result<std::vector<Corner>> cornersOfText(std::string_view text) {
  constexpr std::string_view kVertex = "vertex";
  std::vector<Corner> corners;
  for (std::size_t at = text.find(kVertex); at != std::string_view::npos; at = text.find(kVertex, at)) {
    const std::size_t before = text.find_last_not_of(" \t", at - 1);
    at += kVertex.size();
    if (before != std::string_view::npos && text[before] != '\n' && text[before] != '\r') continue;  // in a name
    Corner& p = corners.emplace_back();
    for (double& value : p) {
      while (at < text.size() && (text[at] == ' ' || text[at] == '\t' || text[at] == '+')) ++at;
      const auto read = fast_float::from_chars(text.data() + at, text.data() + text.size(), value);
      if (read.ec != std::errc{}) return refusedFile("StlCorner");
      at = toSize(read.ptr - text.data());
    }
    if (corners.size() > 3 * kMostFacets) return corners;
  }
  if (text.rfind("endsolid") == std::string_view::npos) return refusedFile("StlCutOff");
  return corners;
}

}  // namespace

Result<Mesh> readStl(std::string_view bytes) {
  const std::size_t facets = bytes.size() >= kHeader ? toSize(number(bytes, 80, 4)) : 0;
  const bool binary = bytes.size() >= kHeader && facets <= kMostFacets && bytes.size() == kHeader + kFacet * facets;
  const std::string_view text = bytes.substr(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  if (!binary && !text.starts_with("solid")) return refusedFile("StlCutOff");
  const Result<std::vector<Corner>> read = binary ? cornersOfBytes(bytes, facets) : cornersOfText(text);
  if (!read) return read.error();
  const std::vector<Corner>& corners = read.value();
  if (corners.size() > 3 * kMostFacets) return refused(ErrorCode::TooLarge, "StlTooLarge");
  if (corners.empty() || corners.size() % 3 != 0) return refusedFile("StlCutOff");

  // Corners at the same place, to 1 µm, become one point.
  std::vector<std::pair<std::array<std::int64_t, 3>, std::size_t>> keys;
  keys.reserve(corners.size());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    for (const double value : corners[k]) {
      if (!(std::abs(value) <= kLargest)) return refusedFile("StlTooFar");
    }
    const auto micrometres = [&](std::size_t axis) { return std::llround(1000 * corners[k][axis]); };
    keys.push_back({{micrometres(0), micrometres(1), micrometres(2)}, k});
  }
  std::sort(keys.begin(), keys.end());
  Mesh mesh;
  std::vector<std::uint32_t> pointOf(corners.size());
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (k == 0 || keys[k].first != keys[k - 1].first) {
      const auto& [x, y, z] = keys[k].first;
      mesh.points.push_back(
          {static_cast<double>(x) / 1000, static_cast<double>(y) / 1000, static_cast<double>(z) / 1000});
    }
    pointOf[keys[k].second] = static_cast<std::uint32_t>(mesh.points.size() - 1);
  }
  for (std::size_t k = 0; k < corners.size(); k += 3) {
    const std::array<std::uint32_t, 3> triangle{pointOf[k], pointOf[k + 1], pointOf[k + 2]};
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
    mesh.triangles.push_back(triangle);
  }
  if (mesh.triangles.empty()) return refusedFile("NoTriangles");
  return mesh;
}

std::size_t openEdges(const Mesh& mesh) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = triangle[k];
      const std::uint64_t b = triangle[(k + 1) % 3];
      edges.push_back(std::min(a, b) << 32 | std::max(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  std::size_t open = 0;
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin;
    while (end < edges.size() && edges[end] == edges[begin]) ++end;
    open += (end - begin) % 2;
    begin = end;
  }
  return open;
}

}  // namespace sillon
