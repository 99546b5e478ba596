// The error for a number that is outside its range, whoever sets the range.
#pragma once

#include <string>

#include "settings/json_out.hpp"
#include "sillon/base/reasons.hpp"
#include "sillon/base/result.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {

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

}  // namespace sillon
