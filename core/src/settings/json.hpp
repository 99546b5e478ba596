// Settings as JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/refused.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {

// Settings as text: the sections of project files, and values for messages.

/// Writes the shortest decimal that reads back as the same double, in any locale: "0.4", "1e-07", "60".
std::string numberText(double value);

/// Words of StrokeTool, in its order.
inline constexpr const char* kStrokeTools = "comb mode erase";

/// Wraps an enumeration as a field that is read and set by number.
template <class Enum>
ChoiceField choiceField(Enum& at) {
  return {&at, [](const void* p) { return toSize(*static_cast<const Enum*>(p)); },
          [](void* p, std::size_t index) { *static_cast<Enum*>(p) = static_cast<Enum>(index); }};
}

/// Writes a pair, such as "[1.5, 20]".
std::string pairText(Vec2 value);

/// Lists the choices of a setting, such as "none", "soft" or "count", in quotes.
std::string choicesText(const Setting& setting);

/// Puts the number of the layer into an error about a setting of a layer: "layers[2].angle is ...".
Error inLayer(Error error, std::size_t number);

/// Writes a project file with the sections of which a view has any part.
std::string projectText(const SettingsView& view);

// The error about a number outside its range.

/// Makes an error such as "print.layerHeight is 0.5 mm; it must be 0.05 to 0.32", followed by `rest`.
/// \param part  ".x" or ".y" of a pair; otherwise empty. \param rest  reason and remedy, with their own comma.
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

/// Error that a reader found; empty if the value is good.
using Fault = std::optional<Error>;

// Each of these reads one value. \param name  name in messages.
Fault readText(const nlohmann::json& value, const std::string& name, std::string& out);
Fault readFlag(const nlohmann::json& value, const std::string& name, bool& out);
Fault readNumber(const nlohmann::json& value, const std::string& name, double& out);
Fault readInteger(const nlohmann::json& value, const std::string& name, int& out);
Fault readInteger(const nlohmann::json& value, const std::string& name, std::uint64_t& out);

/// Makes the error for a value of a wrong type. \param reason  takes `setting` and the JSON `type`
Error wrongType(Reason reason, std::string_view setting, const nlohmann::json& value);

/// Reads the keys of one section; missing keys leave their fields as they are. The values of a named preset or profile
/// are applied first. Only types are checked; ranges are left to the validator. \return the fault, such as an unknown
/// key.
Fault readSection(const nlohmann::json& value, Section section, const SettingsView& view);

/// Reads the list of a project's layers. \return the fault, as readSection
Fault readLayers(const nlohmann::json& value, Project& project);

/// Makes the error for an unknown name. \param near  reason that takes `near`, names like it
/// \param far  reason that takes `known`, all names, if none is like it  \param setting  value of the reason, too
Error unknownName(Reason near, Reason far, std::string_view setting, const std::string& name,
                  const std::vector<std::string>& known);

/// Refuses unknown keys. \param prefix  prefix of the names in messages, such as "print.".
Fault unknownKey(const nlohmann::json& object, const std::string& prefix, const std::vector<std::string>& known);

}  // namespace sillon
