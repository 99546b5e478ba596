// Whether a text nests as XML does, and not too deep: looked over before RapidXML reads it.
#pragma once

#include <string_view>

namespace sillon::svg {

inline constexpr int kMaxDepth = 200;  ///< of elements, <use> counted in: each level costs stack

/// Throws Refused: no well-formed XML, or nested deeper than kMaxDepth.
void checkNesting(std::string_view text);

}  // namespace sillon::svg
