// Releases memory before its owner ends, because the peak of memory limits a plate's size.
#pragma once

namespace sillon {

/// Frees the memory of fields. Assigning `{}` would not do: it clears a vector but keeps its memory.
template <class T>
void release(T& fields) {
  fields = T();
}

}  // namespace sillon
