// A command of the program.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "options.hpp"

namespace cli {

/// Runs a command whose options are read. \return the exit code.
using Action = std::function<int()>;

struct Command {
  const char* name;
  const char* help;      ///< in the list of commands: begins with a small letter, no full stop
  const char* files;     ///< of the usage: "[SCENE.json|PICTURE] [PICTURE...]"
  const char* common;    ///< options that newcomers are shown, with spaces between
  const char* examples;  ///< and notes; paragraphs with empty lines between
  Action (*add)(Options& options);
};

/// All commands, in the order of the help.
const std::vector<const Command*>& commands();

}  // namespace cli
