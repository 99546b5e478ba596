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

using Wrong = std::optional<Error>;

Wrong wrong(std::string message) { return Error{ErrorCode::InvalidArgument, std::move(message)}; }

/// Checks one number against its range. \param part  ".x" or ".y" of a pair; otherwise empty.
Wrong wrongNumber(const Setting& setting, const char* part, double value, Range range) {
  if (value >= range.low && value <= range.high) return std::nullopt;  // NaN fails here
  return settingOutOfRange(setting, value, range.low, range.high, value > range.high ? range.wayOut : "", part);
}

Wrong wrongPair(const Setting& setting, Vec2 value, Range range) {
  if (Wrong found = wrongNumber(setting, ".x", value.x, range)) return found;
  if (Wrong found = wrongNumber(setting, ".y", value.y, range)) return found;
  const bool whole = value.x == std::floor(value.x) && value.y == std::floor(value.y);
  if (setting.type != SettingType::IntegerPair || whole) return std::nullopt;
  return wrong(fullName(setting) + " is " + pairText(value) + "; it must be two whole numbers");
}

/// Checks the length of a text, and its characters: blocks may have several lines, other texts must not.
Wrong wrongText(const Setting& setting, const std::string& value) {
  const std::size_t bytes = toSize(setting.high);
  if (setting.type == SettingType::Block) {
    if (value.size() <= bytes && value.find('\0') == std::string::npos) return std::nullopt;
    return wrong(fullName(setting) + " has " + std::to_string(value.size()) + " bytes; it must be text of at most " +
                 std::to_string(bytes));
  }
  const bool control = std::any_of(value.begin(), value.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7f;
  });
  if (!control && value.size() <= bytes) return std::nullopt;
  return wrong(fullName(setting) + " is " + inQuotes(value) + "; it must be one line of at most " +
               std::to_string(bytes) + " bytes");
}

Wrong tooMany(const Setting& setting, std::size_t count, const char* items) {
  if (count <= toSize(setting.high)) return std::nullopt;
  return wrong(fullName(setting) + " has " + std::to_string(count) + " " + items + "; it may have up to " +
               numberText(setting.high));
}

/// Checks the files and lamps of a list of pictures.
Wrong wrongPictures(const Setting& setting, const std::vector<LampPicture>& pictures) {
  if (Wrong found = tooMany(setting, pictures.size(), "pictures")) return found;
  Setting part = setting;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    std::string key = setting.key;
    key += "[" + std::to_string(k) + "].";
    const std::string file = key + "file", lamp = key + "lamp";
    part.type = SettingType::Text;
    part.key = file.c_str();
    part.high = kLine;
    if (Wrong found = wrongText(part, pictures[k].file)) return found;
    if (pictures[k].file.empty()) return wrong(fullName(part) + " is empty; it must name a picture");
    if (!pictures[k].lamp) continue;
    part.type = SettingType::Number;
    part.unit = "degrees";
    part.key = lamp.c_str();
    if (Wrong found = wrongNumber(part, ".x", pictures[k].lamp->x, {-360, 360})) return found;
    if (Wrong found = wrongNumber(part, ".y", pictures[k].lamp->y, {1, 90})) return found;
  }
  return std::nullopt;
}

/// Checks centres and diameters of a list of holes.
Wrong wrongHoles(const Setting& setting, const std::vector<RoundHole>& holes) {
  if (Wrong found = tooMany(setting, holes.size(), "holes")) return found;
  Setting part = setting;
  part.type = SettingType::Number;
  part.unit = "mm";
  for (std::size_t k = 0; k < holes.size(); ++k) {
    const std::string key = setting.key + ("[" + std::to_string(k) + "]");
    part.key = key.c_str();
    if (Wrong found = wrongNumber(part, ".x", holes[k].centre.x, {-kFurthest, kFurthest})) return found;
    if (Wrong found = wrongNumber(part, ".y", holes[k].centre.y, {-kFurthest, kFurthest})) return found;
    if (Wrong found = wrongNumber(part, ".diameter", holes[k].diameter, {0.5, kFurthest})) return found;
  }
  return std::nullopt;
}

/// Checks colours and angles of a list.
Wrong wrongColours(const Setting& setting, const std::vector<ColourAngle>& colours) {
  if (Wrong found = tooMany(setting, colours.size(), "colours")) return found;
  Setting part = setting;
  part.type = SettingType::Number;
  part.unit = "degrees";
  for (std::size_t k = 0; k < colours.size(); ++k) {
    const std::string& colour = colours[k].colour;
    const std::string key = setting.key + ("[" + std::to_string(k) + "].");
    const bool hex = colour.size() == 7 && colour[0] == '#' &&
                     colour.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
    if (!hex) {
      return wrong(std::string(sectionName(setting.section)) + "." + key + "colour is " + inQuotes(colour) +
                   "; it must be \"#rrggbb\"");
    }
    const std::string angle = key + "angle";
    part.key = angle.c_str();
    if (Wrong found = wrongNumber(part, "", colours[k].angle, {-360, 360})) return found;
  }
  return std::nullopt;
}

/// Checks brushes and points of a list of strokes.
Wrong wrongStrokes(const Setting& setting, const std::vector<Stroke>& strokes) {
  if (Wrong found = tooMany(setting, strokes.size(), "strokes")) return found;
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
    if (Wrong found = within("radius", "mm", strokes[k].radius, {0.1, 1000})) return found;
    if (Wrong found = within("soft", "", strokes[k].soft, {0, 1})) return found;
    for (const Vec2 point : strokes[k].points) {
      for (const double place : {point.x, point.y}) {
        if (Wrong found = within("points", "mm", place, {-kFurthest, kFurthest})) return found;
      }
    }
    points += strokes[k].points.size();
  }
  if (points <= kMostStrokePoints) return std::nullopt;
  return wrong(fullName(setting) + " have " + std::to_string(points) + " points; they may have up to " +
               std::to_string(kMostStrokePoints));
}

Wrong wrongChoice(const Setting& setting, const Field& field) {
  if (chosen(field) < splitWords(setting.choices).size()) return std::nullopt;
  return wrong(fullName(setting) + " is number " + std::to_string(chosen(field)) + " of its choices; it must be " +
               choicesText(setting));
}

/// Checks the value of a field, by the kind of field.
struct WrongValue {
  const Setting& setting;
  Range range;
  const Field& field;

  Wrong operator()(std::monostate /*not there*/) const { return std::nullopt; }
  Wrong operator()(const double* value) const { return wrongNumber(setting, "", *value, range); }
  Wrong operator()(const int* value) const { return wrongNumber(setting, "", *value, range); }
  Wrong operator()(const std::uint64_t* /*any*/) const { return std::nullopt; }
  Wrong operator()(const bool* /*any*/) const { return std::nullopt; }
  Wrong operator()(const std::string* value) const { return wrongText(setting, *value); }
  Wrong operator()(const Vec2* value) const { return wrongPair(setting, *value, range); }
  Wrong operator()(const std::optional<double>* value) const {
    return *value ? wrongNumber(setting, "", **value, range) : std::nullopt;
  }
  Wrong operator()(const std::optional<Vec2>* value) const {
    return *value ? wrongPair(setting, **value, range) : std::nullopt;
  }
  Wrong operator()(const std::vector<LampPicture>* value) const { return wrongPictures(setting, *value); }
  Wrong operator()(const std::vector<RoundHole>* value) const { return wrongHoles(setting, *value); }
  Wrong operator()(const std::vector<ColourAngle>* value) const { return wrongColours(setting, *value); }
  Wrong operator()(const std::vector<Stroke>* value) const { return wrongStrokes(setting, *value); }
  Wrong operator()(const ChoiceField& /*value*/) const { return wrongChoice(setting, field); }
};

// ---- Rules between settings of one section.

Wrong wrongShape(const Project& project) {
  if (project.builtin == BuiltinShape::Text && project.shapeText.empty()) {
    return wrong("shape.text is empty; the shape \"text\" must have letters");
  }
  if (project.shapeFile.empty() || project.builtin == BuiltinShape::None) return std::nullopt;
  return wrong("shape has both file " + inQuotes(project.shapeFile) + " and a builtin; it must have one of them");
}

Wrong wrongPrint(const PrintParams& print) {
  if (print.firstLayerHeight == 0 || print.firstLayerHeight >= 0.05) return std::nullopt;
  const Setting& setting = *findSetting(Section::Print, "firstLayerHeight");
  return settingOutOfRange(setting, print.firstLayerHeight, 0.05, setting.high, ", or 0 for the height of the others");
}

/// Checks the bed, the speed of the machine and the sizes of thumbnails.
Wrong wrongPrinter(const Printer& printer) {
  const Vec2 size = printer.bedMax - printer.bedMin;
  constexpr Range kSide{10, 5000};
  if (!(std::min(size.x, size.y) >= kSide.low && std::max(size.x, size.y) <= kSide.high)) {
    return wrong("printer.bedMax is " + pairText(printer.bedMax) +
                 " mm; it must be 10 to 5000 mm right of and above bedMin " + pairText(printer.bedMin));
  }
  if (printer.roundBed && std::abs(size.x - size.y) > 1e-6) {
    return wrong("printer.roundBed is true on a bed of " + numberText(size.x) + " x " + numberText(size.y) +
                 " mm; it must be a square");
  }
  if (printer.machineSpeed > 0 && printer.machineSpeed < 5) {
    const Setting& setting = *findSetting(Section::Printer, "machineSpeed");
    return settingOutOfRange(setting, printer.machineSpeed, 5, setting.high, ", or 0");
  }
  if (const auto sizes = readThumbnailSizes(printer.screenSizes); !sizes)
    return wrong("printer." + sizes.error().message);
  return std::nullopt;
}

/// Refuses a visible layer that lacks its file, text, pictures or mask.
Wrong lackingLayer(const Layer& layer) {
  const auto* file = layer.as<LayerFile>();
  const auto* words = layer.as<LayerWords>();
  const auto* pattern = layer.as<PatternLayer>();
  const auto* pictures = layer.as<PictureLayer>();
  const bool echo = pattern != nullptr && pattern->pattern == LayerPattern::Echo;
  if (echo && pattern->file.empty() && pattern->text.empty()) {
    return wrong("layers.file is empty; an echo must name a drawing, or have letters in layers.text");
  }
  if (pattern == nullptr && file != nullptr && file->file.empty()) {
    return wrong("layers.file is empty; it must name a picture or a drawing");
  }
  if (pattern == nullptr && words != nullptr && words->text.empty()) {
    return wrong("layers.text is empty; it must have letters");
  }
  if (pictures != nullptr && pictures->pictures.empty()) {
    return wrong("layers.pictures is empty; it must have at least one picture");
  }
  const bool masked = layer.mask == LayerMask::Inside || layer.mask == LayerMask::Outside;
  if (masked && layer.maskFile.empty()) return wrong("layers.maskFile is empty; it must name a drawing");
  return std::nullopt;
}

Wrong wrongLayer(const Layer& layer) {
  if (Wrong found = layer.visible ? lackingLayer(layer) : std::nullopt) return found;
  const auto* crop = layer.as<LayerCrop>();
  if (crop == nullptr || (crop->cropMin.x < crop->cropMax.x && crop->cropMin.y < crop->cropMax.y)) return std::nullopt;
  return wrong("layers.cropMax is " + pairText(crop->cropMax) + "; it must be right of and above cropMin " +
               pairText(crop->cropMin));
}

Wrong wrongIn(const SettingsView& view);

/// Checks the number of layers and each of them; errors name the layer.
Wrong wrongLayers(const Project& project) {
  if (project.layers.size() > kMostLayers) {
    return wrong("the project has " + std::to_string(project.layers.size()) + " layers; it may have up to " +
                 std::to_string(kMostLayers));
  }
  for (std::size_t k = 0; k < project.layers.size(); ++k) {
    SettingsView view;
    view.layer = const_cast<Layer*>(&project.layers[k]);
    Wrong found = wrongIn(view);
    if (!found) continue;
    found->message = inLayer(found->message, k);
    return found;
  }
  return std::nullopt;
}

/// Checks all settings of a view, then the rules between them. \return the first fault.
Wrong wrongIn(const SettingsView& view) {
  for (const Setting& setting : settings()) {
    const Field field = setting.field(view);
    if (Wrong found = std::visit(WrongValue{setting, rangeOf(setting, view), field}, field)) return found;
  }
  Wrong found;
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
