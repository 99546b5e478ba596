// Files of projects: inputs, and the scene files of the paper.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/plate_input.hpp"
#include "sillon/project/project.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

// A picture that a project names.

/// \param what  it is, for messages.
Result<Image> readPicture(const ReadInput& read, const std::string& name, const std::string& what);

/// The part of a picture inside its crop: at least one pixel.
Image cropped(Image image, const LayerCrop& crop);

/// The modes of a layer over its box: its mode picture, or one mode.
Result<ModeMap> readModes(const Layer& layer, const ReadInput& read);

/// A drawing as it is painted, in its own size, or the bright part of a mask picture, 80 mm wide.
/// \return the errors of readSvg, decodeImage and shapeFromMask.
Result<Shape> readDrawing(const ReadInput& read, const std::string& name, const std::string& what);

// The keys of the scene files published with the paper, which stand at the top level; a project may use them too.

/// Their names, for messages about unknown ones.
std::vector<std::string> sceneKeys();

/// Whether an object without a version is such a scene.
bool isScene(const nlohmann::json& root);

/// Lays what they mean over a project. \return what is wrong: type or range. Empty: nothing.
std::string readSceneKeys(const nlohmann::json& root, Project& project);

}  // namespace sillon
