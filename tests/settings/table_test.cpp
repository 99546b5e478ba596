// The table of settings: what it says is what is checked, read and written.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sillon/look/appearance.hpp"
#include "sillon/project/project.hpp"
#include "sillon/settings/presets.hpp"
#include "sillon/settings/table.hpp"
#include "support/layer_of.hpp"
#include "support/told_reason.hpp"
#include "support/wrong_settings.hpp"

using namespace sillon;
using Json = nlohmann::json;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string problem(const Json& project) {
  const Result<Project> read = readProject(project.dump());
  return read ? "" : read.error().message;
}

/// The first kind of layer that has a setting.
std::string kindWith(const Setting& row) {
  Layer layer;
  SettingsView view;
  view.layer = &layer;
  const Setting& kind = *findSetting(Section::Layers, "kind");
  const std::vector<std::string> kinds = splitWords(kind.choices);
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    choose(kind.field(view), k);
    if (!std::holds_alternative<std::monostate>(row.field(view))) return kinds[k];
  }
  return "";
}

Json projectWith(const Setting& row, const Json& value) {
  Json fields = {{row.key, value}};
  // Hidden, it need not be whole.
  if (row.section == Section::Layers) fields.update({{"kind", kindWith(row)}, {"visible", false}});
  return {{"sillon", 1}, {sectionName(row.section), row.section == Section::Layers ? Json::array({fields}) : fields}};
}

/// The name in messages, which number layers.
std::string nameOf(const Setting& row) {
  return row.section == Section::Layers ? std::string("layers[0].") + row.key : fullName(row);
}

/// What the rules between settings ask for besides a value at one end of its range.
Json besides(const Setting& row, Json project, double value) {
  if (row.section == Section::Layers) return project;
  Json& section = project[sectionName(row.section)];
  const std::string key = row.key;
  if (has(key, "emperature")) section["generalHeatLimits"] = true;
  if (key == "bedMin") section["bedMax"] = {std::min(value + 10, 5000.0), std::min(value + 10, 5000.0)};
  if (key == "bedMax") section["bedMin"] = {std::max(value - 5000, -5000.0), std::max(value - 5000, -5000.0)};
  return project;
}

bool isNumber(const Setting& row) {
  return row.type == SettingType::Number || row.type == SettingType::Integer || row.type == SettingType::Pair ||
         row.type == SettingType::IntegerPair;
}

bool isSeed(const Setting& row) { return std::string(row.key) == "seed"; }

Json valueOf(const Setting& row, double value) {
  const bool whole = row.type == SettingType::Integer || row.type == SettingType::IntegerPair;
  const Json one = whole ? Json(static_cast<long long>(value)) : Json(value);
  return row.type == SettingType::Pair || row.type == SettingType::IntegerPair ? Json{one, one} : one;
}

}  // namespace

TEST_CASE("both ends of each range are allowed, and one step past them is not") {
  int tried = 0;
  for (const Setting& row : settings()) {
    if (!isNumber(row) || isSeed(row)) continue;
    CAPTURE(fullName(row));
    const bool whole = row.type == SettingType::Integer || row.type == SettingType::IntegerPair;
    const double infinity = std::numeric_limits<double>::infinity();
    const double below = whole ? row.low - 1 : std::nextafter(row.low, -infinity);
    const double above = whole ? row.high + 1 : std::nextafter(row.high, infinity);
    for (const double end : {row.low, row.high}) {
      // At these ends no bed can be: it would have no other corner.
      const std::string key = row.key;
      if ((key == "bedMin" && end == row.high) || (key == "bedMax" && end == row.low)) continue;
      // Nor would anything be left of a picture.
      if ((key == "cropMin" && end == row.high) || (key == "cropMax" && end == row.low)) continue;
      CHECK(problem(besides(row, projectWith(row, valueOf(row, end)), end)) == "");
    }
    for (const double past : {below, above}) {
      const std::string told = problem(besides(row, projectWith(row, valueOf(row, past)), past));
      CHECK(has(told, nameOf(row)));
      CHECK(has(told, "it must be "));
    }
    ++tried;
  }
  CHECK(tried > 55);
}

TEST_CASE("defaults are allowed, and each row has a key, a label and a sentence of its own") {
  CHECK(!invalidSettings(Project{}));
  std::set<std::string> names;
  std::set<std::string> options;
  for (const Setting& row : settings()) {
    CAPTURE(fullName(row));
    CHECK(names.insert(fullName(row)).second);
    const SettingWords words = wordsOf(row);
    if (*words.option != '\0') CHECK(options.insert(words.option).second);
    CHECK(*words.label != '\0');
    const std::string help = words.help;
    REQUIRE(help.size() > 10);
    CHECK(help.back() != '.');
    for (const char letter : help) CHECK((letter >= ' ' && letter <= '~'));
    CHECK((row.type == SettingType::Choice) == (*row.choices != '\0'));
    if (isNumber(row)) CHECK(row.low < row.high);
    CHECK(findSetting(row.section, row.key) == &row);
  }
  CHECK(findSetting(Section::Print, "spacing") == nullptr);
}

TEST_CASE("the words of choices stand in the order of their enumerators") {
  Project p;
  p.builtin = BuiltinShape::Disc;
  p.corners = CornerStyle::Chamfer;
  p.unitlessIsMm = true;
  p.ignorePaint = true;
  p.toolpath.perimeterMode = PerimeterMode::Soft;
  p.toolpath.mapFilter = MapFilter::Nearest;
  p.toolpath.phaseTransport = PhaseTransport::Neighbour;
  p.print.basePattern = BasePattern::Concentric;
  p.print.showSide = ShowSide::Both;
  const auto text = [&](Section section, const char* key) { return settingText(*findSetting(section, key), p); };
  CHECK(text(Section::Shape, "builtin") == "disc");
  CHECK(text(Section::Shape, "corners") == "chamfer");
  p.builtin = BuiltinShape::Tag;
  CHECK(text(Section::Shape, "builtin") == "tag");
  CHECK(text(Section::Shape, "unitless") == "mm");
  CHECK(text(Section::Toolpath, "perimeterMode") == "soft");
  CHECK(text(Section::Toolpath, "mapFilter") == "nearest");
  CHECK(text(Section::Toolpath, "phaseTransport") == "neighbour");
  CHECK(text(Section::Print, "basePattern") == "concentric");
  CHECK(text(Section::Print, "showSide") == "both");
  const std::vector<std::pair<GcodeFlavor, std::string>> flavors = {{GcodeFlavor::Marlin, "marlin"},
                                                                    {GcodeFlavor::Klipper, "klipper"},
                                                                    {GcodeFlavor::RepRap, "reprap"},
                                                                    {GcodeFlavor::PrusaBuddy, "prusa"},
                                                                    {GcodeFlavor::Bambu, "bambu"}};
  for (const auto& [flavor, name] : flavors) {
    p.printer.flavor = flavor;
    CHECK(text(Section::Printer, "flavor") == name);
  }
}

TEST_CASE("the words of layers' choices stand in the order of their enumerators") {
  const auto words = [](const char* key) { return splitWords(findSetting(Section::Layers, key)->choices); };
  const auto is = [&](const char* key, auto value, const char* word) {
    return words(key).at(static_cast<std::size_t>(value)) == word;
  };
  const std::pair<LayerContents, const char*> kinds[] = {{DirectionLayer(), "direction"}, {MapLayer(), "map"},
                                                         {PictureLayer(), "picture"},     {TextLayer(), "text"},
                                                         {CodeLayer(), "code"},           {PatternLayer(), "pattern"},
                                                         {TonesLayer(), "tones"},         {DrawingLayer(), "drawing"},
                                                         {BorderLayer(), "border"},       {StrokesLayer(), "strokes"}};
  for (const auto& [contents, word] : kinds) CHECK(is("kind", layerOf(contents).kind(), word));
  CHECK(words("kind").size() == std::variant_size_v<LayerContents>);
  CHECK(is("mode", DirectionMode::Parallel, "parallel"));
  CHECK(is("mode", DirectionMode::Orthogonal, "orthogonal"));
  CHECK(is("mode", DirectionMode::Smoothest, "smoothest"));
  CHECK(is("mode", DirectionMode::Constrained, "constrained"));
  CHECK(is("encoding", DirectionEncoding::Rotation, "rotation"));
  CHECK(is("encoding", DirectionEncoding::Tangent, "tangent"));
  CHECK(is("mask", LayerMask::Disc, "disc"));
  CHECK(is("mask", LayerMask::Outside, "outside"));
  CHECK(is("fill", LayerFill::Along, "along"));
  CHECK(is("fill", LayerFill::Across, "across"));
  CHECK(is("align", TextAlign::Right, "right"));
  CHECK(is("correction", QrCorrection::Quartile, "quartile"));
  CHECK(is("pattern", LayerPattern::Spiral, "spiral"));
  CHECK(is("pattern", LayerPattern::Noise, "noise"));
  CHECK(is("pattern", LayerPattern::Echo, "echo"));
  CHECK(is("by", TonesBy::Levels, "levels"));
  CHECK(is("by", TonesBy::Colours, "colours"));
}

TEST_CASE("the lowest layer fills the page by itself if it is a direction, a map or pictures in no place of its own") {
  const LayerContents fills[] = {DirectionLayer(), MapLayer(), PictureLayer()};
  const LayerContents others[] = {TextLayer(),    CodeLayer(),   PatternLayer(), TonesLayer(),
                                  DrawingLayer(), BorderLayer(), StrokesLayer()};
  CHECK(groundOf({}) == nullptr);
  for (const LayerContents& contents : others) {
    const std::vector<Layer> layers{layerOf(contents)};
    CHECK(groundOf(layers) == nullptr);
  }
  for (const LayerContents& contents : fills) {
    std::vector<Layer> layers{layerOf(contents), layerOf(TextLayer())};
    CHECK(groundOf(layers) == layers.data());
    layers[0].mode = DirectionMode::Parallel;
    layers[0].modeFile = "modes.png";
    layers[0].maskFile = "unused.svg";
    CHECK(groundOf(layers) == layers.data());
    const Layer before = layers[0];
    const std::function<void(Layer&)> places[] = {
        [](Layer& layer) { layer.visible = false; }, [](Layer& layer) { layer.at = Vec2{0, 0}; },
        [](Layer& layer) { layer.size = {0, 1}; },   [](Layer& layer) { layer.rotation = 90; },
        [](Layer& layer) { layer.mirror = true; },   [](Layer& layer) { layer.mask = LayerMask::Page; },
        [](Layer& layer) { layer.soft = 0.1; },
    };
    for (const auto& place : places) {
      layers[0] = before;
      place(layers[0]);
      CHECK(groundOf(layers) == nullptr);
      CHECK(groundPictures(layers).empty());
    }
    // Only the lowest.
    layers[0] = before;
    layers.insert(layers.begin(), layerOf(TextLayer()));
    CHECK(groundOf(layers) == nullptr);
  }
  PictureLayer lit;
  lit.pictures = {{"a.png", std::nullopt}};
  CHECK(groundPictures({layerOf(lit)}) == lit.pictures);
  CHECK(groundPictures({layerOf(DirectionLayer()), layerOf(lit)}).empty());
}

TEST_CASE("spools are called as the measured ones are, in the same order") {
  const std::vector<std::string> words = splitWords(findSetting(Section::Pictures, "spool")->choices);
  REQUIRE(words.size() == spools().size());
  for (std::size_t k = 0; k < words.size(); ++k) {
    CHECK(words[k] == spools()[k].key);
    CHECK(spoolOf(static_cast<SpoolName>(k)).key == words[k]);
  }
}

TEST_CASE("pictures with their lamps are written as they were read") {
  const Json lit = {{"kind", "picture"},
                    {"pictures", {{{"file", "a \"b\".png"}, {"lamp", {60.5, 45}}}, {{"file", "c.png"}}}}};
  const Json given = {
      {"sillon", 1}, {"layers", Json::array({lit})}, {"pictures", {{"spool", "goldPla"}, {"slopes", {2.5, 17}}}}};
  const Result<Project> read = readProject(given.dump());
  REQUIRE(read);
  const std::vector<LampPicture> pictures = groundPictures(read.value().layers);
  REQUIRE(pictures.size() == 2);
  CHECK(pictures[0] == LampPicture{"a \"b\".png", Vec2{60.5, 45}});
  CHECK(pictures[1] == LampPicture{"c.png", std::nullopt});
  CHECK(read.value().pictures.spool == SpoolName::GoldPla);
  CHECK(read.value().pictures.slopes == Vec2{2.5, 17});
  const std::string text = writeProject(read.value());
  CHECK(Json::parse(text)["layers"][0]["pictures"][1] == Json{{"file", "c.png"}, {"lamp", nullptr}});
  const Result<Project> again = readProject(text);
  REQUIRE(again);
  CHECK(again.value().layers == read.value().layers);
  CHECK(writeProject(again.value()) == text);

  const auto wrong = [](const Json& one) {
    const Json layer = {{"kind", "picture"}, {"pictures", one}};
    return problem({{"sillon", 1}, {"layers", Json::array({layer})}});
  };
  CHECK(wrong(Json::array()) == "layers[0].pictures is empty; it must have at least one picture");
  CHECK(wrong(Json(5, {{"file", "a"}})) == "layers[0].pictures has 5 entries; it may have up to 4");
  CHECK(has(wrong(Json::array({{{"file", "a"}, {"lamp", {0, 91}}}})), "layers[0].pictures[0].lamp.y is 91 degrees"));
  CHECK(has(wrong(Json::array({{{"file", "a"}, {"lamp", {361, 1}}}})), "layers[0].pictures[0].lamp.x is 361 degrees"));
  CHECK(wrong(Json::array({{{"lamp", {0, 45}}}})) == "layers[0].pictures[0] has no file; it must have one");
  CHECK(wrong(Json::array({{{"file", ""}}})) == "layers[0].pictures[0].file is empty; it must name a file");
}

TEST_CASE("holes are written as they were read, and told what is wrong with them") {
  const auto with = [](const Json& holes) { return Json{{"sillon", 1}, {"shape", {{"holes", holes}}}}; };
  const Json one = {{"x", 10.5}, {"y", -3}, {"diameter", 4.5}};
  const Result<Project> read = readProject(with(Json::array({one})).dump());
  REQUIRE(read);
  CHECK(read.value().holes == std::vector<RoundHole>{{{10.5, -3}, 4.5}});
  CHECK(Json::parse(writeProject(read.value()))["shape"]["holes"] == Json::array({one}));
  const auto wrong = [&](const char* key, const Json& value) {
    Json hole = one;
    hole[key] = value;
    return problem(with(Json::array({one, hole})));
  };
  CHECK(wrong("diameter", 0.25) == "shape.holes[1].diameter is 0.25 mm; it must be 0.5 to 10000");
  CHECK(wrong("x", 20000) == "shape.holes[1].x is 20000 mm; it must be -10000 to 10000");
  CHECK(wrong("y", "top") == "shape.holes[1].y is of the JSON type string; it must be a number");
  CHECK(has(wrong("radius", 2), "unknown key \"shape.holes[1].radius\""));
  CHECK(has(problem(with(Json::array({{{"x", 1}, {"y", 2}}}))), "shape.holes[0] has no diameter"));
  CHECK(has(problem(with(3)), "shape.holes is of the JSON type number; it must be a list"));
  CHECK(has(problem(with(Json::array({3}))), "shape.holes[0] is of the JSON type number; it must be an object"));
  CHECK(problem(with(Json(17, one))) == "shape.holes has 17 entries; it may have up to 16");
  CHECK(problem(with(Json(16, one))) == "");
}

TEST_CASE("what temperatures are allowed depends on generalHeatLimits") {
  Printer printer;
  printer.nozzleTemperature = 320;
  CHECK(wrongSettings(printer, PrintParams{}) ==
        "printer.nozzleTemperature is 320 degrees Celsius; it must be 170 to 300");
  CHECK(toldReason(*invalidSettings(printer, {})) ==
        "SettingOutOfRange setting=printer.nozzleTemperature value=320 low=170 high=300");
  printer.generalHeatLimits = true;  // hotter than that is refused by `check`, which knows no printer
  CHECK(has(wrongSettings(printer, PrintParams{}), "it must be 0 to 300"));
  printer.nozzleTemperature = 20;
  CHECK(!invalidSettings(printer, {}));
  printer.bedTemperature = 121;
  CHECK(has(wrongSettings(printer, PrintParams{}), "it must be 0 to 120"));
}

TEST_CASE("a printer's own limits of temperature hold below the general ones, unless any is allowed") {
  Printer printer;
  printer.maxNozzleTemperature = 240;
  printer.maxBedTemperature = 80;
  CHECK(!invalidSettings(printer, {}));
  for (const auto& [field, key] : {std::pair{&Printer::nozzleTemperature, "nozzleTemperature"},
                                   {&Printer::firstLayerNozzleTemperature, "firstLayerNozzleTemperature"}}) {
    Printer hot = printer;
    hot.*field = 240;
    CHECK(!invalidSettings(hot, {}));
    hot.*field = 241;
    CHECK(wrongSettings(hot, PrintParams{}) ==
          "printer." + std::string(key) +
              " is 241 degrees Celsius; it must be 170 to 240, or maxNozzleTemperature higher for another hot end");
    hot.generalHeatLimits = true;
    CHECK(!invalidSettings(hot, {}));
  }
  printer.bedTemperature = 81;
  CHECK(
      wrongSettings(printer, PrintParams{}) ==
      "printer.bedTemperature is 81 degrees Celsius; it must be 0 to 80, or maxBedTemperature higher for another bed");
  printer.generalHeatLimits = true;
  CHECK(!invalidSettings(printer, {}));
  CHECK(has(problem({{"sillon", 1}, {"printer", {{"profile", "creality-ender-3"}, {"nozzleTemperature", 256}}}}),
            "it must be 170 to 255, or maxNozzleTemperature"));
  CHECK(has(problem({{"sillon", 1}, {"printer", {{"profile", "bambu-a1-mini"}, {"bedTemperature", 81}}}}),
            "it must be 0 to 80, or maxBedTemperature"));
}

TEST_CASE("rules between settings of a section hold wherever they are read") {
  Printer printer;
  printer.bedMin = {215, 0};
  CHECK(
      has(wrongSettings(printer, PrintParams{}), "printer.bedMax is [220, 220] mm; it must be 10 to 5000 mm right of"));
  printer = {};
  printer.roundBed = true;
  printer.bedMax = {200, 210};
  CHECK(has(wrongSettings(printer, PrintParams{}), "it must be a square"));
  printer = {};
  printer.machineSpeed = 4;
  CHECK(has(wrongSettings(printer, PrintParams{}), "it must be 5 to 1000, or 0"));
  PrintParams print;
  print.firstLayerHeight = 0.01;
  CHECK(has(wrongSettings(Printer{}, print), "print.firstLayerHeight is 0.01 mm; it must be 0.05 to 1.6, or 0"));
}

TEST_CASE("the table as JSON has every row with its default and range") {
  const Json all = Json::parse(settingsJson(), nullptr, false);
  REQUIRE(all.is_object());
  REQUIRE(all["settings"].size() == settings().size());
  const Json written = Json::parse(writeProject(Project{}));
  for (std::size_t k = 0; k < settings().size(); ++k) {
    const Setting& row = settings()[k];
    const Json& told = all["settings"][k];
    CAPTURE(fullName(row));
    CHECK(told["section"] == sectionName(row.section));
    CHECK(told["key"] == row.key);
    // A project without layers has none to write.
    const bool writes = row.section != Section::Layers;
    if (writes && told.contains("default")) CHECK(told["default"] == written[sectionName(row.section)][row.key]);
    CHECK(told.contains("low") == isNumber(row));
    if (isNumber(row) && !isSeed(row)) {
      CHECK(told["low"] == row.low);
      CHECK(told["high"] == row.high);
    }
  }
}
