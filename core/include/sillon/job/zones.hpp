// Makes a body with zones of straight lines, which any slicer can print, from a project.
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
  Vec2 corner;   ///< corner of the box around it [mm]
  double z = 0;  ///< height of the face [mm]
};

/// The zones that are asked for.
struct ZonesRequest {
  /// Bytes of an STL whose top faces get the zones; unset: a prism of the project's shape
  std::optional<std::string> body;
  /// Face of the body that carries the project's shape and alone gets the zones
  std::optional<BodyFace> face;
  double height = 2;  ///< height of that prism [mm]
  ZoneParams params;
  double layerHeight = 0.2;  ///< layer height that the slicer is told [mm]
};

/// The zones that were made.
struct ZonesMade {
  std::string package;  ///< bytes of a 3MF
  DirectionZones zones;
  std::size_t openEdges = 0;  ///< number of edges at which the body is open
  std::vector<InputNote> notes;
  std::vector<Warning> warnings;
};

/// Lays a project's layers on the top of a body, and cuts their directions into zones. Directions
/// that vary become steps; DirectionZones::error tells how far off they are.
/// \return the errors of invalidSettings, readPlateInput, compose, readStl, directionZones and
/// zones3mf; InvalidArgument for layers whose mode is not constrained.
Result<ZonesMade> makeZones(const Project& project, const ZonesRequest& request,
                            const ReadInput& read, const RunContext& run);

}  // namespace sillon
