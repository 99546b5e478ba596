// Which paths of a drawing add nothing to it: flags and badges lie on one plain sheet.
#pragma once

#include <vector>

#include "sillon/geometry/shape.hpp"

namespace sillon {

/// For each path 1 if it lies within one of the largest convex paths, so that all of them together are the same without
/// it; of equal paths one stays. \return as many as there are paths.
std::vector<char> coveredPaths(const std::vector<FilledPath>& paths);

}  // namespace sillon
