#include "options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <string_view>
#include <variant>

#include "threads.hpp"
#include "words.hpp"

namespace sillon::cli {
namespace {

/// Returns the name of a setting's value in help: "MM", "N", "up|bed|both".
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

/// Assigns a word of the command line to a field by its type; throws by refuse().
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
  template <class Item>
  void operator()(std::vector<Item>* /*has an option of its own*/) const {}
  template <class Number>
  void operator()(Number* out) const {
    parseInto(option, text, *out);
  }

  void choice() const {
    const std::vector<std::string> words = splitWords(row.choices);
    const auto found = std::find(words.begin(), words.end(), text);
    if (found == words.end()) refuse(option, text, listed(words));
    sillon::choose(field, found - words.begin());
  }
};

/// Returns the heading above the settings of a section.
const char* groupOf(Section section) {
  return section == Section::Toolpath                               ? "Toolpath"
         : section == Section::Pictures                             ? "Pictures"
         : section == Section::Print || section == Section::Printer ? "Print"
                                                                    : "Shape and directions";
}

/// Returns "--output" for "-o,--output".
std::string longName(const std::string& names) {
  const std::size_t begin = names.find("--");
  return begin == std::string::npos ? names : names.substr(begin, names.find(',', begin) - begin);
}

}  // namespace

std::string listed(const std::vector<std::string>& words) {
  std::string out;
  for (std::size_t k = 0; k < words.size(); ++k)
    out += (k == 0 ? "" : k + 1 == words.size() ? " or " : ", ") + words[k];
  return out;
}

Options::Options(CLI::App& app, HelpPage& page, const char* common)
    : app_(app), page_(page), common_(splitWords(common)) {}

void Options::row(const std::string& names, const std::string& unit, const std::string& help,
                  std::vector<ValueHelp> values) {
  const bool common = std::find(common_.begin(), common_.end(), longName(names)) != common_.end();
  page_.rows.push_back(
      {group_, names + (unit.empty() ? "" : " " + unit), withSmallInitial(help), std::move(values), common});
}

void Options::file(const std::string& name, const std::string& help, std::string& path, bool required) {
  app_.add_option("file", path)->option_text(name)->required(required);
  page_.rows.push_back({"", name, help, {}, true});
}

void Options::files(const std::string& name, const std::string& help, std::vector<std::string>& paths, bool required) {
  app_.add_option("file", paths)->option_text(name)->required(required);
  page_.rows.push_back({"", name, help, {}, true});
}

void Options::word(const std::string& name, const std::string& help, const std::vector<std::string>& words,
                   std::string& out) {
  app_.add_option_function<std::string>("kind",
                                        [&out, words](const std::string& text) {
                                          if (std::find(words.begin(), words.end(), text) == words.end()) {
                                            refuse("kind", text, listed(words));
                                          }
                                          out = text;
                                        })
      ->option_text(name)
      ->required();
  page_.rows.push_back({"", name, help, {}, true});
}

void Options::flag(const std::string& names, const std::string& help, bool& out) {
  app_.add_flag(names, out);
  row(names, "", help);
}

void Options::take(const std::string& names, const std::string& unit, const std::string& help,
                   const std::function<void(const std::string&)>& take, std::vector<ValueHelp> values) {
  app_.add_option_function<std::string>(names, take);
  row(names, unit, help, std::move(values));
}

void Options::text(const std::string& names, const std::string& unit, const std::string& help, std::string& out) {
  take(names, unit, help, [&out](const std::string& text) { out = text; });
}

void Options::text(const std::string& names, const std::string& unit, const std::string& help,
                   std::optional<std::string>& out) {
  take(names, unit, help, [&out](const std::string& text) { out = text; });
}

void Options::list(const std::string& names, const std::string& unit, const std::string& help,
                   const std::function<void(const std::string&)>& take, char separator) {
  app_.add_option_function<std::vector<std::string>>(names,
                                                     [take](const std::vector<std::string>& texts) {
                                                       for (const std::string& text : texts) take(text);
                                                     })
      ->delimiter(separator)
      ->allow_extra_args(false);
  row(names, unit, help);
}

template <class Number>
void Options::number(const std::string& name, const std::string& unit, const std::string& help, Number& out) {
  take(name, unit, help, [name, &out](const std::string& text) { parseInto(name, text, out); });
}
template void Options::number(const std::string&, const std::string&, const std::string&, double&);
template void Options::number(const std::string&, const std::string&, const std::string&, std::optional<double>&);
template void Options::number(const std::string&, const std::string&, const std::string&, int&);

void Options::whole(const std::string& name, const std::string& unit, const std::string& help, int low, int high,
                    int& out) {
  take(name, unit, help, [=, &out](const std::string& text) {
    int value = 0;
    parseInto(name, text, value);
    if (value < low || value > high) {
      refuse(name, text, "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    }
    out = value;
  });
}

void Options::refuseWord(const std::string& name, const std::string& text, const std::vector<std::string>& words) {
  refuse(name, text, listed(words));
}

void Options::change(const std::string& name, const std::string& unit, const std::string& help,
                     std::vector<Change>& changes, const std::function<Change(const std::string&)>& read,
                     std::vector<ValueHelp> values) {
  take(
      name, unit, help, [&changes, read](const std::string& text) { changes.push_back(read(text)); },
      std::move(values));
}

void Options::setting(const Setting& row, std::vector<Change>& changes) {
  const SettingWords words = wordsOf(row);
  const std::string name = words.option;
  if (row.type == SettingType::Flag) {
    app_.add_flag_callback(name, [&changes, &row] {
      changes.emplace_back([&row](Project& project) {
        *std::get<bool*>(row.field(viewOf(project))) = true;
        return std::string();
      });
    });
    this->row(name, "", words.help);
    return;
  }
  Project defaults;
  const std::string standard = settingText(row, defaults);
  change(name, valueName(row), words.help + (standard.empty() ? std::string() : " [" + standard + "]"), changes,
         [&row, name](const std::string& text) {
           Project scratch;
           setField(row, scratch, name, text);
           return [&row, name, text](Project& project) {
             setField(row, project, name, text);
             return std::string();
           };
         });
}

void Options::settings(std::vector<Change>& changes, const std::function<bool(const Setting&)>& wanted) {
  for (const bool experts : {false, true}) {
    for (const Setting& row : sillon::settings()) {
      if (!wanted(row) || (row.level == Level::Expert) != experts) continue;
      const char* option = wordsOf(row).option;
      if (*option == '\0' || app_.get_option_no_throw(option) != nullptr) continue;
      group(experts ? "For experts" : groupOf(row.section));
      setting(row, changes);
    }
  }
}

void Options::threads(int& out) {
  out = threadsOfMachine();
  whole("--threads", "N", "number of threads; results do not depend on it [all]", 1, kMostThreads, out);
}

void Options::previewWidth(int& out) {
  whole("--preview-width", "PX", "width of each panel of the preview [1600]; of a WebP, its longer side [560]", 16,
        16384, out);
}

void Options::require(const std::string& name) { app_.get_option(name)->required(); }

void Options::excludes(const std::string& one, const std::string& other) {
  app_.get_option(one)->excludes(app_.get_option(other));
}

void Options::needs(const std::string& one, const std::string& other) {
  app_.get_option(one)->needs(app_.get_option(other));
}

std::function<bool(const std::string&)> Options::given() const {
  return [&app = app_](const std::string& name) { return app.count(name) > 0; };
}

void Options::finish() {
  for (CLI::Option* option : app_.get_options()) {
    if (option->get_items_expected_max() == 0) continue;  // flags have no value
    const std::string name = option->get_name();
    const bool positional = option->get_positional();
    if (!positional && option->get_items_expected_max() == 1) option->take_last();
    // In "--gcode --quiet" the name was forgotten; it does not mean a file called --quiet.
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

}  // namespace sillon::cli
