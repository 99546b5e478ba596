// Tones that a plate leaves out of a picture, asked for on top of it.
#pragma once

#include <span>

#include "sillon/look/appearance.hpp"
#include "sillon/look/tones.hpp"

namespace sillon {

/// Adds a share of what is missing to the tones that are asked for next. \param light  seen, in the cells of `asked`;
/// negative: no plate. \param level  light of white. \param next  any size, stretched over the same page.
void addMissingTones(std::span<const float> light, const Tones& asked, const Lobe& lobe, double level, Tones& next);

}  // namespace sillon
