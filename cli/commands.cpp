#include "commands/commands.hpp"

namespace sillon::cli {

const std::vector<const Command*>& commands() {
  static const std::vector<const Command*> all{
      &generateCommand, &rebrushCommand,  &zonesCommand,     &calibrateCommand, &checkCommand,    &importCommand,
      &shapeCommand,    &printersCommand, &filamentsCommand, &spoolsCommand,    &settingsCommand, &wordsCommand,
  };
  return all;
}

}  // namespace sillon::cli
