// A picture as it is laid on a page of other proportions.
#pragma once

#include "sillon/base/types.hpp"
#include "sillon/look/tones.hpp"
#include "sillon/settings/picture_params.hpp"

namespace sillon {

/// \param leftOut  receives the share of the picture that lies beyond the page, 0..1.
Tones pageTones(Tones tones, Vec2 page, PictureProportions proportions, double& leftOut);

}  // namespace sillon
