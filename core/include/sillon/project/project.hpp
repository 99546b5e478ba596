// Project files (JSON, versioned) and the published scene files, which are read as they are.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "sillon/base/result.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

inline constexpr int kProjectVersion = 1;
/// The studio's strokes take most of it [bytes].
inline constexpr std::size_t kMaxProjectBytes = std::size_t{16} << 20;

/// Reads a project or a published scene. Keys, units, ranges and defaults: docs/reference/project.md.
/// \param json  at most kMaxProjectBytes, nested at most 64 deep.
/// \return InvalidFile (no JSON, unknown or repeated key, wrong type) or InvalidArgument (out of range); the message
/// names the key.
Result<Project> readProject(std::string_view json);

/// The project as JSON with every field but `print.date` and `print.notes`, which belong to a run; readable by
/// readProject, and equal when read back if invalidSettings finds nothing. The studio's own section is kept as it came.
std::string writeProject(const Project& project);

}  // namespace sillon
