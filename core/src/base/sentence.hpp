// Sentences of codes, with their values.
#pragma once

#include <algorithm>
#include <cassert>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "base/decimal_text.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/sentence.hpp"

namespace sillon {

inline std::string_view nameOf(const NamedValue& value) { return value.name; }
inline std::string textOf(const NamedValue& value) {
  return value.text.empty() ? decimal(value.number, 3) : value.text;
}

template <class Name>
std::string_view nameOf(const std::pair<Name, std::string>& value) {
  return value.first;
}
template <class Name>
std::string textOf(const std::pair<Name, std::string>& value) {
  return value.second;
}

/// A sentence with its values in the places of their {names}: each that it names is there, and it says all but those
/// that it marks as unsaid. \param values  NamedValue, or pairs of a name and a text
template <class Values>
std::string filled(const Sentence& sentence, const Values& values) {
  std::string out;
  std::string said = std::string(" ") + sentence.unsaid + " ";
  std::string_view rest = sentence.text;
  for (std::size_t open = rest.find('{'); open != std::string_view::npos; open = rest.find('{')) {
    const std::size_t close = rest.find('}', open);
    const std::string_view name = rest.substr(open + 1, close - open - 1);
    const auto value = std::find_if(values.begin(), values.end(), [&](const auto& one) { return nameOf(one) == name; });
    assert(value != values.end());
    out.append(rest.substr(0, open)) += textOf(*value);
    said.append(name) += ' ';
    rest.remove_prefix(close + 1);
  }
  for ([[maybe_unused]] const auto& value : values) {
    assert(said.find(" " + std::string(nameOf(value)) + " ") != std::string::npos);
  }
  return out.append(rest);
}

/// \param sentences  a list that has the code
template <class Sentences>
const Sentence& sentenceOf(const Sentences& sentences, std::string_view code) {
  const auto row = std::find_if(std::begin(sentences), std::end(sentences),
                                [&](const Sentence& sentence) { return sentence.code == code; });
  assert(row != std::end(sentences));
  return *row;
}

}  // namespace sillon
