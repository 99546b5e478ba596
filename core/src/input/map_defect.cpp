#include "input/map_defect.hpp"

#include <cstdint>

#include "base/refused.hpp"

namespace sillon {

std::optional<Error> imageDefect(const Image& image, std::string_view name) {
  const bool consistent = image.width > 0 && image.height > 0 && image.channels >= 1 && image.channels <= 4 &&
                          image.samples.size() == cellCount(image.width, image.height) * toSize(image.channels);
  if (consistent) return std::nullopt;
  return refusedArgument("SamplesUnlikePicture", {{"name", name},
                                                  {"width", image.width},
                                                  {"height", image.height},
                                                  {"channels", image.channels},
                                                  {"samples", image.samples.size()}});
}

std::optional<Error> mapDefect(const char* name, int width, int height, std::size_t values) {
  if (width > 0 && height > 0 &&
      std::uint64_t{values} == static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height))
    return std::nullopt;
  return refusedArgument("ValuesUnlikeMap", {{"name", name}, {"width", width}, {"height", height}, {"values", values}});
}

}  // namespace sillon
