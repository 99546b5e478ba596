// Transforms and viewports: https://www.w3.org/TR/SVG2/coords.html.
#pragma once

#include <optional>
#include <string_view>

#include "input/svg/svg_length.hpp"
#include "input/svg/svg_node.hpp"
#include "input/svg/svg_path.hpp"
#include "sillon/base/types.hpp"

namespace sillon::svg {

/// (x, y) -> (a x + c y + e, b x + d y + f), as SVG counts them.
Matrix matrix(double a, double b, double c, double d, double e, double f);
Matrix shifted(double x, double y);

/// What lengths in CSS refer to.
struct CssLengths {
  UserUnits units;
  Vec2 box;  ///< of the element's transform-box: 100 % in user units
};

/// \param text  attribute `transform`, or the property where `css` is given: it takes units and translateX, skew, ...
/// Throws Refused, for transforms in space, too.
Matrix parseTransform(std::string_view text, const CssLengths* css = nullptr);
/// \param text  `transform-origin`, from the corner of the box; what lies behind is not read. Throws Refused.
Vec2 parseOrigin(std::string_view text, const CssLengths& css);

struct ViewBox {
  Vec2 min;
  Vec2 size;
};

/// Nothing where there is none. Throws Refused.
std::optional<ViewBox> viewBoxOf(const Node& node);
/// Lays a viewBox into a viewport of the given size at the origin, as preserveAspectRatio says. Throws Refused.
Matrix fit(const Node& node, const ViewBox& box, Vec2 size);

}  // namespace sillon::svg
