// Whether a plate finds room on a bed, and what would help if it does not.
#pragma once

#include "sillon/geometry/shape.hpp"
#include "sillon/settings/print_params.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

/// Ways to bring all copies of a plate, brims included, upon the bed, judged by their boxes: shapes that find room only
/// between the corners of a round bed or around its excluded part are not found, except single ones on a round bed.
struct BedFit {
  bool centred = false;  ///< in the middle of the bed, turned as it is
  bool turned = false;   ///< there, after a quarter turn
  int percent = 100;     ///< largest whole percentage of its size that fits there, turned as it is; 0: none
};

/// \param params  of which rotate, mirror, brim, copies and copyGap count. All values within their ranges.
BedFit fitBed(const Shape& shape, const Printer& printer, const PrintParams& params);

}  // namespace sillon
