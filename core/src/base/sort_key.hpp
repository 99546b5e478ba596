// What lists are sorted by where speed does not matter: each further type that is sorted costs web pages 2 KB of code,
// and std::stable_sort 6.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sillon {

/// Up to four numbers, and what they stand for.
using SortKey = std::pair<std::array<std::int64_t, 4>, std::size_t>;

/// From the least key to the greatest; equal ones stay in their order. \param keyOf  of an item: a number, never NaN.
template <class T, class KeyOf>
void sortBy(std::vector<T>& items, KeyOf&& keyOf) {
  std::vector<std::pair<double, std::size_t>> order;
  order.reserve(items.size());
  for (std::size_t k = 0; k < items.size(); ++k) order.emplace_back(static_cast<double>(keyOf(items[k])), k);
  std::sort(order.begin(), order.end());
  std::vector<T> sorted;
  sorted.reserve(items.size());
  for (const auto& entry : order) sorted.push_back(std::move(items[entry.second]));
  items = std::move(sorted);
}

}  // namespace sillon
