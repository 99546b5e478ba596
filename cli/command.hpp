// Description of a command of the program.
#pragma once

#include <functional>
#include <vector>

#include "options.hpp"

namespace sillon::cli {

/// Function that runs a command after its options were read. \return the exit code.
using Action = std::function<int()>;

struct Command {
  const char* name;
  const char* help;      ///< in the list of commands; begins with a small letter, no full stop
  const char* files;     ///< files in the usage line: "[SCENE.json|PICTURE] [PICTURE...]"
  const char* common;    ///< options that the short help shows, separated by spaces
  const char* examples;  ///< examples and notes, as paragraphs separated by empty lines
  Action (*add)(Options& options);
};

/// Returns all commands, in the order of the help.
const std::vector<const Command*>& commands();

}  // namespace sillon::cli
