#include "input/map_defect.hpp"

#include <cstdint>

namespace sillon {

std::string imageDefect(const Image& image) {
  const bool consistent = image.width > 0 && image.height > 0 && image.channels >= 1 && image.channels <= 4 &&
                          image.samples.size() == cellCount(image.width, image.height) * image.channels;
  if (consistent) return "";
  return "picture of " + std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels with " +
         std::to_string(image.channels) + " channels and " + std::to_string(image.samples.size()) +
         " samples; it must have pixels, 1 to 4 channels and a sample for each";
}

std::string mapDefect(const char* name, int width, int height, std::size_t values) {
  if (width > 0 && height > 0 &&
      std::uint64_t{values} == static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height))
    return {};
  return std::string(name) + " map is " + std::to_string(width) + " x " + std::to_string(height) + " pixels with " +
         std::to_string(values) + " values; it must have a pixel at least, and one value for each";
}

}  // namespace sillon
