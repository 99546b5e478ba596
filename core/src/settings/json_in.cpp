#include "settings/json.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "base/json.hpp"
#include "sillon/base/words.hpp"
#include "sillon/settings/presets.hpp"

namespace sillon {
namespace {

std::string wrongType(const std::string& name, const std::string& wanted, const Json& value) {
  return name + " is " + typeName(value) + "; it must be " + wanted;
}

/// Reads an integer. \param range  range for the message, such as " from 1 to 1000".
template <class Integer>
std::string wholeNumber(const Json& value, const std::string& name, Integer& out, const std::string& range) {
  if (!value.is_number()) return wrongType(name, "a whole number", value);
  constexpr auto kLow = std::numeric_limits<Integer>::min();
  constexpr auto kHigh = std::numeric_limits<Integer>::max();
  bool fits = false;
  if (value.is_number_unsigned()) {
    const auto whole = value.get<std::uint64_t>();
    fits = whole <= static_cast<std::uint64_t>(kHigh);
    if (fits) out = static_cast<Integer>(whole);
  } else if (value.is_number_integer()) {  // negative integers
    const auto whole = value.get<std::int64_t>();
    fits = std::is_signed_v<Integer> && whole >= static_cast<std::int64_t>(kLow);
    if (fits) out = static_cast<Integer>(whole);
  } else {  // 7.0 is an integer, too; beyond 2^53 it may not be the one that was meant
    const auto real = value.get<double>();
    fits = std::floor(real) == real && real >= static_cast<double>(kLow) &&
           real <= std::min(static_cast<double>(kHigh), 9007199254740992.0);
    if (fits) out = static_cast<Integer>(real);
  }
  return fits ? "" : name + " is " + jsonText(value) + "; it must be a whole number" + range;
}

constexpr const char* kSeedRange = " from 0 to 18446744073709551615";

/// Reads the value of a field, by the kind of field.
struct ReadValue {
  const Setting& setting;
  const Field& field;
  const Json& value;
  const std::string name;

  std::string operator()(std::monostate /*not there*/) const { return ""; }
  std::string operator()(double* out) const { return readNumber(value, name, *out); }
  std::string operator()(int* out) const {
    return wholeNumber(value, name, *out, " from " + numberText(setting.low) + " to " + numberText(setting.high));
  }
  std::string operator()(std::uint64_t* out) const { return readInteger(value, name, *out); }
  std::string operator()(bool* out) const {
    return setting.type == SettingType::Choice ? choice() : readFlag(value, name, *out);
  }
  std::string operator()(std::string* out) const { return readText(value, name, *out); }
  std::string operator()(Vec2* out) const {
    if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) {
      return wrongType(name, "two numbers [x, y]", value);
    }
    *out = {value[0].get<double>(), value[1].get<double>()};
    return "";
  }
  std::string operator()(std::optional<double>* out) const {
    if (!value.is_number() && !value.is_null()) return wrongType(name, "a number or null", value);
    *out = value.is_null() ? std::nullopt : std::optional(value.get<double>());
    return "";
  }
  std::string operator()(std::optional<Vec2>* out) const {
    if (value.is_null()) {
      out->reset();
      return "";
    }
    Vec2 read;
    std::string wrong = (*this)(&read);
    if (wrong.empty()) *out = read;
    return wrong;
  }
  std::string operator()(std::vector<LampPicture>* out) const {
    return list(*out, "pictures", {"file", "lamp"},
                [this](const Json& one, const std::string& path, LampPicture& picture) {
                  if (!one.contains("file")) return path + " has no file; it must name a picture";
                  std::string wrong = readText(one["file"], path + ".file", picture.file);
                  if (wrong.empty() && one.contains("lamp")) wrong = other(one["lamp"], path + ".lamp")(&picture.lamp);
                  return wrong;
                });
  }
  std::string operator()(std::vector<RoundHole>* out) const {
    return list(*out, "holes", {"x", "y", "diameter"}, [](const Json& one, const std::string& path, RoundHole& hole) {
      std::string wrong;
      for (const auto& [key, number] :
           {std::pair{"x", &hole.centre.x}, {"y", &hole.centre.y}, {"diameter", &hole.diameter}}) {
        if (!one.contains(key)) return path + " has no " + key + "; it must have x, y and diameter in mm";
        if (wrong = readNumber(one[key], path + "." + key, *number); !wrong.empty()) break;
      }
      return wrong;
    });
  }
  std::string operator()(std::vector<ColourAngle>* out) const {
    return list(*out, "colours", {"colour", "angle"},
                [](const Json& one, const std::string& path, ColourAngle& colour) {
                  if (!one.contains("colour")) return path + " has no colour; it must be \"#rrggbb\"";
                  std::string wrong = readText(one["colour"], path + ".colour", colour.colour);
                  if (wrong.empty() && one.contains("angle"))
                    wrong = readNumber(one["angle"], path + ".angle", colour.angle);
                  return wrong;
                });
  }
  std::string operator()(std::vector<Stroke>* out) const {
    const auto read = [](const Json& one, const std::string& path, Stroke& stroke) {
      std::string wrong;
      const auto word = [&](const char* key, const Setting& choices, auto& field) {
        if (!wrong.empty() || !one.contains(key)) return;
        const ChoiceField choice = choiceField(field);
        wrong = ReadValue{choices, choice, one[key], path + "." + key}.choice();
      };
      const auto number = [&](const char* key, double& field) {
        if (wrong.empty() && one.contains(key)) wrong = readNumber(one[key], path + "." + key, field);
      };
      constexpr Setting kTools{.section = Section::Layers,
                               .key = "tool",
                               .type = SettingType::Choice,
                               .field = nullptr,
                               .choices = kStrokeTools};
      word("tool", kTools, stroke.tool);
      word("mode", *findSetting(Section::Layers, "mode"), stroke.mode);
      number("radius", stroke.radius);
      number("soft", stroke.soft);
      if (!wrong.empty()) return wrong;
      const auto points = one.find("points");
      if (points == one.end() || !points->is_array() || points->size() % 2 != 0) {
        return path + ".points must be a list of numbers x, y, x, y, ... in mm";
      }
      for (std::size_t k = 0; k < points->size() && wrong.empty(); k += 2) {
        Vec2& point = stroke.points.emplace_back();
        wrong = readNumber((*points)[k], path + ".points", point.x);
        if (wrong.empty()) wrong = readNumber((*points)[k + 1], path + ".points", point.y);
      }
      return wrong;
    };
    return list(*out, "strokes", {"tool", "radius", "soft", "mode", "points"}, read);
  }
  std::string operator()(const ChoiceField& /*out*/) const { return choice(); }

  /// Returns a reader of the same setting for another value.
  [[nodiscard]] ReadValue other(const Json& one, const std::string& path) const { return {setting, field, one, path}; }

  /// Reads a list of objects that have these keys.
  template <class Item, class Read>
  std::string list(std::vector<Item>& out, const char* items, const std::vector<std::string>& keys,
                   const Read& read) const {
    if (!value.is_array()) return wrongType(name, std::string("a list of ") + items, value);
    std::vector<Item> all;
    for (const Json& one : value) {
      const std::string path = name + "[" + std::to_string(all.size()) + "]";
      if (!one.is_object()) return wrongType(path, "an object with " + keys.front() + " and " + keys.back(), one);
      if (std::string wrong = unknownKey(one, path + ".", keys); !wrong.empty()) return wrong;
      if (std::string wrong = read(one, path, all.emplace_back()); !wrong.empty()) return wrong;
    }
    out = std::move(all);
    return "";
  }

  std::string choice() const {
    if (!value.is_string()) return wrongType(name, choicesText(setting), value);
    const auto& text = value.get_ref<const std::string&>();
    const std::vector<std::string> words = splitWords(setting.choices);
    const auto found = std::find(words.begin(), words.end(), text);
    if (found == words.end()) return name + " is " + inQuotes(text) + "; it must be " + choicesText(setting);
    choose(field, found - words.begin());
    return "";
  }
};

/// Applies the values of a preset or profile, which later keys may override.
std::string applyNamed(const Setting& setting, const std::string& id, const SettingsView& view) {
  if (id.empty()) return "";
  if (setting.section == Section::Toolpath) return applyPreset(id, *view.toolpath);
  const bool printer = setting.key == std::string_view("profile");
  return applyProfile(printer ? ProfileKind::Printer : ProfileKind::Filament, id, *view.printer);
}

/// Reads one setting; a name of a preset or profile also applies its values.
std::string readSetting(const Setting& setting, const Json& value, const std::string& name, const SettingsView& view) {
  const Field field = setting.field(view);
  if (setting.type != SettingType::Name) return std::visit(ReadValue{setting, field, value, name}, field);
  std::string id;
  if (std::string wrong = readText(value, name, id); !wrong.empty()) return wrong;
  if (std::string* const* out = std::get_if<std::string*>(&field)) **out = id;
  const std::string wrong = applyNamed(setting, id, view);
  return wrong.empty() ? "" : name + ": " + wrong;
}

/// Message about a setting that a layer of this kind does not have.
std::string otherKind(const Setting& setting, const Layer& layer) {
  SettingsView view;
  view.layer = const_cast<Layer*>(&layer);
  std::string known;
  for (const Setting& other : settings()) {
    if (other.section != Section::Layers || std::holds_alternative<std::monostate>(other.field(view))) continue;
    known += (known.empty() ? "" : ", ") + std::string(other.key);
  }
  const Setting& kind = *findSetting(Section::Layers, "kind");
  return fullName(setting) + " is not for the kind " + inQuotes(splitWords(kind.choices)[layer.contents.index()]) +
         "; it has " + known;
}

}  // namespace

const char* typeName(const Json& value) {
  if (value.is_null()) return "null";
  if (value.is_boolean()) return "true or false";
  if (value.is_number()) return "a number";
  if (value.is_string()) return "text";
  return value.is_array() ? "a list" : "an object";
}

std::string readText(const Json& value, const std::string& name, std::string& out) {
  if (!value.is_string()) return wrongType(name, "text", value);
  out = value.get_ref<const std::string&>();
  return "";
}

std::string readFlag(const Json& value, const std::string& name, bool& out) {
  if (!value.is_boolean()) return wrongType(name, "true or false", value);
  out = value.get<bool>();
  return "";
}

std::string readNumber(const Json& value, const std::string& name, double& out) {
  if (!value.is_number()) return wrongType(name, "a number", value);
  out = value.get<double>();
  return "";
}

std::string readInteger(const Json& value, const std::string& name, int& out) {
  return wholeNumber(value, name, out, "");
}

std::string readInteger(const Json& value, const std::string& name, std::uint64_t& out) {
  return wholeNumber(value, name, out, kSeedRange);
}

std::string unknownKey(const Json& object, const std::string& prefix, const std::vector<std::string>& known) {
  for (const auto& item : object.items()) {
    if (std::find(known.begin(), known.end(), item.key()) != known.end()) continue;
    return "unknown key " + inQuotes(prefix + item.key()) + "; " + suggestion(item.key(), known);
  }
  return "";
}

std::string readLayers(const Json& value, Project& project) {
  if (!value.is_array()) return wrongType("layers", "a list of layers", value);
  if (value.size() > kMostLayers) {
    return "layers has " + std::to_string(value.size()) + " entries; it may have up to " + std::to_string(kMostLayers);
  }
  project.layers.clear();
  for (const Json& one : value) {
    SettingsView view;
    view.layer = &project.layers.emplace_back();
    const std::size_t number = project.layers.size() - 1;
    if (!one.is_object()) return wrongType("layers[" + std::to_string(number) + "]", "an object", one);
    if (std::string wrong = readSection(one, Section::Layers, view); !wrong.empty()) return inLayer(wrong, number);
    // An angle given without a fill selects the fill by angle; otherwise it would be lost silently.
    auto* filled = view.layer->as<LayerFilled>();
    if (filled != nullptr && one.contains("angle") && !one.contains("fill")) filled->fill = LayerFill::Angle;
  }
  return "";
}

std::string readSection(const Json& value, Section section, const SettingsView& view) {
  const std::string sectionText = sectionName(section);
  if (!value.is_object()) return wrongType(sectionText, "an object", value);
  std::vector<std::string> known;
  std::string profile;
  for (const Setting& setting : settings()) {
    if (setting.section != section) continue;
    known.emplace_back(setting.key);
    const auto found = value.find(setting.key);
    if (found == value.end()) continue;
    if (section == Section::Layers && std::holds_alternative<std::monostate>(setting.field(view))) {
      return otherKind(setting, *view.layer);
    }
    if (std::string wrong = readSetting(setting, *found, fullName(setting), view); !wrong.empty()) return wrong;
    if (section == Section::Printer && setting.key == std::string_view("profile")) profile = found->get<std::string>();
  }
  // Pressure advance depends on filament and nozzle, which are known only now.
  if (!profile.empty() && !value.contains("pressureAdvance") && !value.contains("setPressureAdvance")) {
    applyAdvance(profile, *view.printer);
  }
  return unknownKey(value, sectionText + ".", known);
}

}  // namespace sillon
