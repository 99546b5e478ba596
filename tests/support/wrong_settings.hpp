// What is wrong with settings, as text.
#pragma once

#include <string>

#include "sillon/settings/table.hpp"

/// The sentence of invalidSettings for the same arguments; empty: nothing is wrong.
template <class... Parts>
std::string wrongSettings(const Parts&... parts) {
  const auto wrong = sillon::invalidSettings(parts...);
  return wrong ? wrong->message : "";
}
