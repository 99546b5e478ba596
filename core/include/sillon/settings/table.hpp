// The one table of settings. Project files, the command line, the documentation, the types of the
// npm package and the studio's fields are made from it; defaults are the initialisers of the
// structs. CONTRIBUTING.md shows how to add one.
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

/// The parts of a project file, in its order.
enum class Section { Shape, Layers, Pictures, Toolpath, Print, Printer };

/// Who looks for a setting.
enum class Level {
  Basic,
  Advanced,  ///< folded away at first
  Expert,    ///< constants of the method: in files and presets, hidden in the studio and in help
};

enum class SettingType {
  Number,
  Integer,
  Flag,
  Choice,
  Pair,         ///< two numbers
  IntegerPair,  ///< two whole numbers
  Text,         ///< one line; `high` is the most bytes it may have
  Block,        ///< several lines, likewise
  PictureList,  ///< files, each with its lamp; `high` is the most there may be
  HoleList,     ///< round holes, likewise
  ColourList,   ///< colours, each with its direction, likewise
  StrokeList,   ///< gestures of brushes, likewise
  Name,         ///< of a preset or profile, whose values lie under the section's others
};

/// The structs that settings are read from or written to. Null: settings that lie there are
/// skipped.
struct SettingsView {
  Project* project = nullptr;
  ToolpathParams* toolpath = nullptr;
  PrintParams* print = nullptr;
  Printer* printer = nullptr;
  Layer* layer = nullptr;  ///< one of the project's
};

SettingsView viewOf(Project& project);

/// A field of an enumeration.
struct ChoiceField {
  void* at;
  std::size_t (*get)(const void* at);
  void (*set)(void* at, std::size_t index);
};

/// The field of a setting in a view. monostate: not there.
using Field = std::variant<std::monostate, double*, int*, std::uint64_t*, bool*, std::string*,
                           Vec2*, std::optional<double>*, std::optional<Vec2>*,
                           std::vector<LampPicture>*, std::vector<RoundHole>*,
                           std::vector<ColourAngle>*, std::vector<Stroke>*, ChoiceField>;

struct Setting {
  Section section;
  const char* key;  ///< in project files
  SettingType type;
  Field (*field)(const SettingsView& view);
  const char* unit = "";  ///< in words for messages: "mm", "degrees", "spacings"
  double low = 0;
  double high = 0;
  Level level = Level::Advanced;
  /// With spaces between; in the order of the enumerators, or of false, true
  const char* choices = "";
};

/// Words of help and documentation about a setting, in ASCII. They stand apart: engines in browsers
/// do without.
struct SettingWords {
  const char* label = "";   ///< at most a few words
  const char* help = "";    ///< one sentence without full stop
  const char* option = "";  ///< of the command line, with its hyphens; empty: none
};

/// All of them, by section, in the order of the files that are written.
std::span<const Setting> settings();

/// The most layers that a project may have.
inline constexpr std::size_t kMostLayers = 32;

/// The most points that all strokes of a layer may have together.
inline constexpr std::size_t kMostStrokePoints = 200'000;

/// Tells whether a layer's font is a file, and no built-in one.
bool isFontFile(std::string_view font);

/// \param setting  one of `settings()`, no copy
SettingWords wordsOf(const Setting& setting);

/// \return null if there is none.
const Setting* findSetting(Section section, std::string_view key);

/// "shape", "layers", "pictures", "toolpath", "print", "printer"
const char* sectionName(Section section);

/// "printer.nozzle"
std::string fullName(const Setting& setting);

/// "one two three" as three words.
std::vector<std::string> splitWords(std::string_view text);

/// Index in `choices` of the value that a field has, and back.
/// \param field  ChoiceField or bool*.
std::size_t chosen(const Field& field);
void choose(const Field& field, std::size_t index);

/// The value that a project has, as in its file, but texts without quotes; empty: the setting has
/// no field.
std::string settingText(const Setting& setting, const Project& project);

/// Checks every setting of a view. It checks ranges, and rules that hold between settings of one
/// section.
/// \return the first that is wrong: name, value, range
[[nodiscard]] std::optional<Error> invalidSettings(const Project& project);
[[nodiscard]] std::optional<Error> invalidSettings(const ToolpathParams& toolpath);
[[nodiscard]] std::optional<Error> invalidSettings(const Printer& printer,
                                                   const PrintParams& print);

/// The table as JSON: `sillon settings --json`, from which docs and types are made.
std::string settingsJson();

}  // namespace sillon
