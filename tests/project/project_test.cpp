// Project and scene files: what is written is read back, what is wrong is named.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sillon/project/project.hpp"
#include "sillon/settings/presets.hpp"
#include "sillon/settings/table.hpp"
#include "support/layer_of.hpp"
#include "support/wrong_settings.hpp"

using namespace sillon;
using Json = nlohmann::json;

namespace {

/// What is wrong with a text; empty if nothing is.
std::string problem(const std::string& text) {
  const Result<Project> project = readProject(text);
  return project ? "" : project.error().message;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// One layer of each kind, all of whose fields differ from their defaults.
std::vector<Layer> unusualLayers() {
  std::vector<Layer> layers;
  const auto add = [&layers](auto contents) {
    layers.push_back({.contents = std::move(contents),
                      .visible = false,
                      .at = Vec2{-3.25, 1.0 / 3.0},
                      .size = {10, 0},
                      .rotation = -30,
                      .mirror = true,
                      .mask = LayerMask::Outside,
                      .maskFile = "mask.svg",
                      .soft = 2,
                      .mode = DirectionMode::Orthogonal,
                      .modeFile = "modes.png"});
    Layer& layer = layers.back();
    if (auto* part = layer.as<LayerAngle>()) part->angle = 12.5;
    if (auto* part = layer.as<LayerFile>()) part->file = "a \"b\".png";
    if (auto* part = layer.as<LayerCrop>()) *part = {{0.1, 0.2}, {0.8, 0.9}};
    if (auto* part = layer.as<LayerFilled>()) part->fill = LayerFill::Along;
    if (auto* part = layer.as<LayerGround>()) part->ground = 100;
    if (auto* part = layer.as<LayerWords>()) part->text = "two\nlines";
    if (auto* part = layer.as<LayerLetters>()) *part = {"own.ttf", 350, 4, -20, TextAlign::Right};
  };
  add(DirectionLayer());
  MapLayer map;
  map.encoding = DirectionEncoding::Tangent;
  add(map);
  PictureLayer lit;
  lit.pictures = {{"one.png", Vec2{10.5, 20}}, {"\xC3\xA9.png", std::nullopt}};
  add(lit);
  add(TextLayer());
  CodeLayer code;
  code.correction = QrCorrection::High;
  add(code);
  PatternLayer pattern;
  pattern.pattern = LayerPattern::Waves;
  pattern.waveLength = 7;
  pattern.amplitude = 8;
  pattern.seed = std::numeric_limits<std::uint64_t>::max();
  add(pattern);
  TonesLayer tones;
  tones.by = TonesBy::Colours;
  tones.from = -10;
  tones.to = 80;
  tones.threshold = 0.1 + 0.2;
  tones.contrast = 1.5;
  tones.smoothing = 0.7;
  tones.colours = {{"#ff00aA", 33}, {"#000000", -1.0 / 3.0}};
  add(tones);
  add(DrawingLayer());
  BorderLayer border;
  border.width = 9;
  add(border);
  StrokesLayer strokes;
  strokes.strokes = {{StrokeTool::Comb, 2.5, 0.25, DirectionMode::Constrained, {{1, 2}, {-0.1, 1.0 / 3.0}}},
                     {StrokeTool::Mode, 1, 0, DirectionMode::Smoothest, {{4, 5}}},
                     {StrokeTool::Comb, 1, 0, DirectionMode::Parallel, {{4, 5}}},
                     {StrokeTool::Erase, 4, 1, DirectionMode::Constrained, {}}};
  add(strokes);
  return layers;
}

/// Every field differs from its default.
Project unusualProject() {
  Project p;
  p.layers = unusualLayers();
  p.shapeText = "ABC";
  p.shapeFont = "Caveat";
  p.shapeWeight = 350;
  p.shapeFile = "shapes/leaf \xC3\xA9.svg";
  p.builtinSize = {120.25, 80.5};
  p.builtinRadius = 1.0 / 3.0;
  p.corners = CornerStyle::Chamfer;
  p.starPoints = 7;
  p.builtinInner = 12.5;
  p.outlineOffset = -1.75;
  p.holes = {{{10.5, -3}, 4.5}, {{0.1 + 0.2, 80}, 8.2}};
  p.pageWidth = 0.1 + 0.2;
  p.unitlessIsMm = true;
  p.ignorePaint = true;
  p.keepThin = true;
  p.toolpath.spacing = 0.45;
  p.toolpath.perimeterMode = PerimeterMode::Soft;
  p.toolpath.perimeters = 3;
  p.toolpath.bridge = 0.07;
  p.toolpath.mapFilter = MapFilter::Nearest;
  p.toolpath.seed = std::numeric_limits<std::uint64_t>::max();
  p.toolpath.jitter = 0.07;
  p.toolpath.phaseTransport = PhaseTransport::Neighbour;
  p.toolpath.sweepsPerLevel = 9;
  p.toolpath.spacingVariation = 0.1;
  p.toolpath.directionTolerance = 4.5;
  p.toolpath.kernelRadius = 0.8;
  p.toolpath.borderWeight = 2.5;
  p.toolpath.stitchAlignment = 0.6;
  p.toolpath.repulsionRounds = 8;
  p.toolpath.relaxationRounds = 4;
  p.toolpath.order = BeadOrder::Plain;
  p.toolpath.relaxationStrength = 0.2;
  p.toolpath.relaxationSmoothing = 0.3;
  p.toolpath.widthBalance = 0.7;
  p.toolpath.beadOverlap = 0.01;
  p.toolpath.minWidth = 0.6;
  p.toolpath.maxWidth = 1.9;
  p.toolpath.simplifyTolerance = 0.004;
  p.pictures.spool = SpoolName::RedPetg;
  p.pictures.slopes = Vec2{2.25, 17.5};
  p.pictures.lampSize = 0.02;
  p.pictures.smoothness = 0.1;
  p.pictures.proportions = PictureProportions::Stretch;
  p.pictures.localContrast = 0.3;
  p.pictures.corrections = 1;
  p.print.layers = 2;
  p.print.basePerimeters = 2;
  p.print.purgeLength = 12;
  p.print.bedFlow = 0.98;
  p.printer.baseSpeed = 45;
  p.printer.showSpeed = 25;
  p.printer.firstLayerAcceleration = 500;
  p.printer.firstLayerFan = 10;
  p.printer.baseFan = 60;
  p.printer.showFan = 70;
  p.printer.minLayerTime = 6;
  p.print.base = 3;
  p.print.rim = 4;
  p.print.rimWidth = 1.6;
  p.print.skirt = 4;
  p.print.basePattern = BasePattern::Concentric;
  p.print.showSide = ShowSide::Bed;
  p.print.brim = 3;
  p.print.elephantFoot = 0.15;
  p.print.constantFlow = true;
  p.print.coast = 0.2;
  p.print.scarf = 4;
  p.print.copies = {2, 3};
  p.print.copyGap = 8;
  p.print.strict = true;
  p.print.layerHeight = 0.15;
  p.print.startHeight = 4.5;
  p.print.firstLayerHeight = 0.25;
  p.print.flow = 0.9;
  p.print.baseFlow = 1.01;
  p.print.bedFlow = 0.98;
  p.print.basePerimeters = 2;
  p.print.purgeLength = 12;
  p.print.rotate = 30.5;
  p.print.mirror = true;
  p.print.place = Vec2{-1.5, 20};
  p.printer.name = "Mine";
  p.printer.flavor = GcodeFlavor::Klipper;
  p.printer.bedMin = {-110, -105};
  p.printer.bedMax = {110, 115};
  p.printer.maxZ = 250;
  p.printer.zOffset = -0.02;
  p.printer.nozzle = 0.6;
  p.printer.filamentDiameter = 2.85;
  p.printer.filamentDensity = 1.27;
  p.printer.filamentFlow = 0.94;
  p.printer.filamentType = "PETG";
  p.printer.maxNozzleTemperature = 280;
  p.printer.maxBedTemperature = 100;
  p.printer.nozzleTemperature = 235;
  p.printer.firstLayerNozzleTemperature = 240;
  p.printer.bedTemperature = 80;
  p.printer.speed = 40;
  p.printer.firstLayerSpeed = 15;
  p.printer.travelSpeed = 150;
  p.printer.baseSpeed = 45;
  p.printer.showSpeed = 25;
  p.printer.firstLayerAcceleration = 500;
  p.printer.firstLayerFan = 10;
  p.printer.baseFan = 60;
  p.printer.showFan = 40;
  p.printer.minLayerTime = 6;
  p.printer.acceleration = 1500;
  p.printer.generalHeatLimits = true;
  p.printer.machineSpeed = 400;
  p.printer.machineAcceleration = 3000;
  p.printer.cornerSpeed = 8;
  p.printer.machineCornerSpeed = 9;
  p.printer.curveAcceleration = 700;
  p.printer.maxFlow = 12;
  p.printer.maxSegmentsPerSecond = 100;
  p.printer.pressureAdvance = 0.05;
  p.printer.setPressureAdvance = true;
  p.printer.retractLength = 0.5;
  p.printer.retractSpeed = 30;
  p.printer.lift = 0.2;
  p.printerProfile = "prusa-mini";
  p.filamentProfile = "petg";
  p.printer.roundBed = true;
  p.printer.excludedMin = {-110, -90};
  p.printer.excludedMax = {-100, -80};
  p.printer.absoluteE = true;
  p.printer.startGcode = "G28\nM109 S{first_layer_temperature}";
  p.printer.endGcode = "M84";
  p.printer.screenSizes = "16x16/QOI";
  return p;
}

}  // namespace

TEST_CASE("a project without words has the defaults") {
  const Result<Project> project = readProject(R"({"sillon": 1})");
  REQUIRE(project);
  CHECK(writeProject(project.value()) == writeProject(Project{}));
  CHECK(project.value().toolpath.spacing == 0.4);
  CHECK(project.value().printer.bedMax == Vec2{220, 220});
  CHECK_FALSE(project.value().toolpath.bridge.has_value());
}

TEST_CASE("every field survives writing and reading bit for bit") {
  const std::string text = writeProject(unusualProject());
  const Result<Project> read = readProject(text);
  REQUIRE_MESSAGE(read, problem(text));
  const Project& p = read.value();
  const Project q = unusualProject();
  CHECK(writeProject(p) == text);
  CHECK(p.shapeFile == q.shapeFile);
  CHECK(p.builtinRadius == q.builtinRadius);
  CHECK(p.pageWidth == q.pageWidth);
  CHECK(p.unitlessIsMm);
  CHECK(p.ignorePaint);
  CHECK(p.keepThin);
  CHECK(p.holes == q.holes);
  CHECK(p.layers == q.layers);
  CHECK(p.shapeText == q.shapeText);
  CHECK(p.outlineOffset == q.outlineOffset);
  CHECK(p.toolpath.seed == q.toolpath.seed);
  CHECK(p.toolpath.bridge == q.toolpath.bridge);
  CHECK(p.toolpath.perimeterMode == q.toolpath.perimeterMode);
  CHECK(p.print.rotate == q.print.rotate);
  CHECK(p.print.mirror);
  CHECK(p.print.place == q.print.place);
  CHECK(p.printer.bedMin == q.printer.bedMin);
  CHECK(p.printer.flavor == q.printer.flavor);
  CHECK(p.printer.setPressureAdvance);
  CHECK(p.printer.machineAcceleration == 3000);
}

TEST_CASE("each kind of layer survives writing and reading with all of its fields, none of which is forgotten here") {
  const std::vector<Layer> layers = unusualLayers();
  REQUIRE(layers.size() == std::variant_size_v<LayerContents>);
  for (std::size_t k = 0; k < layers.size(); ++k) {
    CAPTURE(k);
    REQUIRE(layers[k].contents.index() == k);
    for (const bool visible : {false, true}) {
      Project one;
      one.layers = {layers[k]};
      one.layers[0].visible = visible;
      const std::string text = writeProject(one);
      const Result<Project> read = readProject(text);
      REQUIRE_MESSAGE(read, problem(text));
      CHECK(read.value().layers == one.layers);
      CHECK(writeProject(read.value()) == text);
    }
    // All values that differ from their defaults are written, so all that the kind has.
    Project one;
    one.layers = {layers[k]};
    const Json written = Json::parse(writeProject(one))["layers"][0];
    SettingsView view;
    view.layer = &one.layers[0];
    for (const Setting& setting : settings()) {
      if (setting.section != Section::Layers) continue;
      CAPTURE(setting.key);
      CHECK(written.contains(setting.key) == !std::holds_alternative<std::monostate>(setting.field(view)));
    }
  }
}

TEST_CASE("a key of another kind of layer is refused by name, and told which ones it has") {
  const std::string known = "visible, at, size, rotation, mirror, mask, maskFile, soft, mode, modeFile";
  CHECK(problem(R"({"sillon": 1, "layers": [{"kind": "direction"}, {"kind": "border", "pictures": []}]})") ==
        "layers[1].pictures is not for the kind \"border\"; it has kind, " + known + ", angle, fill, width");
  // Without a kind it is a direction; where the kind stands does not count.
  CHECK(problem(R"({"sillon": 1, "layers": [{"file": "a.png"}]})") ==
        "layers[0].file is not for the kind \"direction\"; it has kind, " + known + ", angle");
  CHECK(problem(R"({"sillon": 1, "layers": [{"file": "a.png", "kind": "map"}]})").empty());
  // Each kind refuses each key that it has not.
  Layer layer;
  SettingsView view;
  view.layer = &layer;
  const Setting& kind = *findSetting(Section::Layers, "kind");
  const std::vector<std::string> kinds = splitWords(kind.choices);
  int refused = 0;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    choose(kind.field(view), k);
    for (const Setting& setting : settings()) {
      if (setting.section != Section::Layers || !std::holds_alternative<std::monostate>(setting.field(view))) continue;
      const Json one{{"kind", kinds[k]}, {setting.key, nullptr}};
      CHECK(has(problem(Json{{"sillon", 1}, {"layers", Json::array({one})}}.dump()),
                "layers[0]." + std::string(setting.key) + " is not for the kind \"" + kinds[k] + "\""));
      ++refused;
    }
  }
  CHECK(refused > 100);
  // A key that no kind has is unknown, and so are former kinds and sections.
  CHECK(has(problem(R"({"sillon": 1, "layers": [{"kind": "picture", "lamp": [60, 45]}]})"),
            "unknown key \"layers[0].lamp\""));
  CHECK(has(problem(R"({"sillon": 1, "layers": [{"kind": "qr", "text": "A"}]})"), "layers[0].kind is \"qr\""));
  CHECK(has(problem(R"({"sillon": 1, "directions": {"angle": 30}})"), "unknown key \"directions\""));
  CHECK(has(problem(R"({"sillon": 1, "modes": {"mode": "parallel"}})"), "unknown key \"modes\""));
  CHECK(has(problem(R"({"sillon": 1, "pictures": {"files": []}})"), "unknown key \"pictures.files\""));
}

TEST_CASE("strokes and colours that are none are named") {
  const auto strokes = [](const std::string& one) {
    return problem(R"({"sillon": 1, "layers": [{"kind": "strokes", "strokes": [)" + one + "]}]}");
  };
  CHECK(strokes(R"({"points": [1, 2]})").empty());
  CHECK(strokes(R"({"tool": "comb"})") ==
        "layers[0].strokes[0].points must be a list of numbers x, y, x, y, ... in mm");
  CHECK(strokes(R"({"points": [1, 2, 3]})") ==
        "layers[0].strokes[0].points must be a list of numbers x, y, x, y, ... in mm");
  CHECK(strokes(R"({"points": [1, "2"]})") ==
        "layers[0].strokes[0].points is of the JSON type string; it must be a number");
  CHECK(strokes(R"({"points": [], "tool": "brush"})") ==
        "layers[0].strokes[0].tool is \"brush\"; it must be \"comb\", \"mode\" or \"erase\"");
  CHECK(strokes(R"({"points": [], "radius": 0})") == "layers[0].strokes[0].radius is 0 mm; it must be 0.1 to 1000");
  CHECK(strokes(R"({"points": [], "soft": 1.5})") == "layers[0].strokes[0].soft is 1.5; it must be 0 to 1");
  CHECK(strokes(R"({"points": [0, 20000]})") == "layers[0].strokes[0].points is 20000 mm; it must be -10000 to 10000");
  CHECK(has(strokes(R"({"points": [], "size": 3})"), "unknown key \"layers[0].strokes[0].size\""));
  Project many;
  many.layers.emplace_back().contents.emplace<StrokesLayer>().strokes.resize(2);
  auto& all = many.layers[0].as<StrokesLayer>()->strokes;
  all[0].points.resize(kMostStrokePoints);
  CHECK(wrongSettings(many).empty());
  all[1].points.resize(1);
  CHECK(wrongSettings(many) == "layers[0].strokes have 200001 points; they may have up to 200000");
  all.assign(10'001, {});
  CHECK(wrongSettings(many) == "layers[0].strokes has 10001 entries; it may have up to 10000");

  const auto colours = [](const std::string& one) {
    return problem(R"({"sillon": 1, "layers": [{"kind": "tones", "file": "a.png", "colours": [)" + one + "]}]}");
  };
  CHECK(colours(R"({"colour": "#0a0B0c", "angle": 3})").empty());
  CHECK(colours(R"({"angle": 3})") == "layers[0].colours[0] has no colour; it must have one");
  for (const char* wrong : {"red", "#0a0b0", "#0a0b0cd", "#0a0b0g"}) {
    CHECK(colours("{\"colour\": \"" + std::string(wrong) + "\"}") ==
          "layers[0].colours[0].colour is \"" + std::string(wrong) + "\"; it must be \"#rrggbb\"");
  }
  CHECK(colours(R"({"colour": "#000000", "angle": 361})") ==
        "layers[0].colours[0].angle is 361 degrees; it must be -360 to 360");
}

TEST_CASE("an angle without a fill is one, and files keep what they meant") {
  const auto fillOf = [](const std::string& layer) {
    const Result<Project> read = readProject("{\"sillon\": 1, \"layers\": [" + layer + "]}");
    REQUIRE(read.ok());
    const Result<Project> again = readProject(writeProject(read.value()));
    REQUIRE(again.ok());
    CHECK(again.value().layers == read.value().layers);
    return read.value().layers[0].as<LayerFilled>()->fill;
  };
  CHECK(fillOf(R"({"kind": "text", "text": "A"})") == LayerFill::Across);
  CHECK(fillOf(R"({"kind": "text", "text": "A", "angle": 30})") == LayerFill::Angle);
  CHECK(fillOf(R"({"kind": "border", "angle": 0})") == LayerFill::Angle);
  CHECK(fillOf(R"({"kind": "drawing", "file": "a.svg", "angle": 30, "fill": "across"})") == LayerFill::Across);
  CHECK(fillOf(R"({"kind": "drawing", "file": "a.svg", "angle": 30, "fill": "along"})") == LayerFill::Along);
}

TEST_CASE("no two fields share a key: each written value differs from its default") {
  const Json unusual = Json::parse(writeProject(unusualProject()));
  const Json defaults = Json::parse(writeProject(Project{}));
  for (const auto& section : defaults.items()) {
    if (!section.value().is_object()) continue;
    for (const auto& field : section.value().items()) {
      CAPTURE(section.key() + "." + field.key());
      // A file and a built-in shape exclude each other, so one of the two keeps its default.
      if (section.key() == "shape" && field.key() == "builtin") continue;
      CHECK(unusual[section.key()][field.key()] != field.value());
    }
  }
}

TEST_CASE("the documentation has a row with the default of every field") {
  std::ifstream file(std::string(SILLON_SOURCE_DIR) + "/docs/reference/project.md");
  std::stringstream text;
  text << file.rdbuf();
  const Json defaults = Json::parse(writeProject(Project{}));
  for (const auto& section : defaults.items()) {
    if (!section.value().is_object()) continue;
    const std::size_t begin = text.str().find("## `" + section.key() + "`");
    REQUIRE(begin != std::string::npos);
    const std::string page = text.str().substr(begin, text.str().find("\n## ", begin) - begin);
    for (const auto& field : section.value().items()) {
      const Json& value = field.value();
      std::string shown = value.dump();
      if (value.size() == 2) shown = "[" + value[0].dump() + ", " + value[1].dump() + "]";
      if (value.is_string() || value.is_array() || value.is_null()) shown = "`" + shown + "`";
      CAPTURE(section.key() + "." + field.key());
      CHECK(has(page, "\n| `" + field.key() + "` | " + shown + " |"));
    }
  }
}

TEST_CASE("a preset lies under the filament, and that under the project's own values") {
  const Result<Project> read =
      readProject(R"({"sillon": 1, "printer": {"bedTemperature": 75, "filament": "petg", "profile": "prusa-mk4s"}})");
  REQUIRE(read);
  const Printer& p = read.value().printer;
  CHECK(p.flavor == GcodeFlavor::PrusaBuddy);
  CHECK(p.bedMax == Vec2{250, 210});
  CHECK(p.filamentDensity == 1.27);
  CHECK(p.nozzleTemperature == 235);
  CHECK(p.bedTemperature == 75);
  CHECK(has(problem(R"({"sillon": 1, "printer": {"profile": "prusa-mk4ss"}})"),
            "\"prusa-mk4ss\" is unknown for printer.profile; similar names: \"prusa-mk4s\""));
  CHECK(has(problem(R"({"sillon": 1, "printer": {"filament": "abs"}})"), "\"abs\" is unknown for printer.filament"));
  CHECK(has(problem(R"({"sillon": 1, "printer": {"screenSizes": "8x8"}})"), "printer.screenSizes must be"));
  const std::string block(65537, 'x');
  CHECK(
      has(problem(R"({"sillon": 1, "printer": {"endGcode": ")" + block + "\"}}"), "printer.endGcode has 65537 bytes"));
}

TEST_CASE("a preset lies under the section's own values, and all presets can be used") {
  const Result<Project> read =
      readProject(R"({"sillon": 1, "toolpath": {"kernelRadius": 0.7, "preset": "paper-2023"}})");
  REQUIRE(read);
  CHECK(read.value().toolpath.phaseTransport == PhaseTransport::Neighbour);
  CHECK(read.value().toolpath.spacingVariation == 0);
  CHECK(read.value().toolpath.relaxationRounds == 0);
  CHECK(read.value().toolpath.kernelRadius == 0.7);
  CHECK(read.value().toolpath.spacing == 0.4);
  CHECK(has(problem(R"({"sillon": 1, "toolpath": {"preset": "paper"}})"), "\"paper\" is unknown for toolpath.preset"));
  CHECK(presets().size() == 5);
  for (const std::string& id : presets()) {
    Project project;
    CHECK_FALSE(applyPreset(id, project.toolpath));
    CHECK(!invalidSettings(project));
    CHECK((writeProject(project) == writeProject({})) == (id == "standard"));
  }
}

TEST_CASE("the presets are the makers' facts and readable projects") {
  struct Fact {
    const char* id;
    Vec2 bed;
    double z;
    GcodeFlavor flavor;
    double retract;
  };
  const Fact facts[] = {{"prusa-mk4s", {250, 210}, 220, GcodeFlavor::PrusaBuddy, 0.7},
                        {"prusa-mk4", {250, 210}, 220, GcodeFlavor::PrusaBuddy, 0.7},
                        {"prusa-core-one", {250, 220}, 270, GcodeFlavor::PrusaBuddy, 0.7},
                        {"prusa-mini", {180, 180}, 180, GcodeFlavor::PrusaBuddy, 2.5},
                        {"prusa-mk3s", {250, 210}, 210, GcodeFlavor::Marlin, 0.8},
                        {"creality-ender-3", {210, 210}, 250, GcodeFlavor::Marlin, 5},
                        {"creality-ender-3-v3-se", {220, 220}, 250, GcodeFlavor::Marlin, 1.2},
                        {"creality-k1", {220, 220}, 250, GcodeFlavor::Klipper, 0.6},
                        {"anycubic-kobra-3", {250, 250}, 260, GcodeFlavor::Klipper, 1},
                        {"bambu-h2d", {300, 320}, 320, GcodeFlavor::Bambu, 0.8},
                        {"bambu-p1p", {256, 256}, 250, GcodeFlavor::Bambu, 0.8},
                        {"bambu-p2s", {256, 256}, 256, GcodeFlavor::Bambu, 0.8},
                        {"creality-ender-3-v2", {220, 220}, 250, GcodeFlavor::Marlin, 5},
                        {"creality-ender-3-v3", {220, 220}, 250, GcodeFlavor::Klipper, 0.6},
                        {"creality-k1c", {220, 220}, 250, GcodeFlavor::Klipper, 0.5},
                        {"creality-k2-plus", {350, 350}, 350, GcodeFlavor::Klipper, 0.5},
                        {"elegoo-centauri-carbon", {256, 256}, 256, GcodeFlavor::Klipper, 0.8},
                        {"prusa-mk3-5", {250, 210}, 210, GcodeFlavor::PrusaBuddy, 0.7},
                        {"sovol-sv08", {350, 350}, 345, GcodeFlavor::Klipper, 0.5},
                        {"voron-0", {120, 120}, 120, GcodeFlavor::Klipper, 0.5},
                        {"voron-trident-300", {300, 300}, 250, GcodeFlavor::Klipper, 0.5},
                        {"creality-cr-10s-pro", {300, 300}, 400, GcodeFlavor::Marlin, 5},
                        {"sovol-sv06", {220, 220}, 250, GcodeFlavor::Marlin, 0.5},
                        {"elegoo-neptune-4-pro", {225, 225}, 265, GcodeFlavor::Klipper, 0.8},
                        {"voron-2-4-300", {300, 300}, 260, GcodeFlavor::Klipper, 0.5},
                        {"qidi-q1-pro", {245, 245}, 240, GcodeFlavor::Klipper, 0.8},
                        {"anycubic-kossel-linear-plus", {230, 230}, 300, GcodeFlavor::Marlin, 5},
                        {"bambu-p1s", {256, 256}, 250, GcodeFlavor::Bambu, 0.8},
                        {"bambu-x1c", {256, 256}, 250, GcodeFlavor::Bambu, 0.8},
                        {"bambu-a1", {256, 256}, 256, GcodeFlavor::Bambu, 0.8},
                        {"bambu-a1-mini", {180, 180}, 180, GcodeFlavor::Bambu, 0.8},
                        {"creality-k2", {260, 260}, 260, GcodeFlavor::Klipper, 0.8},
                        {"prusa-xl", {360, 360}, 360, GcodeFlavor::PrusaBuddy, 0.8},
                        {"generic", {220, 220}, 200, GcodeFlavor::Marlin, 0.8},
                        {"generic-centre", {220, 220}, 200, GcodeFlavor::Marlin, 0.8}};
  const std::vector<PrinterProfile> printers = profiles(ProfileKind::Printer);
  CHECK(printers.size() == std::size(facts));
  for (const Fact& fact : facts) {
    CAPTURE(fact.id);
    Printer p;
    REQUIRE_FALSE(applyProfile(ProfileKind::Printer, fact.id, p));
    CHECK(p.bedMax - p.bedMin == fact.bed);
    CHECK(p.maxZ == fact.z);
    CHECK(p.flavor == fact.flavor);
    CHECK(p.retractLength == fact.retract);
    CHECK(p.acceleration <= p.machineAcceleration + 1e9 * (p.machineAcceleration == 0));
    const Result<Project> read = readProject(writePrinter(p));
    REQUIRE(read);
    CHECK(writePrinter(read.value().printer) == writePrinter(p));
  }
  for (const PrinterProfile& preset : profiles(ProfileKind::Filament)) {
    CAPTURE(preset.id);
    CHECK(problem(writePrinter(preset.printer)) == "");
    CHECK(preset.printer.bedMax == Vec2{220, 220});  // a filament says nothing of the machine
  }
  // The files hold only keys that are read.
  for (const char* name : {"printers", "filaments"}) {
    std::ifstream file(std::string(SILLON_SOURCE_DIR) + "/core/data/" + name + ".json");
    const Json all = Json::parse(file);
    CHECK(all["version"] == 1);
    for (const auto& item : all[name].items()) {
      CAPTURE(item.key());
      Json values = item.value();
      for (const char* key : {"maker", "models", "source", "advance"}) values.erase(key);  // about it, not of it
      CHECK(problem(Json{{"sillon", 1}, {"printer", values}}.dump()) == "");
    }
  }
}

TEST_CASE("pressure advance is the maker's for printer, filament and nozzle, and off where the maker tells none") {
  const struct {
    const char* printer;
    double advance;  // 0: not set
  } cases[] = {
      {R"({"profile": "prusa-mk4s"})", 0.036},
      {R"({"profile": "prusa-mk4s", "filament": "petg"})", 0.053},
      {R"({"profile": "prusa-mk4s", "filament": "petg", "nozzle": 0.6})", 0.032},
      {R"({"profile": "prusa-xl", "filament": "pla-silk", "nozzle": 0.25})", 0.12},
      {R"({"profile": "prusa-mini"})", 0.27},
      {R"({"profile": "prusa-mk3s", "filament": "petg"})", 0.08},
      {R"({"profile": "prusa-mk4s", "nozzle": 0.35})", 0},
      {R"({"profile": "prusa-mk4s", "filamentType": "TPU"})", 0},
      {R"({"profile": "creality-ender-3-v2"})", 0},
      {R"({"filament": "petg"})", 0},
  };
  for (const auto& c : cases) {
    CAPTURE(c.printer);
    const Result<Project> read = readProject(R"({"sillon": 1, "printer": )" + std::string(c.printer) + "}");
    REQUIRE(read);
    CHECK(read.value().printer.setPressureAdvance == (c.advance > 0));
    CHECK(read.value().printer.pressureAdvance == (c.advance > 0 ? c.advance : 0.04));
    CHECK(writeProject(readProject(writeProject(read.value())).value()) == writeProject(read.value()));
  }
  // What the file says counts.
  const Result<Project> own = readProject(
      R"({"sillon": 1, "printer": {"profile": "prusa-mk4s", "filament": "petg", "pressureAdvance": 0.06}})");
  CHECK(own.value().printer.pressureAdvance == 0.06);
  CHECK(own.value().printer.setPressureAdvance);
  const Result<Project> off =
      readProject(R"({"sillon": 1, "printer": {"profile": "prusa-mk4s", "setPressureAdvance": false}})");
  CHECK(!off.value().printer.setPressureAdvance);
}

TEST_CASE("each built-in shape has a name that is read back") {
  for (const BuiltinShape builtin :
       {BuiltinShape::None, BuiltinShape::Rectangle, BuiltinShape::RoundedRectangle, BuiltinShape::Disc}) {
    Project project;
    project.builtin = builtin;
    const Result<Project> read = readProject(writeProject(project));
    REQUIRE(read);
    CHECK(read.value().builtin == builtin);
  }
}

TEST_CASE("a published scene means what its reader meant") {
  const Result<Project> read = readProject(R"({
    "nozzle_width": 0.25, "svg_path": "svg/a.svg", "line_field_path": "png/l.png",
    "line_mode_field_path": "png/m.png", "perimeter_count": 4, "alignment_iter_per_level": 64, "seed": 7,
    "force_sdf_computation": true, "repulse_curves": false, "layer_height_rt_nozzle_width": 0.5, "shell_count": 0 })");
  REQUIRE(read);
  const Project& p = read.value();
  CHECK(p.toolpath.spacing == 0.25);
  CHECK(p.printer.nozzle == 0.25);
  CHECK(p.shapeFile == "svg/a.svg");
  CHECK(p.unitlessIsMm);
  CHECK(p.ignorePaint);
  REQUIRE(p.layers.size() == 1);
  MapLayer map;
  map.file = "png/l.png";
  Layer lowest = layerOf(map);
  lowest.modeFile = "png/m.png";
  CHECK(p.layers[0] == lowest);
  CHECK(groundOf(p.layers) == p.layers.data());
  CHECK(p.toolpath.perimeterMode == PerimeterMode::Count);
  CHECK(p.toolpath.perimeters == 4);
  CHECK(p.toolpath.sweepsPerLevel == 16);
  CHECK(p.toolpath.seed == 7);
  CHECK(p.toolpath.relaxationRounds == 0);
  CHECK(p.print.layerHeight == 0.125);
}

TEST_CASE("a scene without directions or modes has the lowest layer that the others ask for") {
  const auto layersOf = [](const std::string& more) {
    const Result<Project> read = readProject(R"({"nozzle_width": 0.4, "svg_path": "a.svg")" + more + "}");
    REQUIRE(read);
    CHECK(readProject(writeProject(read.value())).value().layers == read.value().layers);
    return read.value().layers;
  };
  CHECK(layersOf("").empty());
  MapLayer map;
  map.file = "l.png";
  CHECK(layersOf(R"(, "line_field_path": "l.png")") == std::vector<Layer>{layerOf(map)});
  Layer modes;
  modes.modeFile = "m.png";
  CHECK(layersOf(R"(, "line_mode_field_path": "m.png")") == std::vector<Layer>{modes});
}

TEST_CASE("a scene without perimeters has beads that end at the border") {
  const Result<Project> read = readProject(R"({"nozzle_width": 0.4, "svg_path": "a.svg", "perimeter_count": 0})");
  REQUIRE(read);
  CHECK(read.value().toolpath.perimeterMode == PerimeterMode::None);
}

TEST_CASE("a scene coarser than any nozzle keeps its spacing and takes the largest nozzle") {
  const Result<Project> read = readProject(R"({"nozzle_width": 2.5, "svg_path": "a.svg"})");
  REQUIRE(read);
  CHECK(read.value().toolpath.spacing == 2.5);
  CHECK(read.value().printer.nozzle == 2);
  CHECK(problem(writeProject(read.value())).empty());
}

TEST_CASE("a project may use the keys of scenes, and its own win") {
  const Result<Project> read =
      readProject(R"({"sillon": 1, "nozzle_width": 0.8, "seed": 3, "toolpath": {"spacing": 0.7}})");
  REQUIRE(read);
  CHECK(read.value().toolpath.spacing == 0.7);
  CHECK(read.value().printer.nozzle == 0.8);
  CHECK(read.value().toolpath.seed == 3);
}

TEST_CASE("every published scene is read") {
  const std::filesystem::path folder = std::filesystem::path(SILLON_SOURCE_DIR) / ".." / "shared" / "scenes";
  if (!std::filesystem::is_directory(folder)) {
    MESSAGE("the published scenes are not here; skipped");
    return;
  }
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    std::ifstream file(entry.path());
    std::stringstream text;
    text << file.rdbuf();
    CAPTURE(entry.path().string());
    CHECK(problem(text.str()) == "");
    const Json scene = Json::parse(text.str());
    const std::vector<Layer> layers = readProject(text.str()).value().layers;
    REQUIRE(layers.size() == (scene.contains("line_field_path") || scene.contains("line_mode_field_path") ? 1 : 0));
    if (!layers.empty()) {
      CHECK(layers[0].modeFile == scene.value("line_mode_field_path", ""));
      CHECK((layers[0].kind() == LayerKind::Map) == scene.contains("line_field_path"));
      if (const auto* map = layers[0].as<MapLayer>()) CHECK(map->file == scene["line_field_path"]);
    }
    ++scenes;
  }
  CHECK(scenes > 0);
}

TEST_CASE("an unknown key is named, with the ones near it") {
  CHECK(has(problem(R"({"sillon": 1, "toolpth": {}})"), "\"toolpth\""));
  CHECK(has(problem(R"({"sillon": 1, "toolpth": {}})"), "similar names: \"toolpath\""));
  const std::string deep = problem(R"({"sillon": 1, "toolpath": {"spaceing": 1}})");
  CHECK(has(deep, "\"toolpath.spaceing\""));
  CHECK(has(deep, "\"spacing\""));
  CHECK(has(problem(R"({"sillon": 1, "print": {"layer_height": 1}})"), "\"layerHeight\""));
  CHECK(has(problem(R"({"nozzle_widht": 0.4})"), "\"nozzle_width\""));
  CHECK(has(problem(R"({"sillon": 1, "pictures": {"qqqqqqqqqq": 1}})"), "known are proportions, spool, slopes"));
}

TEST_CASE("what the studio keeps of its own is written as it was read") {
  const std::string studio = R"({"strokes":[{"points":[0.1,1e-07,3]}],"version":1,"who":"\u00fc \"x\""})";
  const Result<Project> read = readProject(R"({"sillon": 1, "studio": )" + studio + "}");
  REQUIRE(read);
  const Json written = Json::parse(writeProject(read.value()));
  CHECK(written["studio"] == Json::parse(studio));
  const Result<Project> again = readProject(writeProject(read.value()));
  REQUIRE(again);
  CHECK(writeProject(again.value()) == writeProject(read.value()));
  CHECK(!Json::parse(writeProject(Project{})).contains("studio"));
  CHECK(problem(R"({"sillon": 1, "studio": 7})") == "studio is of the JSON type number; it must be an object");
}

TEST_CASE("a wrong type is told with the type that is wanted") {
  CHECK(problem(R"({"sillon": 1, "shape": []})") == "shape is of the JSON type array; it must be an object");
  CHECK(problem(R"({"sillon": 1, "shape": {"file": 3}})") == "shape.file is of the JSON type number; it must be text");
  CHECK(problem(R"({"sillon": 1, "shape": {"size": [1]}})") ==
        "shape.size is of the JSON type array; it must be two numbers [x, y]");
  for (const char* size : {R"([1, "2"])", R"(["1", 2])", "[1, 2, 3]"}) {
    CHECK(problem(R"({"sillon": 1, "shape": {"size": )" + std::string(size) + "}}") ==
          "shape.size is of the JSON type array; it must be two numbers [x, y]");
  }
  CHECK(problem(R"({"sillon": 1, "shape": {"size": {"x": 1, "y": 2}}})") ==
        "shape.size is of the JSON type object; it must be two numbers [x, y]");
  CHECK(problem(R"({"sillon": 1, "toolpath": {"spacing": "0.4"}})") ==
        "toolpath.spacing is of the JSON type string; it must be a number");
  CHECK(problem(R"({"sillon": 1, "toolpath": {"bridge": true}})") ==
        "toolpath.bridge is of the JSON type boolean; it must be a number or null");
  CHECK(problem(R"({"sillon": 1, "toolpath": {"mapFilter": "cubic"}})") ==
        "toolpath.mapFilter is \"cubic\"; it must be \"average\" or \"nearest\"");
  CHECK(problem(R"({"sillon": 1, "printer": {"setPressureAdvance": 1}})") ==
        "printer.setPressureAdvance is of the JSON type number; it must be true or false");
  CHECK(has(problem(R"({"sillon": 1, "print": {"layers": 1.5}})"), "print.layers is 1.5; it must be a whole number"));
  CHECK(has(problem(R"({"sillon": 1, "print": {"layers": 99999999999}})"), "print.layers is 99999999999"));
  CHECK(has(problem(R"({"sillon": 1, "print": {"layers": -99999999999}})"), "print.layers is -99999999999"));
  CHECK(has(problem(R"({"sillon": 1, "toolpath": {"seed": -1}})"), "toolpath.seed is -1"));
  CHECK(has(problem(R"({"sillon": 1, "toolpath": {"seed": 1e30}})"), "toolpath.seed is 1e+30"));
}

TEST_CASE("whole numbers may be written with a point") {
  const Result<Project> read = readProject(R"({"sillon": 1.0, "print": {"layers": 3.0}})");
  REQUIRE(read);
  CHECK(read.value().print.layers == 3);
}

TEST_CASE("a value out of range is told with its range") {
  CHECK(problem(R"({"sillon": 1, "print": {"layers": 0}})") == "print.layers is 0; it must be 1 to 1000");
  CHECK(problem(R"({"sillon": 1, "print": {"layerHeight": -0.2}})") ==
        "print.layerHeight is -0.2 mm; it must be 0.05 to 1.6");
  CHECK(problem(R"({"sillon": 1, "printer": {"nozzle": 3}})") == "printer.nozzle is 3 mm; it must be 0.05 to 2");
  CHECK(problem(R"({"sillon": 1, "printer": {"bedMax": [220, 6000]}})") ==
        "printer.bedMax.y is 6000 mm; it must be -5000 to 5000");
  CHECK(has(problem(R"({"sillon": 1, "printer": {"bedMin": [300, 0]}})"), "printer.bedMax is [220, 220] mm"));
  CHECK(has(problem(R"({"sillon": 1, "toolpath": {"spacing": -0.4}})"), "spacing is -0.4 mm"));
  CHECK(problem(R"({"nozzle_width": 100, "svg_path": "a"})") == "nozzle_width is 100; it must be 0.05 to 20");
  CHECK(has(problem(R"({"nozzle_width": 0.4, "svg_path": "a", "perimeter_count": -1})"), "perimeter_count is -1"));
  CHECK(has(problem(R"({"nozzle_width": 0.4, "svg_path": "a", "alignment_iter_per_level": 0})"), "is 0; it must be 1"));
  CHECK(has(problem(R"({"sillon": 1, "shape": {"file": "a.svg", "builtin": "disc"}})"), "both"));
  CHECK(has(problem("{\"sillon\": 1, \"shape\": {\"file\": \"a\\nb\"}}"), "one line"));
}

TEST_CASE("numbers that are none are found before they reach a file") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Project project;
  project.printer.speed = nan;
  CHECK(wrongSettings(project) == "printer.speed is not a number mm/s; it must be 5 to 1000");
  project = {};
  project.print.place = Vec2{std::numeric_limits<double>::infinity(), 0};
  CHECK(has(wrongSettings(project), "print.place.x is infinite mm"));
  project = {};
  project.toolpath.spacing = nan;
  CHECK(has(wrongSettings(project), "spacing"));
  CHECK(!invalidSettings(Project{}));
  CHECK(!invalidSettings(unusualProject()));
}

TEST_CASE("half a copy is refused") {
  CHECK(problem(R"({"sillon": 1, "print": {"copies": [1.5, 1]}})") ==
        "print.copies is [1.5, 1]; it must be two whole numbers");
}

TEST_CASE("a fraction where a whole number must be is refused with the range of its key") {
  CHECK(problem(R"({"sillon": 1, "print": {"layers": 1.5}})") ==
        "print.layers is 1.5; it must be a whole number from 1 to 1000");
  CHECK(problem(R"({"sillon": 1, "toolpath": {"perimeters": 1.5}})") ==
        "toolpath.perimeters is 1.5; it must be a whole number from 0 to 100");
  CHECK(problem(R"({"sillon": 1, "toolpath": {"seed": -1}})") ==
        "toolpath.seed is -1; it must be a whole number from 0 to 18446744073709551615");
}

TEST_CASE("versions and kinds of file are told apart") {
  CHECK(problem(R"({"sillon": 2})") == "sillon is 2; this program reads version 1");
  CHECK(has(problem(R"({"toolpath": {}})"), "\"sillon\": 1"));
  CHECK(has(problem("{}"), "neither a project nor a scene"));
  CHECK(has(problem(R"({"nozzle_width": 0.4})"), "neither a project nor a scene"));
  CHECK(has(problem("[]"), "neither a project nor a scene"));
  CHECK(has(problem("null"), "neither a project nor a scene"));
}

TEST_CASE("what is no JSON is told with its line") {
  CHECK(has(problem(""), "line 1"));
  CHECK(has(problem("{\"sillon\": 1,\n\"print\": {\n\"layers\": nan}}"), "line 3, column 12;"));
  CHECK(has(problem("{\"sillon\": 1, \"angle\": 1,5}"), "line 1, column 26;"));
  CHECK(has(problem("{\"sillon\": 1,}"), "not JSON"));
  CHECK(has(problem("{\"sillon\": 1} x"), "not JSON"));
  CHECK(has(problem("{\"sillon\": 1e999}"), "not JSON"));
  CHECK(has(problem("{\"sillon\": 1, \"shape\": {\"file\": \"\xFF\xFE\"}}"), "not JSON"));
  CHECK(has(problem(std::string("\0\0\0", 3)), "not JSON"));
}

TEST_CASE("a key given twice is an error, the same key in two sections is none") {
  CHECK(problem(R"({"sillon": 1, "sillon": 1})") == "key \"sillon\" is given twice; each key may be given once");
  CHECK(problem(R"({"sillon": 1, "shape": {"file": "a"}, "layers": [{"kind": "map", "file": "b"}]})") == "");
}

TEST_CASE("hostile files end quickly in an error") {
  CHECK(has(problem(std::string(1'000'000, '[')), "nested deeper than 64"));
  std::string objects;
  for (int k = 0; k < 150'000; ++k) objects += "{\"a\":";
  CHECK(has(problem(objects), "nested deeper than 64"));
  CHECK(has(problem(std::string(17 << 20, ' ')), "has 17 MiB; it may have at most 16"));
  std::string keys = "{";
  for (int k = 0; keys.size() < 1'000'000; ++k) keys += (k == 0 ? "\"k" : ",\"k") + std::to_string(k) + "\":1";
  CHECK(has(problem(keys + "}"), "unknown key"));
  CHECK(has(problem("{\"" + std::string(900'000, 'x') + "\": 1}"), "unknown key"));
  CHECK(problem("{\"" + std::string(900'000, 'x') + "\": 1}").size() < 1000);
  CHECK(has(problem("{\"sillon\": 1, \"printer\": {\"name\": \"" + std::string(2000, 'x') + "\"}}"), "1024 bytes"));
}

TEST_CASE("no cut and no changed byte of a project does harm") {
  const std::string text = writeProject(unusualProject());
  for (std::size_t length = 0; length + 2 < text.size(); length += 7)
    CHECK_FALSE(problem(text.substr(0, length)).empty());
  std::uint32_t state = 1;
  int read = 0;
  for (int k = 0; k < 2000; ++k) {
    std::string changed = text;
    for (int change = 0; change < 3; ++change) {
      state = state * 1664525u + 1013904223u;
      changed[(state >> 8) % changed.size()] = static_cast<char>(state >> 24);
    }
    const Result<Project> project = readProject(changed);
    if (project) {
      ++read;
      CHECK(!invalidSettings(project.value()));
    } else {
      CHECK(project.error().message.find('\n') == std::string::npos);
    }
  }
  CHECK(read < 2000);
}

TEST_CASE("a file name that is no UTF-8 is written all the same") {
  Project project;
  project.shapeFile = "\xFF.svg";
  CHECK(problem(writeProject(project)) == "");
}
