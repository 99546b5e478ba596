#include "options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "threads.hpp"
#include "words.hpp"

namespace cli {
namespace {

using sillon::ChoiceField;
using sillon::Field;
using sillon::Level;
using sillon::Project;
using sillon::Section;
using sillon::Setting;
using sillon::SettingType;
using sillon::Vec2;

/// How a value is called in help: "MM", "N", "up|bed|both".
std::string valueName(const Setting& row) {
  const std::string_view unit = row.unit;
  if (row.type == SettingType::Choice) {
    std::string words = row.choices;
    std::replace(words.begin(), words.end(), ' ', '|');
    return words;
  }
  if (row.type == SettingType::Pair || row.type == SettingType::IntegerPair) return "X,Y";
  if (row.type == SettingType::Integer) return "N";
  if (row.type != SettingType::Number) return "TEXT";
  return unit == "mm" ? "MM" : unit == "degrees" ? "DEG" : unit == "spacings" ? "TAU" : "F";
}

/// Puts a word of the command line into a field, by the kind of field; throws by refuse().
struct SetField {
  const Setting& row;
  const Field field;
  const std::string& option;
  const std::string& text;

  void operator()(std::monostate /*not there*/) const {}
  void operator()(std::string* out) const { *out = text; }
  void operator()(bool* /*choice*/) const { choice(); }
  void operator()(Vec2* out) const {
    const std::optional<Vec2> pair = parsePair(text, ',');
    if (!pair) refuse(option, text, "X,Y, two numbers");
    *out = *pair;
  }
  void operator()(std::optional<Vec2>* out) const { (*this)(&out->emplace()); }
  void operator()(const ChoiceField& /*out*/) const { choice(); }
  void operator()(std::vector<sillon::LampPicture>* /*has options of its own*/) const {}
  template <class Number>
  void operator()(Number* out) const {
    parseInto(option, text, *out);
  }

  void choice() const {
    const std::vector<std::string> words = sillon::splitWords(row.choices);
    const auto found = std::find(words.begin(), words.end(), text);
    if (found != words.end()) return sillon::choose(field, static_cast<std::size_t>(found - words.begin()));
    std::string wanted;
    for (std::size_t k = 0; k < words.size(); ++k) {
      wanted += (k == 0 ? "" : k + 1 == words.size() ? " or " : ", ") + words[k];
    }
    refuse(option, text, wanted);
  }
};

/// Where help shows the settings of a section.
const char* groupOf(Section section) {
  return section == Section::Toolpath                               ? "Toolpath"
         : section == Section::Pictures                             ? "Pictures"
         : section == Section::Print || section == Section::Printer ? "Print"
                                                                    : "Shape and directions";
}

/// A whole number of a range; throws by refuse().
std::function<void(const std::string&)> within(const std::string& name, int low, int high, int& out) {
  return [=, &out](const std::string& text) {
    int value = 0;
    parseInto(name, text, value);
    if (value < low || value > high) {
      refuse(name, text, "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    }
    out = value;
  };
}

}  // namespace

template <class Number>
CLI::Option* addNumber(CLI::App& app, const std::string& name, Number& out, const std::string& help) {
  return app.add_option_function<std::string>(
      name, [name, &out](const std::string& text) { parseInto(name, text, out); }, help);
}
template CLI::Option* addNumber(CLI::App&, const std::string&, double&, const std::string&);
template CLI::Option* addNumber(CLI::App&, const std::string&, std::optional<double>&, const std::string&);
template CLI::Option* addNumber(CLI::App&, const std::string&, int&, const std::string&);

CLI::Option* addPreviewWidth(CLI::App& app, int& out, const std::string& help) {
  const char* name = "--preview-width";
  return app.add_option_function<std::string>(name, within(name, 16, 16384, out), help)->option_text("PX");
}

void addThreads(CLI::App& app, int& out) {
  out = threadsOfMachine();
  const char* name = "--threads";
  app.add_option_function<std::string>(name, within(name, 1, kMostThreads, out),
                                       "how many may work; never changes the result [all]")
      ->option_text("N");
}

void requireValues(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    if (option->get_items_expected_max() == 0) continue;  // a flag
    const std::string name = option->get_name();
    const bool positional = option->get_positional();
    if (!positional && option->get_items_expected_max() == 1) option->take_last();
    // "--gcode --quiet" has forgotten a name; it does not mean a file called --quiet.
    option->check([name, positional](const std::string& text) {
      if (text.empty() || (!positional && text.rfind("--", 0) == 0)) {
        refuse(name, text, positional ? "a name" : "followed by its value");
      }
      return std::string();
    });
  }
}

void setField(const Setting& row, Project& project, const std::string& option, const std::string& text) {
  const Field field = row.field(viewOf(project));
  std::visit(SetField{row, field, option, text}, field);
}

CLI::Option* Options::word(const std::string& name, const char* unit, const std::string& help,
                           const std::function<Change(const std::string&)>& read) {
  return app_
      .add_option_function<std::string>(
          name, [this, read](const std::string& text) { changes_.push_back(read(text)); }, help)
      ->option_text(unit)
      ->group(group_);
}

void Options::setting(const Setting& row) {
  const sillon::SettingWords words = sillon::wordsOf(row);
  const std::string name = words.option;
  if (row.type == SettingType::Flag) {
    app_.add_flag_callback(
            name,
            [this, &row] {
              changes_.emplace_back([&row](Project& project) {
                *std::get<bool*>(row.field(viewOf(project))) = true;
                return std::string();
              });
            },
            words.help)
        ->group(group_);
    return;
  }
  Project defaults;
  const std::string standard = sillon::settingText(row, defaults);
  word(name, valueName(row).c_str(), std::string(words.help) + (standard.empty() ? "" : " [" + standard + "]"),
       [&row, name](const std::string& text) {
         Project scratch;
         setField(row, scratch, name, text);
         return [&row, name, text](Project& project) {
           setField(row, project, name, text);
           return std::string();
         };
       });
}

void Options::settings(const std::function<bool(const Setting&)>& wanted) {
  for (const Setting& row : sillon::settings()) {
    if (!wanted(row)) continue;
    const char* option = sillon::wordsOf(row).option;
    if (*option == '\0' || app_.get_option_no_throw(option) != nullptr) continue;
    group(row.level == Level::Expert ? "" : groupOf(row.section));  // no group: not in help
    setting(row);
  }
}

void Options::output(const std::string& name, const std::string& help, std::string& path) {
  app_.add_option_function<std::string>(
          name, [&path](const std::string& text) { path = text; }, help)
      ->option_text("F")
      ->group(group_);
}

void Options::previewWidth(const std::string& help, int& out) { addPreviewWidth(app_, out, help)->group(group_); }

}  // namespace cli
