// The keys of the scene files published with the paper, which stand at the top level; a project may use them too.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sillon/settings/project.hpp"

namespace sillon {

/// Their names, for messages about unknown ones.
std::vector<std::string> sceneKeys();

/// Whether an object without a version is such a scene.
bool isScene(const nlohmann::json& root);

/// Lays what they mean over a project. \return what is wrong: type or range. Empty: nothing.
std::string readSceneKeys(const nlohmann::json& root, Project& project);

}  // namespace sillon
