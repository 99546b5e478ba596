#include "gcode_reader/rules.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "base/sentence.hpp"

namespace sillon {
namespace {

struct Sentence {
  std::string_view code;
  std::string_view rule;
  std::string_view text;  // {name}: a value
};

// Sorted by rule. A new sentence gets a row here, and its rule the studio's words for its rule.
constexpr Sentence kSentences[] = {
    {"never", "commands", "{command} does not belong in a print file"},
    {"files", "commands", "{command} reaches files, the network or the printer's programs"},
    {"unfollowed", "commands", "{command} moves or heats in a way that nobody can follow"},
    {"runs", "commands", "{command} runs commands that are not in this file"},
    {"out-of-range", "commands", "{command} is beyond {limits}"},
    {"offset", "commands", "offsets move {axis} by {mm} mm in all, beyond {limits}"},
    {"long-wait", "commands", "{command} waits for {minutes} minutes"},
    {"cold-extrusion", "commands", "{command} lets the printer push cold filament"},
    {"macro", "commands", "{command} is a macro of the printer; what it does is not in this file"},
    {"unknown", "commands", "{command} is not in the list of known commands"},

    {"no-plain-line", "grammar", "the line {text} {fault}"},
    {"cr-lf", "grammar", "lines end with CR LF; LF alone is what every host reads"},
    {"cr", "grammar", "a line ends with CR alone, which hides what follows from most viewers"},
    {"not-a-word", "grammar", "not a word: {text}"},
    {"no-number", "grammar", "no number after a letter in {text}"},
    {"no-plain-number", "grammar", "no plain number: {text}"},
    {"unread-arc", "grammar", "an arc without a centre, or whose circle does not reach its end"},
    {"letter-twice", "grammar", "a letter given twice in {text}"},
    {"lower-case", "grammar", "lower case letters in {text}; some firmwares skip them"},
    {"crowded", "grammar", "words without spaces between them in {text}"},
    {"long-command", "grammar", "a command of more than 95 characters, which Marlin cuts"},
    {"line-numbers", "grammar", "line numbers; they belong to a host's protocol, not into a file"},
    {"no-command", "grammar", "no command: {text}"},

    {"unhomed", "homing", "moves before it homes (G28)"},

    {"too-hot", "heating", "hotter than {limit} degrees: {degrees}"},
    {"cold-start", "heating", "extrudes before it has waited for a hot nozzle (M109)"},
    {"cold-bed", "heating", "extrudes before it has waited for a hot bed (M190)"},
    {"cold-bead", "heating", "extrudes with the nozzle at {degrees} degrees"},

    {"inches", "modes", "the file switches to inches (G20); everything else is in millimetres"},
    {"origin", "modes", "G92 moves the origin of an axis; places on the bed can no longer be told"},
    {"origin-shift", "modes", "G92 leaves the origin of an axis {mm} mm off; the print would be laid there"},
    {"volumetric", "modes", "volumetric extrusion (M200) changes what every E means"},

    {"excluded", "bounds", "a bead in the excluded part of the bed"},
    {"off-bed", "bounds", "{what} over the bed's edge at {place}, {mm} mm"},

    {"too-high", "height", "above the printer's height: {mm} mm"},
    {"below-print", "height", "moves below the print on the bed: Z {mm}"},
    {"below-bed", "height", "moves below the bed: Z {mm}"},
    {"in-print", "height", "moves {mm} mm below the top of what is printed there"},
    {"in-air", "height", "a bead in the air: Z {z}, and nothing printed is higher than {top}"},
    {"off-layer", "height", "a bead at Z {z} in a layer that ends at {top}"},
    {"homes-on-print", "height", "{command} after the first layer: most printers come down on the print"},
    {"bead-in-bed", "height", "a bead at or below the bed: Z {mm}"},

    {"too-thick", "extrusion", "more plastic per mm than 4 nozzle diameters squared: {area} mm2"},
    {"long-prime", "extrusion", "more than 50 mm of filament in one move"},
    {"blob", "extrusion", "pushes {mm} mm of filament without moving"},
    {"no-move", "extrusion", "there is no move in it"},
    {"no-bead", "extrusion", "it moves but lays no bead"},

    {"flow", "flow", "more flow than maxFlow: {flow} mm3/s"},

    {"speed-zero", "speed", "F is not above 0"},
    {"no-speed", "speed", "moves before any F"},
    {"too-fast", "speed", "faster than the printer: {speed} mm/s"},

    {"rate", "rate", "more moves per second than the printer takes: {rate}"},

    {"bead-retracted", "retraction", "extrudes while retracted by {mm} mm"},
    {"bead-g10", "retraction", "extrudes while G10 holds filament back; G11 returns it"},
    {"travel-unretracted", "retraction", "travels without retraction over {mm} mm"},
    {"far-retracted", "retraction", "retracted further than any hot end is long"},

    {"gap", "cycle", "a gap of travel inside a path"},
    {"open-cycle", "cycle", "a cycle that does not close: it ends {mm} mm off"},

    {"coverage", "coverage", "an oriented layer covers {percent} % of the layers below it"},
    {"noise", "noise", "the path zigzags by {um} um; above 5 printers brake for it"},

    {"outlives", "settings", "{command} outlives the print"},

    {"filament-total", "totals", "it says it takes {told} mm of filament; its moves take {counted}"},
    {"layer-total", "totals", "it says it has {told} layers; {counted} are marked"},

    {"no-layers", "layers",
     "no layer is marked (;LAYER_CHANGE, ;LAYER:0 or ; CHANGE_LAYER), so all of it counts as a start block: it may "
     "reach 10 "
     "mm over the bed's edge, and beads are not measured"},

    {"cut-off", "end", "the file ends in the middle of its moves, with a hot nozzle"},
    {"hot-nozzle", "end", "the nozzle stays hot at the end"},
    {"hot-bed", "end", "the bed stays hot at the end"},
    {"hot-chamber", "end", "the chamber stays hot at the end"},
};

}  // namespace

GcodeFinding makeFinding(std::string_view code, bool error, FindingValues values) {
  const auto* sentence = std::find_if(std::begin(kSentences), std::end(kSentences),
                                      [&](const Sentence& candidate) { return candidate.code == code; });
  assert(sentence != std::end(kSentences));
  GcodeFinding finding;
  finding.code = std::string(code);
  finding.rule = std::string(sentence->rule);
  finding.error = error;
  finding.values = std::move(values);
  finding.message = filledFrom(sentence->text, finding.values);
  return finding;
}

std::string shownText(std::string_view text) {
  std::string out = "\"";
  for (const char c : text.substr(0, 60)) out += c < ' ' || c > '~' || c == '"' ? '?' : c;
  return out + "\"";
}

}  // namespace sillon
