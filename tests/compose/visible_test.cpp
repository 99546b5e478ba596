// Visibility of layers in closed forms: shares of their ink that are hidden, that do not stand out, and codes that
// read.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "compose/visible.hpp"
#include "report/told.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/project/project.hpp"
#include "sillon/report/warning.hpp"
#include "text/qr_code.hpp"

using namespace sillon;

namespace {

const Vec2 kPage{60, 40};

/// A plate with layers over beads at 0 degrees.
struct Plate {
  Project project;
  Shape shape = makeRectangle(kPage).value();

  /// Puts a layer on top. \return its contents
  template <class Contents>
  Contents& add(Vec2 at, Vec2 size) {
    Layer& layer = project.layers.emplace_back();
    layer.contents = Contents();
    layer.at = at;
    layer.size = size;
    return *layer.as<Contents>();
  }
  /// A drawing that is a filled box.
  DrawingLayer& box(Vec2 at, Vec2 size) {
    DrawingLayer& drawing = add<DrawingLayer>(at, size);
    drawing.file = "box.svg";
    return drawing;
  }
  template <class Part>
  [[nodiscard]] Part& of(std::size_t layer) {
    return *project.layers[layer].as<Part>();
  }
  [[nodiscard]] std::vector<SeenLayer> seen() const {
    const ReadInput read = [](const std::string& name, const std::string&) -> Result<InputFile> {
      if (name != "box.svg") return Error{ErrorCode::InvalidFile, "no " + name};
      return InputFile{std::string(
          "<svg xmlns='http://www.w3.org/2000/svg' width='9mm' height='9mm' viewBox='0 0 1 1'><path d='M0 0h1v1h-1z'/>"
          "</svg>")};
    };
    auto ground = readPlateInput(project, shape, read);
    REQUIRE(ground.ok());
    const auto made = compose(project, std::move(ground).value(), {read}, RunContext());
    REQUIRE_MESSAGE(made.ok(), (made.ok() ? "" : made.error().message));
    return seeLayers(project, made.value().layers.placed, made.value());
  }
  [[nodiscard]] std::vector<Warning> warnings() const {
    return layerWarnings(seen(), shape.page, project.toolpath.spacing);
  }
  /// The warning of a code about a layer; null if there is none.
  [[nodiscard]] static const Warning* find(const std::vector<Warning>& all, WarningCode code, double layer) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Warning& one) {
      return one.code == code && one.value("layer") != nullptr && one.value("layer")->number == layer;
    });
    return found == all.end() ? nullptr : &*found;
  }
};

double percentOf(const Warning* warning) {
  REQUIRE(warning != nullptr);
  return warning->value("percent")->number;
}

Ring ring(Vec2 from, Vec2 to) { return {from, {to.x, from.y}, to, {from.x, to.y}}; }

}  // namespace

TEST_CASE("what lies beside the plate is told to the percent, also beyond the page") {
  Plate plate;
  plate.box({0, 20}, {20, 10});
  CHECK(plate.seen()[0].beside == doctest::Approx(0.5).epsilon(0.001));
  std::vector<Warning> all = plate.warnings();
  REQUIRE(all.size() == 1);
  CHECK(percentOf(Plate::find(all, WarningCode::LayerBeside, 1)) == 50);
  CHECK(all[0].message.find("50 % of layer 1 lie beside the plate") == 0);
  CHECK(all[0].message.find("20 x 10 mm and the page 60 x 40") != std::string::npos);

  // The corner of the page leaves a quarter of a square about it, however that turns.
  plate.project.layers[0].at = Vec2{60, 40};
  plate.project.layers[0].size = {12, 12};
  plate.project.layers[0].rotation = 30;
  CHECK(plate.seen()[0].beside == doctest::Approx(0.75).epsilon(0.005));
  plate.project.layers[0].at = Vec2{-400, 9000};
  CHECK(plate.seen()[0].beside == 1);

  // Larger than any raster: cells of several texels.
  plate.project.layers[0] = {};
  plate.project.layers.clear();
  plate.box({30, 20}, {3000, 2000});
  CHECK(1 - plate.seen()[0].beside == doctest::Approx(2400.0 / 6e6).epsilon(0.05));

  plate.project.layers.clear();
  plate.box({30, 20}, {20, 10});
  CHECK(plate.warnings().empty());
}

TEST_CASE("corners of a square that a round plate cuts off, and what lies in a hole, lie beside the plate") {
  Plate plate;
  plate.shape = makeDisc(40).value();
  plate.box({20, 20}, {40, 40});
  CHECK(plate.seen()[0].beside == doctest::Approx(1 - std::numbers::pi / 4).epsilon(0.005));

  plate.shape = makeRectangle(kPage).value();
  plate.shape.paths = {{{ring({0, 0}, kPage), ring({25, 15}, {35, 25})}, FillRule::EvenOdd}};
  plate.project.layers.clear();
  plate.box({30, 20}, {20, 20});
  CHECK(plate.seen()[0].beside == doctest::Approx(0.25).epsilon(0.005));
}

TEST_CASE("a rim hides what lies under it, on the side that it stands on") {
  Plate plate;
  plate.project.print.rim = 2;
  plate.project.print.rimWidth = 2;
  plate.box({10, 10}, {20, 20});
  CHECK(plate.seen()[0].underRim == doctest::Approx(1 - 18 * 18 / 400.0).epsilon(0.02));
  CHECK(plate.seen()[0].beside == 0);
  CHECK(percentOf(Plate::find(plate.warnings(), WarningCode::LayerUnderRim, 1)) == 19);
  plate.project.print.showSide = ShowSide::Bed;
  CHECK(plate.seen()[0].underRim == 0);
}

TEST_CASE("layers above cover, also where two that lie across make one that does not") {
  Plate plate;
  plate.box({30, 20}, {10, 10});
  plate.box({35, 20}, {10, 10});
  const std::vector<SeenLayer> seen = plate.seen();
  CHECK(seen[0].covered == doctest::Approx(0.5).epsilon(0.001));
  CHECK(seen[1].covered == 0);
  CHECK(percentOf(Plate::find(plate.warnings(), WarningCode::LayerCovered, 1)) == 50);
  CHECK(Plate::find(plate.warnings(), WarningCode::LayerCovered, 2) == nullptr);
  plate.project.layers[1].at = Vec2{30, 20};
  CHECK(plate.seen()[0].covered == 1);
  plate.project.layers[1].visible = false;
  CHECK(plate.seen().size() == 1);
  CHECK(plate.warnings().empty());
  plate.project.layers[0].visible = false;
  CHECK(plate.seen().empty());

  // Others may be covered until nothing of them is left.
  plate.project.layers.clear();
  plate.add<DirectionLayer>({30, 20}, {10, 10}).angle = 45;
  plate.box({30, 20}, {9, 10});
  CHECK(plate.warnings().empty());
  plate.box({30, 20}, {10, 10});
  CHECK(Plate::find(plate.warnings(), WarningCode::LayerCovered, 1) != nullptr);
}

TEST_CASE("letters that lie as what is below them, within 15 degrees, are told") {
  Plate plate;
  plate.box({30, 20}, {20, 10}).fill = LayerFill::Angle;
  for (const double angle : {0.0, 14.0, -14.0, 180.0, 194.0}) {
    plate.of<LayerAngle>(0).angle = angle;
    CHECK(plate.seen()[0].alike == 1);
  }
  CHECK(percentOf(Plate::find(plate.warnings(), WarningCode::LayerAlike, 1)) == 100);
  for (const double angle : {16.0, -16.0, 90.0, 160.0}) {
    plate.of<LayerAngle>(0).angle = angle;
    CHECK(plate.seen()[0].alike == 0);
  }
  plate.of<LayerFilled>(0).fill = LayerFill::Across;
  CHECK(plate.warnings().empty());

  // Over another layer, and half beside it; a layer below everything is what the others stand out from.
  plate.of<LayerFilled>(0).fill = LayerFill::Angle;
  plate.of<LayerAngle>(0).angle = 70;
  Layer below;
  below.as<LayerAngle>()->angle = 75;
  below.at = Vec2{20, 20};
  below.size = {20, 40};
  plate.project.layers.insert(plate.project.layers.begin(), below);
  CHECK(plate.seen()[1].alike == doctest::Approx(0.5).epsilon(0.001));
  CHECK(percentOf(Plate::find(plate.warnings(), WarningCode::LayerAlike, 2)) == 50);

  // Across what another layer laid across the plate.
  plate.project.layers.clear();
  plate.box({30, 20}, {30, 20});
  plate.box({30, 20}, {10, 10}).fill = LayerFill::Angle;
  CHECK(plate.seen()[1].alike == 0);
  plate.of<LayerAngle>(1).angle = 90;
  CHECK(plate.seen()[1].alike == 1);
}

TEST_CASE("a ground is what its letters stand out from") {
  Plate plate;
  TextLayer& text = plate.add<TextLayer>({30, 20}, {});
  text.text = "HH";
  text.fill = LayerFill::Angle;
  text.ground = 90;
  CHECK(plate.warnings().empty());
  plate.of<LayerGround>(0).ground = 10;
  CHECK(plate.seen()[0].alike == 1);
  plate.of<LayerFilled>(0).fill = LayerFill::Across;  // at 90, whatever the angle
  CHECK(plate.seen()[0].alike == 0);
  plate.of<LayerGround>(0).ground = 80;
  CHECK(plate.seen()[0].alike == 1);
}

TEST_CASE("a direction tells that nothing of it is left, unless the plate lies on it") {
  Plate plate;
  plate.add<DirectionLayer>({30, 20}, {10, 10});
  CHECK(Plate::find(plate.warnings(), WarningCode::LayerAlike, 1) != nullptr);
  plate.of<LayerAngle>(0).angle = 30;
  CHECK(plate.warnings().empty());
  plate.project.layers[0].at = Vec2{64, 20};  // a tenth is seen, which may be meant
  CHECK(plate.warnings().empty());
  plate.project.layers[0].at = Vec2{66, 20};
  CHECK(percentOf(Plate::find(plate.warnings(), WarningCode::LayerBeside, 1)) == 100);
  plate.project.layers[0] = {};
  CHECK(plate.warnings().empty());
  plate.project.layers.emplace_back();  // over all of it, too
  CHECK(plate.seen().size() == 1);
  CHECK(plate.warnings().empty());
}

TEST_CASE("a code tells whether it can be read where it lies") {
  Plate plate;
  CodeLayer& code = plate.add<CodeLayer>({30, 20}, {29, 29});  // modules of 1 mm: 21, and twice 4 around them
  code.text = "SILLON";
  code.correction = QrCorrection::Low;
  CHECK(plate.seen()[0].readable == true);
  CHECK(plate.warnings().empty());

  // A part of the quiet zone is told, and does no harm; a finder pattern is needed.
  plate.project.layers[0].at = Vec2{14.5 - 3, 20};
  CHECK(plate.seen()[0].readable == true);
  CHECK(percentOf(Plate::find(plate.warnings(), WarningCode::LayerBeside, 1)) == 10);
  plate.project.layers[0].at = Vec2{14.5 - 6, 20};
  CHECK(plate.seen()[0].readable == false);
  CHECK(Plate::find(plate.warnings(), WarningCode::LayerUnreadable, 1) != nullptr);

  // Mirrored and turned codes are read; two directions that hardly differ are none.
  plate.project.layers[0].at = Vec2{30, 20};
  plate.project.layers[0].mirror = true;
  plate.project.layers[0].rotation = 20;
  CHECK(plate.seen()[0].readable == true);
  plate.of<LayerGround>(0).ground = 25;
  CHECK(plate.seen()[0].readable == false);
  plate.of<LayerGround>(0).ground = 40;
  CHECK(plate.seen()[0].readable == true);
  plate.project.layers[0] = {};

  // A round plate cuts corners off: first those of the patterns, which nobody needs, then their middles.
  Plate round;
  round.shape = makeDisc(40).value();
  CodeLayer& cut = round.add<CodeLayer>({20, 20}, {38, 38});
  cut.text = "https://example.org/ab";
  CHECK(round.seen()[0].readable == true);
  CHECK(Plate::find(round.warnings(), WarningCode::LayerBeside, 1) != nullptr);
  round.project.layers[0].size = {56, 56};
  CHECK(round.seen()[0].readable == false);
}

TEST_CASE("modules narrower than two beads are told, and those narrower than one are not read") {
  Plate plate;
  CodeLayer& code = plate.add<CodeLayer>({30, 20}, {29, 29});
  code.text = "SILLON";
  code.correction = QrCorrection::Low;
  plate.project.toolpath.spacing = 0.6;
  const std::vector<Warning> all = plate.warnings();
  REQUIRE(all.size() == 1);
  REQUIRE(Plate::find(all, WarningCode::ThinModules, 1) != nullptr);
  CHECK(all[0].value("size")->number == 1);
  plate.project.toolpath.spacing = 0.5;
  CHECK(plate.warnings().empty());
  plate.project.toolpath.spacing = 1.1;
  CHECK(Plate::find(plate.warnings(), WarningCode::LayerUnreadable, 1) != nullptr);
  CHECK(Plate::find(plate.warnings(), WarningCode::ThinModules, 1) == nullptr);
}

TEST_CASE("what lies on a code harms it as far as its correction does not reach") {
  for (const auto correction : {QrCorrection::Low, QrCorrection::High}) {
    Plate plate;
    CodeLayer& code = plate.add<CodeLayer>({30, 20}, {29, 29});
    // 21 modules either way. A longer text leaves no room for more correction.
    code.text = correction == QrCorrection::Low ? "SILLONSILLONSILLONSILLON" : "SILLON";
    code.correction = correction;
    plate.box({33, 15}, {1, 5});
    CHECK(plate.seen()[0].readable == true);
    plate.project.layers[1].size = {5, 5};
    CHECK(plate.seen()[0].readable == (correction == QrCorrection::High));
    plate.project.layers[1].size = {14, 14};
    CHECK(plate.seen()[0].readable == false);
  }
}
