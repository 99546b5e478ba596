// Spools as text: what each can show under lamps.
#pragma once

#include <string>
#include <vector>

#include "sillon/look/spools.hpp"

namespace cli {

/// One line per spool, with a head: how many times as bright as black its white is under each lamp.
std::string spoolTable(const std::vector<sillon::Spool>& spools);

/// The constants of the appearance model, the spools, and for each the light of directions under each lamp: what the
/// views on web pages are made from and tested against.
std::string spoolJson(const std::vector<sillon::Spool>& spools);

}  // namespace cli
