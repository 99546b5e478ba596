// sillon zones: a body with zones of straight lines, for any slicer.
#pragma once

#include <string>

#include "files.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/export/zones.hpp"
#include "sillon/project/project.hpp"

namespace CLI {
class App;
}

namespace cli {

struct ZonesArguments {
  std::string out;    ///< a .3mf
  std::string body;   ///< STL; empty: a prism of the shape
  double height = 2;  ///< of that prism [mm]
  sillon::ZoneParams params;
  sillon::ZoneLayers layers;
};

/// Adds what only zones have; \param command  gets the options of shape, directions and pictures elsewhere.
void addZones(CLI::App& command, ZonesArguments& arguments);

sillon::Result<Outcome> runZones(const ZonesArguments& arguments, sillon::Project project,
                                 const sillon::RunContext& run);

}  // namespace cli
