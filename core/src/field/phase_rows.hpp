// The two loops over rows of cells that aligning phases is made of. They take four cells at a time.
#pragma once

#include <cstddef>

namespace sillon {

/// Edges kept per cell: to the neighbours at (1,0), (0,1), (1,1), (-1,1).
inline constexpr std::size_t kEdges = 4;

/// A sum of phases shorter than this keeps the old phase.
inline constexpr float kNoPhase = 1e-9f;

/// A row of cells i, and of their neighbours j across one of the edges.
struct EdgeRow {
  const float* dix;  ///< lines; 0 where masked
  const float* diy;
  const float* fi;  ///< frequencies
  const float* djx;
  const float* djy;
  const float* fj;
  float offsetX;  ///< from j to i, in cells
  float offsetY;
  const float* moveX;  ///< added to it for each cell; null for none
  const float* moveY;
  float weight;   ///< Gaussian, of the edge
  float step;     ///< of a phase over one cell [rad]
  bool midpoint;  ///< whether the wave between them is that of both, or of j
  float* re;      ///< out: see Transport of phase_field.cpp
  float* im;
  float* sign;
  float* backRe;  ///< unless `midpoint`
  float* backIm;
};
/// Eq. 8 for the edges of a row. \param cells  may run over the row's end, to the end of a vector.
void fillEdges(const EdgeRow& row, int cells);

struct SweepSource {
  const float* re;
  const float* im;
  const float* sign;
  const float* qr;
  const float* qi;
};

/// What the update of one colour reads and writes.
struct ColourSweep {
  SweepSource ahead[kEdges];   ///< edges the cell owns
  SweepSource behind[kEdges];  ///< edges owned by the neighbour
  float* qr;
  float* qi;
  const float* free;
  const float* ar;  ///< null without a soft border
  const float* ai;
};
/// Eq. 10 for some cells of one row of one colour, in place: q_i <- the normalised sum of the neighbours' transported
/// phases. \param cells  as of fillEdges.
void sweepCells(const ColourSweep& sweep, std::size_t first, int cells);

}  // namespace sillon
