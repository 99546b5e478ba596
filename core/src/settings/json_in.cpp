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

/// Reads an integer. \param low, high  range for the message
template <class Integer>
Fault wholeNumber(const Json& value, const std::string& name, Integer& out, const std::string& low,
                  const std::string& high) {
  if (!value.is_number()) return wrongType("NotWhole", name, value);
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
  if (fits) return std::nullopt;
  return refusedFile("NotWholeNumber", {{"setting", name}, {"value", jsonText(value)}, {"low", low}, {"high", high}});
}

Error missingKey(const std::string& place, const char* key) {
  return refusedFile("KeyMissing", {{"setting", place}, {"key", key}});
}

/// Reads the value of a field, by the kind of field.
struct ReadValue {
  const Setting& setting;
  const Field& field;
  const Json& value;
  const std::string name;

  Fault operator()(std::monostate /*not there*/) const { return std::nullopt; }
  Fault operator()(double* out) const { return readNumber(value, name, *out); }
  Fault operator()(int* out) const {
    return wholeNumber(value, name, *out, numberText(setting.low), numberText(setting.high));
  }
  Fault operator()(std::uint64_t* out) const { return readInteger(value, name, *out); }
  Fault operator()(bool* out) const {
    return setting.type == SettingType::Choice ? choice() : readFlag(value, name, *out);
  }
  Fault operator()(std::string* out) const { return readText(value, name, *out); }
  Fault operator()(Vec2* out) const {
    if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) {
      return wrongType("NotPair", name, value);
    }
    *out = {value[0].get<double>(), value[1].get<double>()};
    return std::nullopt;
  }
  Fault operator()(std::optional<double>* out) const {
    if (!value.is_number() && !value.is_null()) return wrongType("NotNumberOrNull", name, value);
    *out = value.is_null() ? std::nullopt : std::optional(value.get<double>());
    return std::nullopt;
  }
  Fault operator()(std::optional<Vec2>* out) const {
    if (value.is_null()) {
      out->reset();
      return std::nullopt;
    }
    Vec2 read;
    Fault wrong = (*this)(&read);
    if (!wrong) *out = read;
    return wrong;
  }
  Fault operator()(std::vector<LampPicture>* out) const {
    return list(*out, {"file", "lamp"},
                [this](const Json& one, const std::string& path, LampPicture& picture) -> Fault {
                  if (!one.contains("file")) return missingKey(path, "file");
                  Fault wrong = readText(one["file"], path + ".file", picture.file);
                  if (!wrong && one.contains("lamp")) wrong = other(one["lamp"], path + ".lamp")(&picture.lamp);
                  return wrong;
                });
  }
  Fault operator()(std::vector<RoundHole>* out) const {
    return list(*out, {"x", "y", "diameter"}, [](const Json& one, const std::string& path, RoundHole& hole) -> Fault {
      Fault wrong;
      for (const auto& [key, number] :
           {std::pair{"x", &hole.centre.x}, {"y", &hole.centre.y}, {"diameter", &hole.diameter}}) {
        if (!one.contains(key)) return missingKey(path, key);
        if (wrong = readNumber(one[key], path + "." + key, *number); wrong) break;
      }
      return wrong;
    });
  }
  Fault operator()(std::vector<ColourAngle>* out) const {
    return list(*out, {"colour", "angle"}, [](const Json& one, const std::string& path, ColourAngle& colour) -> Fault {
      if (!one.contains("colour")) return missingKey(path, "colour");
      Fault wrong = readText(one["colour"], path + ".colour", colour.colour);
      if (!wrong && one.contains("angle")) wrong = readNumber(one["angle"], path + ".angle", colour.angle);
      return wrong;
    });
  }
  Fault operator()(std::vector<Stroke>* out) const {
    const auto read = [](const Json& one, const std::string& path, Stroke& stroke) -> Fault {
      Fault wrong;
      const auto word = [&](const char* key, const Setting& choices, auto& field) {
        if (wrong || !one.contains(key)) return;
        const ChoiceField choice = choiceField(field);
        wrong = ReadValue{choices, choice, one[key], path + "." + key}.choice();
      };
      const auto number = [&](const char* key, double& field) {
        if (!wrong && one.contains(key)) wrong = readNumber(one[key], path + "." + key, field);
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
      if (wrong) return wrong;
      const auto points = one.find("points");
      if (points == one.end() || !points->is_array() || points->size() % 2 != 0) {
        return refusedFile("NotPoints", {{"setting", path + ".points"}});
      }
      for (std::size_t k = 0; k < points->size() && !wrong; k += 2) {
        Vec2& point = stroke.points.emplace_back();
        wrong = readNumber((*points)[k], path + ".points", point.x);
        if (!wrong) wrong = readNumber((*points)[k + 1], path + ".points", point.y);
      }
      return wrong;
    };
    return list(*out, {"tool", "radius", "soft", "mode", "points"}, read);
  }
  Fault operator()(const ChoiceField& /*out*/) const { return choice(); }

  /// Returns a reader of the same setting for another value.
  [[nodiscard]] ReadValue other(const Json& one, const std::string& path) const { return {setting, field, one, path}; }

  /// Reads a list of objects that have these keys.
  template <class Item, class Read>
  Fault list(std::vector<Item>& out, const std::vector<std::string>& keys, const Read& read) const {
    if (!value.is_array()) return wrongType("NotList", name, value);
    std::vector<Item> all;
    for (const Json& one : value) {
      const std::string path = name + "[" + std::to_string(all.size()) + "]";
      if (!one.is_object()) return wrongType("NotObject", path, one);
      if (Fault wrong = unknownKey(one, path + ".", keys)) return wrong;
      if (Fault wrong = read(one, path, all.emplace_back())) return wrong;
    }
    out = std::move(all);
    return std::nullopt;
  }

  Fault choice() const {
    if (!value.is_string()) {
      return refusedFile("NotChoice",
                         {{"setting", name}, {"value", value.type_name()}, {"choices", choicesText(setting)}});
    }
    const auto& text = value.get_ref<const std::string&>();
    const std::vector<std::string> words = splitWords(setting.choices);
    const auto found = std::find(words.begin(), words.end(), text);
    if (found == words.end()) {
      return refusedFile("NotChoice",
                         {{"setting", name}, {"value", inQuotes(text)}, {"choices", choicesText(setting)}});
    }
    choose(field, found - words.begin());
    return std::nullopt;
  }
};

/// Applies the values of a preset or profile, which later keys may override.
Fault applyNamed(const Setting& setting, const std::string& id, const SettingsView& view) {
  if (id.empty()) return std::nullopt;
  if (setting.section == Section::Toolpath) return applyPreset(id, *view.toolpath);
  const bool printer = setting.key == std::string_view("profile");
  return applyProfile(printer ? ProfileKind::Printer : ProfileKind::Filament, id, *view.printer);
}

/// Reads one setting; a name of a preset or profile also applies its values.
Fault readSetting(const Setting& setting, const Json& value, const std::string& name, const SettingsView& view) {
  const Field field = setting.field(view);
  if (setting.type != SettingType::Name) return std::visit(ReadValue{setting, field, value, name}, field);
  std::string id;
  if (Fault wrong = readText(value, name, id)) return wrong;
  if (std::string* const* out = std::get_if<std::string*>(&field)) **out = id;
  return applyNamed(setting, id, view);
}

/// Error for a setting that a layer of this kind does not have.
Error otherKind(const Setting& setting, const Layer& layer) {
  SettingsView view;
  view.layer = const_cast<Layer*>(&layer);
  std::string known;
  for (const Setting& other : settings()) {
    if (other.section != Section::Layers || std::holds_alternative<std::monostate>(other.field(view))) continue;
    known += (known.empty() ? "" : ", ") + std::string(other.key);
  }
  const Setting& kind = *findSetting(Section::Layers, "kind");
  return refusedFile("OtherKind", {{"setting", fullName(setting)},
                                   {"kind", inQuotes(splitWords(kind.choices)[layer.contents.index()])},
                                   {"known", known}});
}

}  // namespace

Error wrongType(Reason reason, std::string_view setting, const Json& value) {
  return refusedFile(reason, {{"setting", setting}, {"type", value.type_name()}});
}

Error unknownName(Reason near, Reason far, std::string_view setting, const std::string& name,
                  const std::vector<std::string>& known) {
  const std::vector<std::string> found = nearNames(name, known);
  const std::vector<std::string>& listed = found.empty() ? known : found;
  std::string names;
  for (const std::string& one : listed) names += (names.empty() ? "" : ", ") + (found.empty() ? one : inQuotes(one));
  return refusedFile(found.empty() ? far : near,
                     {{"setting", setting}, {"name", inQuotes(name)}, {found.empty() ? "known" : "near", names}});
}

Fault readText(const Json& value, const std::string& name, std::string& out) {
  if (!value.is_string()) return wrongType("NotText", name, value);
  out = value.get_ref<const std::string&>();
  return std::nullopt;
}

Fault readFlag(const Json& value, const std::string& name, bool& out) {
  if (!value.is_boolean()) return wrongType("NotFlag", name, value);
  out = value.get<bool>();
  return std::nullopt;
}

Fault readNumber(const Json& value, const std::string& name, double& out) {
  if (!value.is_number()) return wrongType("NotNumber", name, value);
  out = value.get<double>();
  return std::nullopt;
}

Fault readInteger(const Json& value, const std::string& name, int& out) {
  return wholeNumber(value, name, out, "-2147483648", "2147483647");
}

Fault readInteger(const Json& value, const std::string& name, std::uint64_t& out) {
  return wholeNumber(value, name, out, "0", "18446744073709551615");
}

Fault unknownKey(const Json& object, const std::string& prefix, const std::vector<std::string>& known) {
  for (const auto& item : object.items()) {
    if (std::find(known.begin(), known.end(), item.key()) != known.end()) continue;
    return unknownName("KeyLike", "KeyUnknown", inQuotes(prefix + item.key()), item.key(), known);
  }
  return std::nullopt;
}

Fault readLayers(const Json& value, Project& project) {
  if (!value.is_array()) return wrongType("NotList", "layers", value);
  if (value.size() > kMostLayers) {
    return refusedFile("TooMany", {{"setting", "layers"}, {"count", value.size()}, {"most", kMostLayers}});
  }
  project.layers.clear();
  for (const Json& one : value) {
    SettingsView view;
    view.layer = &project.layers.emplace_back();
    const std::size_t number = project.layers.size() - 1;
    if (!one.is_object()) return wrongType("NotObject", "layers[" + std::to_string(number) + "]", one);
    if (Fault wrong = readSection(one, Section::Layers, view)) return inLayer(*std::move(wrong), number);
    // An angle given without a fill selects the fill by angle; otherwise it would be lost silently.
    auto* filled = view.layer->as<LayerFilled>();
    if (filled != nullptr && one.contains("angle") && !one.contains("fill")) filled->fill = LayerFill::Angle;
  }
  return std::nullopt;
}

Fault readSection(const Json& value, Section section, const SettingsView& view) {
  const std::string sectionText = sectionName(section);
  if (!value.is_object()) return wrongType("NotObject", sectionText, value);
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
    if (Fault wrong = readSetting(setting, *found, fullName(setting), view)) return wrong;
    if (section == Section::Printer && setting.key == std::string_view("profile")) profile = found->get<std::string>();
  }
  // Pressure advance depends on filament and nozzle, which are known only now.
  if (!profile.empty() && !value.contains("pressureAdvance") && !value.contains("setPressureAdvance")) {
    applyAdvance(profile, *view.printer);
  }
  return unknownKey(value, sectionText + ".", known);
}

}  // namespace sillon
