// Where each kind's pieces lie on its plate.
#pragma once

#include "calibrate/plate.hpp"
#include "sillon/calibrate/calibrate.hpp"

namespace sillon {

/// Every kind but the swatch, whose toolpath is made as any picture's: see addSwatch.
void layOut(CalibrationKind kind, PlateBuilder& plate);

}  // namespace sillon
