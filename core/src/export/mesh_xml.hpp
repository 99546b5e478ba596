// A mesh as the resources of a 3MF model.
#pragma once

#include <string>

#include "sillon/export/base_solid.hpp"

namespace sillon {

/// The <resources> element: the mesh as object 1, on a grid of 0.001 mm, heights 0.000001 mm.
std::string resourcesOf(const Mesh& mesh);

}  // namespace sillon
