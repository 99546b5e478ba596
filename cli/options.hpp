// Options that change a project, each with its word or its row of the table of settings.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sillon/project/project.hpp"
#include "sillon/settings/table.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace cli {

/// What an option changes in the project; returns what is wrong, or nothing.
using Change = std::function<std::string(sillon::Project&)>;

/// Puts options on the command line; each becomes a change of the project, in the order of the line.
class Options {
 public:
  Options(CLI::App& app, std::vector<Change>& changes) : app_(app), changes_(changes) {}

  /// Under which heading help shows the options that follow; empty: not in help.
  void group(std::string name) { group_ = std::move(name); }

  /// An option with a word of its own meaning. \param read  text to change; throws by refuse().
  CLI::Option* word(const std::string& name, const char* unit, const std::string& help,
                    const std::function<Change(const std::string&)>& read);

  /// An option for one row of the table of settings; what is wrong with its value is found with the whole project.
  void setting(const sillon::Setting& row);

  /// The table's options, but for those with a syntax of their own, which are there already.
  /// \param wanted  whether a setting is one of the command's.
  void settings(const std::function<bool(const sillon::Setting&)>& wanted);

  /// An option that names a file.
  void output(const std::string& name, const std::string& help, std::string& path);

  void previewWidth(const std::string& help, int& out);

 private:
  CLI::App& app_;
  std::vector<Change>& changes_;
  std::string group_;
};

/// An option with a number, of which the last counts. \param out  double, optional<double> or int
template <class Number>
CLI::Option* addNumber(CLI::App& app, const std::string& name, Number& out, const std::string& help);

/// \param out  pixels.
CLI::Option* addPreviewWidth(CLI::App& app, int& out, const std::string& help);

void addThreads(CLI::App& app, int& out);

/// No option and no file of a command may be empty, and of options that take one value the last counts.
void requireValues(CLI::App& command);

/// Puts a word of the command line into the field of a row; throws by refuse().
void setField(const sillon::Setting& row, sillon::Project& project, const std::string& option, const std::string& text);

}  // namespace cli
