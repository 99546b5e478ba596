#include "project/files.hpp"

#include <algorithm>

#include "base/json.hpp"
#include "settings/json.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {
namespace {

constexpr const char* kWidth = "nozzle_width";
constexpr const char* kShape = "svg_path";
constexpr const char* kDirections = "line_field_path";
constexpr const char* kModes = "line_mode_field_path";
constexpr const char* kPerimeters = "perimeter_count";
constexpr const char* kIterations = "alignment_iter_per_level";
constexpr const char* kSeed = "seed";
constexpr const char* kRepulse = "repulse_curves";
constexpr const char* kHeight = "layer_height_rt_nozzle_width";
constexpr const char* kCache = "force_sdf_computation";  // cache switch of the paper's program; ignored
constexpr const char* kShells = "shell_count";           // in one published scene, where it is 0

/// Reads keys one by one and stops at the first fault, which it keeps.
class SceneReader {
 public:
  explicit SceneReader(const Json& root) : root_(root) {}
  Fault problem;

  /// Reads one key. \return true if it is there and valid.
  template <class Value, class Read>
  bool take(const char* key, Value& out, const Read& read) {
    if (problem) return false;
    const auto found = root_.find(key);
    if (found == root_.end()) return false;
    problem = read(*found, key, out);
    return !problem;
  }
  bool text(const char* key, std::string& out) { return take(key, out, readText); }
  bool flag(const char* key, bool& out) { return take(key, out, readFlag); }
  bool seed(const char* key, std::uint64_t& out) {
    return take(key, out, [](const Json& value, const char* name, std::uint64_t& seed) {
      return readInteger(value, name, seed);
    });
  }
  bool number(const char* key, double& out, double low, double high) {
    return take(key, out, readNumber) && within(key, out, low, high);
  }
  bool integer(const char* key, int& out, int low, int high) {
    return take(key, out,
                [](const Json& value, const char* name, int& whole) { return readInteger(value, name, whole); }) &&
           within(key, out, low, high);
  }

 private:
  bool within(const char* key, double value, double low, double high) {
    if (value >= low && value <= high) return true;
    problem = outOfRange(key, value, low, high, "");
    return false;
  }
  const Json& root_;
};

}  // namespace

std::vector<std::string> sceneKeys() {
  return {kWidth, kShape, kDirections, kModes, kPerimeters, kIterations, kSeed, kRepulse, kHeight, kCache, kShells};
}

bool isScene(const Json& root) { return root.contains(kWidth) && root.contains(kShape); }

Fault readSceneKeys(const Json& root, Project& project) {
  SceneReader reader(root);
  const Setting& spacing = *findSetting(Section::Toolpath, "spacing");
  const Setting& nozzle = *findSetting(Section::Printer, "nozzle");
  const Setting& perimeters = *findSetting(Section::Toolpath, "perimeters");
  double width = 0;
  if (reader.number(kWidth, width, spacing.low, spacing.high)) {
    project.toolpath.spacing = width;
    project.printer.nozzle = std::min(width, nozzle.high);
  }
  if (reader.text(kShape, project.shapeFile)) project.unitlessIsMm = project.ignorePaint = true;
  std::string lines, modes;
  if (reader.text(kDirections, lines)) {
    project.layers.emplace_back().contents.emplace<MapLayer>().file = lines;
  }
  if (reader.text(kModes, modes)) {
    if (project.layers.empty()) project.layers.emplace_back();
    project.layers[0].modeFile = modes;
  }
  int count = 0;
  if (reader.integer(kPerimeters, count, static_cast<int>(perimeters.low), static_cast<int>(perimeters.high))) {
    project.toolpath.perimeterMode = count == 0 ? PerimeterMode::None : PerimeterMode::Count;
    project.toolpath.perimeters = count;
  }
  // 8 sweeps in place (Gauss-Seidel) smooth as well as the 32 published ones, which read the old field throughout
  // (Jacobi).
  int iterations = 0;
  if (reader.integer(kIterations, iterations, 1, 4000)) project.toolpath.sweepsPerLevel = std::max(1, iterations / 4);
  reader.seed(kSeed, project.toolpath.seed);
  bool repulse = true;
  if (reader.flag(kRepulse, repulse) && !repulse)
    project.toolpath.relaxationRounds = project.toolpath.repulsionRounds = 0;
  double share = 0;
  if (reader.number(kHeight, share, 0.01, 4)) project.print.layerHeight = share * project.toolpath.spacing;
  bool ignored = false;
  reader.flag(kCache, ignored);
  int shells = 0;
  reader.integer(kShells, shells, 0, 0);
  return reader.problem;
}

}  // namespace sillon
