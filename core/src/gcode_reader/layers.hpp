// The beginnings of layers.
#pragma once

#include <string_view>
#include <vector>

#include "gcode_reader/machine.hpp"

namespace sillon {

// The comments by which slicers mark where a layer begins, and what lies outside the print.

/// PrusaSlicer, Cura and Orca; Orca and Bambu Studio for Bambu's printers; Simplify3D.
enum class LayerMark { None, Usual, Bambu, Simplify };

/// \param comment  behind ';', trimmed. Cura counts the layers of a raft from below 0.
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

/// Whether what a role names is no part of the print: blocks of the machine, and what is purged beside it.
inline bool isPurge(std::string_view role) {
  for (const std::string_view name : {"Custom", "Wipe tower", "Prime tower", "PRIME-TOWER", "Flush"}) {
    if (role == name) return true;
  }
  return false;
}

// Heights of what a file has printed, place by place.

/// Heights of the nozzle while it laid beads, on cells of 1 mm. All [mm].
class LaidHeights {
 public:
  /// Raises what a bead passes over; places further than 5 m from the origin are left out.
  void add(const MachineMove& bead);

  /// Greatest depth of a move below what stands under it; 0 where it does not.
  [[nodiscard]] double depthOf(const MachineMove& move) const;

  /// Length of a move that goes through what stands under it, or closer above it than `gap` [mm].
  [[nodiscard]] double touched(const MachineMove& move, double gap) const;

  /// Height of the highest bead; 0 before the first.
  [[nodiscard]] double top() const { return top_; }

 private:
  std::vector<std::vector<float>> tiles_;  // rows of tiles of 64 x 64 cells, without any where nothing lies
  double top_ = 0;
};

}  // namespace sillon
