// The validator of all settings: the ranges of the table, and the rules between settings of one section. Rules between
// the settings of a whole print belong to the G-code: gcode/validation.cpp.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "settings/json.hpp"
#include "sillon/base/words.hpp"
#include "sillon/settings/project.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {
namespace {

constexpr double kLine = 1024;        // [bytes], length of a file's name
constexpr double kFurthest = 10'000;  // [mm], coordinate of a hole; as large as the side of a page

/// Allowed range of a number, with advice about values above it.
struct Range {
  double low;
  double high;
  const char* wayOut = "";  ///< advice in messages about values above the range
};

/// Returns the range of a setting. Most are the table's; temperatures depend on the printer's own limits and
/// generalHeatLimits.
Range rangeOf(const Setting& setting, const SettingsView& view) {
  if (setting.section == Section::Printer && view.printer != nullptr && !view.printer->generalHeatLimits) {
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

/// Checks one number against its range. \param part  ".x" or ".y" of a pair; otherwise empty.
Fault wrongNumber(const Setting& setting, const char* part, double value, Range range) {
  if (value >= range.low && value <= range.high) return std::nullopt;  // NaN fails here
  return settingOutOfRange(setting, value, range.low, range.high, value > range.high ? range.wayOut : "", part);
}

Fault wrongPair(const Setting& setting, Vec2 value, Range range) {
  if (Fault found = wrongNumber(setting, ".x", value.x, range)) return found;
  if (Fault found = wrongNumber(setting, ".y", value.y, range)) return found;
  const bool whole = value.x == std::floor(value.x) && value.y == std::floor(value.y);
  if (setting.type != SettingType::IntegerPair || whole) return std::nullopt;
  return refusedArgument("NotWholePair", {{"setting", fullName(setting)}, {"value", pairText(value)}});
}

/// Checks the length of a text, and its characters: blocks may have several lines, other texts must not.
Fault wrongText(const Setting& setting, const std::string& value) {
  const auto bytes = toSize(setting.high);
  if (setting.type == SettingType::Block) {
    if (value.size() <= bytes && value.find('\0') == std::string::npos) return std::nullopt;
    return refusedArgument("TextTooLong", {{"setting", fullName(setting)}, {"bytes", value.size()}, {"most", bytes}});
  }
  const bool control = std::any_of(value.begin(), value.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7f;
  });
  if (!control && value.size() <= bytes) return std::nullopt;
  return refusedArgument("NotOneLine", {{"setting", fullName(setting)}, {"value", inQuotes(value)}, {"most", bytes}});
}

Fault tooMany(const Setting& setting, std::size_t count) {
  if (count <= toSize(setting.high)) return std::nullopt;
  return refusedArgument("TooMany", {{"setting", fullName(setting)}, {"count", count}, {"most", setting.high}});
}

/// Checks the files and lamps of a list of pictures.
Fault wrongPictures(const Setting& setting, const std::vector<LampPicture>& pictures) {
  if (Fault found = tooMany(setting, pictures.size())) return found;
  Setting part = setting;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    std::string key = setting.key;
    key += "[" + std::to_string(k) + "].";
    const std::string file = key + "file", lamp = key + "lamp";
    part.type = SettingType::Text;
    part.key = file.c_str();
    part.high = kLine;
    if (Fault found = wrongText(part, pictures[k].file)) return found;
    if (pictures[k].file.empty()) return refusedArgument("FileNotNamed", {{"setting", fullName(part)}});
    if (!pictures[k].lamp) continue;
    part.type = SettingType::Number;
    part.unit = "degrees";
    part.key = lamp.c_str();
    if (Fault found = wrongNumber(part, ".x", pictures[k].lamp->x, {-360, 360})) return found;
    if (Fault found = wrongNumber(part, ".y", pictures[k].lamp->y, {1, 90})) return found;
  }
  return std::nullopt;
}

/// Checks centres and diameters of a list of holes.
Fault wrongHoles(const Setting& setting, const std::vector<RoundHole>& holes) {
  if (Fault found = tooMany(setting, holes.size())) return found;
  Setting part = setting;
  part.type = SettingType::Number;
  part.unit = "mm";
  for (std::size_t k = 0; k < holes.size(); ++k) {
    const std::string key = setting.key + ("[" + std::to_string(k) + "]");
    part.key = key.c_str();
    if (Fault found = wrongNumber(part, ".x", holes[k].centre.x, {-kFurthest, kFurthest})) return found;
    if (Fault found = wrongNumber(part, ".y", holes[k].centre.y, {-kFurthest, kFurthest})) return found;
    if (Fault found = wrongNumber(part, ".diameter", holes[k].diameter, {0.5, kFurthest})) return found;
  }
  return std::nullopt;
}

/// Checks colours and angles of a list.
Fault wrongColours(const Setting& setting, const std::vector<ColourAngle>& colours) {
  if (Fault found = tooMany(setting, colours.size())) return found;
  Setting part = setting;
  part.type = SettingType::Number;
  part.unit = "degrees";
  for (std::size_t k = 0; k < colours.size(); ++k) {
    const std::string& colour = colours[k].colour;
    const std::string key = setting.key + ("[" + std::to_string(k) + "].");
    const bool hex = colour.size() == 7 && colour[0] == '#' &&
                     colour.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
    if (!hex) {
      const std::string name = std::string(sectionName(setting.section)) + "." + key + "colour";
      return refusedArgument("NotColour", {{"setting", name}, {"value", inQuotes(colour)}});
    }
    const std::string angle = key + "angle";
    part.key = angle.c_str();
    if (Fault found = wrongNumber(part, "", colours[k].angle, {-360, 360})) return found;
  }
  return std::nullopt;
}

/// Checks brushes and points of a list of strokes.
Fault wrongStrokes(const Setting& setting, const std::vector<Stroke>& strokes) {
  if (Fault found = tooMany(setting, strokes.size())) return found;
  Setting part = setting;
  part.type = SettingType::Number;
  std::size_t points = 0;
  for (std::size_t k = 0; k < strokes.size(); ++k) {
    const std::string key = setting.key + ("[" + std::to_string(k) + "].");
    const auto within = [&](const char* name, const char* unit, double value, Range range) {
      const std::string full = key + name;
      part.key = full.c_str();
      part.unit = unit;
      return wrongNumber(part, "", value, range);
    };
    if (Fault found = within("radius", "mm", strokes[k].radius, {0.1, 1000})) return found;
    if (Fault found = within("soft", "", strokes[k].soft, {0, 1})) return found;
    for (const Vec2 point : strokes[k].points) {
      for (const double place : {point.x, point.y}) {
        if (Fault found = within("points", "mm", place, {-kFurthest, kFurthest})) return found;
      }
    }
    points += strokes[k].points.size();
  }
  if (points <= kMostStrokePoints) return std::nullopt;
  return refusedArgument("TooManyPoints",
                         {{"setting", fullName(setting)}, {"count", points}, {"most", kMostStrokePoints}});
}

Fault wrongChoice(const Setting& setting, const Field& field) {
  if (chosen(field) < splitWords(setting.choices).size()) return std::nullopt;
  return refusedArgument(
      "NotChoice",
      {{"setting", fullName(setting)}, {"value", std::to_string(chosen(field))}, {"choices", choicesText(setting)}});
}

/// Checks the value of a field, by the kind of field.
struct WrongValue {
  const Setting& setting;
  Range range;
  const Field& field;

  Fault operator()(std::monostate /*not there*/) const { return std::nullopt; }
  Fault operator()(const double* value) const { return wrongNumber(setting, "", *value, range); }
  Fault operator()(const int* value) const { return wrongNumber(setting, "", *value, range); }
  Fault operator()(const std::uint64_t* /*any*/) const { return std::nullopt; }
  Fault operator()(const bool* /*any*/) const { return std::nullopt; }
  Fault operator()(const std::string* value) const { return wrongText(setting, *value); }
  Fault operator()(const Vec2* value) const { return wrongPair(setting, *value, range); }
  Fault operator()(const std::optional<double>* value) const {
    return *value ? wrongNumber(setting, "", **value, range) : std::nullopt;
  }
  Fault operator()(const std::optional<Vec2>* value) const {
    return *value ? wrongPair(setting, **value, range) : std::nullopt;
  }
  Fault operator()(const std::vector<LampPicture>* value) const { return wrongPictures(setting, *value); }
  Fault operator()(const std::vector<RoundHole>* value) const { return wrongHoles(setting, *value); }
  Fault operator()(const std::vector<ColourAngle>* value) const { return wrongColours(setting, *value); }
  Fault operator()(const std::vector<Stroke>* value) const { return wrongStrokes(setting, *value); }
  Fault operator()(const ChoiceField& /*value*/) const { return wrongChoice(setting, field); }
};

// ---- Rules between settings of one section.

Fault wrongShape(const Project& project) {
  if (project.builtin == BuiltinShape::Text && project.shapeText.empty()) {
    return refusedArgument("TextMissing", {{"setting", "shape.text"}});
  }
  if (project.shapeFile.empty() || project.builtin == BuiltinShape::None) return std::nullopt;
  return refusedArgument("TwoShapes", {{"file", inQuotes(project.shapeFile)}});
}

Fault wrongPrint(const PrintParams& print) {
  if (print.firstLayerHeight == 0 || print.firstLayerHeight >= 0.05) return std::nullopt;
  const Setting& setting = *findSetting(Section::Print, "firstLayerHeight");
  return settingOutOfRange(setting, print.firstLayerHeight, 0.05, setting.high, ", or 0 for the height of the others");
}

/// Checks the bed, the speed of the machine and the sizes of thumbnails.
Fault wrongPrinter(const Printer& printer) {
  const Vec2 size = printer.bedMax - printer.bedMin;
  constexpr Range kSide{10, 5000};
  if (!(std::min(size.x, size.y) >= kSide.low && std::max(size.x, size.y) <= kSide.high)) {
    return refusedArgument("BedSides", {{"max", pairText(printer.bedMax)},
                                        {"min", pairText(printer.bedMin)},
                                        {"low", kSide.low},
                                        {"high", kSide.high}});
  }
  if (printer.roundBed && std::abs(size.x - size.y) > 1e-6) {
    return refusedArgument("RoundBedSides", {{"width", size.x}, {"depth", size.y}});
  }
  if (printer.machineSpeed > 0 && printer.machineSpeed < 5) {
    const Setting& setting = *findSetting(Section::Printer, "machineSpeed");
    return settingOutOfRange(setting, printer.machineSpeed, 5, setting.high, ", or 0");
  }
  if (const auto sizes = readThumbnailSizes(printer.screenSizes); !sizes) return sizes.error();
  return std::nullopt;
}

/// Refuses a visible layer that lacks its file, text, pictures or mask.
Fault lackingLayer(const Layer& layer) {
  const auto* file = layer.as<LayerFile>();
  const auto* words = layer.as<LayerWords>();
  const auto* pattern = layer.as<PatternLayer>();
  const auto* pictures = layer.as<PictureLayer>();
  const bool echo = pattern != nullptr && pattern->pattern == LayerPattern::Echo;
  if (echo && pattern->file.empty() && pattern->text.empty()) {
    return refusedArgument("EchoOfNothing");
  }
  if (pattern == nullptr && file != nullptr && file->file.empty()) {
    return refusedArgument("FileNotNamed", {{"setting", "layers.file"}});
  }
  if (pattern == nullptr && words != nullptr && words->text.empty()) {
    return refusedArgument("TextMissing", {{"setting", "layers.text"}});
  }
  if (pictures != nullptr && pictures->pictures.empty()) {
    return refusedArgument("PicturesMissing");
  }
  const bool masked = layer.mask == LayerMask::Inside || layer.mask == LayerMask::Outside;
  if (masked && layer.maskFile.empty()) return refusedArgument("FileNotNamed", {{"setting", "layers.maskFile"}});
  return std::nullopt;
}

Fault wrongLayer(const Layer& layer) {
  if (Fault found = layer.visible ? lackingLayer(layer) : std::nullopt) return found;
  const auto* crop = layer.as<LayerCrop>();
  if (crop == nullptr || (crop->cropMin.x < crop->cropMax.x && crop->cropMin.y < crop->cropMax.y)) return std::nullopt;
  return refusedArgument("CropReversed", {{"max", pairText(crop->cropMax)}, {"min", pairText(crop->cropMin)}});
}

Fault wrongIn(const SettingsView& view);

/// Checks the number of layers and each of them; errors name the layer.
Fault wrongLayers(const Project& project) {
  if (project.layers.size() > kMostLayers) {
    return refusedArgument("TooMany", {{"setting", "layers"}, {"count", project.layers.size()}, {"most", kMostLayers}});
  }
  for (std::size_t k = 0; k < project.layers.size(); ++k) {
    SettingsView view;
    view.layer = const_cast<Layer*>(&project.layers[k]);
    if (Fault found = wrongIn(view)) return inLayer(*std::move(found), k);
  }
  return std::nullopt;
}

/// Checks all settings of a view, then the rules between them. \return the first fault.
Fault wrongIn(const SettingsView& view) {
  for (const Setting& setting : settings()) {
    const Field field = setting.field(view);
    if (Fault found = std::visit(WrongValue{setting, rangeOf(setting, view), field}, field)) return found;
  }
  Fault found;
  if (view.project != nullptr) found = wrongShape(*view.project);
  if (!found && view.project != nullptr) found = wrongLayers(*view.project);
  if (!found && view.layer != nullptr) found = wrongLayer(*view.layer);
  if (!found && view.print != nullptr) found = wrongPrint(*view.print);
  if (!found && view.printer != nullptr) found = wrongPrinter(*view.printer);
  return found;
}

}  // namespace

// Views serve reading and writing alike, so const is cast away here; the validator only reads.
std::optional<Error> invalidSettings(const Project& project) { return wrongIn(viewOf(const_cast<Project&>(project))); }

std::optional<Error> invalidSettings(const ToolpathParams& toolpath) {
  SettingsView view;
  view.toolpath = &const_cast<ToolpathParams&>(toolpath);
  return wrongIn(view);
}

std::optional<Error> invalidSettings(const Printer& printer, const PrintParams& print) {
  SettingsView view;
  view.printer = &const_cast<Printer&>(printer);
  view.print = &const_cast<PrintParams&>(print);
  return wrongIn(view);
}

}  // namespace sillon
