// Reads files of a person's own spools (docs/reference/spools.md). They may come from anywhere, so that everything is
// checked.
#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "base/json.hpp"
#include "base/refused.hpp"
#include "sillon/base/words.hpp"
#include "sillon/look/appearance.hpp"

namespace sillon {
namespace {

// Limits that bound the work of reading a file.
constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr std::size_t kMostSpools = 1000;
constexpr std::size_t kLongestKey = 40;
// The range of pictures.slopes [degrees].
constexpr double kLeastSlope = 0.1;
constexpr double kMostSlope = 45;

// Forms of values, as in the file. Slopes are degrees: along the bead, across it.
constexpr char kSlopesForm[] = "[0.1 ... 45, 0.1 ... 45]";
constexpr char kSidesForm[] = "{\"nozzleSide\": [0.1 ... 45, 0.1 ... 45], \"bedSide\": [0.1 ... 45, 0.1 ... 45]}";
constexpr char kColourForm[] = "[0 ... 255, 0 ... 255, 0 ... 255]";
constexpr char kSpoolForm[] = "{\"colour\": [...], \"fine\": {...}, \"wide\": {...}, \"source\": \"...\"}";
constexpr char kFileForm[] = "{\"version\": 1, \"spools\": {...}}";

// Refuses a value for its form. \param where  path of the value  \param form  as in the file
Error wrongForm(std::string_view where, const char* form) {
  return refusedFile("SpoolForm", {{"where", where}, {"form", form}});
}

// Refuses a key that the form does not have.
Error otherKey(std::string_view where, std::string_view key, const char* form) {
  return refusedFile("SpoolKey", {{"where", where}, {"key", inQuotes(key)}, {"form", form}});
}

Error wrongFile() { return refusedFile("SpoolFile", {{"form", kFileForm}}); }

// Parses the text, or tells in words what is wrong with it. Repeated keys are errors: the library would silently keep
// only the last one.
Result<Json> parsed(std::string_view text) {
  if (text.size() > kMaxBytes) return fileTooLarge(text.size(), kMaxBytes);
  // Keys of each object that is open, from the outermost one in.
  std::vector<std::set<std::string>> keys;
  std::string twice;
  const auto look = [&](int /*depth*/, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(value.get_ref<const std::string&>()).second &&
        twice.empty()) {
      twice = value.get<std::string>();
    }
    return true;
  };
  Json json = Json::parse(text.begin(), text.end(), look, false);
  if (json.is_discarded()) return wrongFile();
  if (!twice.empty()) return refusedFile("KeyTwice", {{"key", inQuotes(twice)}});
  return json;
}

/// Finds the first key that is none of the words.
std::optional<std::string> unknownKey(const Json& object, std::initializer_list<const char*> words) {
  for (const auto& item : object.items()) {
    const bool known = std::any_of(words.begin(), words.end(), [&](const char* word) { return item.key() == word; });
    if (!known) return item.key();
  }
  return std::nullopt;
}

/// Reads one side's pair of slopes. \param name  path of the object, for messages.
std::optional<Error> readSlopes(const Json& sides, const char* side, const std::string& name, Roughness& out) {
  const std::string what = name + "." + side;
  const auto found = sides.find(side);
  const bool pair = found != sides.end() && found->is_array() && found->size() == 2 && (*found)[0].is_number() &&
                    (*found)[1].is_number();
  if (!pair) return wrongForm(what, kSlopesForm);
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    const double slope = (*found)[k].get<double>();
    if (slope >= kLeastSlope && slope <= kMostSlope) continue;
    Error error = outOfRange(what + "[" + std::to_string(k) + "]", slope, kLeastSlope, kMostSlope, "degrees");
    error.code = ErrorCode::InvalidFile;
    return error;
  }
  out = {(*found)[0].get<double>(), (*found)[1].get<double>()};
  return std::nullopt;
}

/// Reads the slopes of both sides for one nozzle size.
std::optional<Error> readSides(const Json& spool, const char* nozzle, const std::string& name, SideRoughness& out) {
  const std::string what = name + "." + nozzle;
  const Json& sides = spool[nozzle];
  if (!sides.is_object()) return wrongForm(what, kSidesForm);
  if (const auto key = unknownKey(sides, {"nozzleSide", "bedSide"})) return otherKey(what, *key, kSidesForm);
  if (auto error = readSlopes(sides, "nozzleSide", what, out.nozzleSide)) return error;
  return readSlopes(sides, "bedSide", what, out.bedSide);
}

/// Reads one spool. Its key must not be one that comes with the program, which it would replace silently.
Result<Spool> readSpool(const std::string& key, const Json& json) {
  const std::string name = "spools[" + inQuotes(key) + "]";
  // Keys are words of the command line and of projects, so that they hold no spaces.
  const bool plain = !key.empty() && key.size() <= kLongestKey && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
  if (!plain) return refusedFile("SpoolName", {{"where", name}});
  if (findSpool(key) != nullptr) return refusedFile("SpoolTaken", {{"where", name}});
  if (!json.is_object()) return wrongForm(name, kSpoolForm);
  if (const auto other = unknownKey(json, {"colour", "fine", "wide", "source"})) {
    return otherKey(name, *other, kSpoolForm);
  }
  if (json.contains("source") && !json["source"].is_string()) return wrongForm(name + ".source", "\"...\"");
  Spool spool;
  spool.key = key;
  const Json colour = json.value("colour", Json());
  bool rgb = colour.is_array() && colour.size() == 3;
  for (std::size_t k = 0; rgb && k < 3; ++k) {
    rgb = colour[k].is_number_unsigned() && colour[k].get<std::uint64_t>() <= 255;
    if (rgb) spool.colour[k] = colour[k].get<std::uint8_t>();
  }
  if (!rgb) return wrongForm(name + ".colour", kColourForm);
  if (!json.contains("fine")) return wrongForm(name + ".fine", kSidesForm);
  if (auto error = readSides(json, "fine", name, spool.fine)) return *error;
  // Without figures for a wide nozzle those for a fine one serve.
  spool.wide = spool.fine;
  if (json.contains("wide")) {
    if (auto error = readSides(json, "wide", name, spool.wide)) return *error;
  }
  return spool;
}

}  // namespace

Result<std::vector<Spool>> readSpools(std::string_view text) {
  const Result<Json> json = parsed(text);
  if (!json) return json.error();
  const Json& root = json.value();
  if (!root.is_object() || !root.contains("spools") || !root["spools"].is_object()) {
    return wrongFile();
  }
  // Later versions may mean something else by the same keys.
  if (unknownKey(root, {"version", "spools"}) || root.value("version", Json()) != 1) return wrongFile();
  if (root["spools"].size() > kMostSpools) {
    return refusedFile("ManySpools", {{"count", root["spools"].size()}, {"most", kMostSpools}});
  }
  std::vector<Spool> spools;
  for (const auto& item : root["spools"].items()) {
    Result<Spool> spool = readSpool(item.key(), item.value());
    if (!spool) return spool.error();
    spools.push_back(std::move(spool).value());
  }
  return spools;
}

}  // namespace sillon
