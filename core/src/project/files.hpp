// Files of projects: inputs, and the scene files of the paper.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/project/project.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// Pictures and drawings that a project names.

/// Reads and decodes a picture. \param what  name of its role, for messages.
Result<Image> readPicture(const ReadInput& read, const std::string& name, const std::string& what);

/// Cuts a picture to its crop; at least one pixel stays.
Image cropped(Image image, const LayerCrop& crop);

/// Reads the modes of a layer over its box: its mode picture, or one mode everywhere.
Result<ModeMap> readModes(const Layer& layer, const ReadInput& read);

/// Reads a drawing as it is painted, in its own size, or the bright part of a mask picture, 80 mm wide.
/// \return the errors of readSvg, decodeImage and shapeFromMask.
Result<Shape> readDrawing(const ReadInput& read, const std::string& name, const std::string& what);

// The keys of the scene files published with the paper, which stand at the top level; a project may use them too.

/// Names of these keys, for messages about unknown ones.
std::vector<std::string> sceneKeys();

/// Tells whether an object without a version is such a scene.
bool isScene(const nlohmann::json& root);

/// Applies the keys of a scene to a project. \return the fault, of type or range; empty: none.
std::optional<Error> readSceneKeys(const nlohmann::json& root, Project& project);

}  // namespace sillon
