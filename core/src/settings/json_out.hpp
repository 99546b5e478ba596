// Settings as text: the sections of project files, and values for messages.
#pragma once

#include <string>

#include "sillon/base/types.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {

/// Shortest decimal that reads back as the same double, the same in every locale: "0.4", "1e-07", "60".
std::string numberText(double value);

/// "[1.5, 20]"
std::string pairText(Vec2 value);

/// "\"none\", \"soft\" or \"count\""
std::string choicesText(const Setting& setting);

/// A project file with the sections of which a view has any part.
std::string projectText(const SettingsView& view);

}  // namespace sillon
