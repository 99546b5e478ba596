// Layers in closed forms: where they lie, what they cover, and which directions they ask for.
#include "sillon/compose/compose.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "compose/visible.hpp"
#include "input/stored_angle.hpp"
#include "report/told.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/project/project.hpp"
#include "sillon/settings/table.hpp"
#include "sillon/text/text.hpp"

using namespace sillon;

namespace {

constexpr double kDegree = std::numbers::pi / 180;
const Vec2 kPage{60, 40};

/// A plate with layers over a lowest one that fills it: beads at 0 degrees, in another mode.
struct Plate {
  Project project;
  Shape shape = makeRectangle(kPage).value();
  std::map<std::string, InputFile> files;

  Plate() { project.layers.emplace_back().mode = DirectionMode::Smoothest; }
  /// Puts a layer on top. \return its contents
  template <class Contents>
  Contents& add() {
    project.layers.emplace_back().contents = Contents();
    return top<Contents>();
  }
  [[nodiscard]] Layer& top() { return project.layers.back(); }
  template <class Part>
  [[nodiscard]] Part& top() {
    return *top().as<Part>();
  }
  [[nodiscard]] ReadInput reader() const {
    return [this](const std::string& name, const std::string&) -> Result<InputFile> {
      const auto found = files.find(name);
      if (found == files.end()) return Error{ErrorCode::InvalidFile, "no " + name};
      return found->second;
    };
  }
  [[nodiscard]] Result<Composition> tried() const {
    auto ground = readPlateInput(project, shape, reader());
    if (!ground) return ground.error();
    return compose(project, std::move(ground).value(), {reader()}, RunContext());
  }
  [[nodiscard]] Composition composition() const {
    const auto wrong = invalidSettings(project);
    CHECK_MESSAGE(!wrong, (wrong ? wrong->message : ""));
    auto made = tried();
    REQUIRE_MESSAGE(made.ok(), (made.ok() ? "" : made.error().message));
    return std::move(made).value();
  }
  [[nodiscard]] LayerStack stack() const { return composition().layers; }
  [[nodiscard]] PlateInput composed() const { return composition().laid(); }
  [[nodiscard]] std::vector<Warning> letterWarnings() const {
    return toldOf(stack().placed, {}, shape.page, project.toolpath.spacing).warnings;
  }
};

/// Difference of two lines [degrees], 0..90.
double apart(double a, double b) {
  const double turned = std::abs(std::remainder(a - b, 180));
  return std::min(turned, 180 - turned);
}

struct At {
  double angle;  ///< [degrees]
  DirectionMode mode;
};

At at(const PlateInput& input, Vec2 place) {
  const DirectionMap& map = input.directions;
  const auto x = static_cast<std::size_t>(place.x / input.shape.page.x * map.width);
  const auto y = static_cast<std::size_t>((1 - place.y / input.shape.page.y) * map.height);
  const std::size_t k = y * static_cast<std::size_t>(map.width) + x;
  return {angleOf(map.angle[k]) / kDegree, input.modes.mode[k]};
}

/// Area of the texels that a rule holds for [mm²].
double areaWhere(const PlateInput& input, const std::function<bool(double angle)>& rule) {
  std::size_t count = 0;
  for (const std::uint16_t angle : input.directions.angle) count += rule(angleOf(angle) / kDegree) ? 1 : 0;
  return kPage.x * kPage.y * static_cast<double>(count) / static_cast<double>(input.directions.angle.size());
}

std::function<bool(double)> near(double wanted) {
  return [wanted](double angle) { return apart(angle, wanted) < 0.01; };
}

std::string square(double side) {
  const std::string text = std::to_string(side);
  return "<svg xmlns='http://www.w3.org/2000/svg' width='" + text + "mm' height='" + text +
         "mm' viewBox='0 0 1 1'><path d='M0 0h1v1h-1z'/></svg>";
}

}  // namespace

TEST_CASE("without layers above the lowest nothing changes") {
  Plate plate;
  plate.top<DirectionLayer>().angle = 30;
  plate.top().mode = DirectionMode::Parallel;
  CHECK(plate.composed().directions == uniformDirection(30).value());
  CHECK(plate.composed().modes.mode == std::vector<DirectionMode>{DirectionMode::Parallel});
  plate.add<DirectionLayer>();
  plate.top().visible = false;
  CHECK(plate.composed().directions == uniformDirection(30).value());
  CHECK(plate.stack().placed.size() == 2);
  // Nor are there any: beads at 0 degrees.
  plate.project.layers.clear();
  CHECK(plate.composed().directions == uniformDirection(0).value());
  CHECK(plate.composed().modes.mode == std::vector<DirectionMode>{DirectionMode::Constrained});
  CHECK(plate.stack().placed.empty());
}

TEST_CASE("a lowest layer that does not fill the page lies on beads at 0 degrees") {
  Plate plate;
  plate.top<DirectionLayer>().angle = 50;
  plate.top().size = {20, 10};
  const PlateInput input = plate.composed();
  CHECK(areaWhere(input, near(50)) == doctest::Approx(200).epsilon(0.02));
  CHECK(at(input, {30, 20}).mode == DirectionMode::Smoothest);
  CHECK(apart(at(input, {5, 5}).angle, 0) < 0.01);
  CHECK(at(input, {5, 5}).mode == DirectionMode::Constrained);
  CHECK(plate.stack().inks.size() == 1);
  // Hidden, it is not there.
  plate.top() = {};
  plate.top<DirectionLayer>().angle = 50;
  plate.top().visible = false;
  CHECK(plate.composed().directions == uniformDirection(0).value());
}

TEST_CASE("a direction fills its box, which lies and turns as told") {
  Plate plate;
  plate.add<DirectionLayer>().angle = 40;
  plate.top().at = Vec2{20, 25};
  plate.top().size = {16, 10};
  for (const double rotation : {0.0, 30.0, -75.0}) {
    plate.top().rotation = rotation;
    const PlateInput input = plate.composed();
    CHECK(areaWhere(input, near(40)) == doctest::Approx(160).epsilon(0.01));
    const Vec2 corner{std::cos(rotation * kDegree) * 7.5 - std::sin(rotation * kDegree) * 4.5,
                      std::sin(rotation * kDegree) * 7.5 + std::cos(rotation * kDegree) * 4.5};
    CHECK(apart(at(input, Vec2{20, 25} + corner).angle, 40) < 0.01);
    CHECK(at(input, Vec2{20, 25} + corner).mode == DirectionMode::Constrained);
    CHECK(apart(at(input, {50, 8}).angle, 0) < 0.01);
    CHECK(at(input, {50, 8}).mode == DirectionMode::Smoothest);
  }
  const PlacedLayer placed = plate.stack().placed.at(1);
  CHECK(placed.at == Vec2{20, 25});
  CHECK(placed.size == Vec2{16, 10});
}

TEST_CASE("the topmost layer wins") {
  Plate plate;
  plate.add<DirectionLayer>().angle = 20;
  plate.add<DirectionLayer>().angle = 70;
  plate.top().size = {10, 10};
  PlateInput input = plate.composed();
  CHECK(areaWhere(input, near(70)) == doctest::Approx(100).epsilon(0.02));
  CHECK(areaWhere(input, near(20)) == doctest::Approx(60 * 40 - 100).epsilon(0.002));
  std::swap(plate.project.layers[1], plate.project.layers[2]);
  input = plate.composed();
  CHECK(areaWhere(input, near(20)) == doctest::Approx(60 * 40));
}

TEST_CASE("each mode of a layer reaches its place, and no other") {
  for (const DirectionMode mode :
       {DirectionMode::Parallel, DirectionMode::Orthogonal, DirectionMode::Smoothest, DirectionMode::Constrained}) {
    CAPTURE(static_cast<int>(mode));
    Plate plate;
    plate.top().mode = mode == DirectionMode::Smoothest ? DirectionMode::Parallel : DirectionMode::Smoothest;
    // Letters, a pattern and one direction beside each other.
    plate.add<TextLayer>().text = "I";
    plate.top<LayerLetters>().textSize = 30;
    plate.top().at = Vec2{10, 20};
    plate.top().mode = mode;
    plate.add<PatternLayer>();
    plate.top().at = Vec2{30, 20};
    plate.top().size = {10, 10};
    plate.top().mode = mode;
    plate.add<DirectionLayer>().angle = 40;
    plate.top().at = Vec2{50, 20};
    plate.top().size = {10, 10};
    plate.top().mode = mode;
    const PlateInput input = plate.composed();
    for (const double x : {10.0, 30.0, 50.0}) CHECK(at(input, {x, 20}).mode == mode);
    for (const Vec2 beside : {Vec2{10, 2}, Vec2{20, 20}, Vec2{40, 20}, Vec2{58, 20}}) {
      CHECK(at(input, beside).mode == plate.project.layers[0].mode);
    }
  }
}

TEST_CASE("a mode picture lies over the box of its layer, turned and cropped with it") {
  using enum DirectionMode;
  Plate plate;
  plate.files["modes"] = Image{2, 1, 1, {0, 21845}};  // parallel on the left, orthogonal on the right
  plate.files["map"] = Image{2, 1, 1, {32768, 32768}};
  const auto place = [&plate] {
    plate.top().at = Vec2{30, 20};
    plate.top().size = {20, 10};
    plate.top().mode = Constrained;  // does not count
    plate.top().modeFile = "modes";
  };
  const auto modesAt = [&plate](Vec2 from) {
    const PlateInput input = plate.composed();
    return std::pair{at(input, Vec2{30, 20} - from).mode, at(input, Vec2{30, 20} + from).mode};
  };
  plate.add<DirectionLayer>().angle = 10;
  place();
  CHECK(modesAt({5, 0}) == std::pair{Parallel, Orthogonal});
  CHECK(modesAt({15, 0}) == std::pair{Smoothest, Smoothest});
  plate.top().rotation = 90;  // what was on the left is below
  CHECK(modesAt({0, 5}) == std::pair{Parallel, Orthogonal});
  plate.project.layers.pop_back();

  plate.add<MapLayer>().file = "map";
  place();
  CHECK(modesAt({5, 0}) == std::pair{Parallel, Orthogonal});
  plate.top().mirror = true;
  CHECK(modesAt({5, 0}) == std::pair{Orthogonal, Parallel});
  plate.top<LayerCrop>().cropMin = {0.5, 0};
  CHECK(modesAt({5, 0}) == std::pair{Orthogonal, Orthogonal});
  plate.project.layers.pop_back();

  plate.files["tones"] = Image{2, 1, 1, {20000, 40000}};
  plate.add<PictureLayer>().pictures = {{"tones", Vec2{60, 45}}};
  place();
  CHECK(modesAt({5, 0}) == std::pair{Parallel, Orthogonal});
  CHECK(modesAt({15, 0}) == std::pair{Smoothest, Smoothest});
  plate.project.layers.pop_back();

  // Other kinds have one, too.
  plate.files["square.svg"] = square(10);
  plate.add<TextLayer>().text = "MM";
  place();
  plate.top().size = {20, 0};
  plate.top<LayerGround>().ground = 0;
  CHECK(modesAt({5, 0}) == std::pair{Parallel, Orthogonal});
  plate.project.layers.pop_back();
  plate.add<CodeLayer>().text = "A";
  place();
  CHECK(modesAt({5, 0}) == std::pair{Parallel, Orthogonal});
  plate.project.layers.pop_back();
  plate.add<PatternLayer>();
  place();
  CHECK(modesAt({5, 0}) == std::pair{Parallel, Orthogonal});
  plate.project.layers.pop_back();
  plate.add<TonesLayer>().file = "tones";
  place();
  CHECK(modesAt({5, 0}) == std::pair{Parallel, Orthogonal});
  plate.project.layers.pop_back();
  plate.add<DrawingLayer>().file = "square.svg";
  place();
  CHECK(modesAt({5, 0}) == std::pair{Parallel, Orthogonal});
  // At the bottom it lies over the page.
  plate.project.layers.clear();
  for (const LayerContents& lowest :
       {LayerContents(DirectionLayer()), LayerContents(MapLayer()), LayerContents(PictureLayer())}) {
    plate.project.layers.assign(1, {});
    plate.top().contents = lowest;
    if (auto* map = plate.top().as<MapLayer>()) map->file = "map";
    if (auto* lit = plate.top().as<PictureLayer>()) lit->pictures = {{"tones", Vec2{60, 45}}};
    plate.top().modeFile = "modes";
    CHECK(plate.composed().modes.mode == std::vector<DirectionMode>{Parallel, Orthogonal});
  }
}

TEST_CASE("a soft edge turns from one direction into the other about the edge") {
  Plate plate;
  plate.add<DirectionLayer>().angle = 60;
  plate.top().at = Vec2{15, 20};
  plate.top().size = {30, 80};
  plate.top().soft = 8;
  const PlateInput input = plate.composed();
  double before = 60;
  for (double x = 24; x <= 36; x += 0.5) {
    const double angle = at(input, {x, 20}).angle;
    CHECK(angle <= before + 0.01);
    before = angle;
  }
  CHECK(apart(at(input, {25, 20}).angle, 60) < 0.01);
  CHECK(at(input, {30, 20}).angle == doctest::Approx(30).epsilon(0.05));
  CHECK(apart(at(input, {35, 20}).angle, 0) < 0.01);
}

TEST_CASE("letters cover what their outlines do, over a ground if there is one") {
  Plate plate;
  TextLayer& layer = plate.add<TextLayer>();
  layer.text = "SILLON";
  layer.font = "Bebas Neue";
  layer.textSize = 12;
  layer.fill = LayerFill::Angle;
  layer.angle = 50;
  const Shape letters = textShape({"SILLON", "Bebas Neue", 12}, plate.reader()).value();
  const double area = resolveOutline(letters).value().area;
  CHECK(areaWhere(plate.composed(), near(50)) == doctest::Approx(area).epsilon(0.01));
  CHECK(plate.stack().placed[1].size == letters.page);

  plate.top<LayerGround>().ground = 110;
  const PlateInput input = plate.composed();
  CHECK(areaWhere(input, near(50)) == doctest::Approx(area).epsilon(0.01));
  CHECK(areaWhere(input, near(110)) == doctest::Approx(letters.page.x * letters.page.y - area).epsilon(0.02));

  // A width makes the letters as wide; what is too small for two beads is told.
  plate.top().size = {20, 0};
  CHECK(plate.stack().placed[1].size.x == doctest::Approx(20));
  CHECK(plate.stack().placed[1].size.y == doctest::Approx(20 * letters.page.y / letters.page.x));
  plate.top().size = {};
  CHECK(plate.stack().placed[1].thin < 0.05);
  plate.top<LayerLetters>().textSize = 2;
  CHECK(plate.stack().placed[1].thin > 0.5);
}

TEST_CASE("what lies across turns whatever is below by a right angle") {
  Plate plate;
  TextLayer& layer = plate.add<TextLayer>();
  layer.text = "I";
  layer.textSize = 20;
  layer.fill = LayerFill::Across;
  CHECK(apart(at(plate.composed(), {30, 20}).angle, 90) < 0.01);
  *plate.project.layers[0].as<LayerAngle>() = {35};
  const PlateInput input = plate.composed();
  CHECK(apart(at(input, {30, 20}).angle, 125) < 0.01);
  CHECK(apart(at(input, {5, 20}).angle, 35) < 0.01);
}

TEST_CASE("patterns have their closed forms") {
  Plate plate;
  plate.add<PatternLayer>().angle = 30;
  plate.top().at = Vec2{22, 13};
  PlateInput input = plate.composed();
  for (const Vec2 place : {Vec2{40, 13}, Vec2{22, 30}, Vec2{5, 2}, Vec2{50, 35}}) {
    CHECK(apart(at(input, place).angle, std::atan2(place.y - 13, place.x - 22) / kDegree + 30) < 1.5);
  }
  PatternLayer& waves = plate.top<PatternLayer>();
  waves.pattern = LayerPattern::Waves;
  waves.waveLength = 16;
  waves.amplitude = 25;
  input = plate.composed();
  for (const Vec2 place : {Vec2{40, 13}, Vec2{22, 30}, Vec2{5, 2}}) {
    const double along = (place.x - 22) * std::cos(30 * kDegree) + (place.y - 13) * std::sin(30 * kDegree);
    CHECK(apart(at(input, place).angle, 30 + 25 * std::sin(2 * std::numbers::pi * along / 16)) < 1.5);
  }
}

TEST_CASE("an echo runs along a drawing, over the whole plate") {
  Plate plate;
  plate.files["disc.svg"] = std::string(
      "<svg xmlns='http://www.w3.org/2000/svg' width='10mm' height='10mm' viewBox='0 0 2 2'><circle cx='1' cy='1' "
      "r='1'/></svg>");
  plate.add<PatternLayer>().pattern = LayerPattern::Echo;
  plate.top<LayerFile>().file = "disc.svg";
  plate.top().at = Vec2{30, 20};
  const PlateInput input = plate.composed();
  for (const Vec2 place : {Vec2{33, 21}, Vec2{55, 35}, Vec2{10, 20}, Vec2{30, 3}}) {
    CHECK(apart(at(input, place).angle, std::atan2(place.y - 20, place.x - 30) / kDegree + 90) < 2);
  }
}

TEST_CASE("an echo without a drawing follows letters") {
  Plate plate;
  plate.add<PatternLayer>().pattern = LayerPattern::Echo;
  CHECK(invalidSettings(plate.project)->message.find("layers[1].file is empty; an echo") == 0);
  plate.top<LayerWords>().text = "I";
  plate.top<LayerLetters>().textSize = 30;
  CHECK(apart(at(plate.composed(), {8, 20}).angle, 90) < 3);   // beside the stroke
  CHECK(apart(at(plate.composed(), {30, 38}).angle, 0) < 10);  // above it
}

TEST_CASE("a border is a band within the plate") {
  Plate plate;
  plate.shape = makeDisc(40).value();
  plate.shape.page = {40, 40};
  BorderLayer& border = plate.add<BorderLayer>();
  border.width = 4;
  border.fill = LayerFill::Angle;
  border.angle = 33;
  const PlateInput input = plate.composed();
  const double share = areaWhere(input, near(33)) / (kPage.x * kPage.y);
  CHECK(share * 1600 == doctest::Approx(std::numbers::pi * (20 * 20 - 16 * 16)).epsilon(0.03));
  CHECK(apart(at(input, {20, 2}).angle, 33) < 0.01);
  CHECK(apart(at(input, {20, 6}).angle, 0) < 0.01);
  plate.top<LayerFilled>().fill = LayerFill::Along;
  CHECK(apart(at(plate.composed(), {20 + 18 * std::cos(0.7), 20 + 18 * std::sin(0.7)}).angle, 0.7 / kDegree + 90) < 2);
}

TEST_CASE("masks show a layer inside or outside of a drawing") {
  Plate plate;
  plate.files["square.svg"] = square(10);
  plate.add<DirectionLayer>().angle = 45;
  Layer& layer = plate.top();
  layer.maskFile = "square.svg";
  layer.size = {20, 12};
  layer.mask = LayerMask::Inside;
  CHECK(areaWhere(plate.composed(), near(45)) == doctest::Approx(240).epsilon(0.02));
  plate.top().mask = LayerMask::Disc;
  CHECK(areaWhere(plate.composed(), near(45)) == doctest::Approx(std::numbers::pi * 10 * 6).epsilon(0.02));
  plate.top().mask = LayerMask::Outside;
  CHECK(areaWhere(plate.composed(), near(45)) == doctest::Approx(60 * 40 - 240).epsilon(0.005));
}

TEST_CASE("maps are cropped, placed, mirrored and turned") {
  // Four texels: -60, 20 above 40, 80 degrees.
  Plate plate;
  Image image{2, 2, 1, {}};
  for (const double angle : {-60.0, 20.0, 40.0, 80.0})
    image.samples.push_back(static_cast<std::uint16_t>(std::lround((angle / 180 + 0.5) * 65535)));
  plate.files["map.png"] = image;
  plate.add<MapLayer>().file = "map.png";
  Layer& layer = plate.top();
  layer.at = Vec2{30, 20};
  layer.size = {20, 0};
  const Vec2 middle{30, 20};
  const auto angleAt = [&](Vec2 from) { return at(plate.composed(), middle + from).angle; };
  CHECK(plate.stack().placed[1].size == Vec2{20, 20});
  CHECK(apart(angleAt({-5, 5}), -60) < 0.01);
  CHECK(apart(angleAt({5, -5}), 80) < 0.01);
  plate.top().rotation = 90;  // what was upper left is lower left
  CHECK(apart(angleAt({-5, -5}), -60 + 90) < 0.01);
  plate.top().rotation = 0;
  plate.top().mirror = true;
  CHECK(apart(angleAt({5, 5}), 60) < 0.01);
  plate.top().mirror = false;
  plate.top<LayerCrop>().cropMin = {0.5, 0};
  CHECK(plate.stack().placed[1].size == Vec2{20, 40});
  CHECK(apart(angleAt({-5, 10}), 20) < 0.01);
  CHECK(apart(angleAt({5, -10}), 80) < 0.01);
}

TEST_CASE("a lowest map is stretched over the page, and one above keeps its proportions") {
  // Grey from left to right: -90, 0 and nearly 90 degrees, in a picture that is three times as wide as high.
  Plate plate;
  plate.files["map.png"] = Image{3, 1, 1, {0, 32768, 65535}};
  plate.project.layers.clear();
  plate.add<MapLayer>().file = "map.png";
  PlateInput input = plate.composed();
  CHECK(input.directions == DirectionMap{3, 1, {0, 32768, 65535}});
  CHECK(plate.stack().width == 0);
  // The page is 60 x 40 mm: the picture is 20 mm high in its middle.
  plate.project.layers.insert(plate.project.layers.begin(), Layer());
  plate.project.layers[0].as<LayerAngle>()->angle = 30;
  CHECK(plate.stack().placed[1].size == Vec2{60, 20});
  input = plate.composed();
  for (const double y : {11.0, 29.0}) {
    CHECK(apart(at(input, {10, y}).angle, 90) < 0.01);
    CHECK(apart(at(input, {30, y}).angle, 0) < 0.01);
    CHECK(apart(at(input, {50, y}).angle, 90) < 0.01);
  }
  for (const double y : {9.0, 31.0}) CHECK(apart(at(input, {30, y}).angle, 30) < 0.01);
  // A soft edge, which one that fills the page has not, leaves it at the bottom and stretched.
  plate.project.layers.erase(plate.project.layers.begin());
  plate.top().soft = 4;
  CHECK(plate.stack().placed[0].size == kPage);
}

TEST_CASE("a QR code lies across its own ground, with a quiet zone") {
  Plate plate;
  CodeLayer& code = plate.add<CodeLayer>();
  code.text = "SILLON";
  code.correction = QrCorrection::Low;
  code.angle = 25;
  plate.top().size = {29, 29};  // 21 modules and twice 4 around them
  const PlateInput input = plate.composed();
  CHECK(apart(at(input, {30 - 10, 20 + 10}).angle, 25) < 0.01);   // a finder's corner
  CHECK(apart(at(input, {30 - 12, 20 + 12}).angle, 115) < 0.01);  // the quiet zone
  CHECK(apart(at(input, {5, 20}).angle, 0) < 0.01);
}

TEST_CASE("a layer with a letter that no font has is left out alone, and named") {
  Plate plate;
  plate.add<DirectionLayer>().angle = 30;
  const PlateInput without = plate.composed();
  TextLayer& letters = plate.add<TextLayer>();
  letters.text = "A\u5b57";
  letters.angle = 80;
  CHECK(plate.composed().directions == without.directions);
  const auto told = [&] {
    std::vector<std::string> messages;
    for (const Warning& warning : plate.letterWarnings()) messages.push_back(warning.message);
    return messages;
  };
  using Messages = std::vector<std::string>;
  CHECK(told() == Messages{"layer 3 is left out: no font has a letter for \"\u5b57\" (U+5B57)"});
  CHECK(plate.stack().placed[2].problem->message.find("layers[2]: no font has a letter") == 0);

  plate.top<LayerWords>().text = "A\u05d0";
  CHECK(plate.composed().directions != without.directions);
  CHECK(told() == Messages{"the letters \"\u05d0\" (U+05D0) of layer 3 come from Fredoka: its own font lacks them"});

  // A drawing is drawn without the letter.
  plate.top().contents = DrawingLayer();
  plate.top<LayerFile>().file = "text.svg";
  plate.top<LayerAngle>().angle = 80;
  const std::string begin = "<svg xmlns='http://www.w3.org/2000/svg' width='40mm' height='20mm'><text y='15'>";
  plate.files["text.svg"] = begin + "A\u5b57</text></svg>";
  CHECK(plate.composed().directions != without.directions);
  CHECK(told() == Messages{"the letters \"\u5b57\" (U+5B57) of layer 3 are left out: no font has them"});
  plate.files["text.svg"] = begin + "\u5b57</text></svg>";
  CHECK(told() == Messages{"layer 3 is left out: no font has a letter for \"\u5b57\" (U+5B57)"});
}

TEST_CASE("a hidden layer is not read, so that nothing is wrong with it") {
  Plate plate;
  plate.project.layers.clear();
  plate.add<DrawingLayer>().file = "none.svg";
  plate.add<PictureLayer>();
  plate.add<TextLayer>().text = "\u5b57";
  plate.add<TextLayer>();
  plate.add<TextLayer>();
  plate.top().mask = LayerMask::Inside;
  for (Layer& layer : plate.project.layers) layer.visible = false;
  CHECK(plate.stack().width == 0);
  CHECK(plate.stack().placed.size() == 5);
  CHECK(plate.letterWarnings().empty());
  CHECK(placeLayers(plate.project, plate.shape, plate.reader())[0].problem.has_value());
}

TEST_CASE("errors tell the layer") {
  Plate plate;
  plate.add<DrawingLayer>().file = "none.svg";
  const auto made = plate.tried();
  REQUIRE(!made.ok());
  CHECK(made.error().message.find("layers[1]: ") == 0);
  plate.top<LayerFile>().file = "";
  CHECK(invalidSettings(plate.project)->message == "layers[1].file is empty; it must name a file");
  plate.project.layers[1] = {};
  plate.project.layers[1].rotation = 400;
  CHECK(invalidSettings(plate.project)->message == "layers[1].rotation is 400 degrees; it must be -360 to 360");
  plate.project.layers.resize(33);
  CHECK(invalidSettings(plate.project).has_value());
}
