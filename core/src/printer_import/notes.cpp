#include "printer_import/notes.hpp"

#include <algorithm>
#include <cassert>

#include "base/sentence.hpp"

namespace sillon {
namespace {

struct Sentence {
  std::string_view code;
  std::string_view text;  // {name} stands for a value
};

constexpr Sentence kSentences[] = {
    // Settings.
    {"NotANumber", "{key} is {value}; it must be a number"},
    {"OutOfRange", "{key} is {value}; taken are {low} to {high}"},
    {"Thumbnails", "{key} is {value}; taken are at most 8 sizes as PNG or QOI"},
    {"BedShape", "{key} is {value}; it must be corners such as \"0x0,220x0,220x220,0x220\""},
    {"BedUnknown", "the file does not tell the bed; {width} x {depth} mm is taken"},
    {"BedCorners", "the bed has {count} corners; the box around them is taken"},
    {"FilamentGuessed", "the file does not tell the filament's diameter; its beads fit {diameter} mm, which is taken"},
    {"FilamentUnclear",
     "the file does not tell the filament's diameter; with the {diameter} mm that is taken its beads would be {width} "
     "mm wide, from a nozzle of {nozzle} mm; check both"},
    {"FlowTaken",
     "the flow ratio of the file's filament is {value}, which is taken: all that is laid is multiplied by it"},
    {"ExcludedArea", "{key} is {value}; it must be one box of corners"},
    {"Flavor", "{key} is {value}; known are Marlin, Klipper and RepRapFirmware; Marlin is taken"},
    {"BlockTooLong", "{key} is {value}; a block may have 65536 bytes"},
    {"Placeholder", "{detail}"},
    // Bundles and presets.
    {"SectionMissing", "{section} is inherited, but not in the file; its values are missing"},
    {"InheritedTooDeep", "the file inherits in a circle, or from more than 1000 sections; the rest is missing"},
    {"InheritedElsewhere", "the file inherits from {name}, which lies in another file; what it lacks is ours"},
    // Start and end blocks of a file that was printed.
    {"FixedArea", "the start block names a fixed area ({line}); check that it is where the plate lies"},
    {"FixedTemperatures", "the start block heats for purposes of its own ({lines}); these do not follow the filament"},
    {"Factor", "the start block has {line}, a share of the speed; files written here go back to 100 % after it"},
    {"FlowFactor", "the start block has {line}, a share of the flow, which holds for the whole of each print"},
    {"EndHeights", "heights in the end block were left out; the nozzle is lifted by 10 mm before it"},
    {"EndPlaces", "places more than 10 mm off the bed were left out of the end block"},
    {"NoHoming", "the start block does not home"},
    {"NoNozzleWait", "the start block does not wait for a hot nozzle (M109)"},
    {"NoBedWait", "the start block does not wait for a hot bed (M190)"},
    {"BeyondBed", "{detail}"},
};

}  // namespace

std::vector<std::string> importNoteCodes() {
  std::vector<std::string> codes;
  for (const Sentence& sentence : kSentences) codes.emplace_back(sentence.code);
  return codes;
}

ImportNote importNote(std::string_view code, std::initializer_list<std::pair<const char*, std::string>> values) {
  ImportNote note{std::string(code), {values.begin(), values.end()}, {}};
  const auto* row = std::find_if(std::begin(kSentences), std::end(kSentences),
                                 [&](const Sentence& sentence) { return sentence.code == code; });
  assert(row != std::end(kSentences));
  note.message = filledFrom(row->text, note.values);
  return note;
}

void addNote(std::vector<ImportNote>& notes, ImportNote note) {
  const auto same = [&](const ImportNote& other) { return other.message == note.message; };
  if (std::none_of(notes.begin(), notes.end(), same)) notes.push_back(std::move(note));
}

}  // namespace sillon
