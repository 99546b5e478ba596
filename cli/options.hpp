// Options of a command: how each is read, and its row of the help. Commands see nothing of the library below.
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

namespace cli {

/// A change that an option makes to the project; returns what is wrong, or nothing.
using Change = std::function<std::string(sillon::Project&)>;

/// Puts options on the command line, in the order of the help.
class Options {
 public:
  /// \param common  names of the options that newcomers are shown, with spaces between; files always are
  Options(CLI::App& app, HelpPage& page, const char* common);

  /// The heading that help shows above the options that follow.
  void group(std::string name) { group_ = std::move(name); }

  /// A file without an option in front.
  void file(const std::string& name, const std::string& help, std::string& path, bool required);
  /// One or more of them, or none.
  void files(const std::string& name, const std::string& help, std::vector<std::string>& paths, bool required);

  /// A word without an option in front, which must be given.
  void word(const std::string& name, const std::string& help, const std::vector<std::string>& words, std::string& out);

  void flag(const std::string& names, const std::string& help, bool& out);
  /// \param unit  how help calls the value. \param take  gets the text; throws by refuse().
  void take(const std::string& names, const std::string& unit, const std::string& help,
            const std::function<void(const std::string&)>& take, std::vector<ValueHelp> values = {});
  void text(const std::string& names, const std::string& unit, const std::string& help, std::string& out);
  void text(const std::string& names, const std::string& unit, const std::string& help,
            std::optional<std::string>& out);
  /// May be repeated, or hold several values with commas between.
  void list(const std::string& names, const std::string& unit, const std::string& help,
            const std::function<void(const std::string&)>& take, char separator = '\0');
  /// A number, of which the last counts. \param out  double, optional<double> or int
  template <class Number>
  void number(const std::string& name, const std::string& unit, const std::string& help, Number& out);
  /// A whole number of a range.
  void whole(const std::string& name, const std::string& unit, const std::string& help, int low, int high, int& out);
  /// One of some words.
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
  /// A word that changes the project. Changes stand in the order of the options here, not in that of the line.
  void change(const std::string& name, const std::string& unit, const std::string& help, std::vector<Change>& changes,
              const std::function<Change(const std::string&)>& read, std::vector<ValueHelp> values = {});

  /// Options of the table of settings, but for those that are there already. \param wanted  whether a setting is one of
  /// the command's.
  void settings(std::vector<Change>& changes, const std::function<bool(const sillon::Setting&)>& wanted);

  void threads(int& out);
  void previewWidth(int& out);

  /// The command is refused without it.
  void require(const std::string& name);
  /// Both together are refused.
  void excludes(const std::string& one, const std::string& other);
  /// The first alone is refused.
  void needs(const std::string& one, const std::string& other);

  /// Tells, once the words are read, whether an option is among them.
  [[nodiscard]] std::function<bool(const std::string&)> given() const;

  /// No option and no file may be empty, and of options that take one value the last counts.
  void finish();

 private:
  [[noreturn]] static void refuseWord(const std::string& name, const std::string& text,
                                      const std::vector<std::string>& words);
  void setting(const sillon::Setting& row, std::vector<Change>& changes);
  void row(const std::string& names, const std::string& unit, const std::string& help,
           std::vector<ValueHelp> values = {});

  CLI::App& app_;
  HelpPage& page_;
  std::vector<std::string> common_;
  std::string group_;
};

/// Puts a word of the command line into the field of a row; throws by refuse().
void setField(const sillon::Setting& row, sillon::Project& project, const std::string& option, const std::string& text);

/// "a, b or c"
std::string listed(const std::vector<std::string>& words);

}  // namespace cli
