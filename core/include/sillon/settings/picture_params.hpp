// Pictures that a plate shall show, each under its lamp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sillon/base/types.hpp"

namespace sillon {

/// A picture and where its lamp stands.
struct LampPicture {
  std::string file;          ///< PNG, JPEG, BMP or TGA
  std::optional<Vec2> lamp;  ///< azimuth counter-clockwise from +x, -360..360, and elevation, 1..90 [degrees]; unset:
                             ///< chosen for the picture

  friend bool operator==(const LampPicture&, const LampPicture&) = default;
};

/// The measured spools, in the order of their keys: look/spools.hpp says what they look like.
enum class SpoolName { BluePla, ClearPetg, GoldPla, GreyPla, RedPetg };

/// What becomes of pictures whose proportions are not the page's.
enum class PictureProportions {
  Keep,     ///< what sticks out is cut off, as much on either side
  Stretch,  ///< they are stretched over the page
};

struct PictureParams {
  std::vector<LampPicture> files;  ///< 0..4; none: the directions decide
  PictureProportions proportions = PictureProportions::Keep;
  SpoolName spool = SpoolName::BluePla;  ///< whose colour and slopes count
  std::optional<Vec2> slopes;            ///< along and across the bead of a spool of one's own, 0.1..45 [degrees]
  double lampSize = 0.1;                 ///< of all lamps, as a slope, 0..2
  double smoothness = 0.02;              ///< InversionParams::smoothness, 0.001..10
  double localContrast = 0;              ///< InversionParams::localContrast, 0..2
  int corrections = 3;  ///< how often a single picture is asked for anew with what its beads leave out, 0..8
};

}  // namespace sillon
