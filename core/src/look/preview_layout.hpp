// Where the panels of a preview lie.
#pragma once

#include "sillon/base/types.hpp"

namespace sillon {

struct Box {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

inline bool holds(const Box& box, int x, int y) {
  return x >= box.x && x < box.x + box.width && y >= box.y && y < box.y + box.height;
}

struct Layout {
  int width = 0;
  int height = 0;
  Box directions;  // the page in panel 1 [pixels]; no width: only the look is drawn
  Box look;        // the page in panel 2
  double pixelsPerMm = 0;
  double legendX = 0;  // centre of the half wheel's base
  double legendY = 0;
  double legendRadius = 0;
  double lampX = 0;  // centre of the small ring that shows where the light is
  double lampY = 0;
  double lampRadius = 0;
};

/// Both panels, beside or above each other. \return width 0 if the picture would be beyond the limits.
Layout layOut(Vec2 page, int panelWidth);

/// The look alone in the middle of a picture of this size.
Layout layOutLook(Vec2 page, int width, int height);

}  // namespace sillon
