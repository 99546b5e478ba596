// Notes of an import: their codes, and the English sentence of each.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sillon/printer_import/printer_import.hpp"

namespace sillon {

/// Makes a note with its sentence. \param code  one of importNoteSentences(). \param values  values that the sentence
/// names, in its order.
ImportNote importNote(std::string_view code, std::initializer_list<std::pair<const char*, std::string>> values = {});

/// Makes a note of what a plate would be refused for; its code is the error's reason.
ImportNote importNote(const Error& error);

/// Adds a note, unless the list has one with the same sentence.
void addNote(std::vector<ImportNote>& notes, ImportNote note);

}  // namespace sillon
