#include "printer_import/notes.hpp"

#include <algorithm>

#include "base/sentence.hpp"

namespace sillon {
namespace {

constexpr Sentence kSentences[] = {
    // Settings.
    {"NotANumber", "{key} is {value}, which is not a number"},
    {"OutOfRange", "{key} is {value}; it must be {low} to {high}"},
    {"Thumbnails", "{key} is {value}; at most 8 sizes as PNG or QOI are taken"},
    {"BedShape", "{key} is {value}; it must be corners such as \"0x0,220x0,220x220,0x220\""},
    {"BedUnknown", "the file does not give the bed's size; {width} x {depth} mm is assumed"},
    {"BedCorners", "the bed has {count} corners; the box around them is used"},
    {"FilamentGuessed", "the file gives no filament diameter; its beads match {diameter} mm, which is assumed"},
    {"FilamentUnclear",
     "the file gives no filament diameter; with the {diameter} mm that is assumed, its beads would be {width} mm wide, "
     "from a nozzle of {nozzle} mm; check both"},
    {"FlowTaken", "the flow ratio of the file's filament is {value}; it is kept, and multiplies all that is extruded"},
    {"ExcludedArea", "{key} is {value}; only one box can be excluded"},
    {"Flavor", "{key} is {value}; known are Marlin, Klipper and RepRapFirmware; Marlin is assumed"},
    {"BlockTooLong", "{key} is {value}; a block may have 65536 bytes"},
    // Bundles and presets.
    {"SectionMissing", "{section} is inherited, but missing from the file"},
    {"InheritedTooDeep", "the file inherits in a circle, or from more than 1000 sections; the rest is missing"},
    {"InheritedElsewhere", "the file inherits from {name}, which is in another file; defaults fill the gaps"},
    // Start and end blocks of a file that was printed.
    {"FixedArea", "the start block names a fixed area ({line}); check that the plate lies there"},
    {"FixedTemperatures",
     "the start block heats for purposes of its own ({lines}); these temperatures do not follow the filament"},
    {"Factor", "the start block has {line}, which scales the speed; it is set back to 100 % after the block"},
    {"FlowFactor", "the start block has {line}, which scales the flow of the whole of each print"},
    {"EndHeights", "heights in the end block were left out; the nozzle is lifted by 10 mm before it"},
    {"EndPlaces", "places more than 10 mm off the bed were left out of the end block"},
    {"NoHoming", "the start block does not home"},
    {"NoNozzleWait", "the start block does not wait for a hot nozzle (M109)"},
    {"NoBedWait", "the start block does not wait for a hot bed (M190)"},
    {"BeyondBed", "the start block moves beyond the bed: {detail}"},
};

}  // namespace

std::span<const Sentence> importNoteSentences() { return kSentences; }

ImportNote importNote(std::string_view code, std::initializer_list<std::pair<const char*, std::string>> values) {
  return {std::string(code), {values.begin(), values.end()}, filled(sentenceOf(kSentences, code), values)};
}

ImportNote importNote(const Error& error) {
  ImportNote note{error.reason, {}, error.message};
  for (const NamedValue& value : error.values) note.values.emplace_back(value.name, textOf(value));
  return note;
}

void addNote(std::vector<ImportNote>& notes, ImportNote note) {
  const auto same = [&](const ImportNote& other) { return other.message == note.message; };
  if (std::none_of(notes.begin(), notes.end(), same)) notes.push_back(std::move(note));
}

}  // namespace sillon
