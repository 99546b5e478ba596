// Sorts by a number, where speed does not matter.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sillon {

/// Sorts from the smallest key to the largest; items with equal keys keep their order. Sorting pairs of numbers,
/// instead of the items by std::stable_sort, saves web pages 6 KB of code for each type of item, because all of them
/// share one sort.
/// \param keyOf  returns a number for each item, never NaN.
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
