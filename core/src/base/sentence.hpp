// Sentences of codes with values.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace sillon {

/// A sentence with its values in the places of their {names}. \param valueOf  the text for a name
template <class ValueOf>
std::string filled(std::string_view sentence, const ValueOf& valueOf) {
  std::string text;
  for (std::size_t open = sentence.find('{'); open != std::string_view::npos; open = sentence.find('{')) {
    const std::size_t close = std::min(sentence.find('}', open), sentence.size() - 1);
    text += sentence.substr(0, open);
    text += valueOf(sentence.substr(open + 1, close - open - 1));
    sentence.remove_prefix(close + 1);
  }
  text += sentence;
  return text;
}

/// For values that are pairs of a name and a text.
template <class Values>
std::string filledFrom(std::string_view sentence, const Values& values) {
  return filled(sentence, [&](std::string_view name) {
    const auto value = std::find_if(values.begin(), values.end(), [&](const auto& pair) { return pair.first == name; });
    return value == values.end() ? std::string() : std::string(value->second);
  });
}

}  // namespace sillon
