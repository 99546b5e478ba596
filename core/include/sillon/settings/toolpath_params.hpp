// What a person may choose about the toolpath. Each field is a row of the documentation: default, unit, range.
#pragma once

#include <cstdint>
#include <optional>

namespace sillon {

/// How beads meet the border.
enum class PerimeterMode {
  None,   ///< beads end at the border in U-turns
  Soft,   ///< beads follow the border where the directions allow it, and end there where they do not
  Count,  ///< `perimeters` beads follow the border
};

enum class MapFilter {
  Average,  ///< lines averaged over a cell, as numbers e^{2i angle}
  Nearest,  ///< the texel under the cell's centre
};

/// How the wave of a neighbour is carried over (Eq. 8).
enum class PhaseTransport {
  Midpoint,   ///< by the mean of both lines: second order
  Neighbour,  ///< by the neighbour's line alone, as published in 2023: first order
};

struct ToolpathParams {
  double spacing = 0.4;  ///< tau [mm], distance between neighbouring beads, 0.05..20
  PerimeterMode perimeterMode = PerimeterMode::Count;
  int perimeters = 1;            ///< beads along the border in mode Count, 0..100
  std::optional<double> bridge;  ///< solids nearer than this count as one part [mm], 0..100; unset: one spacing
  MapFilter mapFilter = MapFilter::Average;
  std::uint64_t seed = 0;  ///< 0: regular sample points; others: moved by `jitter`, another plate of like quality
  double jitter = 0.025;   ///< how far a seed moves sample points [tau], 0..0.25
  PhaseTransport phaseTransport = PhaseTransport::Midpoint;
  int sweepsPerLevel = 8;         ///< smoothing sweeps on each level of the hierarchy, 1..1000
  double spacingVariation = 0.3;  ///< beads may lie up to e^this closer or wider where that saves U-turns, 0..0.5
  double directionTolerance =
      0;                         ///< beads may run up to so far off the lines where that saves U-turns [degrees], 0..30
  double kernelRadius = 1;       ///< over which the waves of cells are averaged: three sigma of Eq. 13 [tau], 0.45..1.5
  double borderWeight = 1;       ///< soft border: weight of the border's wave against a neighbour's, 0..100
  double stitchAlignment = 1.1;  ///< cost of misaligned length made by a stitch, against 0.65 of added length, 0..10
  int relaxationRounds = 2;      ///< rounds of spacing relaxation, 0..100
  double relaxationStrength = 0.08;   ///< move towards the wider side per round, of the gaps' difference, 0..0.5
  double relaxationSmoothing = 0.65;  ///< pull towards the neighbours' middle per round, 0..1
  double widthBalance = 1;  ///< 0: the nearer neighbour bounds a bead on both sides (Eq. 16); 1: the room does, 0..1
  double beadOverlap = 0.0021;        ///< how far beads may overlap [tau], 0..1; 1: they are not held apart
  double minWidth = 0.5;              ///< narrowest bead [tau], 0.1..1
  double maxWidth = 2;                ///< widest bead [tau], 1..4
  double simplifyTolerance = 0.0013;  ///< largest change of position and width by leaving out points [mm], 0..1

  friend bool operator==(const ToolpathParams&, const ToolpathParams&) = default;
};

/// Beads that follow the border whatever the directions: none in the other modes.
inline int countedPerimeters(const ToolpathParams& params) {
  return params.perimeterMode == PerimeterMode::Count ? params.perimeters : 0;
}

}  // namespace sillon
