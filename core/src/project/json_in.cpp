// Reads project files. They count as hostile, so sizes, nesting and repeated keys are checked before anything is built.
#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include "base/json.hpp"
#include "project/files.hpp"
#include "settings/json.hpp"
#include "sillon/base/words.hpp"
#include "sillon/project/project.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {
namespace {

constexpr std::size_t kMaxDepth = 64;
constexpr const char* kStudio = "studio";
constexpr std::array kSections{Section::Shape,    Section::Layers, Section::Pictures,
                               Section::Toolpath, Section::Print,  Section::Printer};

/// Checks a JSON text without building it: syntax, nesting, repeated keys.
class Inspector : public nlohmann::json_sax<Json> {
 public:
  explicit Inspector(std::string_view text) : text_(text) {}
  Fault problem;

  bool null() override { return true; }
  bool boolean(bool /*value*/) override { return true; }
  bool number_integer(number_integer_t /*value*/) override { return true; }
  bool number_unsigned(number_unsigned_t /*value*/) override { return true; }
  bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return true; }
  bool string(string_t& /*value*/) override { return true; }
  bool binary(binary_t& /*value*/) override { return true; }
  bool start_object(std::size_t /*size*/) override { return enter(); }
  bool start_array(std::size_t /*size*/) override { return enter(); }
  bool end_object() override { return leave(); }
  bool end_array() override { return leave(); }
  bool key(string_t& key) override {
    if (keys_.back().insert(key).second) return true;
    problem = refusedFile("KeyTwice", {{"key", inQuotes(key)}});
    return false;
  }
  bool parse_error(std::size_t position, const std::string& /*token*/, const Json::exception& /*why*/) override {
    const std::size_t end = std::min(position, text_.size());
    const std::string_view before = text_.substr(0, end);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t column = end - (before.rfind('\n') + 1);  // npos + 1 is 0, in the first line
    problem = refusedFile("NotJson", {{"line", line}, {"column", column}});
    return false;
  }

 private:
  bool enter() {
    if (keys_.size() == kMaxDepth) {
      problem = refusedFile("JsonTooDeep", {{"most", kMaxDepth}});
      return false;
    }
    keys_.emplace_back();
    return true;
  }
  bool leave() {
    keys_.pop_back();
    return true;
  }

  std::string_view text_;
  std::vector<std::set<std::string>> keys_;  // keys of each open object; an empty set for a list
};

/// Checks that an object is a project of the known version, or a scene.
Fault wrongKind(const Json& root) {
  const auto version = root.find("sillon");
  if (version != root.end()) {
    int read = 0;
    if (Fault wrong = readInteger(*version, "sillon", read)) return wrong;
    if (read == kProjectVersion) return std::nullopt;
    return refusedFile("OtherVersion", {{"version", read}, {"known", kProjectVersion}});
  }
  for (const Section section : kSections) {
    if (!root.contains(sectionName(section))) continue;
    return refusedFile("NoVersion", {{"known", kProjectVersion}});
  }
  if (isScene(root)) return std::nullopt;
  return refusedFile("NoProject");
}

/// Reads a project. \return the fault, such as an unknown key or a wrong type
Fault readRoot(const Json& root, Project& project) {
  std::vector<std::string> known{"sillon"};
  for (const Section section : kSections) known.emplace_back(sectionName(section));
  known.emplace_back(kStudio);
  for (std::string& key : sceneKeys()) known.push_back(std::move(key));
  if (Fault wrong = unknownKey(root, "", known)) return wrong;
  if (Fault wrong = wrongKind(root)) return wrong;
  if (Fault wrong = readSceneKeys(root, project)) return wrong;
  for (const Section section : kSections) {
    const auto found = root.find(sectionName(section));
    if (found == root.end()) continue;
    Fault wrong =
        section == Section::Layers ? readLayers(*found, project) : readSection(*found, section, viewOf(project));
    if (wrong) return wrong;
  }
  const auto studio = root.find(kStudio);
  if (studio == root.end()) return std::nullopt;
  if (!studio->is_object()) return wrongType("NotObject", kStudio, *studio);
  project.studio = jsonText(*studio);
  return std::nullopt;
}

}  // namespace

Result<Project> readProject(std::string_view json) {
  if (json.size() > kMaxProjectBytes) return fileTooLarge(json.size(), kMaxProjectBytes);
  Inspector inspector(json);
  if (!Json::sax_parse(json, &inspector)) return *std::move(inspector.problem);
  const Json root = parseJson(json);
  if (!root.is_object()) return refusedFile("NoProject");
  Project project;
  if (Fault wrong = readRoot(root, project)) return *std::move(wrong);
  if (auto wrong = invalidSettings(project)) return *std::move(wrong);
  return project;
}

}  // namespace sillon
