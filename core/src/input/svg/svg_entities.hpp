// What a DOCTYPE abbreviates: Illustrator writes <!ENTITY st0 "fill:none;"> and style="&st0;".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sillon::svg {

/// The text with its own general entities written out; empty: it has none. Entities hold only those declared before.
/// Throws Refused: the text would be longer than `maxBytes`, or there are too many entities.
std::string withEntities(std::string_view text, std::size_t maxBytes);

}  // namespace sillon::svg
