#include "sillon/input/plate_input.hpp"

#include "base/refused.hpp"
#include "input/map_defect.hpp"
#include "input/stored_angle.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

namespace sillon {
namespace {

/// Returns the grey of a texel, by Rec. 709 weights in 1/65536. They sum to one, so that equal channels keep their
/// value.
std::uint16_t greyAt(const Image& image, int x, int y) {
  if (image.channels < 3) return image.at(x, y, 0);
  const std::uint64_t sum = 13933ull * image.at(x, y, 0) + 46871ull * image.at(x, y, 1) + 4732ull * image.at(x, y, 2);
  return static_cast<std::uint16_t>((sum + 32768) >> 16);
}

/// Converts grey 0..65535 for 0..180 degrees to a stored angle: a turn by 90 degrees, modulo 180.
std::uint16_t fromRotation(std::uint16_t grey) {
  return static_cast<std::uint16_t>(grey < 32768 ? grey + 32768 : grey - 32767);
}

/// Converts a tangent (red, green) to a stored angle. The last digits of atan2 differ between platforms; rounding to 16
/// bits hides them.
std::uint16_t fromTangent(std::uint16_t red, std::uint16_t green) {
  constexpr int kNeutral = 257;  // 8-bit pictures can store 127 or 128, but not one half
  const int x = 2 * red - 65535;
  const int y = 2 * green - 65535;
  if (std::abs(x) <= kNeutral && std::abs(y) <= kNeutral) return storedAngle(0);
  return storedAngle(std::atan2(y, x) / std::numbers::pi);
}

template <class Body>
void forEachTexel(const Image& image, const Body& body) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) body(x, y);
  }
}

}  // namespace

Result<DirectionMap> directionMap(const Image& image, DirectionEncoding encoding) {
  if (std::optional<Error> defect = imageDefect(image, "layers.directionFile")) return *std::move(defect);
  if (encoding == DirectionEncoding::Tangent && image.channels < 3) {
    return refusedArgument("TangentsNeedColours", {{"channels", image.channels}});
  }
  DirectionMap map{image.width, image.height, {}};
  map.angle.reserve(cellCount(image.width, image.height));
  switch (encoding) {
    case DirectionEncoding::Angle:
      forEachTexel(image, [&](int x, int y) { map.angle.push_back(greyAt(image, x, y)); });
      break;
    case DirectionEncoding::Rotation:
      forEachTexel(image, [&](int x, int y) { map.angle.push_back(fromRotation(greyAt(image, x, y))); });
      break;
    case DirectionEncoding::Tangent:
      forEachTexel(image,
                   [&](int x, int y) { map.angle.push_back(fromTangent(image.at(x, y, 0), image.at(x, y, 1))); });
      break;
  }
  return map;
}

Result<DirectionMap> uniformDirection(double degrees) {
  if (!std::isfinite(degrees)) {
    return refusedArgument("AngleNotFinite");
  }
  return DirectionMap{1, 1, {storedAngle(std::fmod(degrees, 180.0) / 180)}};
}

Result<ModeMap> modeMap(const Image& image) {
  if (std::optional<Error> defect = imageDefect(image, "layers.modeFile")) return *std::move(defect);
  ModeMap map{image.width, image.height, {}};
  map.mode.reserve(cellCount(image.width, image.height));
  forEachTexel(image, [&](int x, int y) {
    map.mode.push_back(static_cast<DirectionMode>((6 * greyAt(image, x, y) + 65535) / (2 * 65535)));
  });
  return map;
}

ModeMap uniformMode(DirectionMode mode) { return {1, 1, {mode}}; }

}  // namespace sillon
