#include "settings/json.hpp"

#include "sillon/project/project.hpp"

namespace sillon {

std::string writeProject(const Project& project) { return projectText(viewOf(const_cast<Project&>(project))); }

}  // namespace sillon
