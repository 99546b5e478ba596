// The paper's Tables 2 to 5 and Fig. 14 beside the same figures of a program built here.
#pragma once

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <vector>

#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"

namespace bench {

/// A result of the paper, with its row of each table; 0 where the paper has no figure.
struct PublishedResult {
  const char* name;
  const char* scene;                    ///< its file in examples/paper
  int cellsX, cellsY, cycles;           ///< Table 2
  double align, stitch, other;          ///< Table 3: seconds on a GPU, stitching on a CPU
  double cpu;                           ///< Table 4: seconds of one thread
  double coverage, overlap, alignment;  ///< Table 5: %, %, -1 is perfect
};

inline constexpr PublishedResult kPublishedResults[] = {
    {"LOGO", "teaser", 1004, 457, 548, 3.89, 10.05, 2.08, 0, 97.57, 0.78, 0},
    {"WAVE", "wave", 854, 579, 495, 2.03, 10.48, 1.49, 0, 96.75, 0.86, -0.958},
    {"BRAIN", "brain", 328, 266, 121, 0.70, 1.02, 1.54, 12.67, 95.91, 1.13, -0.930},
    {"PEOPLE", "people", 501, 411, 283, 0.75, 3.06, 1.26, 19.27, 95.88, 1.19, -0.924},
    {"VARY", "ani_to_iso", 216, 853, 260, 1.85, 2.64, 1.03, 45.38, 96.79, 0.85, -0.946},
};

/// Prints two rows, the paper's and that of a plate made here with one thread; times are processor time.
inline bool paperRows(const PublishedResult& paper, const sillon::PlateInput& input,
                      const sillon::ToolpathParams& params) {
  const sillon::RunContext run(1);
  std::vector<double> totals;
  sillon::ToolpathResult plate;
  for (int k = 0; k < 3; ++k) {
    const std::clock_t begin = std::clock();
    auto made = generateToolpath(input, params, run);
    totals.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    if (!made) return std::printf("%s: %s\n", paper.name, made.error().message.c_str()), false;
    plate = std::move(made).value();
  }
  std::sort(totals.begin(), totals.end());
  const double total = totals[1];
  double align = 0, stitch = 0, all = 0;
  for (const sillon::StageTime& stage : plate.time) {
    all += stage.seconds;
    if (stage.stage == "lines" || stage.stage == "phases") align += stage.seconds;
    if (stage.stage == "stitch") stitch += stage.seconds;
  }
  // Stages are timed by the clock, which other programs slow down; shares of processor time are fair on a busy machine.
  align *= total / all;
  stitch *= total / all;
  const auto measured = measureToolpath(plate.toolpath, input, params, run);
  if (!measured) return std::printf("%s: %s\n", paper.name, measured.error().message.c_str()), false;
  const sillon::Measures& m = measured.value();

  const auto row = [](const char* name, const char* whose, int nx, int ny, int cycles) {
    std::printf("%-7s %-6s %4d x %-4d %5d", name, whose, nx, ny, cycles);
  };
  row(paper.name, "paper", paper.cellsX, paper.cellsY, paper.cycles);
  std::printf(" %6.2f %6.2f %6.2f %6.2f", paper.align, paper.stitch, paper.other,
              paper.align + paper.stitch + paper.other);
  paper.cpu > 0 ? (void)std::printf(" %6.2f", paper.cpu) : (void)std::printf(" %6s", "-");
  // Directions are free over parts of LOGO, so that its alignment says nothing.
  const auto quality = [&](double alignment, double coverage, double overlap) {
    paper.alignment < 0 ? (void)std::printf(" %7.3f", alignment) : (void)std::printf(" %7s", "-");
    std::printf(" %6.2f %5.2f", coverage, overlap);
  };
  quality(paper.alignment, paper.coverage, paper.overlap);

  std::printf("\n");
  row("", "here", plate.nx, plate.ny, static_cast<int>(plate.contourCycles));
  std::printf(" %6.2f %6.2f %6.2f %6s %6.2f", align, stitch, total - align - stitch, "", total);
  quality(m.alignment, m.coverage, m.overlap);
  std::printf("   %.2f %.2f %.2f\n", m.width.p01, m.width.median, m.width.p99);
  std::fflush(stdout);
  return true;
}

inline void paperHead() {
  std::printf("%-14s %-11s %5s %20s %6s %6s %7s %6s %5s   %s\n", "", "cells", "cyc.", "align stitch  other", "GPU",
              "CPU", "align.", "cover", "over", "width: 1 %, median, 99 %");
}

}  // namespace bench
