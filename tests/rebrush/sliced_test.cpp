// The packaged slicers slice models that this test makes, in the variants that people print: every top is found where
// it is, replaced, and nothing else changes. A slicer that is not installed is skipped, with a line that says so.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "geometry/outline.hpp"
#include "rebrush/blocks.hpp"
#include "rebrush/replace.hpp"
#include "sillon/rebrush/rebrush.hpp"
#include "support/installed.hpp"
#include "support/rebrushed.hpp"

using namespace sillon;
using namespace rebrushed;
using sillon::test::installed;
namespace fs = std::filesystem;

namespace {

constexpr int kSides = 128;

using Point = std::array<double, 3>;

/// Prisms as an STL of text.
class Stl {
 public:
  void ring(double outer, double inner, double height) {
    const auto at = [](double r, int k, double z) {
      const double angle = 2 * std::numbers::pi * k / kSides;
      return Point{r * std::cos(angle), r * std::sin(angle), z};
    };
    for (int k = 0; k < kSides; ++k) {
      const int j = k + 1;
      quad(at(inner, k, height), at(outer, k, height), at(outer, j, height), at(inner, j, height));
      quad(at(inner, j, 0), at(outer, j, 0), at(outer, k, 0), at(inner, k, 0));
      quad(at(outer, k, 0), at(outer, j, 0), at(outer, j, height), at(outer, k, height));
      if (inner > 0) quad(at(inner, j, 0), at(inner, k, 0), at(inner, k, height), at(inner, j, height));
    }
  }
  /// \param low, high  opposite corners.
  void box(Point low, Point high) {
    const auto at = [&](int k) {
      return Point{(k & 1) != 0 ? high[0] : low[0], (k & 2) != 0 ? high[1] : low[1], (k & 4) != 0 ? high[2] : low[2]};
    };
    quad(at(0), at(2), at(3), at(1));
    quad(at(4), at(5), at(7), at(6));
    quad(at(0), at(1), at(5), at(4));
    quad(at(1), at(3), at(7), at(5));
    quad(at(3), at(2), at(6), at(7));
    quad(at(2), at(0), at(4), at(6));
  }
  /// Two steps of a stair, 16 x 20 mm each, one above the other's half.
  void steps() {
    const std::array<std::array<double, 2>, 8> profile{
        {{0, 0}, {16, 0}, {32, 0}, {32, 1}, {16, 1}, {16, 2}, {0, 2}, {0, 1}}};
    const auto at = [&](std::size_t k, double y) { return Point{profile[k % 8][0], y, profile[k % 8][1]}; };
    for (std::size_t k = 0; k < 8; ++k) quad(at(k, 0), at(k, 20), at(k + 1, 20), at(k + 1, 0));
    for (const auto& face : {std::array<std::size_t, 4>{0, 1, 4, 7}, {1, 2, 3, 4}, {7, 4, 5, 6}}) {
      quad(at(face[0], 0), at(face[1], 0), at(face[2], 0), at(face[3], 0));
      quad(at(face[3], 20), at(face[2], 20), at(face[1], 20), at(face[0], 20));
    }
  }
  void write(const fs::path& path) const {
    std::ofstream out(path);
    out << "solid model\n" << text_ << "endsolid model\n";
  }

 private:
  void quad(Point a, Point b, Point c, Point d) {
    facet(a, b, c);
    facet(a, c, d);
  }
  void facet(Point a, Point b, Point c) {
    if (a == b || b == c || a == c) return;
    text_ += "facet normal 0 0 0\nouter loop\n";
    for (const Point& p : {a, b, c})
      text_ += "vertex " + number(p[0], 6) + " " + number(p[1], 6) + " " + number(p[2], 6) + "\n";
    text_ += "endloop\nendfacet\n";
  }
  std::string text_;
};

/// A folder of its own, gone afterwards.
struct Folder {
  Folder() : path(fs::temp_directory_path() / "sillon_sliced_test") {
    fs::remove_all(path);
    fs::create_directories(path);
    Stl disc;
    disc.ring(15, 0, 1);
    disc.write(path / "disc.stl");
    Stl ring;
    ring.ring(16, 6, 1);
    ring.write(path / "ring.stl");
    Stl box;
    box.box({0, 0, 0}, {24, 16, 1});
    box.write(path / "box.stl");
    Stl steps;
    steps.steps();
    steps.write(path / "steps.stl");
  }
  ~Folder() {
    std::error_code error;
    fs::remove_all(path, error);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path path;
};

std::string readAll(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

/// The model's top less a border, as far as its area tells; in the middle of a page.
using Inside = std::function<bool(Vec2)>;
Inside discOf(double area) {
  const double r = std::sqrt(area / std::numbers::pi);
  return [=](Vec2 p) { return length(p) <= r; };
}
Inside ringOf(double area) {
  // (16 - d)² - (6 + d)² = 220 - 44 d
  const double d = (220 - area / std::numbers::pi) / 44;
  return [=](Vec2 p) { return length(p) <= 16 - d && length(p) >= 6 + d; };
}
Inside boxOf(double area, Vec2 size) {
  // (a - 2d)(b - 2d)
  const double sum = size.x + size.y;
  const double d = (sum - std::sqrt(sum * sum - 4 * (size.x * size.y - area))) / 4;
  return [=](Vec2 p) { return std::abs(p.x) <= size.x / 2 - d && std::abs(p.y) <= size.y / 2 - d; };
}

Inside topOf(const std::string& model, double area) {
  if (model == "disc") return discOf(area);
  if (model == "ring") return ringOf(area);
  return boxOf(area, model == "box" ? Vec2{24, 16} : Vec2{16, 20});
}

/// Area that the region and the top share, over the area of either.
double overlapWith(const Shape& region, const Inside& inside) {
  constexpr double kStep = 0.02;
  const Bounds box = bounds(region);
  const Vec2 middle = 0.5 * (box.min + box.max);
  const int rows = static_cast<int>(region.page.y / kStep);
  const int columns = static_cast<int>(region.page.x / kStep);
  double both = 0;
  double either = 0;
  const auto spans = insideIntervals(region, kStep / 2, kStep, rows);
  for (int row = 0; row < rows; ++row) {
    std::size_t next = 0;
    const auto& line = spans[row];
    for (int column = 0; column < columns; ++column) {
      const Vec2 p{(column + 0.5) * kStep, (row + 0.5) * kStep};
      while (next < line.size() && line[next].end < p.x) ++next;
      const bool one = next < line.size() && line[next].begin <= p.x;
      const bool other = inside(p - middle);
      both += one && other ? 1 : 0;
      either += one || other ? 1 : 0;
    }
  }
  return both / either;
}

/// Checks a sliced file by all that re-brushing promises. \param tops  how many there are.
void checkSliced(const std::string& text, const char* slicer, const std::string& model, const std::string& variant,
                 std::size_t tops, double most = 0.01) {
  const RunContext run(2);
  CAPTURE(std::string(slicer));
  CAPTURE(model);
  CAPTURE(variant);
  REQUIRE_FALSE(text.empty());
  const auto done = rebrush(text, options(30), run);
  CAPTURE(done ? std::string() : done.error().message);
  REQUIRE(done);
  checkKept(text, done.value(), false);
  std::size_t replaced = 0;
  for (const RebrushedSurface& made : done.value().surfaces) {
    const SlicedSurface& top = done.value().file.surfaces[made.surface];
    CAPTURE(made.why);
    CAPTURE(top.layer);
    const bool sliver = top.left == LeftBecause::Narrow || top.left == LeftBecause::Small;
    CHECK((made.replaced || sliver));
    if (!made.replaced) continue;
    ++replaced;
    const double fill = top.volumeMm3 / (top.areaMm2 * top.height);
    CHECK(fill == Approx(top.flow).epsilon(most));
    // The lower step's reaches under the walls of the upper one, by as much as the slicer likes.
    const bool known = model != "steps" || top.layer > 5;
    const double overlap = known ? overlapWith(top.region, topOf(model, top.areaMm2)) : 1;
    CHECK(overlap >= 0.99);
    std::printf(
        "%-12s %-5s %-66s layer %2d, %.2f mm2, overlap %.4f, volume %.4f, coverage %.2f %%, beyond %.3f mm, alignment "
        "%.3f\n",
        slicer, model.c_str(), variant.c_str(), top.layer, top.areaMm2, overlap, fill / top.flow, made.coverage,
        made.beyond, made.alignment);
  }
  CHECK(replaced == tops);

  // The slicer's own lines in the place of the new ones: the slicer's file.
  const auto blocks = readBlocks(text);
  REQUIRE(blocks);
  std::vector<Edit> edits;
  for (const SurfaceBlock& block : blocks.value().blocks) {
    if (block.surface.left != LeftBecause::None) continue;
    const auto [begin, end] = std::pair{block.surface.begin, block.surface.end};
    edits.push_back({begin, end, text.substr(begin, end - begin)});
    const std::string_view rest = std::string_view(text).substr(begin);
    CHECK(stateDifference(rest, rest, block).empty());
  }
  CHECK(edits.size() >= tops);
  CHECK(withEdits(text, edits) == text);
}

struct Variant {
  const char* model;
  const char* options;
  std::size_t tops = 1;
  double fill = 0.01;  ///< by which volume and area times height may differ
};

std::string prusaText(const Folder& folder, const char* model, const std::string& options) {
  const fs::path out = folder.path / "out.gcode";
  fs::remove(out);
  const std::string command =
      "prusa-slicer --export-gcode --layer-height 0.2 --first-layer-height 0.2 --perimeters 2 --top-solid-layers 2 " +
      options + " --output " + out.string() + " " + (folder.path / (std::string(model) + ".stl")).string() +
      " >/dev/null 2>&1";
  return std::system(command.c_str()) == 0 ? readAll(out) : std::string();
}

/// Moves round the middle of the model as arcs, as arc fitting writes them.
std::string withArcs(const std::string& text, Vec2 middle) {
  std::string out;
  Vec2 at;
  for (const std::string& line : lines(text)) {
    Vec2 to = at;
    bool x = false;
    bool y = false;
    std::istringstream in(line);
    std::string head;
    in >> head;
    std::string rest;
    for (std::string word; head == "G1" && in >> word;) {
      if (word[0] == 'X') x = true, to.x = std::atof(word.c_str() + 1);
      if (word[0] == 'Y') y = true, to.y = std::atof(word.c_str() + 1);
      if (word[0] == 'E' || word[0] == 'F') rest += " " + word;
    }
    const Vec2 a = at - middle;
    const Vec2 b = to - middle;
    const bool round = x && y && rest.find('E') != std::string::npos && length(a) > 3 &&
                       std::abs(length(a) - length(b)) < 0.002 && length(b - a) < 3 && length(b - a) > 0.05;
    at = to;
    if (!round) {
      out += line + "\n";
      continue;
    }
    out += std::string(cross(a, b) > 0 ? "G3" : "G2") + " X" + number(to.x, 3) + " Y" + number(to.y, 3) + " I" +
           number(-a.x, 3) + " J" + number(-a.y, 3) + rest + "\n";
  }
  return out;
}

}  // namespace

TEST_CASE("tops that prusa-slicer sliced are found and replaced") {
  if (!installed("prusa-slicer", "tops that prusa-slicer sliced")) return;
  const Folder folder;
  const Variant variants[] = {
      {"disc", ""},
      {"disc", "--use-relative-e-distances --layer-gcode 'G92 E0'"},
      {"disc", "--use-firmware-retraction --gcode-flavor reprapfirmware"},
      {"disc", "--retract-lift 0.4 --wipe --retract-before-wipe 70%"},
      {"disc", "--top-fill-pattern rectilinear --gcode-label-objects"},
      {"disc", "--top-fill-pattern concentric"},
      {"disc", "--default-acceleration 1000 --perimeter-acceleration 500"},
      {"disc", "--gcode-comments"},
      {"disc", "--extrusion-multiplier 0.93"},
      {"box", "--extrusion-multiplier 1.06 --top-fill-pattern rectilinear"},
      {"box", "--gcode-flavor marlin2 --remaining-times --silent-mode"},
      {"box", "--perimeters 0"},
      {"box", "--avoid-crossing-perimeters --raft-layers 2"},
      {"ring", ""},
      {"ring", "--top-infill-extrusion-width 0.3"},
      {"ring", "--first-layer-height 0.3 --layer-height 0.15"},
      {"steps", "--gcode-label-objects", 2},
      {"ring", "--duplicate 2 --gcode-label-objects", 2},
      {"ring", "--duplicate 2 --complete-objects", 2},
      {"ring",
       "--nozzle-diameter 0.4,0.4 --filament-diameter 1.75,1.75 --temperature 200,200 --solid-infill-extruder 2"},
  };
  for (const Variant& variant : variants) {
    checkSliced(prusaText(folder, variant.model, variant.options), "prusa-slicer", variant.model, variant.options,
                variant.tops);
  }
  // Nothing tells its version but a comment: as its newer versions and relatives mark the same moves.
  std::string orca = prusaText(folder, "box", "");
  const std::pair<const char*, const char*> words[] = {{"; generated by PrusaSlicer", "; generated by OrcaSlicer"},
                                                       {";TYPE:Top solid infill", "; FEATURE: Top surface"},
                                                       {";WIDTH:", "; LINE_WIDTH: "},
                                                       {";HEIGHT:", "; LAYER_HEIGHT: "},
                                                       {";LAYER_CHANGE", "; CHANGE_LAYER"}};
  for (const auto& [old, fresh] : words) {
    for (std::size_t at = 0; (at = orca.find(old, at)) != std::string::npos; at += std::string(fresh).size())
      orca.replace(at, std::string(old).size(), fresh);
  }
  checkSliced(orca, "prusa-slicer", "box", "in OrcaSlicer's words", 1);

  const std::string plain = prusaText(folder, "ring", "--top-fill-pattern concentric --center 100,100");
  const std::string arcs = withArcs(plain, {100, 100});
  CHECK(arcs.find("\nG3 ") != std::string::npos);
  checkSliced(arcs, "prusa-slicer", "ring", "with arcs", 1);
}

TEST_CASE("what prusa-slicer lays otherwise is left, with the reason") {
  if (!installed("prusa-slicer", "what prusa-slicer lays otherwise")) return;
  const Folder folder;
  const RunContext run(1);
  const std::pair<const char*, const char*> refused[] = {
      {"--ironing", "ironed"}, {"--use-volumetric-e", "plastic"}, {"--top-solid-layers 0", "no surface"}};
  for (const auto& one : refused) {
    const std::string given = one.first;
    const char* const why = one.second;
    CAPTURE(given);
    const std::string text = prusaText(folder, "box", given);
    REQUIRE_FALSE(text.empty());
    const auto done = rebrush(text, options(30), run);
    REQUIRE_FALSE(done);
    CAPTURE(done.error().message);
    CHECK(done.error().message.find(why) != std::string::npos);
  }
}

TEST_CASE("tops that CuraEngine sliced are found and replaced, whatever the filament") {
  if (!installed("CuraEngine", "tops that CuraEngine sliced")) return;
  fs::path definition;
  std::vector<fs::path> folders{"/usr/share/cura/resources/definitions"};
  if (const char* given = std::getenv("CURA_ENGINE_SEARCH_PATH")) folders.insert(folders.begin(), given);
  for (const fs::path& place : folders) {
    if (definition.empty() && fs::exists(place / "fdmprinter.def.json")) definition = place / "fdmprinter.def.json";
  }
  if (definition.empty()) {
    std::puts(
        "skipped: tops that CuraEngine sliced; it lacks fdmprinter.def.json, which the package cura installs "
        "(or set CURA_ENGINE_SEARCH_PATH)");
    return;
  }
  const Folder folder;
  const auto sliced = [&](const char* model, const std::string& given) {
    const fs::path out = folder.path / "out.gcode";
    fs::remove(out);
    const std::string command =
        "CURA_ENGINE_SEARCH_PATH=" + definition.parent_path().string() + " CuraEngine slice -j " + definition.string() +
        " -o " + out.string() +
        " -s layer_height=0.2 -s layer_height_0=0.2 -s wall_line_count=2 -s top_layers=3 -s "
        "bottom_layers=2 -s initial_bottom_layers=2 -s adhesion_type=none -s retraction_amount=2 " +
        given + " -l " + (folder.path / (std::string(model) + ".stl")).string() + " >/dev/null 2>&1";
    return std::system(command.c_str()) == 0 ? readAll(out) : std::string();
  };
  const char* const thin = "-e0 -s material_diameter=1.75";
  const Variant variants[] = {
      {"disc", ""},  // filament of 2.85 mm, which the file does not tell
      {"disc", thin},
      {"ring", thin},
      {"box", thin},
      {"box", "-s top_bottom_pattern=zigzag"},
      {"ring", "-s top_bottom_pattern=concentric -s retraction_combing=off", 1,
       0.05},  // its rings overlap where they meet
      {"ring", "-s relative_extrusion=true"},
      {"box", "-s material_flow=94 -s material_diameter=1.75"},
      {"ring", "-s retraction_hop_enabled=true -s retraction_combing=off"},
      {"box", "-s acceleration_enabled=true -s jerk_enabled=true"},
  };
  for (const Variant& variant : variants) {
    checkSliced(sliced(variant.model, variant.options), "CuraEngine", variant.model, variant.options, variant.tops,
                variant.fill);
  }
  const RunContext run(1);
  // Its lower top reaches under the walls above it.
  const auto steps = rebrush(sliced("steps", ""), options(30), run);
  REQUIRE(steps);
  std::vector<int> layers;
  for (const RebrushedSurface& made : steps.value().surfaces) {
    if (made.replaced) layers.push_back(steps.value().file.surfaces[made.surface].layer);
  }
  CHECK(layers == std::vector<int>{5, 10});
  const auto ironed = rebrush(sliced("box", "-s ironing_enabled=true"), options(30), run);
  REQUIRE_FALSE(ironed);
  CHECK(ironed.error().message.find("irons it") != std::string::npos);
}

TEST_CASE("slic3r marks nothing, and is refused with the slicers that do") {
  if (!installed("slic3r", "what slic3r sliced")) return;
  const Folder folder;
  const RunContext run(1);
  for (const char* given : {"", "--gcode-comments"}) {
    const fs::path out = folder.path / "out.gcode";
    fs::remove(out);
    const std::string command = "slic3r --layer-height 0.2 " + std::string(given) + " -o " + out.string() + " " +
                                (folder.path / "box.stl").string() + " >/dev/null 2>&1";
    REQUIRE(std::system(command.c_str()) == 0);
    const auto done = rebrush(readAll(out), options(30), run);
    REQUIRE_FALSE(done);
    CHECK(done.error().message.find("does not mark its surfaces") != std::string::npos);
  }
}
