#include <string>

#include "base/numbers.hpp"
#include "gcode_reader/parser.hpp"
#include "rebrush/stretches.hpp"

namespace sillon {
namespace {

constexpr double kShortWipe = 1;  // [mm] length up to which Cura's first move without plastic may be a wipe
// [mm] Length below which relative moves behind a retraction are passed over: with these, end blocks step aside from
// wherever the nozzle is.
constexpr double kAside = 10;
constexpr int kLookAhead = 500;  // lines behind a block in which its next travel is looked for

// Key of a command. Commands of one key replace each other altogether: they have the same name, set the same
// parameters, and are for the same tool.
std::string kindOf(const GcodeCommand& command) {
  std::string kind(command.name);
  if (command.is('M', 117)) return kind;  // it is followed by text, not by parameters
  std::string_view rest = command.rest;
  while (!(rest = trimmed(rest)).empty()) {
    const std::string_view word = rest.substr(0, rest.find(' '));
    rest.remove_prefix(word.size());
    const std::size_t equal = word.find('=');
    const bool named = command.letter == 0 && equal != std::string_view::npos;
    double value = 0;
    const bool number = named && readNumber(word.substr(equal + 1), value) > 0;
    const bool whose =
        command.letter == 0 ? !number : std::string_view("TDPtdp").find(word[0]) != std::string_view::npos;
    kind += ' ';
    kind += whose ? word : word.substr(0, named ? equal : 1);
  }
  return kind;
}

}  // namespace

void leaveSurface(SurfaceBlock& block, LeftBecause why) {
  if (block.surface.left == LeftBecause::None) block.surface.left = why;
}

void keepCommand(std::string_view line, KeptPlaces& places, SurfaceBlock& block) {
  const GcodeParts parts = partsOf(line);
  const auto put = [&](const std::string& key) {
    const auto [place, fresh] = places.emplace(key, block.kept.size());
    if (!fresh) block.kept[place->second].clear();
    place->second = block.kept.size();
    block.kept.emplace_back(line);
  };
  if (parts.code.empty()) {
    const Mark mark = readMark(parts.comment);
    if (mark.kind == MarkKind::Width) put("width");
    if (mark.kind == MarkKind::Height) put("height");
    return;
  }
  const GcodeCommand command = commandOf(parts.code);
  if (command.letter == 'G' && command.sub == 0) {
    const bool origin = command.code == 92 && parts.code.find_first_of("XYZ") == std::string_view::npos;
    const bool ofTool = command.rest.find_first_of("PLpl") != std::string_view::npos;
    const bool retraction = (command.code == 10 && !ofTool) || command.code == 11;
    if (!origin && !retraction && command.code != 90) leaveSurface(block, LeftBecause::Command);
    return;
  }
  if (command.isAny('M', {82, 83})) return;
  if (command.isAny('M', {106, 107})) return put("fan " + decimal(wordsOf(command.rest).at('P'), 3));
  // M104 and M140 set a temperature without waiting for it.
  if (command.isAny('M', {73, 104, 117, 140, 201, 203, 204, 205, 572, 900}) || command.name == "SET_VELOCITY_LIMIT" ||
      command.name == "SET_PRESSURE_ADVANCE" || command.name == "SET_PRINT_STATS_INFO") {
    return put(kindOf(command));
  }
  leaveSurface(block, LeftBecause::Command);
}

void lookAhead(std::string_view gcode, bool byCura, SurfaceBlock& block) {
  MachineState machine = block.after;
  std::optional<Vec2> aside;  // end of a short move of Cura: a wipe if a retraction follows, else the travel
  std::size_t asideEnd = 0;
  int lines = 0;
  std::string_view rest = gcode.substr(block.surface.end);
  std::size_t offset = block.surface.end;
  while (!rest.empty() && lines++ < kLookAhead) {
    const std::size_t lineFeed = rest.find('\n');
    const std::size_t size = lineFeed == std::string_view::npos ? rest.size() : lineFeed + 1;
    const GcodeParts parts = partsOf(trimmed(rest.substr(0, size - (lineFeed == std::string_view::npos ? 0 : 1))));
    const std::size_t begin = offset;
    rest.remove_prefix(size);
    offset += size;
    if (parts.code.empty()) continue;
    const GcodeCommand command = commandOf(parts.code);
    if (command.is('G', 28) || command.is('M', 84)) return;
    const GcodeWords words = readsWords(command) ? wordsOf(command.rest) : GcodeWords{};
    if (command.is('G', 92) && (words.has('X') || words.has('Y'))) return leaveSurface(block, LeftBecause::Travel);
    const auto move = runCommand(machine, command, words);
    if (!move || !move->xy) continue;
    const bool tight = machine.firmwareRetracted || machine.retracted > block.after.retracted + 0.05;
    if (aside && !tight) {
      block.wipes.clear();
      block.next = aside;
      block.nextEnd = asideEnd;
      return;
    }
    if (tight && !machine.absolute && move->e <= 0 && move->length < kAside) continue;
    if (!machine.absolute || move->arc || machine.inches || move->e > 0)
      return leaveSurface(block, LeftBecause::Travel);
    if (move->e < 0) {
      if (!words.has('X') || !words.has('Y')) return leaveSurface(block, LeftBecause::Travel);
      block.wipes.push_back({begin, offset, move->length});
      continue;
    }
    // A coordinate that is left out stays as the block leaves it, and the new beads end elsewhere.
    if (!words.has('X') || !words.has('Y')) return leaveSurface(block, LeftBecause::Travel);
    if (byCura && block.wipes.empty() && !(move->toldF && tight) && move->length < kShortWipe &&
        block.after.at == move->from && move->z == move->zFrom) {
      block.wipes.push_back({begin, offset, move->length});
      if (move->toldF) aside = move->to;
      asideEnd = offset;
      continue;
    }
    block.next = move->to;
    block.nextEnd = offset;
    block.tightBefore = tight;
    return;
  }
}

}  // namespace sillon
