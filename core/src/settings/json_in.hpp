// Settings from JSON.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/settings/table.hpp"

namespace sillon {

// Each reads one value. \param name  for messages. \return what is wrong; empty: nothing.
std::string readText(const nlohmann::json& value, const std::string& name, std::string& out);
std::string readFlag(const nlohmann::json& value, const std::string& name, bool& out);
std::string readNumber(const nlohmann::json& value, const std::string& name, double& out);
std::string readInteger(const nlohmann::json& value, const std::string& name, int& out);
std::string readInteger(const nlohmann::json& value, const std::string& name, std::uint64_t& out);

/// "a list", "text": what a value is, in words.
const char* typeName(const nlohmann::json& value);

/// Reads the keys of one section; those that are not there leave their fields alone. The values of a
/// preset or profile that is named come first. Types only: ranges are the validator's.
/// \return what is wrong, an unknown key too; empty: nothing.
std::string readSection(const nlohmann::json& value, Section section, const SettingsView& view);

/// Refuses keys that are not known. \param prefix  of the names in messages, such as "print.".
std::string unknownKey(const nlohmann::json& object, const std::string& prefix, const std::vector<std::string>& known);

}  // namespace sillon
