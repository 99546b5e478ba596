// Benches of the core: quality per scene, time per stage, threads, growth. Prints tables; asserts nothing.
//
//   sillon_bench quality [none|soft|N|RECIPE] [SCENE.json ...]   figures of the delivered toolpath, and of the G-code
//   sillon_bench time [SCENE.json ...]                    stages, 1 against 2 threads in one interleaved run; what
//                                                         measures and the G-code file add, in processor time
//   sillon_bench live [SCENE.json ...]                    edits of a kept session against runs from nothing
//   sillon_bench turns SCENE.json [THREADS]               a plate for each byte that comes in, for other benches:
//                                                         seconds of its stages, and of all threads' processor time
//   sillon_bench roof                                     the sweeps of the alignment against the machine's limits
//   sillon_bench photo [N [SEED]] [elevation] [lamp] [x3]  rendered photographs of coupons, read back
//   sillon_bench photograph FILE.jpg                      one of them
//   sillon_bench look [PICTURE[+PICTURE] ...]             what the G-code shows of pictures, solved for and straight
//   sillon_bench random [N [SEED [NOZZLE]]]               promises on random shapes, fields and parameters (2000 from
//   1);
//                                                         every fifth is a drawing: made here, or one of
//                                                         SILLON_DRAWINGS
//   sillon_bench paper [PRESET]                          the paper's Tables 2 to 5 and Fig. 14, beside our rows
//   sillon_bench measure SCENE.json [PATHS]               figures of these paths, or of the plate, as JSON
//   sillon_bench growth [MILLIONS]                        0.25 to 16 million cells: time exponent, bytes per cell

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "assemble.hpp"
#include "base/simd.hpp"
#include "look.hpp"
#include "measure.hpp"
#include "memory.hpp"
#include "paper.hpp"
#include "photo.hpp"
#include "random.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/settings/presets.hpp"
#include "support/random_plates.hpp"
#include "written.hpp"

namespace {

namespace fs = std::filesystem;
using sillon::PlateInput;
using sillon::Project;
using sillon::RunContext;
using sillon::ToolpathResult;

std::vector<std::string> publishedScenes() {
  std::vector<std::string> scenes;
  for (const auto& entry : fs::directory_iterator(fs::path(SILLON_SOURCE_DIR) / "examples" / "paper")) {
    if (entry.path().extension() == ".json") scenes.push_back(entry.path().string());
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

struct Loaded {
  std::string name;
  Project project;
  PlateInput input;
};

bool load(const std::string& path, Loaded& out) {
  out.name = fs::path(path).stem().string();
  const auto project = sillon::cli::loadProject(path);
  if (!project) {
    std::printf("%s: %s\n", path.c_str(), project.error().message.c_str());
    return false;
  }
  out.project = project.value();
  auto input = sillon::cli::assemblePlate(out.project);
  if (!input) {
    std::printf("%s: %s\n", path.c_str(), input.error().message.c_str());
    return false;
  }
  out.input = std::move(input).value();
  return true;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double seconds(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Of all threads of this process: other programs on the machine do not count.
double processorSeconds(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double totalOf(const ToolpathResult& plate) {
  double sum = 0;
  for (const auto& stage : plate.time) sum += stage.seconds;
  return sum;
}

void qualityRow(const std::string& name, const sillon::Measures& m) {
  std::printf("%-27s %8.4f %8.4f %8.4f %7.2f %7.2f %7.3f %7.3f %6d %6.0f %6d %5d", name.c_str(), m.alignment,
              m.alignmentInterior, m.alignmentConstrained, m.coverage, m.overlap, m.spill, m.fillRatio,
              static_cast<int>(m.uTurns), m.turnBound, static_cast<int>(m.kinks), static_cast<int>(m.crossings));
}

void quality(const std::vector<std::string>& scenes, const std::string& perimeters) {
  std::printf("%-27s %8s %8s %8s %7s %7s %7s %7s %6s %6s %6s %5s %6s %5s %6s %6s %6s %6s\n", "scene", "align", "inner",
              "constr.", "cover%", "over%", "spill%", "fill", "U-turn", "bound", "kinks", "cross", "cycles", "parts",
              "paths", ">30s%", ">120s%", "squee%");
  const RunContext run(2);
  for (const std::string& path : scenes) {
    Loaded scene;
    if (!load(path, scene)) continue;
    sillon::ToolpathParams params = scene.project.toolpath;
    if (perimeters == "none") params.perimeterMode = sillon::PerimeterMode::None;
    if (perimeters == "soft") params.perimeterMode = sillon::PerimeterMode::Soft;
    if (const auto known = sillon::presets(); std::find(known.begin(), known.end(), perimeters) != known.end()) {
      if (sillon::applyPreset(perimeters, params)) continue;
    }
    if (!perimeters.empty() && std::isdigit(perimeters[0])) {
      params.perimeterMode = sillon::PerimeterMode::Count;
      params.perimeters = std::stoi(perimeters);
    }
    const auto plate = generateToolpath(scene.input, params, run);
    if (!plate) {
      std::printf("%-27s %s\n", scene.name.c_str(), plate.error().message.c_str());
      continue;
    }
    const auto measured = [&](const sillon::Toolpath& toolpath) {
      return measureToolpath(toolpath, scene.input, params, run);
    };
    const auto m = measured(plate.value().toolpath);
    if (!m) continue;
    qualityRow(scene.name, m.value());
    std::printf(" %6d %5d %6d\n", static_cast<int>(plate.value().contourCycles), static_cast<int>(plate.value().parts),
                static_cast<int>(plate.value().toolpath.cycles.size()));
    const bench::Written written = bench::writtenToolpath(plate.value().toolpath, scene.input.shape);
    if (!written.error.empty()) {
      std::printf("  not written: %s\n", written.error.c_str());
      continue;
    }
    auto read = measured(written.beads);
    const auto turns = measured(written.path);
    if (!read || !turns) continue;
    sillon::Measures& v = read.value();
    v.uTurns = turns.value().uTurns;
    v.kinks = turns.value().kinks;
    v.crossings = turns.value().crossings;
    qualityRow("  as written", v);
    if (const auto& delay = written.delay) {
      std::printf(" %6s %5s %6s %6.1f %6.1f %6.1f", "", "", "", 100 * delay->over30, 100 * delay->over120,
                  100 * delay->squeezed);
    }
    std::printf("\n");
    std::fflush(stdout);
  }
}

// What a call with --report and one with --gcode do besides making the path, in turns with the path alone.
void added(const Loaded& scene, const RunContext& run) {
  constexpr int kRuns = 9;
  std::vector<double> paths, reports, files;
  for (int k = 0; k < kRuns; ++k) {
    paths.push_back(processorSeconds([&] { (void)generateToolpath(scene.input, scene.project.toolpath, run); }));
    ToolpathResult plate;
    reports.push_back(processorSeconds([&] {
      plate = generateToolpath(scene.input, scene.project.toolpath, run, true).value();
      (void)measureToolpath(plate.toolpath, scene.input, scene.project.toolpath, run, plate.dislocations);
    }));
    files.push_back(processorSeconds([&] {
      plate = generateToolpath(scene.input, scene.project.toolpath, run).value();
      (void)measureToolpath(plate.toolpath, scene.input, scene.project.toolpath, run,
                            sillon::Dislocations{});  // which no file shows
      sillon::PrintParams print = scene.project.print;
      print.thumbnails =
          sillon::lookThumbnails(plate.toolpath, scene.input.shape.page, scene.project.printer.screenSizes, {}, run)
              .value();
      std::string text;
      (void)writeGcode(plate.toolpath, scene.input.shape, scene.project.printer, print, [&](std::string_view piece) {
        text += piece;
        return true;
      });
      (void)sillon::checkGcode(text, scene.project.printer);
    }));
  }
  const double path = median(paths);
  std::printf(
      "  processor time, 1 thread, median of %d: path %.3f s, measured %.3f s (%.2f), its G-code %.3f s (%.2f)\n",
      kRuns, path, median(reports), median(reports) / path, median(files), median(files) / path);
}

void times(const std::vector<std::string>& scenes) {
  constexpr int kWarmUps = 2;
  constexpr int kRuns = 9;
  const RunContext one(1);
  const RunContext two(2);
  for (const std::string& path : scenes) {
    Loaded scene;
    if (!load(path, scene)) continue;
    std::vector<std::vector<double>> stages;
    std::vector<std::vector<double>> stages2;
    std::vector<double> totals;
    std::vector<double> totals2;
    std::vector<double> ratios;
    std::vector<std::string> names;
    for (int k = 0; k < kWarmUps + kRuns; ++k) {
      const auto a = generateToolpath(scene.input, scene.project.toolpath, one);
      const auto b = generateToolpath(scene.input, scene.project.toolpath, two);
      if (!a || !b) {
        std::printf("%s: %s\n", scene.name.c_str(), (a ? b : a).error().message.c_str());
        break;
      }
      if (k < kWarmUps) continue;
      const auto& time = a.value().time;
      stages.resize(time.size());
      stages2.resize(time.size());
      names.clear();
      for (std::size_t s = 0; s < time.size(); ++s) {
        names.push_back(time[s].stage);
        stages[s].push_back(time[s].seconds);
        stages2[s].push_back(b.value().time[s].seconds);
      }
      totals.push_back(totalOf(a.value()));
      totals2.push_back(totalOf(b.value()));
      ratios.push_back(totals.back() / totals2.back());
    }
    if (totals.empty()) continue;
    std::printf("%s: median of %d after %d warm-ups, inputs decoded -> toolpath\n", scene.name.c_str(), kRuns,
                kWarmUps);
    const double total = median(totals);
    for (std::size_t s = 0; s < names.size(); ++s) {
      std::printf("  %-12s %8.4f s  %5.1f %%   2 threads %8.4f s\n", names[s].c_str(), median(stages[s]),
                  100 * median(stages[s]) / total, median(stages2[s]));
    }
    std::printf("  %-12s %8.4f s  (least %.4f)\n", "1 thread", total, *std::min_element(totals.begin(), totals.end()));
    std::printf("  %-12s %8.4f s  (least %.4f), %.2f times faster (median of pairs)\n", "2 threads", median(totals2),
                *std::min_element(totals2.begin(), totals2.end()), median(ratios));
    added(scene, one);
    const auto plate = generateToolpath(scene.input, scene.project.toolpath, two);
    std::vector<double> writes;
    std::size_t bytes = 0;
    std::string error;
    for (int k = 0; plate && k < kWarmUps + kRuns; ++k) {
      bytes = 0;
      const double took = seconds([&] {
        const auto written = writeGcode(plate.value().toolpath, scene.input.shape, scene.project.printer,
                                        scene.project.print, [&](std::string_view piece) {
                                          bytes += piece.size();
                                          return true;
                                        });
        if (!written) error = written.error().message;
      });
      if (k >= kWarmUps) writes.push_back(took);
    }
    if (!error.empty()) {
      std::printf("  %-12s not written: %s\n", "G-code", error.c_str());
    } else if (!writes.empty()) {
      std::printf("  %-12s %8.4f s  (least %.4f), %.1f MB\n", "G-code", median(writes),
                  *std::min_element(writes.begin(), writes.end()), static_cast<double>(bytes) / 1e6);
    }
  }
}

// A square plate of waves with so many million cells at a spacing of 0.4 mm.
PlateInput wavesOf(double millions) {
  const double side = std::sqrt(millions * 1e6) * 0.2;
  PlateInput input;
  input.shape = sillon::makeRectangle({side, side}).value();
  input.modes = sillon::uniformMode(sillon::DirectionMode::Constrained);
  input.directions.width = input.directions.height = 256;
  input.directions.angle.resize(256 * 256);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const double wave = std::sin(x * 0.1) + std::sin(y * 0.07 + x * 0.03);
      input.directions.angle[y * 256 + x] = static_cast<std::uint16_t>(32767 + 12000 * wave);
    }
  }
  return input;
}

// Turns the directions within a disc of a tenth of the map, elsewhere each time: what a brush does.
void brush(sillon::DirectionMap& map, int stroke) {
  const double radius2 = 0.1 * map.width * map.height / 3.1416;
  const double cx = map.width * (0.3 + 0.04 * (stroke % 11));
  const double cy = map.height * (0.7 - 0.03 * (stroke % 13));
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if ((x - cx) * (x - cx) + (y - cy) * (y - cy) > radius2) continue;
      map.angle[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x)] +=
          9000;
    }
  }
}

// Each round edits a tenth of the directions, then makes the plate with a kept session, and from nothing; and edits the
// widest bead in the session.
void live(const std::vector<std::string>& scenes) {
  constexpr int kWarmUps = 2;
  constexpr int kRuns = 9;
  for (const std::string& path : scenes) {
    Loaded scene;
    if (!load(path, scene)) continue;
    std::printf("%s: median of %d edits of a tenth of the directions (least)\n", scene.name.c_str(), kRuns);
    for (const int threads : {1, 2}) {
      const RunContext run(threads);
      sillon::Session session;
      std::vector<double> kept, fresh, widened;
      for (int k = 0; k < kWarmUps + kRuns; ++k) {
        brush(scene.input.directions, k);
        const double times[] = {
            seconds([&] { (void)session.generateToolpath(scene.input, scene.project.toolpath, run); }),
            seconds([&] { (void)generateToolpath(scene.input, scene.project.toolpath, run); }), seconds([&] {
              sillon::ToolpathParams wider = scene.project.toolpath;
              wider.maxWidth = 1.5;
              (void)session.generateToolpath(scene.input, wider, run);
            })};
        if (k < kWarmUps) continue;
        kept.push_back(times[0]);
        fresh.push_back(times[1]);
        widened.push_back(times[2]);
      }
      const auto least = [](const std::vector<double>& values) {
        return *std::min_element(values.begin(), values.end());
      };
      std::printf("  %d thread%s  session %7.1f ms (%.1f)   from nothing %7.1f ms (%.1f)   widths %6.1f ms (%.1f)\n",
                  threads, threads == 1 ? " " : "s", 1e3 * median(kept), 1e3 * least(kept), 1e3 * median(fresh),
                  1e3 * least(fresh), 1e3 * median(widened), 1e3 * least(widened));
    }
  }
}

// As a program that stays does, whose memory and caches are warm.
bool turns(const std::string& path, int threads) {
  Loaded scene;
  if (!load(path, scene)) return false;
  const RunContext run(threads);
  while (std::getchar() != EOF) {
    double stages = 0;
    const double processor = processorSeconds([&] {
      const auto made = generateToolpath(scene.input, scene.project.toolpath, run);
      stages = made ? totalOf(made.value()) : -1;
    });
    std::printf("%.6f %.6f\n", stages, processor);
    std::fflush(stdout);
  }
  return true;
}

// What the machine can do on one thread: bytes moved by a + s b -> c over arrays larger than its caches, and flops of
// independent multiply-adds on vectors of four.
void roof() {
  constexpr std::size_t kFloats = std::size_t{1} << 25;
  std::vector<float> a(kFloats, 1), b(kFloats, 2), c(kFloats, 0);
  double bandwidth = 0;
  for (int k = 0; k < 5; ++k) {
    const double time = seconds([&] {
      for (std::size_t i = 0; i < kFloats; ++i) c[i] = a[i] + 0.5f * b[i];
    });
    bandwidth = std::max(bandwidth, 12.0 * kFloats / time);
  }
  constexpr int kSteps = 20'000'000;
  sillon::F4 sums[8];
  for (int k = 0; k < 8; ++k) sums[k] = sillon::splat(static_cast<float>(k) + c[k]);
  double flops = 0;
  for (int round = 0; round < 3; ++round) {
    const double time = seconds([&] {
      const sillon::F4 factor = sillon::splat(0.999f);
      for (int k = 0; k < kSteps; ++k) {
        for (sillon::F4& sum : sums) sum = sum * factor + factor;
      }
    });
    flops = std::max(flops, 8.0 * 8 * kSteps / time);
  }
  volatile float sink =
      sums[0][0] + sums[1][0] + sums[2][0] + sums[3][0] + sums[4][0] + sums[5][0] + sums[6][0] + sums[7][0];
  (void)sink;
  std::printf("machine, one thread: %.1f GB/s (triad), %.1f Gflop/s (vectors of four)\n", bandwidth / 1e9, flops / 1e9);

  // Each sweep of a cell: 4 edges of 3 numbers and whether it is free are read, the phase read and written: 68 bytes at
  // least; 8 neighbours of 10 operations and 12 for the norm. All levels together are 4/3 of the finest.
  constexpr double kBytes = 68.0 * 4 / 3;
  constexpr double kFlops = 92.0 * 4 / 3;
  std::printf("%12s %14s %22s %22s\n", "cells", "ns/cell sweep", "GB/s (share)", "Gflop/s (share)");
  const RunContext run(1);
  for (const double millions : {0.0625, 0.25, 1.0, 4.0}) {
    const PlateInput input = wavesOf(millions);
    double cells = 0;
    const auto phases = [&](int sweeps) {
      sillon::ToolpathParams params;
      params.sweepsPerLevel = sweeps;
      sillon::Session session;
      double least = 1e9;
      for (int k = 0; k < 3; ++k) {
        params.seed = static_cast<std::uint64_t>(k + 1);  // so that it is made anew
        const auto plate = session.generateToolpath(input, params, run);
        if (!plate) continue;
        cells = static_cast<double>(plate.value().nx) * plate.value().ny;
        for (const auto& stage : plate.value().time) {
          if (stage.stage == "phases") least = std::min(least, stage.seconds);
        }
      }
      return least;
    };
    const double sweep = (phases(40) - phases(8)) / 32;
    std::printf("%12.0f %14.2f %14.1f (%3.0f %%) %15.1f (%3.0f %%)\n", cells, sweep / cells * 1e9,
                kBytes * cells / sweep / 1e9, 100 * kBytes * cells / sweep / bandwidth, kFlops * cells / sweep / 1e9,
                100 * kFlops * cells / sweep / flops);
  }
}

// A plate of waves whose page grows at one spacing, so that cells are all alike. Each size runs in a process of its
// own, whose peak memory is the run's.
void growth(double most) {
  std::printf("%12s %10s %12s %14s\n", "cells", "seconds", "ns/cell", "bytes/cell");
  std::vector<double> logCells;
  std::vector<double> logTime;
  for (double millions = 0.25; millions <= most; millions *= 4) {
    int pipeEnds[2];
    if (pipe(pipeEnds) != 0) return;
    const pid_t child = fork();
    if (child == 0) {
      const PlateInput input = wavesOf(millions);
      rusage before{};
      getrusage(RUSAGE_SELF, &before);
      const RunContext run(1);
      double row[4] = {0, 0, 0, 0};
      std::vector<double> warm;
      for (int k = 0; k < 4; ++k) {
        const auto plate = generateToolpath(input, {}, run);
        if (!plate) _exit(1);
        if (k == 0) {
          rusage after{};
          getrusage(RUSAGE_SELF, &after);
          row[0] = static_cast<double>(plate.value().nx) * plate.value().ny;
          row[1] = totalOf(plate.value());
          row[3] = static_cast<double>(after.ru_maxrss - before.ru_maxrss) * 1024 / row[0];
        } else {
          warm.push_back(totalOf(plate.value()));
        }
      }
      row[2] = median(warm);
      if (write(pipeEnds[1], row, sizeof row) != sizeof row) _exit(1);
      _exit(0);
    }
    double row[4] = {0, 0, 0, 0};
    const bool got = read(pipeEnds[0], row, sizeof row) == sizeof row;
    waitpid(child, nullptr, 0);
    close(pipeEnds[0]);
    close(pipeEnds[1]);
    if (!got || row[0] == 0) {
      std::printf("%12.0f  failed\n", millions * 1e6);
      continue;
    }
    std::printf("%12.0f %10.3f %10.3f %12.1f %14.0f\n", row[0], row[1], row[2], row[2] / row[0] * 1e9, row[3]);
    std::fflush(stdout);
    logCells.push_back(std::log(row[0]));
    logTime.push_back(std::log(row[2]));
  }
  const double n = static_cast<double>(logCells.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < logCells.size(); ++k) {
    sx += logCells[k];
    sy += logTime[k];
    sxx += logCells[k] * logCells[k];
    sxy += logCells[k] * logTime[k];
  }
  std::printf("fitted exponent of time over cells: %.3f\n", (n * sxy - sx * sy) / (n * sxx - sx * sx));
}

}  // namespace

int main(int argc, char** argv) {
  sillon::cli::keepFreedMemory();
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const std::string what = arguments.empty() ? "" : arguments[0];
  std::vector<std::string> rest(arguments.begin() + (arguments.empty() ? 0 : 1), arguments.end());
  if (what == "random") {
    const auto number = [&](std::size_t k, std::uint64_t fallback) {
      return rest.size() > k ? std::strtoull(rest[k].c_str(), nullptr, 10) : fallback;
    };
    bench::randomPlates(number(0, 2000), number(1, 1), rest.size() > 2 ? std::strtod(rest[2].c_str(), nullptr) : 1);
    return 0;
  }
  if (what == "look") {
    const char* photographs = std::getenv("SILLON_PHOTOS");
    bench::look(photographs == nullptr ? "" : photographs, rest);
    return 0;
  }
  if (what == "measure" && (rest.size() == 1 || rest.size() == 2)) {
    Loaded scene;
    return load(rest[0], scene) && bench::measure(scene.input, scene.project.toolpath, rest.size() == 2 ? rest[1] : "")
               ? 0
               : 1;
  }
  if (what == "turns" && !rest.empty()) {
    return turns(rest[0], rest.size() > 1 ? std::clamp(std::atoi(rest[1].c_str()), 1, 64) : 1) ? 0 : 1;
  }
  if (what == "paper") {
    bench::paperHead();
    for (const bench::PublishedResult& result : bench::kPublishedResults) {
      Loaded scene;
      const fs::path file = fs::path(SILLON_SOURCE_DIR) / "examples" / "paper" / (std::string(result.scene) + ".json");
      if (!load(file.string(), scene)) return 1;
      if (!rest.empty() && sillon::applyPreset(rest[0], scene.project.toolpath)) return 1;
      if (!bench::paperRows(result, scene.input, scene.project.toolpath)) return 1;
    }
    return 0;
  }
  if (what == "photograph" && rest.size() == 1) return bench::photograph(rest[0]) ? 0 : 1;
  if (what == "photo") {
    bench::PhotoBench asked;
    std::vector<std::string> numbers;
    for (const std::string& word : rest) {
      if (word == "elevation") {
        asked.elevationKnown = true;
      } else if (word == "lamp") {
        asked.lampKnown = true;
      } else if (word.starts_with("x")) {
        asked.together = std::clamp(std::atoi(word.c_str() + 1), 1, 100);
      } else {
        numbers.push_back(word);
      }
    }
    const auto number = [&](std::size_t k, std::uint64_t otherwise) {
      return numbers.size() > k ? std::strtoull(numbers[k].c_str(), nullptr, 10) : otherwise;
    };
    asked.count = static_cast<int>(std::min<std::uint64_t>(number(0, 100), 100000));
    asked.seed = number(1, 0);
    bench::photographs(asked);
    return 0;
  }
  double mostMillions = 16;
  if (what == "growth" && !rest.empty()) {
    mostMillions = std::strtod(rest[0].c_str(), nullptr);
    rest.clear();
  }
  std::string perimeters;
  if (what == "quality" && !rest.empty() && rest[0].find(".json") == std::string::npos) {
    perimeters = rest[0];
    rest.erase(rest.begin());
  }
  const bool named = !rest.empty();
  if (rest.empty()) rest = publishedScenes();
  const bool timed = what == "time" || what == "live";
  if (what == "quality") {
    quality(rest, perimeters);
  } else if (timed) {
    if (!named) {
      std::erase_if(rest, [](const std::string& path) {
        const std::string name = fs::path(path).stem().string();
        return name != "brain" && name != "wave";
      });
    }
    what == "time" ? times(rest) : live(rest);
  } else if (what == "growth") {
    growth(mostMillions);
  } else if (what == "roof") {
    roof();
  } else {
    std::printf(
        "sillon_bench quality [none|soft|N|RECIPE] [SCENE.json ...] | time [SCENE.json ...] | live [SCENE.json ...] | "
        "turns SCENE.json [THREADS] | roof "
        "| look [PICTURE ...] | measure SCENE.json [PATHS] | photo [N [SEED]] [elevation] [lamp] [xN] | photograph "
        "FILE | growth [MILLIONS] | "
        "random [N "
        "[SEED]]\n");
    return 2;
  }
  return 0;
}
