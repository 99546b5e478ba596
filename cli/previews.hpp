// Pictures that --preview names: PNG files, each under a light, or one moving picture of all of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/look/preview.hpp"

namespace cli {

/// "plate.png" for the first picture, "plate-2.png" for the second.
std::string previewName(const std::string& path, std::size_t picture);

/// Names of all files for that many lights; none where the path is empty.
std::vector<std::string> previewNames(const std::string& path, std::size_t lights);

/// Refuses what can be known to be wrong before the work begins. \param width  as that of previewFiles
std::optional<sillon::Error> previewProblem(const std::string& path, int width);

/// \param looks  one for each light; not empty.
/// \param width  of each panel, of a moving picture the longer side [pixels]; 0: the usual one.
sillon::Result<std::vector<OutputFile>> previewFiles(const std::string& path, const sillon::Toolpath& toolpath,
                                                     sillon::Vec2 page, const std::vector<sillon::LookParams>& looks,
                                                     int width, const sillon::RunContext& run);

/// The bytes of a PNG file. \return TooLarge if memory runs out.
sillon::Result<std::string> pngFile(const sillon::RgbImage& image);

}  // namespace cli
