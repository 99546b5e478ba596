// Commands of the program, one file each.
#pragma once

#include "command.hpp"

namespace sillon::cli {

extern const Command generateCommand;
extern const Command rebrushCommand;
extern const Command zonesCommand;
extern const Command calibrateCommand;
extern const Command checkCommand;
extern const Command importCommand;
extern const Command shapeCommand;
extern const Command printersCommand;
extern const Command filamentsCommand;
extern const Command spoolsCommand;
extern const Command settingsCommand;
extern const Command wordsCommand;

}  // namespace sillon::cli
