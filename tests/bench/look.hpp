// Pictures under lamps: what the G-code shows of them, solved for and by the straight line from grey to angle.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assemble.hpp"
#include "gcode/read_back.hpp"
#include "look/rasters.hpp"
#include "quality/seen_cells.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/gcode/writer.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "sillon/quality/metrics.hpp"
#include "support/measure_pictures.hpp"

namespace bench {

/// A plate whose longer side is 100 mm, its beads 0.4 mm apart; blue PLA, softbox.
inline sillon::Project lookProject(const std::vector<std::string>& files) {
  sillon::Project project;
  auto& pictures = project.layers.emplace_back().contents.emplace<sillon::PictureLayer>().pictures;
  for (const std::string& file : files) pictures.push_back({file, std::nullopt});
  pictures[0].lamp = sillon::Vec2{60, 45};
  project.builtinSize.x = 100;
  project.toolpath.perimeterMode = sillon::PerimeterMode::None;
  project.print.layerHeight = 0.2;
  project.print.base = 1;
  return project;
}

/// Angle by grey alone: along the lamp where the picture is black, across it where it is white.
inline sillon::DirectionMap straight(const sillon::ShownPicture& picture) {
  sillon::DirectionMap map{picture.tones.width, picture.tones.height, {}};
  for (const float tone : picture.tones.value) {
    const double turn = (picture.lamp.azimuth + 90 * static_cast<double>(tone)) / 180 + 0.5;
    map.angle.push_back(static_cast<std::uint16_t>((turn - std::floor(turn)) * 65535));
  }
  return map;
}

struct LookRow {
  std::vector<sillon::PictureMeasures> measures;
  std::int64_t turns = 0, kinks = 0;
  double coverage = 0;
};

/// Makes the plate, writes its G-code, reads that back and judges it; prints why that is not possible.
inline LookRow judged(const sillon::Project& project, const sillon::PlateInput& input,
                      const sillon::Result<sillon::ToolpathResult>& plate,
                      const std::vector<sillon::ShownPicture>& asked, const sillon::RunContext& run) {
  LookRow row;
  if (!plate) {
    std::printf("%s\n", plate.error().message.c_str());
    return row;
  }
  const sillon::Toolpath& toolpath = plate.value().toolpath;
  const auto measures = sillon::measureToolpath(toolpath, input, project.toolpath, run);
  if (measures) {
    row.turns = measures.value().uTurns;
    row.kinks = measures.value().kinks;
    row.coverage = measures.value().coverage;
  }
  std::string text;
  const auto written =
      sillon::writeGcode(toolpath, input.shape, project.printer, project.print, [&](std::string_view piece) {
        text += piece;
        return true;
      });
  const auto read = sillon::readBack(text, input.shape, project.printer, project.print, toolpath.spacing);
  if (!written || !read) {
    std::printf("%s\n", (written ? read.error() : written.error()).message.c_str());
    return row;
  }
  auto seen = sillon::measurePictures(read.value(), input.shape.page, asked, sillon::roughnessOf(project), run);
  if (seen) row.measures = std::move(seen).value();
  return row;
}

inline void printLook(const std::string& name, const LookRow& row) {
  std::printf("%-34s", name.c_str());
  for (const sillon::PictureMeasures& m : row.measures) std::printf("  %.4f %.4f %5.1f", m.r, m.ssim, m.contrast);
  std::printf("  %6lld  %6.2f %4lld", static_cast<long long>(row.turns), row.coverage,
              static_cast<long long>(row.kinks));
}

/// One plate, solved for and, if it has one picture, straight.
inline void lookPlate(const std::vector<std::string>& files, const sillon::RunContext& run) {
  const sillon::Project project = lookProject(files);
  auto input = sillon::cli::assemblePlate(project);
  if (!input) {
    std::printf("%s\n", input.error().message.c_str());
    return;
  }
  auto composed = sillon::compose(project, std::move(input).value(), {sillon::cli::readInputFile}, run);
  if (!composed) {
    std::printf("%s\n", composed.error().message.c_str());
    return;
  }
  sillon::Composition composition = std::move(composed).value();
  const std::vector<sillon::ShownPicture> shown = composition.pictures.shown;
  std::string name;
  for (const std::string& file : files) {
    name += (name.empty() ? "" : " + ") + std::filesystem::path(file).stem().string();
  }
  const auto make = [&](const sillon::PlateInput& tried) {
    return sillon::generateToolpath(tried, project.toolpath, run, true);
  };
  const auto made = sillon::makeShown(project, composition, sillon::cli::readInputFile, make, run);
  const LookRow solved = judged(project, composition.laid(), made, shown, run);
  printLook(name, solved);
  if (files.size() == 1) {
    sillon::PlateInput plate = composition.laid();
    plate.directions = straight(shown[0]);
    plate.showsPictures = false;
    const LookRow line = judged(project, plate, make(plate), shown, run);
    std::printf("  %3.0f %%\n", 100.0 * static_cast<double>(solved.turns) / static_cast<double>(line.turns));
    printLook("  straight", line);
  }
  std::printf("\n");
  for (std::size_t k = 0; k < solved.measures.size() && files.size() == 2; ++k) {
    std::vector<float> own;
    for (const float code : shown[1 - k].tones.value) own.push_back(sillon::lightOfCode(code));
    const double between = sillon::compareTones(own, shown[k].tones).r;
    std::printf("  lamp %zu at %.0f: with the other %.3f, the pictures themselves %.3f\n", k + 1, shown[k].lamp.azimuth,
                solved.measures[k].others[1 - k], between);
  }
}

/// Seconds of a solver's call for pictures of 1000 x 1000 pixels, of the wall and of processors, medians.
inline void lookTime(const char* name, std::size_t pictures, bool chooses, double side, const sillon::RunContext& run) {
  constexpr int kRuns = 9;
  std::vector<sillon::LitPicture> lit;
  for (std::size_t p = 0; p < pictures; ++p) {
    sillon::Tones tones{1000, 1000, {}};
    for (int y = 0; y < 1000; ++y) {
      for (int x = 0; x < 1000; ++x) {
        const double wave = std::sin(x * (p == 0 ? 0.02 : 0.05)) * std::sin((y + x / 3) * 0.013);
        tones.value.push_back(static_cast<float>(0.5 + 0.4 * wave + 0.1 * std::sin(x * y * 1e-3)));
      }
    }
    lit.push_back({std::move(tones), {60 + 40 * static_cast<double>(p), 45, 0.1}, chooses});
  }
  std::vector<double> wall, processor;
  for (int k = 0; k < kRuns; ++k) {
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t from = std::clock();
    (void)sillon::solveDirections(lit, {2.36, 17.32}, {{side, side}, 0.4}, {}, run);
    processor.push_back(static_cast<double>(std::clock() - from) / CLOCKS_PER_SEC);
    wall.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  std::sort(wall.begin(), wall.end());
  std::sort(processor.begin(), processor.end());
  std::printf("  %-44s %6.3f s, %6.3f s of processors\n", name, wall[kRuns / 2], processor[kRuns / 2]);
}

/// \param photographs  folder with pictures such as those of scikit-image; none: those of the project alone.
inline void look(const std::string& photographs, const std::vector<std::string>& given) {
  namespace fs = std::filesystem;
  const sillon::RunContext run(2);
  std::printf("%-34s  %6s %6s %5s  %6s  %6s %4s  turns by those of the straight line\n", "picture", "r", "SSIM",
              "contr", "turns", "cover%", "kink");
  for (const std::string& file : given) {
    std::vector<std::string> files;
    for (std::size_t at = 0; at <= file.size();) {
      const std::size_t end = std::min(file.find('+', at), file.size());
      files.push_back(file.substr(at, end - at));
      at = end + 1;
    }
    lookPlate(files, run);
  }
  if (!given.empty()) return;
  const auto drawn = [](const char* name) { return std::string(SILLON_SOURCE_DIR "/examples/inputs/") + name; };
  for (const char* name : {"photo.png", "relief.png", "star.png"}) lookPlate({drawn(name)}, run);
  lookPlate({drawn("star.png"), drawn("heart.png")}, run);
  std::vector<std::string> photos;
  for (const char* name : {"camera.png", "astronaut.png", "chelsea.png", "coffee.png", "rocket.jpg"}) {
    const fs::path path = fs::path(photographs) / name;
    if (!photographs.empty() && fs::exists(path)) photos.push_back(path.string());
  }
  if (photos.empty()) {
    std::printf("no photographs: install scikit-image for Python, or set SILLON_PHOTOS to its folder skimage/data\n");
  }
  for (const std::string& photo : photos) lookPlate({photo}, run);
  if (photos.size() > 1) lookPlate({photos[0], photos[1]}, run);
  std::printf("solving for pictures of 1000 x 1000 pixels, 2 threads, median of 9\n");
  lookTime("one, its lamp given, 500 x 500 cells", 1, false, 100, run);
  lookTime("one, its lamp given, 1000 x 1000 cells", 1, false, 200, run);
  lookTime("one, its lamp chosen, 1000 x 1000 cells", 1, true, 200, run);
  lookTime("two, their lamps chosen, 1000 x 1000 cells", 2, true, 200, run);
}

}  // namespace bench
