#include <algorithm>
#include <optional>
#include <utility>

#include "base/refused.hpp"
#include "compose/visible.hpp"
#include "export/zones.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/project/project.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {
namespace {

/// A body, and its top as the surface on which layers lie.
struct Topped {
  Mesh body;
  PlateInput ground;
  Vec2 corner;  ///< corner of the surface's page on the bed [mm]
};

/// Reads the body, or makes a prism of the shape; its surface is the face that is given, its silhouette or its shape.
Result<Topped> bodyOf(const Project& project, const ZonesRequest& request, const ReadInput& read,
                      const RunContext& run) {
  Topped out;
  std::optional<Shape> outline;
  if (request.body) {
    Result<Mesh> mesh = readStl(*request.body);
    if (!mesh) return mesh.error();
    out.body = std::move(mesh).value();
    if (request.face) {
      out.corner = request.face->corner;
    } else {
      Result<Shape> seen = silhouetteOf(out.body, out.corner);
      if (!seen) return seen.error();
      outline = std::move(seen).value();
    }
  }
  Result<PlateInput> ground =
      outline ? readPlateInput(project, *std::move(outline), read) : readPlateInput(project, read, run);
  if (!ground) return ground.error();
  out.ground = std::move(ground).value();
  if (request.body) return out;
  Result<Mesh> prism = prismOf(out.ground.shape, request.height);
  if (!prism) return prism.error();
  out.body = std::move(prism).value();
  out.corner = 0.5 * (project.printer.bedMin + project.printer.bedMax - out.ground.shape.page);
  for (auto& point : out.body.points) {
    point[0] += out.corner.x;
    point[1] += out.corner.y;
  }
  return out;
}

}  // namespace

Result<ZonesMade> makeZones(const Project& project, const ZonesRequest& request, const ReadInput& read,
                            const RunContext& run) {
  if (auto wrong = invalidSettings(project)) return *std::move(wrong);
  Result<Topped> topped = bodyOf(project, request, read, run);
  if (!topped) return topped.error();
  const auto composed = compose(project, std::move(topped.value().ground), {read}, run);
  if (!composed) return composed.error();
  const PlateInput laid = composed.value().laid();
  if (std::any_of(laid.modes.mode.begin(), laid.modes.mode.end(),
                  [](DirectionMode mode) { return mode != DirectionMode::Constrained; })) {
    return refusedArgument("ZonesConstrained");
  }
  Result<DirectionZones> zones = directionZones(laid.shape, laid.directions, request.params, run);
  if (!zones) return zones.error();
  Result<std::string> package = zones3mf(topped.value().body, zones.value(), topped.value().corner, request.layerHeight,
                                         request.body && request.face ? std::optional(request.face->z) : std::nullopt);
  if (!package) return package.error();

  ZonesMade made;
  made.package = std::move(package).value();
  made.zones = std::move(zones).value();
  made.openEdges = openEdges(topped.value().body);
  if (!request.body || request.face) {
    made.notes = inputNotes(project, laid.shape.drawing);
    made.warnings = drawingWarnings(laid.shape.drawing);
  }
  const auto& placed = composed.value().layers.placed;
  const LayersTold told =
      toldOf(placed, seeLayers(project, placed, composed.value()), laid.shape.page, project.toolpath.spacing);
  made.notes.insert(made.notes.end(), told.notes.begin(), told.notes.end());
  made.warnings.insert(made.warnings.end(), told.warnings.begin(), told.warnings.end());
  return made;
}

}  // namespace sillon
