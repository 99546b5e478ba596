// Settings from and to JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {

// Settings as text: the sections of project files, and values for messages.

/// Shortest decimal that reads back as the same double, the same in every locale: "0.4", "1e-07", "60".
std::string numberText(double value);

/// Words of StrokeTool.
inline constexpr const char* kStrokeTools = "comb mode erase";

/// A field of an enumeration, by number.
template <class Enum>
ChoiceField choiceField(Enum& at) {
  return {&at, [](const void* p) { return static_cast<std::size_t>(*static_cast<const Enum*>(p)); },
          [](void* p, std::size_t index) { *static_cast<Enum*>(p) = static_cast<Enum>(index); }};
}

/// "[1.5, 20]"
std::string pairText(Vec2 value);

/// "\"none\", \"soft\" or \"count\""
std::string choicesText(const Setting& setting);

/// A message about a setting of a layer, which then tells the number of the layer: "layers[2].angle is ...".
std::string inLayer(std::string message, std::size_t number);

/// A project file with the sections of which a view has any part.
std::string projectText(const SettingsView& view);

// The error for a number that is outside its range, whoever sets the range.

/// "print.layerHeight is 0.5 mm; it must be 0.05 to 0.32" and the rest.
/// \param part  ".x" or ".y" of a pair; else empty. \param rest  why, and the way out, with its own comma.
inline Error settingOutOfRange(const Setting& setting, double value, double low, double high,
                               const std::string& rest = "", const char* part = "") {
  const std::string unit = *setting.unit == '\0' ? "" : std::string(" ") + setting.unit;
  return {ErrorCode::InvalidArgument,
          fullName(setting) + part + " is " + numberText(value) + unit + "; it must be " + numberText(low) + " to " +
              numberText(high) + rest,
          reason::kSettingOutOfRange,
          {{"setting", fullName(setting)}, {"value", value}, {"low", low}, {"high", high}}};
}

// Settings from JSON.

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

/// Reads the list of a project's layers. \return as readSection.
std::string readLayers(const nlohmann::json& value, Project& project);

/// Refuses keys that are not known. \param prefix  of the names in messages, such as "print.".
std::string unknownKey(const nlohmann::json& object, const std::string& prefix, const std::vector<std::string>& known);

}  // namespace sillon
