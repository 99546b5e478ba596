#include "job/place_on_bed.hpp"

#include "gcode/layout.hpp"

namespace sillon {

bool placeOnBed(Project& project, const Shape& shape, Placing placing) {
  if (placing == Placing::AsGiven) return false;
  const BedFit fit = fitBed(shape, project.printer, project.print);
  if (fit.centred) return false;
  if (fit.turned) {
    project.print.rotate += project.print.rotate > 270 ? -270 : 90;
    return false;
  }
  if (placing != Placing::Fit || fit.percent < 1) return false;
  const double scale = fit.percent / 100.0;
  if (project.shapeFile.empty()) {
    const bool disc = project.builtin == BuiltinShape::Disc;
    project.builtinSize = {scale * shape.page.x, disc ? 0 : scale * shape.page.y};
    project.builtinRadius *= scale;
  } else {
    project.pageWidth = scale * shape.page.x;
  }
  return true;
}

}  // namespace sillon
