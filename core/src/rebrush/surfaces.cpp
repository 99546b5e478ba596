#include "sillon/rebrush/rebrush.hpp"

#include <utility>

#include "rebrush/blocks.hpp"

namespace sillon {

const char* surfaceReason(LeftBecause reason) {
  switch (reason) {
    case LeftBecause::None:
      return "it can be replaced";
    case LeftBecause::Narrow:
      return "it is narrower than three beads";
    case LeftBecause::Small:
      return "it is smaller than ten squares of one bead width";
    case LeftBecause::Covered:
      return "the next layer lies on part of it";
    case LeftBecause::Bridge:
      return "it bridges air";
    case LeftBecause::Ironed:
      return "the slicer irons it afterwards; switch ironing off";
    case LeftBecause::Interleaved:
      return "the slicer goes to and fro between it and another surface";
    case LeftBecause::Command:
      return "a command inside it would be lost";
    case LeftBecause::Object:
      return "another object begins inside it";
    case LeftBecause::Height:
      return "its moves rise or fall";
    case LeftBecause::Modes:
      return "inches, relative coordinates, E in mm3 or arcs by their radius are not followed";
    case LeftBecause::Flow:
      return "its plastic is not that of one full layer";
    case LeftBecause::Travel:
      return "what follows needs the nozzle where the slicer's last bead ended";
    case LeftBecause::Cut:
      return "the file ends inside it";
  }
  return "";
}

const char* surfaceReasonName(LeftBecause reason) {
  switch (reason) {
    case LeftBecause::None:
      return "";
    case LeftBecause::Narrow:
      return "Narrow";
    case LeftBecause::Small:
      return "Small";
    case LeftBecause::Covered:
      return "Covered";
    case LeftBecause::Bridge:
      return "Bridge";
    case LeftBecause::Ironed:
      return "Ironed";
    case LeftBecause::Interleaved:
      return "Interleaved";
    case LeftBecause::Command:
      return "Command";
    case LeftBecause::Object:
      return "Object";
    case LeftBecause::Height:
      return "Height";
    case LeftBecause::Modes:
      return "Modes";
    case LeftBecause::Flow:
      return "Flow";
    case LeftBecause::Travel:
      return "Travel";
    case LeftBecause::Cut:
      return "Cut";
  }
  return "";
}

Result<SlicedFile> readSlicedFile(std::string_view gcode, const RunContext& run) {
  run.beginJob();
  Result<SlicedBlocks> blocks = readBlocks(gcode, run);
  if (!blocks) return blocks.error();
  SlicedFile file = std::move(blocks.value().file);
  for (const SurfaceBlock& block : blocks.value().blocks) file.surfaces.push_back(block.surface);
  file.blocks = std::make_shared<const SlicedBlocks>(std::move(blocks).value());
  return file;
}

}  // namespace sillon
