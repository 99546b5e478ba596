// Words and numbers as slicers write their settings.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/lines.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

/// In quotes, printable ASCII, at most 60 characters of it.
std::string shown(std::string_view text);

/// The first number of "0.4", "0.4,0.4", "500;1250", "7.04172e-15": settings of several tools begin with the first
/// one's. Nothing for a percentage.
std::optional<double> firstNumber(std::string_view text);

/// "0x0,220x0,220x220,0x220"; empty if it is not that.
std::vector<Vec2> readCorners(std::string_view text);

/// PrusaSlicer's and Cura's escapes in one-line texts.
std::string unescaped(std::string_view text);

/// How many values "1250,960" or "PLA;PETG" has.
std::size_t itemsOf(std::string_view list);

/// The k-th of them without its escapes, or the first where there are fewer.
std::string itemOf(std::string_view list, std::size_t index);

/// "key = value", split at the first equal sign only: values hold them too.
bool splitSetting(std::string_view line, std::string_view& key, std::string_view& value);

}  // namespace sillon
