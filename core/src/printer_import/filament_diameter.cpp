#include "printer_import/filament_diameter.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "gcode_reader/layer_mark.hpp"
#include "gcode_reader/machine.hpp"
#include "gcode_reader/parser.hpp"

namespace sillon {
namespace {

constexpr double kLeastLength = 100;           // [mm] of beads, or too little is known
constexpr double kShortest = 0.5;              // [mm] of a bead: its E is rounded
constexpr double kThinnest = 0.04;             // [mm] of a layer
constexpr double kThickest = 1.6;              // [mm]
constexpr std::size_t kMostBeads = 1'000'000;  // that are judged

/// A bead's length [mm] and its filament per length [mm/mm].
struct Bead {
  double length;
  double filament;
};

}  // namespace

std::optional<double> filamentPerFace(std::string_view gcode, GcodeFlavor flavor) {
  MachineState machine(flavor);
  std::vector<std::pair<double, double>> judged;  // filament per face of a bead [1/mm], its length [mm]
  std::vector<Bead> layer;
  double z = 0;
  double below = 0;
  bool begun = false;
  const auto finish = [&] {
    const double height = z - below;
    if (layer.empty()) return;
    if (height >= kThinnest && height <= kThickest) {
      for (const Bead& bead : layer) judged.emplace_back(bead.filament / height, bead.length);
    }
    below = z;
    layer.clear();
  };
  forEachLine(gcode, [&](const GcodeLine& line) {
    const GcodeParts parts = partsOf(line.text);
    begun = begun || layerMark(parts.comment) != LayerMark::None;
    if (parts.code.empty() || judged.size() > kMostBeads) return;
    const GcodeCommand command = commandOf(parts.code);
    const auto move = runCommand(machine, command, readsWords(command) ? wordsOf(command.rest) : GcodeWords{});
    if (!begun || !move || !(move->e > 0) || move->length < kShortest || move->z != move->zFrom) return;
    if (move->z != z) {
      finish();
      z = move->z;
    }
    layer.push_back({move->length, move->e / move->length});
  });
  finish();

  double total = 0;
  for (const auto& [filament, length] : judged) total += length;
  if (total < kLeastLength) return std::nullopt;
  std::sort(judged.begin(), judged.end());
  double passed = 0;
  for (const auto& [filament, length] : judged) {
    passed += length;
    if (passed >= total / 2) return filament;
  }
  return std::nullopt;
}

}  // namespace sillon
