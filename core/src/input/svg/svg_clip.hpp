// Areas that limit what is shown, and areas laid over each other.
#pragma once

#include <memory>
#include <vector>

#include "input/svg/svg_work.hpp"
#include "sillon/geometry/outline.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon::svg {

/// What is shown lies inside of it.
struct Limit {
  FilledPath area;
  Bounds box;
  bool isBox = false;  ///< nothing of the box is outside
};

/// An area that adds to what lies below it, or hides it.
struct Layer {
  FilledPath path;
  bool adds = true;
  bool faint = false;  ///< painted at half opacity or less
};

std::shared_ptr<const Limit> limitOf(FilledPath area);
/// Whether nothing of `box` is cut off.
bool covers(const Limit& limit, const Bounds& box);
Bounds boxOf(const std::vector<Ring>& rings);

/// What of the paths `rule` says. Throws Refused.
FilledPath combine(const std::vector<FilledPath>& paths, const InsideRule& rule, Work& work);
/// What of a path lies within all limits. Throws Refused.
FilledPath within(FilledPath path, const std::vector<const Limit*>& limits, Work& work);
/// What of a path lies outside of a limit that is a box, in pieces. Throws Refused.
std::vector<FilledPath> beyondBox(const FilledPath& path, const Limit& limit, Work& work);
/// Layers from below upwards as one area. Throws Refused.
FilledPath flattened(const std::vector<Layer>& layers, Work& work);

}  // namespace sillon::svg
