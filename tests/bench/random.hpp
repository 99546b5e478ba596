// Promises on random plates, and on drawings: some made here, some that nobody here made.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "assemble.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"
#include "support/joinable.hpp"
#include "support/random_plates.hpp"
#include "written.hpp"

namespace bench {

/// The SVGs that a list names, one a line; none without a list.
inline std::vector<std::string> drawingsOf(const char* list) {
  std::vector<std::string> files;
  if (list == nullptr || *list == 0) return files;
  std::ifstream in(list);
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) files.push_back(line);
  }
  return files;
}

/// One of the drawings, 15 to 90 beads wide, with any directions and parameters.
inline scenes::RandomPlate foreignDrawing(std::uint64_t seed, const std::vector<std::string>& files) {
  scenes::Random random = scenes::randomOf(seed);
  scenes::RandomPlate plate;
  scenes::randomParams(random, plate.params);
  sillon::Project project;
  project.shapeFile = files[static_cast<std::size_t>(random.index(static_cast<int>(files.size())))];
  project.pageWidth = plate.params.spacing * random.in(15, 90);
  plate.name = project.shapeFile;
  if (auto input = sillon::cli::assemblePlate(project)) plate.input.shape = std::move(input).value().shape;
  scenes::randomField(random, plate);
  return plate;
}

/// Every fifth is a drawing, and every other of these nobody here made, where there are such.
inline scenes::RandomPlate benchPlate(std::uint64_t seed, const std::vector<std::string>& files) {
  if (seed % 5 != 0) return scenes::randomPlate(seed);
  return seed % 10 == 0 && !files.empty() ? foreignDrawing(seed, files) : scenes::randomDrawing(seed);
}

struct RandomSums {
  std::uint64_t made = 0, empty = 0, crossing = 0, parted = 0, inPieces = 0, joinable = 0, laborious = 0;
  std::uint64_t spilling = 0, spillingAnyhow = 0, straying = 0, kinked = 0, kinkedMore = 0;
  std::uint64_t refused = 0, writtenCrossing = 0, writtenSpilling = 0, writtenKinked = 0;
  std::vector<double> coverage, overlap;
};

inline void addPlate(std::uint64_t seed, const scenes::RandomPlate& plate, double nozzle, const sillon::RunContext& run,
                     RandomSums& sums) {
  const auto id = static_cast<unsigned long long>(seed);
  const auto result = generateToolpath(plate.input, plate.params, run);
  if (!result) {
    ++sums.empty;
    if (result.error().code != sillon::ErrorCode::EmptyShape)
      std::printf("%llu: %s\n", id, result.error().message.c_str());
    return;
  }
  const sillon::ToolpathResult& made = result.value();
  const auto measuredAs = [&](const sillon::Toolpath& toolpath) {
    return measureToolpath(toolpath, plate.input, plate.params, run);
  };
  const auto measured = measuredAs(made.toolpath);
  if (!measured) return;
  ++sums.made;
  const sillon::Measures& m = measured.value();
  const bool crosses = m.crossings > 0;
  const bool parts = static_cast<int>(made.toolpath.cycles.size()) != made.parts + made.unjoined;
  const bool spills = m.spill > scenes::spillAllowed(plate, made);
  const double outside = scenes::farthestOutside(plate.input.shape, made.toolpath, run);
  const bool strays = outside > scenes::outsideAllowed(plate.params);
  const bool toils = static_cast<double>(made.stitchWork) > scenes::kMostWork * made.nx * made.ny;
  sums.crossing += crosses ? 1 : 0;
  sums.parted += parts ? 1 : 0;
  sums.inPieces += made.unjoined > 0 ? 1 : 0;
  const int joinable =
      made.unjoined > 0 ? scenes::joinablePaths(plate.input.shape, plate.params, made.toolpath, run) : 0;
  sums.joinable += joinable > 0 ? 1 : 0;
  sums.spilling += spills ? 1 : 0;
  sums.straying += strays ? 1 : 0;
  sums.laborious += toils ? 1 : 0;
  const double kinksOver = static_cast<double>(m.kinks) - 0.05 * static_cast<double>(m.uTurns);
  sums.kinked += kinksOver > 0 ? 1 : 0;
  sums.kinkedMore += kinksOver > 1 ? 1 : 0;
  sums.spillingAnyhow += m.spill > 0.05 ? 1 : 0;
  sums.coverage.push_back(m.coverage);
  sums.overlap.push_back(m.overlap);
  const Written written = writtenToolpath(made.toolpath, plate.input.shape, nozzle);
  const auto path = measuredAs(written.path);  // an error where nothing was written
  const auto beads = measuredAs(written.beads);
  if (!path || !beads) {
    ++sums.refused;
    std::printf("%llu: %s: not written: %s\n", id, plate.name.c_str(),
                written.error.empty() ? "its measures fail" : written.error.c_str());
  } else {
    sums.writtenCrossing += path.value().crossings > 0 ? 1 : 0;
    sums.writtenSpilling += beads.value().spill > 0.05 ? 1 : 0;
    sums.writtenKinked +=
        static_cast<double>(path.value().kinks) > 0.05 * static_cast<double>(path.value().uTurns) ? 1 : 0;
  }
  if (crosses || parts || spills || strays || toils || made.unjoined > 0) {
    std::printf(
        "%llu: %s: crossings %d, paths %d of %d parts, %d unjoined (%d joinable), spill %.3f %%, %.3f mm outside, work "
        "%.0f a cell\n",
        id, plate.name.c_str(), static_cast<int>(m.crossings), static_cast<int>(made.toolpath.cycles.size()),
        static_cast<int>(made.parts), made.unjoined, joinable, m.spill, outside,
        static_cast<double>(made.stitchWork) / (static_cast<double>(made.nx) * made.ny));
    std::fflush(stdout);
  }
}

/// One random plate after another; prints those that break a promise, and what all of them come to.
/// \param nozzle  that writes them, as a share of the spacing.
inline void randomPlates(std::uint64_t count, std::uint64_t seed, double nozzle) {
  const sillon::RunContext run(2);
  const std::vector<std::string> files = drawingsOf(std::getenv("SILLON_DRAWINGS"));
  if (files.empty()) std::printf("drawings of others are skipped: SILLON_DRAWINGS names no list of them\n");
  RandomSums sums;
  for (std::uint64_t k = seed; k < seed + count; ++k) addPlate(k, benchPlate(k, files), nozzle, run, sums);
  const auto quantile = [](std::vector<double>& values, double share) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  const auto n = [](std::uint64_t number) { return static_cast<unsigned long long>(number); };
  std::printf("seeds %llu to %llu: %llu plates, %llu without room for a bead, %llu drawings of others to choose from\n",
              n(seed), n(seed + count - 1), n(sums.made), n(sums.empty), n(files.size()));
  std::printf(
      "with crossings %llu, other than one path per part and piece %llu, in pieces %llu (joinable ones %llu), above "
      "%.0f joints a cell %llu\n"
      "spill above 0.05 %% %llu (besides threads across gaps %llu), threads too far outside %llu\n"
      "with kinks above 5 %% of U-turns %llu (by more than one kink %llu)\n",
      n(sums.crossing), n(sums.parted), n(sums.inPieces), n(sums.joinable), scenes::kMostWork, n(sums.laborious),
      n(sums.spillingAnyhow), n(sums.spilling), n(sums.straying), n(sums.kinked), n(sums.kinkedMore));
  std::printf(
      "in the G-code: with crossings %llu, spill above 0.05 %% %llu, kinks above 5 %% of U-turns %llu, not written "
      "%llu\n",
      n(sums.writtenCrossing), n(sums.writtenSpilling), n(sums.writtenKinked), n(sums.refused));
  std::printf("coverage: median %.2f, worst tenth below %.2f; overlap: median %.2f, worst tenth above %.2f\n",
              quantile(sums.coverage, 0.5), quantile(sums.coverage, 0.1), quantile(sums.overlap, 0.5),
              quantile(sums.overlap, 0.9));
}

}  // namespace bench
