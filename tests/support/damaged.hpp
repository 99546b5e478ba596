// Copies of a text with damage in random places.
#pragma once

#include <string>

#include "support/scenes.hpp"

namespace scenes {

/// `text` with `times` places where either a byte is another or fewer than `longest` bytes are gone. It is not empty.
inline std::string damaged(std::string text, Random& random, int times, int longest) {
  for (int k = 0; k < times; ++k) {
    const auto at = static_cast<std::size_t>(random.index(static_cast<int>(text.size())));
    if (random.index(2) == 0) {
      text[at] = static_cast<char>(random.index(256));
    } else {
      text.erase(at, static_cast<std::size_t>(random.index(longest)));
    }
  }
  return text;
}

}  // namespace scenes
