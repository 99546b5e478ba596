// The measures of any program's path of a scene: what compares two programs (peers.py).
#pragma once

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"

namespace bench {

/// Reads closed paths: a point a line as `x y width` in mm from the page's lower left corner, an empty line between
/// paths. \return nothing if a line is something else, or a path has fewer than 3 points.
inline bool readPaths(const std::string& file, sillon::Toolpath& toolpath) {
  std::ifstream in(file);
  if (!in) return false;
  toolpath.cycles.clear();
  bool begins = true;
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) {
      begins = true;
      continue;
    }
    sillon::Vec2f point{};
    float width = 0;
    char rest = 0;
    if (std::sscanf(line.c_str(), "%f %f %f %c", &point.x, &point.y, &width, &rest) != 3) return false;
    if (begins) toolpath.cycles.emplace_back();
    begins = false;
    toolpath.cycles.back().points.push_back(point);
    toolpath.cycles.back().widths.push_back(width);
  }
  for (const sillon::Cycle& cycle : toolpath.cycles) {
    if (cycle.points.size() < 3) return false;
  }
  return !toolpath.cycles.empty();
}

/// Prints the measures as one line of JSON, of the paths in the file, or where none is named of the plate made here.
inline bool measure(const sillon::PlateInput& input, const sillon::ToolpathParams& params, const std::string& file) {
  const sillon::RunContext run(1);
  sillon::Toolpath toolpath;
  toolpath.spacing = params.spacing;
  if (file.empty()) {
    auto plate = generateToolpath(input, params, run);
    if (!plate) return std::printf("%s\n", plate.error().message.c_str()), false;
    toolpath = std::move(plate).value().toolpath;
  } else if (!readPaths(file, toolpath)) {
    return std::printf("%s holds no paths: lines of x, y and width in mm\n", file.c_str()), false;
  }
  const auto measured = measureToolpath(toolpath, input, params, run);
  if (!measured) return std::printf("%s\n", measured.error().message.c_str()), false;
  const sillon::Measures& m = measured.value();
  std::printf(
      "{\"alignment\": %.4f, \"coverage\": %.2f, \"overlap\": %.3f, \"spill\": %.3f, \"uTurns\": %d, \"kinks\": %d, "
      "\"crossings\": %d, \"lengthMm\": %.1f, \"digest\": \"%s\"}\n",
      m.alignment, m.coverage, m.overlap, m.spill, static_cast<int>(m.uTurns), static_cast<int>(m.kinks),
      static_cast<int>(m.crossings), m.lengthMm, m.digest.c_str());
  return true;
}

}  // namespace bench
