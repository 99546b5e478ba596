#include "sillon/rebrush/rebrush.hpp"

#include <iterator>
#include <utility>

#include "rebrush/blocks.hpp"

namespace sillon {

namespace {

// Sentences in the order of LeftBecause.
constexpr Sentence kSentences[] = {
    {"", "it can be replaced"},
    {"Narrow", "narrower than three beads"},
    {"Small", "smaller than ten squares of one bead width"},
    {"Covered", "the next layer lies on part of it"},
    {"Bridge", "bridges air"},
    {"Ironed", "ironed afterwards; switch ironing off in the slicer"},
    {"Interleaved", "the slicer goes back and forth between it and another face"},
    {"Command", "a command inside it would be lost"},
    {"Object", "another object begins inside it"},
    {"Height", "its moves rise or fall"},
    {"Modes", "inches, relative coordinates, E in mm3 or arcs by their radius are not followed"},
    {"Flow", "its plastic is not that of one full layer"},
    {"Travel", "the next move needs the nozzle where its last bead ended"},
    {"Cut", "the file ends inside it"},
    {"Path", "no single path can be laid in it"},
    {"Coverage", "the new beads would leave too much of it free"},
    {"Spill", "the new beads would reach over it"},
    {"After", "the moves that follow would find the machine in another state"},
};
static_assert(std::size(kSentences) == toSize(LeftBecause::After) + 1);

const Sentence& sentence(LeftBecause reason) { return kSentences[toSize(reason)]; }

}  // namespace

const char* surfaceReason(LeftBecause reason) { return sentence(reason).text; }

const char* surfaceReasonName(LeftBecause reason) { return sentence(reason).code; }

std::span<const Sentence> surfaceSentences() { return std::span(kSentences).subspan(1); }

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
