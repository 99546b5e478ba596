// Warnings and notes as JSON.
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "sillon/base/result.hpp"

namespace sillon {

/// Writes a list of warnings or notes as JSON. \param codeOf  returns the name of the code of one of them.
template <class Told, class CodeOf>
std::string toldJson(const std::vector<Told>& all, const CodeOf& codeOf) {
  std::string list;
  for (const Told& told : all) {
    std::string values;
    for (const NamedValue& value : told.values) {
      values += (values.empty() ? "" : ",") + jsonString(value.name) + ":" +
                (value.text.empty() ? jsonNumber(value.number) : jsonString(value.text));
    }
    list += (list.empty() ? "" : ",") + ("{\"code\":" + jsonString(codeOf(told))) + ",\"values\":{" + values +
            "},\"message\":" + jsonString(told.message) + "}";
  }
  return "[" + list + "]";
}

}  // namespace sillon
