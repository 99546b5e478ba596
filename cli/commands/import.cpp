// sillon import: takes a printer from a file of the user.
#include <cstdio>
#include <memory>
#include <string>

#include "commands/commands.hpp"
#include "files.hpp"
#include "run.hpp"
#include "sillon/printer_import/printer_import.hpp"
#include "sillon/settings/presets.hpp"

namespace sillon::cli {
namespace {

struct Arguments {
  std::string file;
  std::string name;  ///< name of a printer in a bundle; empty for the active one
};

/// Prints the printer as a project to stdout, and notes to stderr.
int run(const Arguments& arguments) {
  const Result<std::string> text = readFile(arguments.file, "file", kMaxInputBytes);
  if (!text) return fail(text.error());
  const Result<ImportedPrinter> imported = importPrinter(text.value(), arguments.name);
  if (!imported) return fail(imported.error());
  const ImportedPrinter& printer = imported.value();
  const std::string under = printer.profile.empty() ? "" : ", the rest from the profile " + printer.profile;
  if (const int code = answer(writePrinter(printer.printer)); code != 0) return code;
  std::fprintf(stderr, "sillon: read %zu settings as %s%s\n", printer.read.size(), printer.source.c_str(),
               under.c_str());
  for (const ImportNote& note : printer.notRead) std::fprintf(stderr, "sillon: note: %s\n", note.message.c_str());
  return 0;
}

Action add(Options& options) {
  const auto arguments = std::make_shared<Arguments>();
  options.file("FILE", "G-code or settings of your slicer (.gcode, .ini, .json, .orca_printer, .3mf), or a project",
               arguments->file, true);
  options.group("Options");
  options.text("--name", "NAME", "printer of a bundle [the active one]", arguments->name);
  return [arguments] { return run(*arguments); };
}

}  // namespace

const Command importCommand{"import",
                            "take a printer from a file of your slicer",
                            "FILE",
                            "--name",
                            "Examples:\n"
                            "  sillon import part.gcode > mine.json\n"
                            "  sillon generate mine.json --shape disc --gcode disc.gcode",
                            add};

}  // namespace sillon::cli
