// The measured spools as text: what each can show under lamps.
#pragma once

#include <string>

namespace cli {

/// One line per spool, with a head: how many times as bright as black its white is under each lamp.
std::string spoolTable();

/// The constants of the appearance model, the spools, and for each the light of directions under each lamp: what the
/// views on web pages are made from and tested against.
std::string spoolJson();

}  // namespace cli
