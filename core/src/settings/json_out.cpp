#include "settings/json.hpp"

#include <cmath>

#include "base/json.hpp"
#include "sillon/base/words.hpp"

namespace sillon {
namespace {

/// Writes the value of a field as JSON. \param pad  line break and indent of list items; empty: lists stay on one line.
struct ValueJson {
  const Setting& setting;
  const Field& field;
  std::string pad;

  std::string operator()(std::monostate /*not there*/) const { return "null"; }
  std::string operator()(const double* value) const { return numberText(*value); }
  std::string operator()(const int* value) const { return std::to_string(*value); }
  std::string operator()(const std::uint64_t* value) const { return std::to_string(*value); }
  std::string operator()(const bool* value) const {
    if (setting.type == SettingType::Choice) return choice();
    return *value ? "true" : "false";
  }
  std::string operator()(const std::string* value) const { return jsonString(*value); }
  std::string operator()(const Vec2* value) const {
    if (pad.empty()) return pairText(*value);
    return "[\n" + pad + "  " + numberText(value->x) + ",\n" + pad + "  " + numberText(value->y) + "\n" + pad + "]";
  }
  std::string operator()(const std::optional<double>* value) const { return *value ? numberText(**value) : "null"; }
  std::string operator()(const std::optional<Vec2>* value) const { return *value ? (*this)(&**value) : "null"; }
  std::string operator()(const std::vector<LampPicture>* value) const {
    return list(*value, [](const LampPicture& one) {
      return "{\"file\": " + jsonString(one.file) + ", \"lamp\": " + (one.lamp ? pairText(*one.lamp) : "null") + "}";
    });
  }
  std::string operator()(const std::vector<RoundHole>* value) const {
    return list(*value, [](const RoundHole& one) {
      return "{\"x\": " + numberText(one.centre.x) + ", \"y\": " + numberText(one.centre.y) +
             ", \"diameter\": " + numberText(one.diameter) + "}";
    });
  }
  std::string operator()(const std::vector<ColourAngle>* value) const {
    return list(*value, [](const ColourAngle& one) {
      return "{\"colour\": " + jsonString(one.colour) + ", \"angle\": " + numberText(one.angle) + "}";
    });
  }
  std::string operator()(const std::vector<Stroke>* value) const {
    return list(*value, [](const Stroke& one) {
      const Setting& modes = *findSetting(Section::Layers, "mode");
      std::string points;
      for (const Vec2 point : one.points) {
        points += (points.empty() ? "" : ", ") + numberText(point.x) + ", " + numberText(point.y);
      }
      const bool mode = one.tool == StrokeTool::Mode || one.mode != Stroke().mode;
      return "{\"tool\": \"" + splitWords(kStrokeTools).at(toSize(one.tool)) +
             "\", \"radius\": " + numberText(one.radius) + ", \"soft\": " + numberText(one.soft) +
             (mode ? ", \"mode\": \"" + splitWords(modes.choices).at(toSize(one.mode)) + "\"" : "") +
             ", \"points\": [" + points + "]}";
    });
  }
  std::string operator()(const ChoiceField& /*value*/) const { return choice(); }

  template <class Item, class Text>
  std::string list(const std::vector<Item>& items, const Text& text) const {
    std::string out;
    for (const Item& item : items) {
      out += (out.empty() ? "" : pad.empty() ? ", " : ",") + (pad.empty() ? "" : "\n" + pad + "  ") + text(item);
    }
    return out.empty() || pad.empty() ? "[" + out + "]" : "[" + out + "\n" + pad + "]";
  }

  std::string choice() const { return "\"" + splitWords(setting.choices).at(chosen(field)) + "\""; }
};

const char* typeName(SettingType type) {
  constexpr const char* kNames[] = {"number", "integer",  "flag",  "choice",  "pair",    "integer pair", "text",
                                    "block",  "pictures", "holes", "colours", "strokes", "name"};
  return kNames[static_cast<std::size_t>(type)];
}

const char* levelName(Level level) {
  return level == Level::Basic ? "basic" : level == Level::Advanced ? "advanced" : "expert";
}

std::string listJson(const char* words) {
  std::string out;
  for (const std::string& word : splitWords(words)) out += (out.empty() ? "\"" : ", \"") + word + "\"";
  return "[" + out + "]";
}

/// Appends a member to an object. \param json  value as JSON text, quoted if it is text.
void add(std::string& object, const char* key, const std::string& json) {
  object += std::string(object.empty() ? "" : ", ") + "\"" + key + "\": " + json;
}

/// Describes a setting as JSON. \param kinds  kinds of layers that have it; empty: all.
std::string settingJson(const Setting& setting, const Field& field, const std::string& kinds) {
  const SettingType type = setting.type;
  const bool number = type == SettingType::Number || type == SettingType::Integer || type == SettingType::Pair ||
                      type == SettingType::IntegerPair;
  const bool nullable =
      std::holds_alternative<std::optional<double>*>(field) || std::holds_alternative<std::optional<Vec2>*>(field);
  std::string out;
  add(out, "section", jsonString(sectionName(setting.section)));
  add(out, "key", jsonString(setting.key));
  add(out, "type", jsonString(typeName(type)));
  add(out, "level", jsonString(levelName(setting.level)));
  if (!std::holds_alternative<std::monostate>(field)) {
    add(out, "default", std::visit(ValueJson{setting, field, ""}, field));
  }
  if (nullable) add(out, "nullable", "true");
  if (*setting.unit != '\0') add(out, "unit", jsonString(setting.unit));
  const bool seed = std::holds_alternative<std::uint64_t*>(field);  // its upper end is no double
  if (number) add(out, "low", numberText(setting.low));
  if (number) add(out, "high", seed ? std::to_string(UINT64_MAX) : numberText(setting.high));
  const bool list = type == SettingType::PictureList || type == SettingType::HoleList ||
                    type == SettingType::ColourList || type == SettingType::StrokeList;
  if (list) add(out, "most", numberText(setting.high));
  const bool text = type == SettingType::Text || type == SettingType::Block;
  if (text && setting.high > 0) add(out, "maxBytes", numberText(setting.high));
  if (*setting.choices != '\0') add(out, "choices", listJson(setting.choices));
  if (!kinds.empty()) add(out, "kinds", listJson(kinds.c_str()));
  const SettingWords words = wordsOf(setting);
  add(out, "label", jsonString(words.label));
  add(out, "help", jsonString(words.help));
  if (*words.option != '\0') add(out, "option", jsonString(words.option));
  return "    {" + out + "}";
}

/// Writes a layer on one line: its kind and all settings that differ from the defaults. The fill is also written beside
/// an angle, which would select the fill by angle otherwise.
std::string layerText(const Layer& layer) {
  Layer usual;
  SettingsView view, defaults;
  defaults.layer = &usual;
  choose(findSetting(Section::Layers, "kind")->field(defaults), layer.contents.index());
  view.layer = const_cast<Layer*>(&layer);
  std::string out;
  for (const Setting& setting : settings()) {
    if (setting.section != Section::Layers) continue;
    const Field field = setting.field(view), other = setting.field(defaults);
    if (std::holds_alternative<std::monostate>(field)) continue;
    const std::string json = std::visit(ValueJson{setting, field, ""}, field);
    const bool fill = setting.key == std::string_view("fill");
    const bool angled = fill && layer.as<LayerAngle>()->angle != usual.as<LayerAngle>()->angle;
    const bool told = out.empty() || angled || json != std::visit(ValueJson{setting, other, ""}, other);
    if (told) add(out, setting.key, json);
  }
  return "{" + out + "}";
}

std::string layersText(const std::vector<Layer>& layers) {
  std::string out;
  for (const Layer& layer : layers) out += (out.empty() ? "\n    " : ",\n    ") + layerText(layer);
  return out.empty() ? "[]" : "[" + out + "\n  ]";
}

}  // namespace

std::string numberText(double value) {
  if (std::isnan(value)) return "not a number";
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
  std::string text = jsonNumber(value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text;
}

std::string pairText(Vec2 value) {
  std::string out = "[";  // GCC 12 warns of "[" + numberText() here
  return out += numberText(value.x) + ", " + numberText(value.y) + "]";
}

std::string choicesText(const Setting& setting) {
  const std::vector<std::string> words = splitWords(setting.choices);
  std::string out;
  for (std::size_t k = 0; k < words.size(); ++k) {
    out += (k == 0 ? "" : k + 1 == words.size() ? " or " : ", ") + inQuotes(words[k]);
  }
  return out;
}

std::string settingText(const Setting& setting, const Project& project) {
  const Field field = setting.field(viewOf(const_cast<Project&>(project)));
  if (std::holds_alternative<std::monostate>(field)) return "";
  if (std::string* const* text = std::get_if<std::string*>(&field)) return **text;
  std::string json = std::visit(ValueJson{setting, field, ""}, field);
  return setting.type == SettingType::Choice ? json.substr(1, json.size() - 2) : json;
}

Error inLayer(Error error, std::size_t number) {
  const std::string_view section = "layers.";
  const std::size_t at = error.message.find(section);
  if (at != std::string::npos) error.message.insert(at + section.size() - 1, "[" + std::to_string(number) + "]");
  error.values.emplace_back("layer", static_cast<double>(number + 1));
  return error;
}

std::string projectText(const SettingsView& view) {
  std::string out = "{\n  \"sillon\": 1";
  const char* open = "";
  bool layers = view.project == nullptr || view.project->layers.empty();  // layers are written, or there are none
  for (const Setting& setting : settings()) {
    const Field field = setting.field(view);
    if (std::holds_alternative<std::monostate>(field)) continue;
    const char* section = sectionName(setting.section);
    if (!layers && setting.section > Section::Layers) {
      out += "\n  },\n  \"layers\": " + layersText(view.project->layers) + ",\n  \"" + section + "\": {\n";
      open = section;
      layers = true;
    } else if (std::string_view(section) == open) {
      out += ",\n";
    } else {
      out += std::string(*open == '\0' ? "" : "\n  }") + ",\n  \"" + section + "\": {\n";
      open = section;
    }
    out += std::string("    \"") + setting.key + "\": " + std::visit(ValueJson{setting, field, "    "}, field);
  }
  if (*open != '\0') out += "\n  }";
  if (view.project != nullptr && !view.project->studio.empty()) out += ",\n  \"studio\": " + view.project->studio;
  return out + "\n}\n";
}

std::string settingsJson() {
  Project defaults;
  SettingsView view = viewOf(defaults);
  const Setting& kind = *findSetting(Section::Layers, "kind");
  const std::vector<std::string> kinds = splitWords(kind.choices);
  std::string out;
  for (const Setting& setting : settings()) {
    std::string having;  // kinds of layers that have the setting
    std::vector<Layer> layers(kinds.size());
    Field field;
    for (std::size_t k = kinds.size(); k-- > 0;) {
      view.layer = &layers[k];
      choose(kind.field(view), k);
      Field one = setting.field(view);
      if (std::holds_alternative<std::monostate>(one)) continue;
      field = one;
      having = kinds[k] + (having.empty() ? "" : " ") + having;
    }
    const bool some = setting.section == Section::Layers && having != kind.choices;
    out += (out.empty() ? "" : ",\n") + settingJson(setting, field, some ? having : "");
  }
  return "{\n  \"version\": 1,\n  \"settings\": [\n" + out + "\n  ]\n}\n";
}

}  // namespace sillon
