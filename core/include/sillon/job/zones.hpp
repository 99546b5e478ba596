// The way from a project to a body with zones of straight lines, which any slicer can print.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/export/zones.hpp"
#include "sillon/input/read_input.hpp"
#include "sillon/report/input_note.hpp"
#include "sillon/report/warning.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// The place of a level top face of a body.
struct BodyFace {
  Vec2 corner;   ///< of the box around it [mm]
  double z = 0;  ///< [mm]
};

struct ZonesRequest {
  /// An STL, whose top faces get the zones; unset: a prism of the project's shape
  std::optional<std::string> body;
  /// The face of the body that carries the project's shape and alone gets the zones
  std::optional<BodyFace> face;
  double height = 2;  ///< of that prism [mm]
  ZoneParams params;
  double layerHeight = 0.2;  ///< that the slicer is told [mm]
};

struct ZonesMade {
  std::string package;  ///< the bytes of a 3MF
  DirectionZones zones;
  std::size_t openEdges = 0;  ///< of the body
  std::vector<InputNote> notes;
  std::vector<Warning> warnings;
};

/// Lays a project's layers on the top of a body, and cuts their directions into zones. Directions
/// that vary become steps: DirectionZones::error tells how far they are off.
/// \return the errors of invalidSettings, readPlateInput, compose, readStl, directionZones and
/// zones3mf; InvalidArgument for layers whose mode is not constrained.
Result<ZonesMade> makeZones(const Project& project, const ZonesRequest& request,
                            const ReadInput& read, const RunContext& run);

}  // namespace sillon
