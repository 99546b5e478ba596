// The reason of an error with its values, as text.
#pragma once

#include <string>

#include "base/numbers.hpp"
#include "sillon/base/result.hpp"

/// "OverBedEdge left=2 back=5.5"; empty: the message alone says it.
inline std::string toldReason(const sillon::Error& error) {
  std::string text = error.reason;
  for (const sillon::NamedValue& value : error.values) {
    text += std::string(" ") + value.name + "=" + (value.text.empty() ? sillon::decimal(value.number, 4) : value.text);
  }
  return text;
}
