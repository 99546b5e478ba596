#include "sillon/export/export.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

#include "base/refused.hpp"
#include "export/mesh.hpp"
#include "export/zip.hpp"
#include "gcode/job.hpp"
#include "gcode/layout.hpp"

namespace sillon {
namespace {

// Unit normal of a triangle; 0 if it has no area.
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
  if (params.base == 0) return refusedArgument("NoBase");
  PrintParams turning = params;
  if (params.showSide == ShowSide::Bed) turning.mirror = !params.mirror;
  const PlateTransform turn(turning, given.page);
  const Shape& shape = turn.none() ? given : turn.apply(given);
  const Bounds box = sillon::bounds(shape);
  if (box.empty()) return refused(ErrorCode::EmptyShape, "NoArea");
  const Result<FlatBody> flat = flatBody(shape, placement(box, printer, params));
  if (!flat) return flat.error();
  const int below = params.showSide == ShowSide::Up ? 0 : params.layers;  // number of oriented layers on the bed
  const double bottom = below == 0 ? params.startHeight : layerTop(params, below - 1);
  const double top = layerTop(params, below + params.base - 1);
  Mesh mesh;
  for (const PointUm copy : copyPlaces(box, printer, params)) {
    addPrism(flat.value().triangulation, flat.value().points, copy, bottom, top, mesh);
  }
  return mesh;
}

std::optional<Error> meshDefect(const Mesh& mesh) {
  const auto isFinite = [](double value) { return std::isfinite(value); };
  const bool finite = std::all_of(mesh.points.begin(), mesh.points.end(),
                                  [&](const auto& point) { return std::all_of(point.begin(), point.end(), isFinite); });
  const bool whole = std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
    return *std::max_element(triangle.begin(), triangle.end()) < mesh.points.size();
  });
  if (finite && whole) return std::nullopt;
  return refusedArgument("BrokenMesh");
}

Result<std::string> writeStl(const Mesh& mesh) {
  if (auto defect = meshDefect(mesh)) return *std::move(defect);
  std::string out = "base body by Sillon, mm";  // must not begin with "solid", the first word of a text STL
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

Result<std::string> write3mf(const Mesh& mesh) {
  if (auto defect = meshDefect(mesh)) return *std::move(defect);
  Zip zip;
  addPackageParts(zip);
  zip.add("3D/3dmodel.model",
          std::string(kXml) +
              "<model unit=\"millimeter\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
              " <metadata name=\"Application\">Sillon</metadata>\n" +
              resourcesOf(mesh) + " <build>\n  <item objectid=\"1\"/>\n </build>\n</model>\n");
  return zip.finish();
}

}  // namespace sillon
