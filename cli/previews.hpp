// Files of --preview: a PNG for each light, or one moving picture of all of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/look/preview.hpp"

namespace sillon::cli {

/// Names the preview of a picture: "plate.png" for the first, "plate-2.png" for the second.
std::string previewName(const std::string& path, std::size_t picture);

/// Returns the names of all previews for a number of lights; none if the path is empty.
std::vector<std::string> previewNames(const std::string& path, std::size_t lights);

/// Refuses, before the work begins, previews that cannot be made. \param width  see previewFiles()
std::optional<Error> previewProblem(const std::string& path, int width);

/// Renders the previews.
/// \param looks  one for each light; not empty.
/// \param width  width of each panel, or longer side of a moving picture [pixels]; 0 for the default.
Result<std::vector<OutputFile>> previewFiles(const std::string& path, const Toolpath& toolpath, Vec2 page,
                                             const std::vector<LookParams>& looks, int width, const RunContext& run);

/// Encodes a picture as PNG. \return TooLarge if memory runs out.
Result<std::string> pngFile(const RgbImage& image);

}  // namespace sillon::cli
