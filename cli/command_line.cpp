#include "command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "command.hpp"
#include "help.hpp"
#include "run.hpp"
#include "sillon/base/words.hpp"
#include "terminal.hpp"

namespace sillon::cli {
namespace {

/// A command that was added to the parser.
struct Added {
  const Command* command;
  CLI::App* app;
  HelpPage page;
  Action action;
};

/// Returns "; did you mean check?", or nothing if no name is similar.
std::string didYouMean(const std::string& word, const std::vector<std::string>& names) {
  const std::vector<std::string> near = nearNames(word, names);
  return near.empty() ? "" : "; did you mean " + near.front() + "?";
}

std::vector<std::string> commandNames() {
  std::vector<std::string> names;
  for (const Command* command : commands()) names.emplace_back(command->name);
  return names;
}

Error unknownCommand(const std::string& word) {
  const std::vector<std::string> names = commandNames();
  return {ErrorCode::InvalidArgument,
          "\"" + word + "\" is not a command; it must be " + listed(names) + didYouMean(word, names)};
}

/// Makes the error for a word that the command does not accept.
Error unexpected(const Added& added) {
  const std::vector<std::string> words = added.app->remaining();
  const std::string word = words.empty() ? std::string() : words.front();
  const std::string name = std::string("sillon ") + added.command->name;
  if (word.rfind('-', 0) != 0) {
    return {ErrorCode::InvalidArgument, "\"" + word + "\" is unexpected; see " + name + " --help"};
  }
  std::vector<std::string> known;
  for (const CLI::Option* option : added.app->get_options()) {
    for (const std::string& one : option->get_lnames()) known.push_back("--" + one);
  }
  const std::string given = word.substr(0, word.find('='));
  const std::string meant = didYouMean(given, known);
  return {ErrorCode::InvalidArgument,
          given + " is not an option of " + name + (meant.empty() ? "; see " + name + " --help-all" : meant)};
}

/// Returns the first line of a message of CLI11, without the full stop that some end in.
std::string oneSentence(std::string text) {
  text = text.substr(0, text.find('\n'));
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text;
}

std::vector<std::string> paragraphs(const std::string& text) {
  std::vector<std::string> all;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find("\n\n", begin), text.size());
    all.push_back(text.substr(begin, end - begin));
    begin = end + 2;
  }
  return all;
}

void addHelpRows(HelpPage& page) {
  page.rows.push_back({"Help", "-h,--help", "show this", {}, true});
  page.rows.push_back({"Help", "--help-all", "show all options", {}, true});
}

/// Adds a command with its options to the parser, and fills its page of help.
Added addCommand(CLI::App& app, const Command& command) {
  Added added{&command, app.add_subcommand(command.name, command.help), {}, {}};
  const std::string name = std::string("sillon ") + command.name;
  added.page.title = name + ": " + command.help;
  added.page.usage = name + (*command.files == '\0' ? "" : " ") + command.files + " [options]";
  added.page.notes = paragraphs(command.examples);
  added.page.completeHelpCommand = name + " --help-all";
  Options options(*added.app, added.page, command.common);
  added.action = command.add(options);
  options.finish();
  addHelpRows(added.page);
  return added;
}

/// Makes the help of the program as a whole.
HelpPage generalHelp() {
  HelpPage page;
  page.title = "sillon turns a picture and a shape into one continuous dense oriented toolpath, and into G-code.";
  page.usage = "sillon COMMAND [options]";
  for (const Command* command : commands()) page.rows.push_back({"Commands", command->name, command->help, {}, true});
  page.rows.push_back({"Options", "-h,--help", "show this; after a command, its options", {}, true});
  page.rows.push_back({"Options", "--version", "show the version", {}, true});
  page.notes = {
      "Begin with:\n"
      "  sillon generate --shape disc --size 40 --angle 30 --gcode disc.gcode",
      "sillon COMMAND --help shows the options that most people need, --help-all shows all of them."};
  return page;
}

}  // namespace

int runCommandLine(int argc, const char* const* argv) {
  if (argc < 2) return answer(helpText(generalHelp(), true, terminalWidth()));
  const std::vector<std::string> names = commandNames();
  const std::string first = argv[1];
  if (first.rfind('-', 0) != 0 && std::find(names.begin(), names.end(), first) == names.end()) {
    return fail(unknownCommand(first));
  }
  CLI::App app{"", "sillon"};
  app.set_help_all_flag("--help-all");
  app.set_version_flag("--version", std::string("sillon ") + kVersion);
  app.require_subcommand(1);
  app.allow_windows_style_options(false);  // "/x/part.gcode" is a file, not an option
  std::vector<Added> all;
  all.reserve(commands().size());
  for (const Command* command : commands()) all.push_back(addCommand(app, *command));
  const auto asked = [&]() -> const Added* {
    const auto parsed = std::find_if(all.begin(), all.end(), [](const Added& one) { return one.app->parsed(); });
    return parsed == all.end() ? nullptr : &*parsed;
  };
  const auto help = [&](bool complete) {
    const Added* of = asked();
    return answer(helpText(of == nullptr ? generalHelp() : of->page, complete, terminalWidth()));
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return help(false);
  } catch (const CLI::CallForAllHelp&) {
    return help(true);
  } catch (const CLI::CallForVersion& version) {
    return answer(std::string(version.what()) + "\n");
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string text = error.what();
    return fail(
        {ErrorCode::InvalidArgument, text.substr(0, text.find(':')) + " has no value; it must be followed by one"});
  } catch (const CLI::ExtrasError& error) {
    if (const Added* of = asked()) return fail(unexpected(*of));
    return fail({ErrorCode::InvalidArgument, oneSentence(error.what()) + "; see sillon --help"});
  } catch (const CLI::RequiredError& error) {
    const Added* of = asked();
    if (of == nullptr) return fail({ErrorCode::InvalidArgument, "no command is given; see sillon --help"});
    const std::string name = of->command->name;
    return fail({ErrorCode::InvalidArgument, oneSentence(error.what()) + "; see sillon " + name + " --help"});
  } catch (const CLI::ParseError& error) {
    return fail({ErrorCode::InvalidArgument, oneSentence(error.what())});
  }
  return asked()->action();
}

}  // namespace sillon::cli
