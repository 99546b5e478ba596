// What lists are sorted by where speed does not matter: each further type that is sorted costs web pages 2 KB of code.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace sillon {

/// Up to four numbers, and what they stand for.
using SortKey = std::pair<std::array<std::int64_t, 4>, std::size_t>;

}  // namespace sillon
