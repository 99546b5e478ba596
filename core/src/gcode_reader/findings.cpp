#include "gcode_reader/rules.hpp"

#include <algorithm>
#include <cassert>

namespace sillon {
namespace {

constexpr FindingRow kRows[] = {
    {"commands", {"never", "{command} does not belong in a print file"}},
    {"commands", {"files", "{command} reaches files, the network or the printer's programs"}},
    {"commands", {"unfollowed", "{command} moves or heats in a way that cannot be followed"}},
    {"commands", {"runs", "{command} runs commands that are not in this file"}},
    {"commands", {"out-of-range", "{command} is {value}; it must be {low} to {high}"}},
    {"commands", {"offset", "offsets move {axis} by {mm} mm in all; it must be {low} to {high}"}},
    {"commands", {"long-wait", "{command} waits for {minutes} minutes"}},
    {"commands", {"cold-extrusion", "{command} lets the printer push cold filament"}},
    {"commands", {"macro", "{command} is a macro of the printer; what it does is not in this file"}},
    {"commands", {"unknown", "{command} is not in the list of known commands"}},

    {"grammar", {"no-ascii", "the line {text} has a character that is not printable ASCII"}},
    {"grammar", {"long-line", "the line {text} is longer than the 95 characters that Marlin reads"}},
    {"grammar", {"no-plain-line", "the line {text} is not a plain command"}},
    {"grammar", {"cr-lf", "lines end with CR LF; every host reads LF alone"}},
    {"grammar", {"cr", "a line ends with CR alone, which hides what follows from most viewers"}},
    {"grammar", {"not-a-word", "not a word: {text}"}},
    {"grammar", {"no-number", "no number after a letter in {text}"}},
    {"grammar", {"no-plain-number", "no plain number: {text}"}},
    {"grammar", {"unread-arc", "an arc without a centre, or whose circle does not reach its end"}},
    {"grammar", {"letter-twice", "a letter given twice in {text}"}},
    {"grammar", {"lower-case", "lower case letters in {text}; some firmwares skip them"}},
    {"grammar", {"crowded", "words without spaces between them in {text}"}},
    {"grammar", {"long-command", "a command of more than 95 characters, which Marlin cuts"}},
    {"grammar", {"line-numbers", "line numbers; they belong to a host's protocol, not into a file"}},
    {"grammar", {"no-command", "no command: {text}"}},

    {"homing", {"unhomed", "moves before it homes (G28)"}},

    {"heating", {"too-hot", "hotter than {limit} degrees: {degrees}"}},
    {"heating", {"cold-start", "extrudes before it has waited for a hot nozzle (M109)"}},
    {"heating", {"cold-bed", "extrudes before it has waited for a hot bed (M190)"}},
    {"heating", {"cold-bead", "extrudes with the nozzle at {degrees} degrees"}},

    {"modes", {"inches", "the file switches to inches (G20); everything else is in millimetres"}},
    {"modes", {"origin", "G92 moves the origin of an axis; places on the bed are no longer known"}},
    {"modes", {"origin-shift", "G92 leaves the origin of an axis {mm} mm off; the print would be shifted by that"}},
    {"modes", {"volumetric", "volumetric extrusion (M200) changes what every E means"}},

    {"bounds", {"excluded", "a bead in the excluded part of the bed"}},
    {"bounds", {"bead-off-bed", "a bead over the bed's edge at {place}, {mm} mm"}},
    {"bounds", {"arc-off-bed", "an arc over the bed's edge at {place}, {mm} mm"}},
    {"bounds", {"move-off-bed", "a move over the bed's edge at {place}, {mm} mm"}},

    {"height", {"too-high", "above the printer's height: {mm} mm"}},
    {"height", {"below-print", "moves below the print on the bed: Z {mm}"}},
    {"height", {"below-bed", "moves below the bed: Z {mm}"}},
    {"height", {"in-print", "moves {mm} mm below the top of what is printed there"}},
    {"height", {"in-air", "a bead in the air: Z {z}, and nothing printed is higher than {top}"}},
    {"height", {"off-layer", "a bead at Z {z} in a layer that ends at {top}"}},
    {"height", {"homes-on-print", "{command} after the first layer: most printers come down on the print"}},
    {"height", {"bead-in-bed", "a bead at or below the bed: Z {mm}"}},

    {"extrusion", {"too-thick", "more plastic per mm than 4 nozzle diameters squared: {area} mm2"}},
    {"extrusion", {"long-prime", "more than 50 mm of filament in one move"}},
    {"extrusion", {"blob", "pushes {mm} mm of filament without moving"}},
    {"extrusion", {"no-move", "the file has no move"}},
    {"extrusion", {"no-bead", "the file moves but lays no bead"}},

    {"flow", {"flow", "more flow than printer.maxFlow: {flow} mm3/s"}},

    {"speed", {"speed-zero", "F is not above 0"}},
    {"speed", {"no-speed", "moves before any F"}},
    {"speed", {"too-fast", "faster than the printer: {speed} mm/s"}},

    {"rate", {"rate", "more moves per second than the printer takes: {rate}"}},

    {"retraction", {"bead-retracted", "extrudes while retracted by {mm} mm"}},
    {"retraction", {"bead-g10", "extrudes while G10 holds filament back; G11 returns it"}},
    {"retraction", {"travel-unretracted", "travels without retraction over {mm} mm"}},
    {"retraction", {"far-retracted", "retracted further than any hot end is long"}},

    {"cycle", {"gap", "a gap of travel inside a path"}},
    {"cycle", {"open-cycle", "a cycle that does not close: it ends {mm} mm off"}},

    {"coverage", {"coverage", "a top layer covers {percent} % of the layers below it"}},

    {"settings", {"outlives", "{command} outlives the print"}},

    {"totals", {"filament-total", "the file states {told} mm of filament; its moves take {counted}"}},
    {"totals", {"layer-total", "the file states {told} layers; {counted} are marked"}},

    {"layers",
     {"no-layers",
      "no layer is marked (;LAYER_CHANGE, ;LAYER:0 or ; CHANGE_LAYER), so all of it counts as a start block: it may "
      "reach 10 mm over the bed's edge, and its beads are not measured"}},

    {"end", {"cut-off", "the file ends in the middle of its moves, with a hot nozzle"}},
    {"end", {"hot-nozzle", "the nozzle stays hot at the end"}},
    {"end", {"hot-bed", "the bed stays hot at the end"}},
    {"end", {"hot-chamber", "the chamber stays hot at the end"}},
};

constexpr auto kSentences = sentencesOf(kRows);

}  // namespace

std::span<const Sentence> findingSentences() { return kSentences; }

GcodeFinding makeFinding(std::string_view code, bool error, FindingValues values) {
  return makeFinding(kRows, code, error, std::move(values));
}

GcodeFinding makeFinding(std::span<const FindingRow> rows, std::string_view code, bool error, FindingValues values) {
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const FindingRow& one) { return one.sentence.code == code; });
  assert(row != rows.end());
  const Sentence& sentence = row->sentence;
  GcodeFinding finding;
  finding.code = std::string(code);
  finding.rule = row->rule;
  finding.error = error;
  finding.count = 1;
  finding.values = std::move(values);
  finding.message = filled(sentence, finding.values);
  return finding;
}

std::string shownText(std::string_view text) {
  std::string out = "\"";
  for (const char c : text.substr(0, 60)) out += c < ' ' || c > '~' || c == '"' ? '?' : c;
  return out + "\"";
}

}  // namespace sillon
