// Options of a command, with their rows of the help. Commands do not use CLI11 themselves.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "help.hpp"
#include "sillon/settings/project.hpp"
#include "sillon/settings/table.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sillon::cli {

/// Change that an option makes to the project; returns an error, or an empty string.
using Change = std::function<std::string(Project&)>;

/// Adds options to the command line, in the order of the help.
class Options {
 public:
  /// \param common  names of options in the short help, separated by spaces; files are always in it
  Options(CLI::App& app, HelpPage& page, const char* common);

  /// Sets the heading for the options that follow.
  void group(std::string name) { group_ = std::move(name); }

  /// Adds a file without an option in front.
  void file(const std::string& name, const std::string& help, std::string& path, bool required);
  /// Adds any number of files without an option in front; at least one if `required`.
  void files(const std::string& name, const std::string& help, std::vector<std::string>& paths, bool required);

  /// Adds a mandatory word without an option in front.
  void word(const std::string& name, const std::string& help, const std::vector<std::string>& words, std::string& out);

  void flag(const std::string& names, const std::string& help, bool& out);
  /// Adds an option with a value.
  /// \param unit  name of the value in help.
  /// \param take  receives the text; throws by refuse().
  void take(const std::string& names, const std::string& unit, const std::string& help,
            const std::function<void(const std::string&)>& take, std::vector<ValueHelp> values = {});
  void text(const std::string& names, const std::string& unit, const std::string& help, std::string& out);
  void text(const std::string& names, const std::string& unit, const std::string& help,
            std::optional<std::string>& out);
  /// Adds an option that may be repeated, or contain several values between separators.
  void list(const std::string& names, const std::string& unit, const std::string& help,
            const std::function<void(const std::string&)>& take, char separator = '\0');
  /// Adds a number; if repeated, the last one counts. \param out  double, optional<double> or int
  template <class Number>
  void number(const std::string& name, const std::string& unit, const std::string& help, Number& out);
  /// Adds a whole number from `low` to `high`.
  void whole(const std::string& name, const std::string& unit, const std::string& help, int low, int high, int& out);
  /// Adds a choice among words.
  template <class Value>
  void choice(const std::string& names, const std::string& unit, const std::string& help,
              const std::vector<std::pair<std::string, Value>>& words, const std::function<void(Value)>& take) {
    const std::string name = names.substr(0, names.find(','));
    this->take(names, unit, help, [=](const std::string& text) {
      std::vector<std::string> all;
      for (const auto& [word, value] : words) {
        if (word == text) return take(value);
        all.push_back(word);
      }
      refuseWord(name, text, all);
    });
  }
  /// Adds an option that changes the project. Changes are applied in the order of these calls, not in that of the line.
  void change(const std::string& name, const std::string& unit, const std::string& help, std::vector<Change>& changes,
              const std::function<Change(const std::string&)>& read, std::vector<ValueHelp> values = {});

  /// Adds options of the table of settings, except those that exist already.
  /// \param wanted  tells whether a setting belongs to the command.
  void settings(std::vector<Change>& changes, const std::function<bool(const Setting&)>& wanted);

  void threads(int& out);
  void previewWidth(int& out);

  /// Makes an option mandatory.
  void require(const std::string& name);
  /// Refuses two options together.
  void excludes(const std::string& one, const std::string& other);
  /// Refuses the first option without the other.
  void needs(const std::string& one, const std::string& other);

  /// Returns a function that tells, after parsing, whether an option was given.
  [[nodiscard]] std::function<bool(const std::string&)> given() const;

  /// Completes the options: refuses empty values, and lets the last one count for options with one value.
  void finish();

 private:
  [[noreturn]] static void refuseWord(const std::string& name, const std::string& text,
                                      const std::vector<std::string>& words);
  void setting(const Setting& row, std::vector<Change>& changes);
  void row(const std::string& names, const std::string& unit, const std::string& help,
           std::vector<ValueHelp> values = {});

  CLI::App& app_;
  HelpPage& page_;
  std::vector<std::string> common_;
  std::string group_;
};

/// Assigns a word of the command line to the field of a setting; throws by refuse().
void setField(const Setting& row, Project& project, const std::string& option, const std::string& text);

/// Joins words to "a, b or c".
std::string listed(const std::vector<std::string>& words);

}  // namespace sillon::cli
