// Sentences for codes, with their values.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "base/numbers.hpp"
#include "sillon/base/result.hpp"

namespace sillon {

inline std::string_view nameOf(const NamedValue& value) { return value.name; }
inline std::string textOf(const NamedValue& value) {
  if (!value.text.empty()) return value.text;
  return std::abs(value.number) < 1e-3 ? shownNumber(value.number) : decimal(value.number, 3);
}

template <class Name>
std::string_view nameOf(const std::pair<Name, std::string>& value) {
  return value.first;
}
template <class Name>
std::string textOf(const std::pair<Name, std::string>& value) {
  return value.second;
}

/// Tells whether a sentence gets each value that it mentions, and mentions each value that it does not mark as unsaid.
/// \param values  NamedValue, or pairs of a name and a text
template <class Values>
bool saysAll(const Sentence& sentence, const Values& values) {
  std::string names = std::string(" ") + sentence.unsaid + " ";
  std::string_view rest = sentence.text;
  for (std::size_t open = rest.find('{'); open != std::string_view::npos; open = rest.find('{')) {
    const std::string_view name = rest.substr(open + 1, rest.find('}') - open - 1);
    if (std::none_of(values.begin(), values.end(), [&](const auto& one) { return nameOf(one) == name; })) return false;
    names.append(name) += ' ';
    rest.remove_prefix(rest.find('}') + 1);
  }
  return std::all_of(values.begin(), values.end(), [&](const auto& one) {
    return names.find(" " + std::string(nameOf(one)) + " ") != std::string::npos;
  });
}

/// Replaces each {name} in a sentence by its value. \param values  all values that it mentions
template <class Values>
std::string filled(const Sentence& sentence, const Values& values) {
  assert(saysAll(sentence, values));
  std::string out;
  std::string_view rest = sentence.text;
  for (std::size_t open = rest.find('{'); open != std::string_view::npos; open = rest.find('{')) {
    const std::size_t close = rest.find('}');
    const std::string_view name = rest.substr(open + 1, close - open - 1);
    const auto value = std::find_if(values.begin(), values.end(), [&](const auto& one) { return nameOf(one) == name; });
    out.append(rest.substr(0, open)).append(value != values.end() ? textOf(*value) : "?");
    rest.remove_prefix(close + 1);
  }
  return out.append(rest);
}

/// Turns a warning or a note about a plate's only drawing into one about the drawing of a layer. \param layer  number,
/// from 1
template <class Told>
void tellOfLayer(Told& told, std::size_t layer) {
  told.values.emplace_back("layer", static_cast<double>(layer));
  told.message = "layer " + std::to_string(layer) + ": " + told.message;
}

/// Returns the sentence for a code. \param sentences  a list that contains the code
template <class Sentences>
const Sentence& sentenceOf(const Sentences& sentences, std::string_view code) {
  const auto row = std::find_if(std::begin(sentences), std::end(sentences),
                                [&](const Sentence& sentence) { return sentence.code == code; });
  assert(row != std::end(sentences));
  return *row;
}

}  // namespace sillon
