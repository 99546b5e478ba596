// Layers in closed forms: where they lie, what they cover, and which directions they ask for.
#include "sillon/compose/compose.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "input/stored_angle.hpp"
#include "sillon/geometry/outline.hpp"
#include "sillon/settings/table.hpp"
#include "sillon/text/text.hpp"

using namespace sillon;

namespace {

constexpr double kDegree = std::numbers::pi / 180;
const Vec2 kPage{60, 40};

/// A plate with layers over beads at 0 degrees.
struct Plate {
  Project project;
  Shape shape = makeRectangle(kPage).value();
  std::map<std::string, InputFile> files;

  Layer& add(LayerKind kind) {
    project.layers.emplace_back().kind = kind;
    return project.layers.back();
  }
  [[nodiscard]] ReadInput reader() const {
    return [this](const std::string& name, const std::string&) -> Result<InputFile> {
      const auto found = files.find(name);
      if (found == files.end()) return Error{ErrorCode::InvalidFile, "no " + name};
      return found->second;
    };
  }
  [[nodiscard]] LayerStack stack() const {
    const auto wrong = invalidSettings(project);
    CHECK_MESSAGE(!wrong, (wrong ? wrong->message : ""));
    auto made = makeLayers(project, shape, reader(), RunContext());
    REQUIRE_MESSAGE(made.ok(), (made.ok() ? "" : made.error().message));
    return std::move(made).value();
  }
  [[nodiscard]] PlateInput composed() const {
    PlateInput input{shape, uniformDirection(0).value(), uniformMode(DirectionMode::Smoothest)};
    layOver(stack(), input);
    return input;
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

TEST_CASE("without layers nothing changes") {
  Plate plate;
  PlateInput input{plate.shape, uniformDirection(30).value(), uniformMode(DirectionMode::Parallel)};
  layOver(plate.stack(), input);
  CHECK(input.directions == uniformDirection(30).value());
  plate.add(LayerKind::Direction).visible = false;
  layOver(plate.stack(), input);
  CHECK(input.directions == uniformDirection(30).value());
  CHECK(plate.stack().placed.size() == 1);
}

TEST_CASE("a direction fills its box, which lies and turns as told") {
  Plate plate;
  Layer& layer = plate.add(LayerKind::Direction);
  layer.angle = 40;
  layer.at = Vec2{20, 25};
  layer.size = {16, 10};
  for (const double rotation : {0.0, 30.0, -75.0}) {
    plate.project.layers[0].rotation = rotation;
    const PlateInput input = plate.composed();
    CHECK(areaWhere(input, near(40)) == doctest::Approx(160).epsilon(0.01));
    const Vec2 corner{std::cos(rotation * kDegree) * 7.5 - std::sin(rotation * kDegree) * 4.5,
                      std::sin(rotation * kDegree) * 7.5 + std::cos(rotation * kDegree) * 4.5};
    CHECK(apart(at(input, Vec2{20, 25} + corner).angle, 40) < 0.01);
    CHECK(at(input, Vec2{20, 25} + corner).mode == DirectionMode::Constrained);
    CHECK(apart(at(input, {50, 8}).angle, 0) < 0.01);
    CHECK(at(input, {50, 8}).mode == DirectionMode::Smoothest);
  }
  const PlacedLayer placed = plate.stack().placed.at(0);
  CHECK(placed.at == Vec2{20, 25});
  CHECK(placed.size == Vec2{16, 10});
}

TEST_CASE("the topmost layer wins") {
  Plate plate;
  plate.add(LayerKind::Direction).angle = 20;
  Layer& top = plate.add(LayerKind::Direction);
  top.angle = 70;
  top.size = {10, 10};
  PlateInput input = plate.composed();
  CHECK(areaWhere(input, near(70)) == doctest::Approx(100).epsilon(0.02));
  CHECK(areaWhere(input, near(20)) == doctest::Approx(60 * 40 - 100).epsilon(0.002));
  std::swap(plate.project.layers[0], plate.project.layers[1]);
  input = plate.composed();
  CHECK(areaWhere(input, near(20)) == doctest::Approx(60 * 40));
}

TEST_CASE("a soft edge turns from one direction into the other about the edge") {
  Plate plate;
  Layer& layer = plate.add(LayerKind::Direction);
  layer.angle = 60;
  layer.at = Vec2{15, 20};
  layer.size = {30, 80};
  layer.soft = 8;
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
  Layer& layer = plate.add(LayerKind::Text);
  layer.text = "SILLON";
  layer.font = "Bebas Neue";
  layer.textSize = 12;
  layer.fill = LayerFill::Angle;
  layer.angle = 50;
  const Shape letters = textShape({"SILLON", "Bebas Neue", 12}, plate.reader()).value();
  const double area = resolveOutline(letters).value().area;
  CHECK(areaWhere(plate.composed(), near(50)) == doctest::Approx(area).epsilon(0.01));
  CHECK(plate.stack().placed[0].size == letters.page);

  plate.project.layers[0].ground = 110;
  const PlateInput input = plate.composed();
  CHECK(areaWhere(input, near(50)) == doctest::Approx(area).epsilon(0.01));
  CHECK(areaWhere(input, near(110)) == doctest::Approx(letters.page.x * letters.page.y - area).epsilon(0.02));

  // A width makes the letters as wide; what is too small for two beads is told.
  plate.project.layers[0].size = {20, 0};
  CHECK(plate.stack().placed[0].size.x == doctest::Approx(20));
  CHECK(plate.stack().placed[0].size.y == doctest::Approx(20 * letters.page.y / letters.page.x));
  plate.project.layers[0].size = {};
  CHECK(plate.stack().placed[0].thin < 0.05);
  plate.project.layers[0].textSize = 2;
  CHECK(plate.stack().placed[0].thin > 0.5);
}

TEST_CASE("what lies across turns whatever is below by a right angle") {
  Plate plate;
  Layer& layer = plate.add(LayerKind::Text);
  layer.text = "I";
  layer.textSize = 20;
  layer.fill = LayerFill::Across;
  CHECK(apart(at(plate.composed(), {30, 20}).angle, 90) < 0.01);
  Layer below;
  below.angle = 35;
  plate.project.layers.insert(plate.project.layers.begin(), below);
  const PlateInput input = plate.composed();
  CHECK(apart(at(input, {30, 20}).angle, 125) < 0.01);
  CHECK(apart(at(input, {5, 20}).angle, 35) < 0.01);
}

TEST_CASE("patterns have their closed forms") {
  Plate plate;
  Layer& radial = plate.add(LayerKind::Pattern);
  radial.at = Vec2{22, 13};
  radial.angle = 30;
  PlateInput input = plate.composed();
  for (const Vec2 place : {Vec2{40, 13}, Vec2{22, 30}, Vec2{5, 2}, Vec2{50, 35}}) {
    CHECK(apart(at(input, place).angle, std::atan2(place.y - 13, place.x - 22) / kDegree + 30) < 1.5);
  }
  Layer& waves = plate.project.layers[0];
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
  Layer& echo = plate.add(LayerKind::Pattern);
  echo.pattern = LayerPattern::Echo;
  echo.file = "disc.svg";
  echo.at = Vec2{30, 20};
  const PlateInput input = plate.composed();
  for (const Vec2 place : {Vec2{33, 21}, Vec2{55, 35}, Vec2{10, 20}, Vec2{30, 3}}) {
    CHECK(apart(at(input, place).angle, std::atan2(place.y - 20, place.x - 30) / kDegree + 90) < 2);
  }
}

TEST_CASE("an echo without a drawing follows letters") {
  Plate plate;
  Layer& echo = plate.add(LayerKind::Pattern);
  echo.pattern = LayerPattern::Echo;
  CHECK(invalidSettings(plate.project)->message.find("layers[0].file is empty; an echo") == 0);
  plate.project.layers[0].text = "I";
  plate.project.layers[0].textSize = 30;
  CHECK(apart(at(plate.composed(), {8, 20}).angle, 90) < 3);   // beside the stroke
  CHECK(apart(at(plate.composed(), {30, 38}).angle, 0) < 10);  // above it
}

TEST_CASE("a border is a band within the plate") {
  Plate plate;
  plate.shape = makeDisc(40).value();
  plate.shape.page = {40, 40};
  Layer& border = plate.add(LayerKind::Border);
  border.width = 4;
  border.fill = LayerFill::Angle;
  border.angle = 33;
  const PlateInput input = plate.composed();
  const double share = areaWhere(input, near(33)) / (kPage.x * kPage.y);
  CHECK(share * 1600 == doctest::Approx(std::numbers::pi * (20 * 20 - 16 * 16)).epsilon(0.03));
  CHECK(apart(at(input, {20, 2}).angle, 33) < 0.01);
  CHECK(apart(at(input, {20, 6}).angle, 0) < 0.01);
  plate.project.layers[0].fill = LayerFill::Along;
  CHECK(apart(at(plate.composed(), {20 + 18 * std::cos(0.7), 20 + 18 * std::sin(0.7)}).angle, 0.7 / kDegree + 90) < 2);
}

TEST_CASE("masks show a layer inside or outside of a drawing") {
  Plate plate;
  plate.files["square.svg"] = square(10);
  Layer& layer = plate.add(LayerKind::Direction);
  layer.angle = 45;
  layer.maskFile = "square.svg";
  layer.size = {20, 12};
  layer.mask = LayerMask::Inside;
  CHECK(areaWhere(plate.composed(), near(45)) == doctest::Approx(240).epsilon(0.02));
  plate.project.layers[0].mask = LayerMask::Disc;
  CHECK(areaWhere(plate.composed(), near(45)) == doctest::Approx(std::numbers::pi * 10 * 6).epsilon(0.02));
  plate.project.layers[0].mask = LayerMask::Outside;
  CHECK(areaWhere(plate.composed(), near(45)) == doctest::Approx(60 * 40 - 240).epsilon(0.005));
}

TEST_CASE("maps are cropped, placed, mirrored and turned") {
  // Four texels: -60, 20 above 40, 80 degrees.
  Plate plate;
  Image image{2, 2, 1, {}};
  for (const double angle : {-60.0, 20.0, 40.0, 80.0})
    image.samples.push_back(static_cast<std::uint16_t>(std::lround((angle / 180 + 0.5) * 65535)));
  plate.files["map.png"] = image;
  Layer& layer = plate.add(LayerKind::Map);
  layer.file = "map.png";
  layer.at = Vec2{30, 20};
  layer.size = {20, 0};
  const Vec2 middle{30, 20};
  const auto angleAt = [&](Vec2 from) { return at(plate.composed(), middle + from).angle; };
  CHECK(plate.stack().placed[0].size == Vec2{20, 20});
  CHECK(apart(angleAt({-5, 5}), -60) < 0.01);
  CHECK(apart(angleAt({5, -5}), 80) < 0.01);
  plate.project.layers[0].rotation = 90;  // what was upper left is lower left
  CHECK(apart(angleAt({-5, -5}), -60 + 90) < 0.01);
  plate.project.layers[0].rotation = 0;
  plate.project.layers[0].mirror = true;
  CHECK(apart(angleAt({5, 5}), 60) < 0.01);
  plate.project.layers[0].mirror = false;
  plate.project.layers[0].cropMin = {0.5, 0};
  CHECK(plate.stack().placed[0].size == Vec2{20, 40});
  CHECK(apart(angleAt({-5, 10}), 20) < 0.01);
  CHECK(apart(angleAt({5, -10}), 80) < 0.01);
}

TEST_CASE("a QR code lies across its own ground, with a quiet zone") {
  Plate plate;
  Layer& code = plate.add(LayerKind::Qr);
  code.text = "SILLON";
  code.correction = QrCorrection::Low;
  code.angle = 25;
  code.size = {29, 29};  // 21 modules and twice 4 around them
  const PlateInput input = plate.composed();
  CHECK(apart(at(input, {30 - 10, 20 + 10}).angle, 25) < 0.01);   // a finder's corner
  CHECK(apart(at(input, {30 - 12, 20 + 12}).angle, 115) < 0.01);  // the quiet zone
  CHECK(apart(at(input, {5, 20}).angle, 0) < 0.01);
}

TEST_CASE("a layer with a letter that no font has is left out alone, and named") {
  Plate plate;
  plate.add(LayerKind::Direction).angle = 30;
  const PlateInput without = plate.composed();
  Layer& letters = plate.add(LayerKind::Text);
  letters.text = "A\u5b57";
  letters.angle = 80;
  CHECK(plate.composed().directions == without.directions);
  const auto told = [&] {
    std::vector<std::string> messages;
    for (const Warning& warning : letterWarnings(plate.stack().placed)) messages.push_back(warning.message);
    return messages;
  };
  using Messages = std::vector<std::string>;
  CHECK(told() == Messages{"layer 2 is left out: no font has a letter for \"\u5b57\" (U+5B57)"});
  CHECK(plate.stack().placed[1].problem->message.find("layers[1]: no font has a letter") == 0);

  plate.project.layers[1].text = "A\u05d0";
  CHECK(plate.composed().directions != without.directions);
  CHECK(told() == Messages{"the letters \"\u05d0\" (U+05D0) of layer 2 come from Fredoka: its own font lacks them"});

  // A drawing is drawn without the letter.
  plate.project.layers[1] = {};
  plate.project.layers[1].kind = LayerKind::Drawing;
  plate.project.layers[1].file = "text.svg";
  plate.project.layers[1].angle = 80;
  const std::string begin = "<svg xmlns='http://www.w3.org/2000/svg' width='40mm' height='20mm'><text y='15'>";
  plate.files["text.svg"] = begin + "A\u5b57</text></svg>";
  CHECK(plate.composed().directions != without.directions);
  CHECK(told() == Messages{"the letters \"\u5b57\" (U+5B57) of layer 2 are left out: no font has them"});
  plate.files["text.svg"] = begin + "\u5b57</text></svg>";
  CHECK(told() == Messages{"layer 2 is left out: no font has a letter for \"\u5b57\" (U+5B57)"});
}

TEST_CASE("a hidden layer is not read, so that nothing is wrong with it") {
  Plate plate;
  plate.add(LayerKind::Drawing).file = "none.svg";
  plate.add(LayerKind::Picture);
  plate.add(LayerKind::Text).text = "\u5b57";
  plate.add(LayerKind::Text);
  plate.add(LayerKind::Text).mask = LayerMask::Inside;
  for (Layer& layer : plate.project.layers) layer.visible = false;
  CHECK(plate.stack().width == 0);
  CHECK(plate.stack().placed.size() == 5);
  CHECK(letterWarnings(plate.stack().placed).empty());
  CHECK(placeLayers(plate.project, plate.shape, plate.reader())[0].problem.has_value());
}

TEST_CASE("errors tell the layer") {
  Plate plate;
  plate.add(LayerKind::Direction);
  plate.add(LayerKind::Drawing).file = "none.svg";
  const auto made = makeLayers(plate.project, plate.shape, plate.reader(), RunContext());
  REQUIRE(!made.ok());
  CHECK(made.error().message.find("layers[1]: ") == 0);
  plate.project.layers[1].file = "";
  CHECK(invalidSettings(plate.project)->message == "layers[1].file is empty; it must name a picture or a drawing");
  plate.project.layers[1] = {};
  plate.project.layers[1].rotation = 400;
  CHECK(invalidSettings(plate.project)->message == "layers[1].rotation is 400 degrees; it must be -360 to 360");
  plate.project.layers.resize(33);
  CHECK(invalidSettings(plate.project).has_value());
}
