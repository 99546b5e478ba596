// How slicers mark what they lay.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sillon/rebrush/surfaces.hpp"

namespace sillon {

enum class MarkKind { None, Layer, Role, Width, Height, Z, Object };

/// What the following moves are.
enum class RoleKind { Other, Top, Bottom, FirstSolid, Skin, Ironing, Purge };

/// What a comment says.
struct Mark {
  MarkKind kind = MarkKind::None;
  RoleKind role = RoleKind::Other;
  double value = 0;       ///< of Height and Z [mm]
  std::string_view name;  ///< of the object; of a layer, the comment
};

/// \param comment  without ';', trimmed.
Mark readMark(std::string_view comment);

/// The object that a command begins or ends, where it is one that slicers write: EXCLUDE_OBJECT_START, M486, M624,
/// M625.
std::optional<std::string> objectOf(std::string_view code);

/// "PrusaSlicer 2.5.0" and the slicer, if a comment tells it.
struct Program {
  Slicer slicer;
  std::string name;
};
std::optional<Program> programOf(std::string_view comment);

}  // namespace sillon
