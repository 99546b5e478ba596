#include "sillon/rebrush/rebrush.hpp"

#include <algorithm>
#include <utility>

#include "base/numbers.hpp"
#include "base/parallel_for.hpp"
#include "base/refused.hpp"
#include "geometry/signed_distance.hpp"
#include "rebrush/blocks.hpp"
#include "rebrush/replace.hpp"
#include "rebrush/wanted_directions.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {
namespace {

constexpr double kLeastCoverage = 97;  // [%] least coverage: less shows the layer below; wide faces reach 98.5
constexpr double kMostSpill = 2;       // [% of the region's area] largest area of beads beyond the region
constexpr double kMostBeyond = 0.05;   // [mm] largest reach of a bead beyond the region

// Largest reach of the beads beyond the region [mm].
Result<double> reachOver(const Cycle& cycle, const Shape& region, double spacing, const RunContext& run) {
  const Result<Outline> outline = resolveOutline(region);
  if (!outline) return outline.error();
  const Result<BorderIndex> border = buildBorderIndex(outline.value(), makeGrid(outline.value().bounds, spacing), run);
  if (!border) return border.error();
  double most = 0;
  const std::size_t count = cycle.points.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t next = (k + 1) % count;
    const Vec2 a{cycle.points[k].x, cycle.points[k].y};
    const Vec2 b{cycle.points[next].x, cycle.points[next].y};
    const int pieces = std::clamp(static_cast<int>(length(b - a) / (spacing / 4)) + 1, 1, 100);
    for (int piece = 0; piece < pieces; ++piece) {
      const double t = static_cast<double>(piece) / pieces;
      const double width = (1 - t) * static_cast<double>(cycle.widths[k]) + t * static_cast<double>(cycle.widths[next]);
      const double inside = -static_cast<double>(border.value().nearest(a + t * (b - a)).distance);
      most = std::max(most, width / 2 - inside);
    }
  }
  return most;
}

// Reason for which a face is left.
struct Why {
  LeftBecause because = LeftBecause::None;
  std::string text;
};

// Finds the limit that new beads break, if there is one.
Why problemOf(const Measures& measures) {
  if (measures.crossings > 0) return {LeftBecause::Path, "the new path would cross itself"};
  if (measures.coverage < kLeastCoverage) {
    return {LeftBecause::Coverage, "the new beads would cover " + fixed(measures.coverage, 2) + " % of it; " +
                                       decimal(kLeastCoverage, 1) + " is the least"};
  }
  if (measures.spill > kMostSpill) {
    return {LeftBecause::Spill, "the new beads would spill over " + fixed(measures.spill, 1) + " % of it; " +
                                    decimal(kMostSpill, 1) + " is the most"};
  }
  return {};
}

// New beads of a face, or the reason for which it has none.
struct LaidBeads {
  Toolpath toolpath;  // path whose widths follow from its plastic; by the same rule the slicer's beads just touch
  Replacement replacement;
  Measures measures;
  Why left;
};

// Lays a face along the wanted directions, as one cycle, and measures it.
Result<LaidBeads> layBeads(std::string_view gcode, const SurfaceBlock& block, const PlateInput& input,
                           const ToolpathParams& params, const SlicedBlocks& file, const RunContext& run) {
  const SlicedSurface& surface = block.surface;
  LaidBeads laid;
  Result<ToolpathResult> path = generateToolpath(input, params, run);
  if (!path) {
    if (path.error().code == ErrorCode::Cancelled) return path.error();
    laid.left = {LeftBecause::Path, path.error().message};
    return laid;
  }
  laid.toolpath = std::move(path.value().toolpath);
  std::vector<Cycle>& cycles = laid.toolpath.cycles;
  if (cycles.size() != 1) {
    laid.left = {LeftBecause::Path, "it falls into " + std::to_string(cycles.size()) + " cycles; one is needed"};
    return laid;
  }
  laid.replacement = replaceBeads(gcode, block, cycles.front(), surface.corner, file.filamentArea, block.mostFlow);
  if (laid.replacement.left != LeftBecause::None) {
    laid.left = {laid.replacement.left, surfaceReason(laid.replacement.left)};
    return laid;
  }
  for (float& width : cycles.front().widths) width *= static_cast<float>(laid.replacement.flow / surface.flow);
  Result<Measures> measures = measureToolpath(laid.toolpath, input, params, run);
  if (!measures) return measures.error();
  laid.measures = std::move(measures).value();
  return laid;
}

// Lays one surface anew, or leaves it. \param made  receives the outcome, with the reason if the surface is left.
// \param edits, change  receive the changes of the file if it is not.
std::optional<Error> relay(std::string_view gcode, const SlicedFile& file, const RebrushOptions& options,
                           DirectionSource& source, const RunContext& run, RebrushedSurface& made,
                           std::vector<Edit>& edits, TimeChange& change) {
  const SurfaceBlock& block = file.blocks->blocks[made.surface];
  const SlicedSurface& surface = block.surface;
  const auto leave = [&](Why why) {
    made.because = why.because;
    made.why = std::move(why.text);
    return std::nullopt;
  };
  if (surface.left != LeftBecause::None) return leave({surface.left, surfaceReason(surface.left)});
  Result<WantedDirections> wanted = source.of(made.surface, run);
  if (!wanted) return wanted.error();
  PlateInput input{surface.region, std::move(wanted.value().directions), std::move(wanted.value().modes)};
  ToolpathParams params = options.project.toolpath;
  params.spacing = surface.spacing;
  Result<LaidBeads> laid = layBeads(gcode, block, input, params, *file.blocks, run);
  if (!laid) return laid.error();
  if (laid.value().left.because != LeftBecause::None) return leave(std::move(laid.value().left));
  Toolpath& toolpath = laid.value().toolpath;
  Replacement& replacement = laid.value().replacement;
  const Measures& measures = laid.value().measures;
  made.alignment = measures.alignment;
  made.coverage = measures.coverage;
  made.spill = measures.spill;
  if (Why problem = problemOf(measures); problem.because != LeftBecause::None) return leave(std::move(problem));
  // The slicer's lines behind the block must find the machine in the state in which the slicer's block left it.
  constexpr std::size_t kBehind = 200'000;  // [bytes] text behind the block that is compared where no travel ends it
  std::vector<Edit> local = replacement.edits;
  for (Edit& edit : local) {
    edit.begin -= surface.begin;
    edit.end -= surface.begin;
  }
  const std::size_t last = local.back().end;
  const std::size_t until = block.next ? block.nextEnd - surface.begin : last + kBehind;
  const std::string_view old = gcode.substr(surface.begin, until);
  const std::string fresh = withEdits(old, local);
  if (const std::string differs = stateDifference(old, fresh, block); !differs.empty()) {
    return leave({LeftBecause::After, "replacing it would change " + differs + " of the moves that follow"});
  }
  const Result<double> beyond = reachOver(toolpath.cycles.front(), input.shape, params.spacing, run);
  if (!beyond) return beyond.error();
  made.beyond = beyond.value();
  if (made.beyond > kMostBeyond) {
    return leave({LeftBecause::Spill, "a new bead would reach " + fixed(made.beyond, 3) + " mm over it; " +
                                          fixed(kMostBeyond, 2) + " is the most"});
  }
  auto pictures = source.judge(made.surface, toolpath, run);
  if (!pictures) return pictures.error();
  made.pictures = std::move(pictures).value();
  made.leftOut = source.last().pictures.leftOut;
  const std::string_view oldMoves = old.substr(0, last);
  const std::string_view relaid = std::string_view(fresh).substr(0, fresh.size() - (old.size() - last));
  made.seconds = secondsOfMoves(relaid, block.before, block.acceleration) -
                 secondsOfMoves(oldMoves, block.before, block.acceleration);
  change = {replacement.edits.front().end, made.seconds, surface.layer == 1};
  made.toolpath = std::move(toolpath);
  made.replaced = true;
  made.volumeMm3 = replacement.volumeMm3;
  made.moves = replacement.moves;
  edits = std::move(replacement.edits);
  return std::nullopt;
}

}  // namespace

Result<Rebrushed> rebrush(std::string_view gcode, SlicedFile file, const RebrushOptions& options,
                          const RunContext& run) {
  if (auto wrong = invalidSettings(options.project)) return *std::move(wrong);
  if (file.blocks == nullptr) return refusedArgument("FileNotRead");
  const std::vector<SurfaceBlock>& blocks = file.blocks->blocks;
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (isChosen(blocks[k].surface, k, options)) chosen.push_back(k);
  }
  for (const std::size_t k : options.only) {
    if (k < blocks.size()) continue;
    return refusedArgument("NoSuchSurface", {{"surface", k + 1}, {"count", blocks.size()}});
  }

  Rebrushed out;
  DirectionSource source(options, file);
  std::vector<Edit> edits;
  std::vector<TimeChange> changes;
  std::string reason;  // reason of the largest surface that was left
  LeftBecause because = LeftBecause::None;
  double largest = 0;  // [mm²] area of that surface
  for (const std::size_t k : chosen) {
    if (options.onSurface) options.onSurface(out.surfaces.size(), chosen.size());
    if (run.cancelled()) return cancelledRun();
    RebrushedSurface& made = out.surfaces.emplace_back();
    made.surface = k;
    std::vector<Edit> relaid;
    TimeChange change;
    if (auto error = relay(gcode, file, options, source, run, made, relaid, change)) return *error;
    if (made.replaced) {
      changes.push_back(change);
      edits.insert(edits.end(), relaid.begin(), relaid.end());
    } else if (const SlicedSurface& surface = file.surfaces[k]; reason.empty() || surface.areaMm2 > largest) {
      reason = "no surface can be replaced; layer " + std::to_string(surface.layer) + ": " + made.why;
      because = made.because;
      largest = surface.areaMm2;
    }
  }
  if (out.surfaces.empty()) return refusedArgument("NoSurface");
  if (edits.empty()) return Error{ErrorCode::InvalidArgument, reason, surfaceReasonName(because)};
  std::sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
  for (std::size_t k = 1; k < edits.size(); ++k) {
    if (edits[k].begin < edits[k - 1].end) return refused(ErrorCode::Internal, "SurfacesOverlap");
  }
  for (const TimeChange& entry : changes) out.seconds += entry.seconds;
  std::sort(changes.begin(), changes.end(), [](const TimeChange& a, const TimeChange& b) { return a.at < b.at; });
  out.totals = changeTotals(gcode, changes, edits);
  out.edits = std::move(edits);
  out.file = std::move(file);
  return out;
}

Result<Rebrushed> rebrush(std::string_view gcode, const RebrushOptions& options, const RunContext& run) {
  Result<SlicedFile> file = readSlicedFile(gcode, run);
  if (!file) return file.error();
  return rebrush(gcode, std::move(file).value(), options, run);
}

}  // namespace sillon
