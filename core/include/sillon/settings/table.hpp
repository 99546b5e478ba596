// The one table of settings. Project files, the command line, the documentation, the types of the
// npm package and the studio's fields are made from it; defaults are the initialisers of the
// structs. CONTRIBUTING.md shows how to add a setting.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// Parts of a project file, in its order.
enum class Section { Shape, Layers, Pictures, Toolpath, Print, Printer };

/// Levels of a setting, by the people who look for it.
enum class Level {
  Basic,
  Advanced,  ///< folded away at first
  Expert,    ///< constants of the method: in files and presets, hidden in the studio and in help
};

/// Types of a setting's value.
enum class SettingType {
  Number,
  Integer,
  Flag,
  Choice,
  Pair,         ///< two numbers
  IntegerPair,  ///< two whole numbers
  Text,         ///< one line; `high` is the most bytes it may have
  Block,        ///< several lines; `high` is likewise
  PictureList,  ///< files, each with its lamp; `high` is the most there may be
  HoleList,     ///< round holes; `high` is likewise
  ColourList,   ///< colours, each with its direction; `high` is likewise
  StrokeList,   ///< gestures of brushes; `high` is likewise
  Name,         ///< name of a preset or profile, whose values lie under the section's others
};

/// The structs that settings are read from or written to. Settings of a struct that is null are
/// skipped.
struct SettingsView {
  Project* project = nullptr;
  ToolpathParams* toolpath = nullptr;
  PrintParams* print = nullptr;
  Printer* printer = nullptr;
  Layer* layer = nullptr;  ///< one of the project's
};

/// Returns a view of all of a project but its layers.
SettingsView viewOf(Project& project);

/// A field of an enumeration, read and written by the index of its value.
struct ChoiceField {
  void* at;
  std::size_t (*get)(const void* at);
  void (*set)(void* at, std::size_t index);
};

/// The field of a setting in a view; monostate: the view does not have it.
using Field = std::variant<std::monostate, double*, int*, std::uint64_t*, bool*, std::string*,
                           Vec2*, std::optional<double>*, std::optional<Vec2>*,
                           std::vector<LampPicture>*, std::vector<RoundHole>*,
                           std::vector<ColourAngle>*, std::vector<Stroke>*, ChoiceField>;

/// One row of the table.
struct Setting {
  Section section;
  const char* key;  ///< name in project files
  SettingType type;
  Field (*field)(const SettingsView& view);
  const char* unit = "";  ///< unit in words, for messages: "mm", "degrees", "spacings"
  double low = 0;
  double high = 0;
  Level level = Level::Advanced;
  /// Names of the values, with spaces between, in the order of the enumerators, or of false and
  /// true
  const char* choices = "";
};

/// Words of help and documentation about a setting, in ASCII. They are kept apart from Setting
/// because engines in browsers do without them.
struct SettingWords {
  const char* label = "";   ///< name in at most a few words
  const char* help = "";    ///< one sentence without full stop
  const char* option = "";  ///< option of the command line, with its hyphens; empty: none
};

/// Returns all settings by section, in the order of the files that are written.
std::span<const Setting> settings();

/// The most layers that a project may have.
inline constexpr std::size_t kMostLayers = 32;

/// The most points that all strokes of a layer may have together.
inline constexpr std::size_t kMostStrokePoints = 200'000;

/// Tells whether a layer's font is a file rather than a built-in one.
bool isFontFile(std::string_view font);

/// Returns the words about a setting.
/// \param setting  one of `settings()`, not a copy.
SettingWords wordsOf(const Setting& setting);

/// Finds a setting.
/// \return null if there is none of this key in the section.
const Setting* findSetting(Section section, std::string_view key);

/// Returns the name of a section: "shape", "layers", "pictures", "toolpath", "print", "printer".
const char* sectionName(Section section);

/// Returns the name of a setting with its section, such as "printer.nozzle".
std::string fullName(const Setting& setting);

/// Splits a text at its spaces: "one two three" gives three words.
std::vector<std::string> splitWords(std::string_view text);

/// Returns the index in `choices` of the value that a field has; choose() sets it.
/// \param field  ChoiceField or bool*.
std::size_t chosen(const Field& field);
void choose(const Field& field, std::size_t index);

/// Returns the value that a project has, as in its file, but texts without quotes. It is empty
/// where the setting has no field.
std::string settingText(const Setting& setting, const Project& project);

/// Checks every setting of a view: its range, and rules that hold between settings of one section.
/// \return the first that is wrong: name, value, range.
[[nodiscard]] std::optional<Error> invalidSettings(const Project& project);
[[nodiscard]] std::optional<Error> invalidSettings(const ToolpathParams& toolpath);
[[nodiscard]] std::optional<Error> invalidSettings(const Printer& printer,
                                                   const PrintParams& print);

/// Returns the table as JSON: `sillon settings --json`, from which docs and types are made.
std::string settingsJson();

}  // namespace sillon
