// Layers of tones and strokes within a project: from its files to the directions and modes of beads.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "input/stored_angle.hpp"
#include "sillon/compose/compose.hpp"

using namespace sillon;

namespace {

/// Page of 60 x 40 mm over beads at 0 degrees.
struct Plate {
  Project project;
  Shape shape = makeRectangle({60, 40}).value();
  std::map<std::string, InputFile> files;

  template <class Contents>
  Contents& add() {
    return project.layers.emplace_back().contents.emplace<Contents>();
  }
  [[nodiscard]] ReadInput reader() const {
    return [this](const std::string& name, const std::string&) -> Result<InputFile> {
      const auto found = files.find(name);
      if (found == files.end()) return Error{ErrorCode::InvalidFile, "no " + name};
      return found->second;
    };
  }
  [[nodiscard]] PlateInput laid() const {
    const ReadInput read = reader();
    PlateInput ground{shape, uniformDirection(0).value(), uniformMode(DirectionMode::Constrained)};
    Result<Composition> made = compose(project, std::move(ground), {read}, RunContext());
    REQUIRE_MESSAGE(made.ok(), (made.ok() ? "" : made.error().message));
    return made.value().laid();
  }
};

struct At {
  double angle;  ///< [degrees]
  DirectionMode mode;
};

At at(const PlateInput& input, Vec2 place) {
  const auto texel = [&](int width, int height) {
    const auto x = static_cast<std::size_t>(place.x / 60 * width);
    const auto y = static_cast<std::size_t>((1 - place.y / 40) * height);
    return y * static_cast<std::size_t>(width) + x;
  };
  return {angleOf(input.directions.angle[texel(input.directions.width, input.directions.height)]) * 180 / 3.14159265,
          input.modes.mode[texel(input.modes.width, input.modes.height)]};
}

bool lies(double angle, double along) { return std::abs(std::remainder(angle - along, 180)) < 0.02; }

const std::string kDrawing =
    "<svg width='40mm' height='40mm' viewBox='0 0 40 40'><rect width='40' height='40' fill='gold'/>"
    "<circle cx='20' cy='10' r='8' fill='teal'/><image width='9' height='9'/></svg>";

}  // namespace

TEST_CASE("each colour of a drawing lies in its direction, and brushes turn some of it") {
  Plate plate;
  plate.files["sign.svg"] = kDrawing;
  TonesLayer& tones = plate.add<TonesLayer>();
  tones.by = TonesBy::Colours;
  tones.file = "sign.svg";
  tones.colours = {{"#ffd700", 30}, {"#008080", 120}};
  plate.project.layers[0].size = {40, 40};
  const PlateInput signs = plate.laid();
  CHECK(lies(at(signs, {30, 30}).angle, 120));
  CHECK(lies(at(signs, {30, 21}).angle, 30));
  CHECK(lies(at(signs, {12, 2}).angle, 30));
  CHECK(lies(at(signs, {5, 20}).angle, 0));

  StrokesLayer& strokes = plate.add<StrokesLayer>();
  Stroke comb;
  comb.radius = 3;
  comb.soft = 0;
  comb.points = {{30, 30}, {30, 5}};
  Stroke mode = comb;
  mode.tool = StrokeTool::Mode;
  mode.mode = DirectionMode::Parallel;
  mode.points = {{5, 20}};
  strokes.strokes = {comb, mode};
  const PlateInput painted = plate.laid();
  CHECK(lies(at(painted, {30, 30}).angle, 90));
  CHECK(lies(at(painted, {32.5, 10}).angle, 90));
  CHECK(lies(at(painted, {34, 10}).angle, 30));
  CHECK(at(painted, {5, 20}).mode == DirectionMode::Parallel);
  CHECK(at(painted, {5, 24}).mode == DirectionMode::Constrained);
}

TEST_CASE("parts of a painted drawing that are not seen are told, and its colours are") {
  Plate plate;
  plate.files["sign.svg"] = kDrawing;
  plate.add<TonesLayer>().file = "sign.svg";
  const std::vector<PlacedLayer> placed = placeLayers(plate.project, plate.shape, plate.reader());
  REQUIRE(placed.size() == 1);
  REQUIRE(placed[0].drawings.size() == 1);
  CHECK(placed[0].drawings[0].images == 1);
  CHECK_FALSE(placed[0].drawings[0].severalColours);
}

TEST_CASE("where a picture of tones is clear, what lies below shows, but for a lowest one that fills the page") {
  Plate plate;
  plate.files["ring.svg"] = std::string(
      "<svg width='40mm' height='40mm' viewBox='0 0 40 40'><circle cx='20' cy='20' r='10' fill='teal'/></svg>");
  plate.project.layers.emplace_back().contents = DirectionLayer{{70}};
  TonesLayer& tones = plate.add<TonesLayer>();
  tones.by = TonesBy::Colours;
  tones.file = "ring.svg";
  tones.colours = {{"#008080", 120}};
  plate.project.layers[1].size = {40, 40};
  plate.project.layers[0].size = {60, 40};
  const PlateInput over = plate.laid();
  CHECK(lies(at(over, {30, 20}).angle, 120));
  CHECK(lies(at(over, {30, 37}).angle, 70));
  CHECK(lies(at(over, {14, 20}).angle, 70));

  plate.project.layers.erase(plate.project.layers.begin());
  plate.project.layers[0].size = {};
  CHECK(lies(at(plate.laid(), {3, 3}).angle, 120));
}
