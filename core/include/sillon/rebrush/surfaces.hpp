// The top and bottom surfaces of a sliced file, found by the slicer's own marks and measured from its moves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/sentence.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"

namespace sillon {

enum class Slicer { PrusaSlicer, SuperSlicer, OrcaSlicer, BambuStudio, Cura };

/// Its name as its makers write it.
const char* slicerName(Slicer slicer);

enum class SurfaceSide { Top, Bottom };

/// Why a surface is left as it is. Sentences: surfaceReason().
enum class LeftBecause {
  None,         ///< it can be replaced
  Narrow,       ///< narrower than three beads
  Small,        ///< less than ten beads' squares
  Covered,      ///< the next layer lies on part of it (Cura marks tops and inner skins alike)
  Bridge,       ///< hardly any plastic lies below it (Cura marks bridges as skins, too)
  Ironed,       ///< the slicer irons it afterwards
  Interleaved,  ///< the slicer goes to and fro between it and another surface
  Command,      ///< a command inside it that would be lost
  Object,       ///< another object begins inside it
  Height,       ///< its moves rise or fall
  Modes,        ///< inches, relative coordinates, E in mm³ or arcs by their radius
  Flow,         ///< its flow is not that of one layer
  Travel,       ///< what follows needs the nozzle where the slicer's last bead ended
  Cut,          ///< the file ends inside it
};

/// The sentence for people, without a full stop.
const char* surfaceReason(LeftBecause reason);

/// The name of the reason as it stands above; empty for None.
const char* surfaceReasonName(LeftBecause reason);

/// The sentence of each reason but None.
std::span<const Sentence> surfaceSentences();

/// One connected surface of one layer. Lengths mm, places on the bed.
struct SlicedSurface {
  SurfaceSide side = SurfaceSide::Top;
  int layer = 0;  ///< from 1
  double z = 0;
  double height = 0;
  std::string object;  ///< as the slicer names it; may be empty
  int tool = 0;
  Shape region;  ///< its page is the box of the region
  Vec2 corner;   ///< of that page on the bed
  double areaMm2 = 0;
  double width = 0;    ///< of its beads
  double spacing = 0;  ///< of neighbouring beads
  double flow = 1;     ///< plastic of a bead over spacing x height: the slicer's flow ratio, for most filaments near 1
  double volumeMm3 = 0;
  double speed = 0;            ///< of most of its length [mm/s]
  Vec2 entry;                  ///< where the slicer begins
  Vec2 exit;                   ///< where it ends
  std::int64_t firstLine = 0;  ///< of the moves that lay it, from 1
  std::int64_t lastLine = 0;
  std::size_t begin = 0;  ///< of those lines [bytes]
  std::size_t end = 0;
  LeftBecause left = LeftBecause::None;
};

struct SlicedBlocks;

struct SlicedFile {
  Slicer slicer = Slicer::PrusaSlicer;
  std::string program;  ///< as the file says: "PrusaSlicer 2.5.0"
  int layers = 0;
  std::int64_t lines = 0;
  double nozzle = 0.4;                         ///< [mm], as most have where the file does not say
  std::vector<SlicedSurface> surfaces;         ///< in the order of the file
  std::shared_ptr<const SlicedBlocks> blocks;  ///< the moves of each, for rebrush
};

/// Finds the surfaces of a file by PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio or Cura. Bottoms are those
/// that lie on the bed. Memory: one layer of moves and the regions, beside the text.
/// \return InvalidFile with what is missing: no marks of a known slicer, line numbers, binary G-code; Cancelled.
Result<SlicedFile> readSlicedFile(std::string_view gcode, const RunContext& run = RunContext());

}  // namespace sillon
