// Marks of layers, and heights of what is printed.
#pragma once

#include <string_view>
#include <vector>

#include "gcode_reader/machine.hpp"

namespace sillon {

// Comments by which slicers mark the beginning of a layer, and roles that are no part of the print.

/// Kinds of marks. Usual: PrusaSlicer, Cura and OrcaSlicer; Bambu: OrcaSlicer and Bambu Studio for Bambu's printers;
/// Simplify: Simplify3D.
enum class LayerMark { None, Usual, Bambu, Simplify };

/// Reads a comment as the mark of a layer. Cura gives the layers of a raft numbers below 0.
/// \param comment  text behind ';', trimmed.
inline LayerMark layerMark(std::string_view comment) {
  if (comment == "LAYER_CHANGE") return LayerMark::Usual;
  if (comment.starts_with("LAYER:")) {
    const std::string_view number = comment.substr(comment.starts_with("LAYER:-") ? 7 : 6);
    return !number.empty() && number[0] >= '0' && number[0] <= '9' ? LayerMark::Usual : LayerMark::None;
  }
  if (comment == "CHANGE_LAYER") return LayerMark::Bambu;
  const bool simplify = comment.starts_with("layer ") && comment.find(", Z = ") != std::string_view::npos;
  return simplify ? LayerMark::Simplify : LayerMark::None;
}

/// Tells whether a role is no part of the print: the machine's blocks, and what is purged beside the print.
inline bool isPurge(std::string_view role) {
  for (const std::string_view name : {"Custom", "Wipe tower", "Prime tower", "PRIME-TOWER", "Flush"}) {
    if (role == name) return true;
  }
  return false;
}

// Heights of what a file has printed, place by place.

/// Greatest heights of the nozzle while it laid beads, on cells of 1 mm; lengths in mm.
class LaidHeights {
 public:
  /// Raises the cells that a bead passes over; places further than 5 m from the origin are left out.
  void add(const MachineMove& bead);

  /// Greatest depth to which a move goes into what is printed; 0 if it stays above.
  [[nodiscard]] double depthOf(const MachineMove& move) const;

  /// Length of a move that goes through what is printed, or less than `gap` above it [mm].
  [[nodiscard]] double touched(const MachineMove& move, double gap) const;

  /// Height of the highest bead; 0 before the first.
  [[nodiscard]] double top() const { return top_; }

 private:
  std::vector<std::vector<float>> tiles_;  // rows of tiles of 64 x 64 cells; a tile on which nothing lies is empty
  double top_ = 0;
};

}  // namespace sillon
