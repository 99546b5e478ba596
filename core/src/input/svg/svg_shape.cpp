#include "input/svg/svg_path.hpp"

#include <cmath>

namespace sillon::svg {

bool isShape(std::string_view name) {
  return name == "path" || name == "rect" || name == "circle" || name == "ellipse" || name == "polygon" ||
         name == "polyline" || name == "line";
}

bool outlineShape(Outliner& out, const Node& node, Vec2 view, const UserUnits& units) {
  const std::string_view name = elementName(node);
  const double diagonal = std::sqrt(dot(view, view) / 2);
  if (name == "path") {
    drawPath(out, attribute(node, "d").value_or(""));
  } else if (name == "polygon" || name == "polyline") {
    drawPolygon(out, attribute(node, "points").value_or(""), name == "polygon");
  } else if (name == "line") {
    out.line({units.of(node, "x1", view.x, 0), units.of(node, "y1", view.y, 0)},
             {units.of(node, "x2", view.x, 0), units.of(node, "y2", view.y, 0)});
    out.end();
  } else if (name == "rect") {
    const Vec2 corner{units.of(node, "x", view.x, 0), units.of(node, "y", view.y, 0)};
    const Vec2 size{units.positive(node, "width", view.x, 0), units.positive(node, "height", view.y, 0)};
    if (size.x == 0 || size.y == 0) return false;
    drawRectangle(out, corner, size, units.radii(node, view));
  } else {
    const Vec2 center{units.of(node, "cx", view.x, 0), units.of(node, "cy", view.y, 0)};
    const double r = name == "circle" ? units.positive(node, "r", diagonal, 0) : 0;
    const Vec2 radii = name == "circle" ? Vec2{r, r} : units.radii(node, view);
    if (radii.x == 0 || radii.y == 0) return false;
    drawEllipse(out, center, radii);
  }
  return true;
}

}  // namespace sillon::svg
