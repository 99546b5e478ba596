// sillon calibrate: small prints that teach a printer's and a filament's settings, and a photograph of one read back.
#pragma once

#include <optional>
#include <string>

#include "files.hpp"
#include "pictures.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/calibrate/calibrate.hpp"
#include "sillon/project/project.hpp"

namespace CLI {
class App;
}

namespace cli {

struct CalibrateArguments {
  std::string kind;  ///< a name of sillon::calibrationKinds, or kReadPhotograph
  std::optional<double> from;
  std::optional<double> to;
  std::string out;          ///< G-code; packed by its ending as --gcode of generate; of a photograph, a file of spools
  std::string preview;      ///< PNG
  int previewWidth = 1600;  ///< [pixels], as that of generate
  bool json = false;
  std::vector<std::string> further;     ///< photographs of the same coupon
  std::string name = "mySpool";         ///< of the spool in a photograph
  std::optional<double> lampElevation;  ///< [degrees]
  std::string lampSize;                 ///< of the photograph's lamp; empty: unknown
};

inline constexpr const char* kReadPhotograph = "read";

/// Adds what only calibrations have; \param command  gets the options of the print elsewhere.
void addCalibrate(CLI::App& command, CalibrateArguments& arguments);

/// \param options  of which the spool counts. \param scene  the file that the project is of; empty: none. \param date
/// for line 1 of the G-code.
sillon::Result<Outcome> runCalibrate(const CalibrateArguments& arguments, const PictureOptions& options,
                                     const sillon::Project& project, const std::string& scene, const std::string& date,
                                     const sillon::RunContext& run);

/// What is told of photographs of one coupon, and the file of spools, if one is asked for.
/// \param photographs  pictures' files; those that cannot be read are told of, if one can. \param project  as the
/// coupon was made.
sillon::Result<Outcome> runReadPhotographs(const CalibrateArguments& arguments,
                                           const std::vector<std::string>& photographs, const sillon::Project& project,
                                           const sillon::RunContext& run);

}  // namespace cli
