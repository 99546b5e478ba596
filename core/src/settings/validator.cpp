// The one validator: the table's ranges, and the rules that hold between settings of one section. What the settings of
// a whole print must be together is the G-code's business: gcode/validation.cpp.
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "base/words.hpp"
#include "settings/json_out.hpp"
#include "sillon/settings/screen_sizes.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {
namespace {

constexpr double kLine = 1024;  // [bytes], of a file's name

struct Range {
  double low;
  double high;
  const char* wayOut = "";  ///< of what is too high
};

/// Most ranges are the table's; what a printer may heat to depends on its own limits and anyTemperature.
Range rangeOf(const Setting& setting, const SettingsView& view) {
  if (setting.section == Section::Printer && view.printer != nullptr && !view.printer->anyTemperature) {
    const Printer& printer = *view.printer;
    const Printer usual;
    const std::string_view key = setting.key;
    if (key == "nozzleTemperature" || key == "firstLayerNozzleTemperature") {
      const double high = printer.maxNozzleTemperature;
      return {170, high,
              high < usual.maxNozzleTemperature ? ", or maxNozzleTemperature higher for another hot end" : ""};
    }
    if (key == "bedTemperature") {
      const double high = printer.maxBedTemperature;
      return {0, high, high < usual.maxBedTemperature ? ", or maxBedTemperature higher for another bed" : ""};
    }
  }
  return {setting.low, setting.high};
}

std::string unitOf(const Setting& setting) { return *setting.unit == '\0' ? "" : std::string(" ") + setting.unit; }

std::string wrongNumber(const Setting& setting, const char* part, double value, Range range) {
  if (value >= range.low && value <= range.high) return "";  // false for NaN
  return fullName(setting) + part + " is " + numberText(value) + unitOf(setting) + "; it must be " +
         numberText(range.low) + " to " + numberText(range.high) + (value > range.high ? range.wayOut : "");
}

std::string wrongPair(const Setting& setting, Vec2 value, Range range) {
  if (std::string wrong = wrongNumber(setting, ".x", value.x, range); !wrong.empty()) return wrong;
  if (std::string wrong = wrongNumber(setting, ".y", value.y, range); !wrong.empty()) return wrong;
  const bool whole = value.x == std::floor(value.x) && value.y == std::floor(value.y);
  if (setting.type != SettingType::IntegerPair || whole) return "";
  return fullName(setting) + " is " + pairText(value) + "; it must be two whole numbers";
}

std::string wrongText(const Setting& setting, const std::string& value) {
  const auto bytes = static_cast<std::size_t>(setting.high);
  if (setting.type == SettingType::Block) {
    if (value.size() <= bytes && value.find('\0') == std::string::npos) return "";
    return fullName(setting) + " has " + std::to_string(value.size()) + " bytes; it must be text of at most " +
           std::to_string(bytes);
  }
  const bool control = std::any_of(value.begin(), value.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7f;
  });
  if (!control && value.size() <= bytes) return "";
  return fullName(setting) + " is " + inQuotes(value) + "; it must be one line of at most " + std::to_string(bytes) +
         " bytes";
}

std::string wrongPictures(const Setting& setting, const std::vector<LampPicture>& pictures) {
  if (pictures.size() > static_cast<std::size_t>(setting.high)) {
    return fullName(setting) + " has " + std::to_string(pictures.size()) + " pictures; it may have up to " +
           numberText(setting.high);
  }
  Setting part = setting;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    std::string key = setting.key;
    key += "[" + std::to_string(k) + "].";
    const std::string file = key + "file", lamp = key + "lamp";
    part.type = SettingType::Text;
    part.key = file.c_str();
    part.high = kLine;
    if (std::string wrong = wrongText(part, pictures[k].file); !wrong.empty()) return wrong;
    if (pictures[k].file.empty()) return fullName(part) + " is empty; it must name a picture";
    if (!pictures[k].lamp) continue;
    part.type = SettingType::Number;
    part.unit = "degrees";
    part.key = lamp.c_str();
    if (std::string wrong = wrongNumber(part, ".x", pictures[k].lamp->x, {-360, 360}); !wrong.empty()) return wrong;
    if (std::string wrong = wrongNumber(part, ".y", pictures[k].lamp->y, {1, 90}); !wrong.empty()) return wrong;
  }
  return "";
}

std::string wrongChoice(const Setting& setting, const Field& field) {
  if (chosen(field) < splitWords(setting.choices).size()) return "";
  return fullName(setting) + " is number " + std::to_string(chosen(field)) + " of its choices; it must be " +
         choicesText(setting);
}

/// Says what is wrong with the value of a field, by the kind of field.
struct WrongValue {
  const Setting& setting;
  Range range;
  const Field& field;

  std::string operator()(std::monostate /*not there*/) const { return ""; }
  std::string operator()(const double* value) const { return wrongNumber(setting, "", *value, range); }
  std::string operator()(const int* value) const { return wrongNumber(setting, "", *value, range); }
  std::string operator()(const std::uint64_t* /*any*/) const { return ""; }
  std::string operator()(const bool* /*any*/) const { return ""; }
  std::string operator()(const std::string* value) const { return wrongText(setting, *value); }
  std::string operator()(const Vec2* value) const { return wrongPair(setting, *value, range); }
  std::string operator()(const std::optional<double>* value) const {
    return *value ? wrongNumber(setting, "", **value, range) : "";
  }
  std::string operator()(const std::optional<Vec2>* value) const {
    return *value ? wrongPair(setting, **value, range) : "";
  }
  std::string operator()(const std::vector<LampPicture>* value) const { return wrongPictures(setting, *value); }
  std::string operator()(const ChoiceField& /*value*/) const { return wrongChoice(setting, field); }
};

// ---- rules between settings of one section

std::string wrongShape(const Project& project) {
  if (project.shapeFile.empty() || project.builtin == BuiltinShape::None) return "";
  return "shape has both file " + inQuotes(project.shapeFile) + " and a builtin; it must have one of them";
}

std::string wrongDirections(const Project& project) {
  if (project.directionFile.empty() || project.pictures.files.empty()) return "";
  return "directions.file is " + inQuotes(project.directionFile) + " and pictures.files has " +
         inQuotes(project.pictures.files[0].file) + "; directions come from one of them";
}

std::string wrongPrint(const PrintParams& print) {
  if (print.firstLayerHeight == 0 || print.firstLayerHeight >= 0.05) return "";
  return "print.firstLayerHeight is " + numberText(print.firstLayerHeight) +
         " mm; it must be 0.05 to 1.6, or 0 for the height of the others";
}

std::string wrongPrinter(const Printer& printer) {
  const Vec2 size = printer.bedMax - printer.bedMin;
  constexpr Range kSide{10, 5000};
  if (!(std::min(size.x, size.y) >= kSide.low && std::max(size.x, size.y) <= kSide.high)) {
    return "printer.bedMax is " + pairText(printer.bedMax) +
           " mm; it must be 10 to 5000 mm right of and above bedMin " + pairText(printer.bedMin);
  }
  if (printer.roundBed && std::abs(size.x - size.y) > 1e-6) {
    return "printer.roundBed is true on a bed of " + numberText(size.x) + " x " + numberText(size.y) +
           " mm; it must be a square";
  }
  if (printer.machineSpeed > 0 && printer.machineSpeed < 5) {
    return "printer.machineSpeed is " + numberText(printer.machineSpeed) + " mm/s; it must be 5 to 1000, or 0";
  }
  if (const auto sizes = readThumbnailSizes(printer.screenSizes); !sizes) return "printer." + sizes.error().message;
  return "";
}

std::string wrongIn(const SettingsView& view) {
  for (const Setting& setting : settings()) {
    const Field field = setting.field(view);
    std::string wrong = std::visit(WrongValue{setting, rangeOf(setting, view), field}, field);
    if (!wrong.empty()) return wrong;
  }
  std::string wrong;
  if (view.project != nullptr) wrong = wrongShape(*view.project);
  if (wrong.empty() && view.project != nullptr) wrong = wrongDirections(*view.project);
  if (wrong.empty() && view.print != nullptr) wrong = wrongPrint(*view.print);
  if (wrong.empty() && view.printer != nullptr) wrong = wrongPrinter(*view.printer);
  return wrong;
}

}  // namespace

// Views are made for reading and writing alike; the validator only reads.
std::string invalidSettings(const Project& project) { return wrongIn(viewOf(const_cast<Project&>(project))); }

std::string invalidSettings(const ToolpathParams& toolpath) {
  SettingsView view;
  view.toolpath = &const_cast<ToolpathParams&>(toolpath);
  return wrongIn(view);
}

std::string invalidSettings(const Printer& printer, const PrintParams& print) {
  SettingsView view;
  view.printer = &const_cast<Printer&>(printer);
  view.print = &const_cast<PrintParams&>(print);
  return wrongIn(view);
}

}  // namespace sillon
