// Gives memory back before its owner ends: the peak of memory is what limits a plate's size.
#pragma once

namespace sillon {

/// `fields = {}` would not do: a vector keeps its memory then.
template <class T>
void release(T& fields) {
  fields = T();
}

}  // namespace sillon
