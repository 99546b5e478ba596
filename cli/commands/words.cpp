// sillon words: prints the sentences of warnings, notes, findings and refusals by their codes, for translators and
// programs.
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "commands/commands.hpp"
#include "run.hpp"
#include "sillon/base/result.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/printer_import/printer_import.hpp"
#include "sillon/rebrush/rebrush.hpp"
#include "sillon/report/warning.hpp"

namespace sillon::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the sentences of each kind.
Json words() {
  Json all;
  for (const auto& [kind, sentences] :
       {std::pair("warnings", warningSentences()), std::pair("inputNotes", inputNoteSentences()),
        std::pair("importNotes", importNoteSentences()), std::pair("findings", findingSentences()),
        std::pair("printFindings", printFindingSentences()), std::pair("surfaces", surfaceSentences()),
        std::pair("reasons", reasonSentences()), std::pair("hints", errorHints())}) {
    for (const Sentence& sentence : sentences) all[kind][sentence.code] = sentence.text;
  }
  return all;
}

std::string wordsTable() {
  std::string out;
  const Json all = words();
  for (const auto& [kind, sentences] : all.items()) {
    out += (out.empty() ? "" : "\n") + kind + "\n";
    for (const auto& [code, text] : sentences.items()) out += "  " + code + ": " + text.get<std::string>() + "\n";
  }
  return out;
}

Action add(Options& options) {
  const auto json = std::make_shared<bool>(false);
  options.group("Options");
  options.flag("--json", "print JSON instead of text", *json);
  return [json] { return answer(*json ? words().dump(2) + "\n" : wordsTable()); };
}

}  // namespace

const Command wordsCommand{
    "words", "list the sentences of warnings, notes, findings and refusals, by their codes", "", "--json", "", add};

}  // namespace sillon::cli
