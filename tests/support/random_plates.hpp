// Random shapes x fields x parameters: islands, slivers, holes, tiny, huge aspect, self-crossing outlines; and drawings
// of many solids: halftones, tiles that nearly touch, icons.
#pragma once

#include "sillon/geometry/shape.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "support/scenes.hpp"

namespace scenes {

struct RandomPlate {
  std::string name;
  PlateInput input;
  sillon::ToolpathParams params;
};

inline Ring blob(Random& random, Vec2 centre, double radius) {
  const int corners = 3 + random.index(40);
  const double ragged = random.in(0, 0.8);
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double a = 2 * std::numbers::pi * k / corners;
    const double r = radius * (1 - ragged * random.in(0, 1));
    ring.push_back({centre.x + r * std::cos(a), centre.y + r * std::sin(a)});
  }
  return ring;
}

inline Shape randomShape(Random& random, std::string& name) {
  const double size = std::exp(random.in(std::log(2.5), std::log(22.0)));
  const double aspect = random.index(5) == 0 ? std::exp(random.in(-3, 3)) : std::exp(random.in(-0.6, 0.6));
  const Vec2 page{size * std::sqrt(aspect), size / std::sqrt(aspect)};
  const auto point = [&] { return Vec2{random.in(0, page.x), random.in(0, page.y)}; };
  std::vector<Ring> rings;
  switch (random.index(6)) {
    case 0:
      name = "rectangle";
      rings.push_back(rectangle({0, 0}, page));
      break;
    case 1:
      name = "blob with holes";
      rings.push_back(blob(random, page * 0.5, 0.5 * std::min(page.x, page.y)));
      for (int k = random.index(4); k > 0; --k) rings.push_back(blob(random, point(), 0.12 * std::min(page.x, page.y)));
      break;
    case 2:
      name = "islands";
      for (int k = 1 + random.index(6); k > 0; --k) {
        // One number a statement, here and below: compilers call the arguments of a function in any order.
        const double radius = random.in(0.1, 0.4) * std::min(page.x, page.y);
        rings.push_back(blob(random, point(), radius));
      }
      break;
    case 3: {
      name = "random polygon";
      Ring ring;
      for (int k = 3 + random.index(12); k > 0; --k) ring.push_back(point());
      rings.push_back(ring);
      break;
    }
    case 4: {
      name = "comb";
      const int teeth = 2 + random.index(12);
      rings.push_back(rectangle({0, 0}, {page.x, page.y * 0.3}));
      for (int k = 0; k < teeth; ++k) {
        const double x = page.x * (k + random.in(0, 0.3)) / teeth;
        rings.push_back(
            rectangle({x, page.y * 0.2}, {x + page.x * random.in(0.05, 0.7) / teeth, page.y * random.in(0.4, 1)}));
      }
      break;
    }
    default: {
      name = "star";
      const int points = 3 + random.index(12);
      const double inner = random.in(0.05, 0.45) * std::min(page.x, page.y);
      rings.push_back(star(page * 0.5, 0.5 * std::min(page.x, page.y), inner, points));
      break;
    }
  }
  const bool evenOdd = name == "blob with holes" || random.index(2) == 0;
  return shapeOf(std::move(rings), page, evenOdd ? sillon::FillRule::EvenOdd : sillon::FillRule::NonZero);
}

// Dots on a square or hexagonal grid whose sizes follow a picture: some touch, some nearly do, some are too small.
inline std::vector<Ring> halftone(Random& random, double spacing, Vec2& page) {
  const int count = 4 + random.index(9);
  const double pitch = spacing * random.in(2, 6);
  const double smallest = random.in(0.1, 0.4);
  const double largest = random.in(smallest, 0.6);
  const double fx = random.in(-4, 4);
  const double fy = random.in(-4, 4);
  const bool hexagonal = random.index(2) == 0;
  page = {pitch * (count + 1), pitch * (count + 1)};
  std::vector<Ring> rings;
  for (int y = 0; y < count; ++y) {
    for (int x = 0; x < count; ++x) {
      const double tone = 0.5 + 0.5 * std::sin(fx * x / count + fy * y / count);
      const double radius = pitch * (smallest + (largest - smallest) * tone);
      const double shift = hexagonal && y % 2 == 1 ? 0.5 : 0;
      rings.push_back(circle({pitch * (x + 0.75 + shift), pitch * (y + 1)}, radius, 24));
    }
  }
  return rings;
}

// Tiles in rows with gaps about as wide as what bridges them.
inline std::vector<Ring> tiles(Random& random, double spacing, Vec2& page) {
  const int rows = 2 + random.index(6);
  const int columns = 2 + random.index(6);
  const double gap = spacing * random.in(0.02, 2);
  const double side = spacing * random.in(1.2, 9);
  page = {columns * (side + gap), rows * (side + gap)};
  std::vector<Ring> rings;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const Vec2 low{x * (side + gap) + spacing * random.in(0, 0.3), y * (side + gap) + spacing * random.in(0, 0.3)};
      rings.push_back(rectangle(low, low + Vec2{side, side}));
    }
  }
  return rings;
}

// A frame too thin for a bead round bars and discs of which some touch it, as icons have.
inline std::vector<Ring> icon(Random& random, double spacing, Vec2& page) {
  const double side = spacing * random.in(15, 45);
  const double line = spacing * random.in(0.1, 1.6);
  page = {side, side};
  std::vector<Ring> rings;
  rings.push_back(rectangle({0, 0}, {side, line}));
  rings.push_back(rectangle({0, side - line}, {side, side}));
  rings.push_back(rectangle({0, 0}, {line, side}));
  rings.push_back(rectangle({side - line, 0}, {side, side}));
  const int bars = 1 + random.index(5);
  for (int k = 0; k < bars; ++k) {
    const double left = side * (k + random.in(0.15, 0.4)) / bars;
    const double top = random.index(3) == 0 ? side : side * random.in(0.6, 0.97);
    const double bottom = random.index(3) == 0 ? 0 : side * random.in(0.03, 0.4);
    rings.push_back(rectangle({left, bottom}, {left + side * random.in(0.1, 0.55) / bars, top}));
  }
  for (int k = random.index(4); k > 0; --k) {
    const Vec2 centre{random.in(0, side), random.index(2) == 0 ? 0 : side};
    rings.push_back(circle(centre, side * random.in(0.05, 0.2), 48));
  }
  return rings;
}

inline DirectionMap randomMap(Random& random, std::string& name) {
  const double a = random.in(0, std::numbers::pi);
  const double fx = random.in(-12, 12);
  const double fy = random.in(-12, 12);
  const Vec2 centre{random.in(-0.3, 1.3), random.in(-0.3, 1.3)};
  switch (random.index(6)) {
    case 0:
      name += ", uniform";
      return mapOf(1, [=](double, double) { return a; });
    case 1:
      name += ", waves";
      return mapOf(80, [=](double x, double y) { return a + std::sin(fx * x + fy * y); });
    case 2:
      name += ", swirl";
      return mapOf(80, [=](double x, double y) {
        return std::atan2(y - centre.y, x - centre.x) + a + fx * 0.1 * std::hypot(x - centre.x, y - centre.y);
      });
    case 3:
      name += ", noise";
      return noise(random.bits());
    case 4:
      name += ", mosaic";
      return mapOf(60, [=](double x, double y) {
        return a * std::floor(x * std::abs(fx)) + 0.7 * std::floor(y * std::abs(fy));
      });
    default:
      name += ", half-index singularity";
      return mapOf(80, [=](double x, double y) { return 0.5 * std::atan2(y - centre.y, x - centre.x) + a; });
  }
}

// What is drawn on the shape, and how.
inline void randomField(Random& random, RandomPlate& plate) {
  plate.input.directions = randomMap(random, plate.name);
  const DirectionMode modes[] = {DirectionMode::Parallel, DirectionMode::Orthogonal, DirectionMode::Smoothest,
                                 DirectionMode::Constrained};
  if (random.index(3) == 0) {
    const int n = 1 + random.index(6);
    plate.input.modes = {n, n, {}};
    for (int k = 0; k < n * n; ++k) plate.input.modes.mode.push_back(modes[random.index(4)]);
    plate.name += ", modes";
  } else {
    plate.input.modes = sillon::uniformMode(DirectionMode::Constrained);
  }
}

inline void randomParams(Random& random, sillon::ToolpathParams& params) {
  params.spacing = std::exp(random.in(std::log(0.2), std::log(0.8)));
  params.seed = static_cast<std::uint64_t>(random.index(3));
  const int perimeters = random.index(6);
  params.perimeterMode = perimeters == 0   ? sillon::PerimeterMode::None
                         : perimeters <= 2 ? sillon::PerimeterMode::Soft
                                           : sillon::PerimeterMode::Count;
  params.perimeters = perimeters == 5 ? 3 : 1;
  if (random.index(4) == 0) params.bridge = random.in(0, 2);
}

inline Random randomOf(std::uint64_t seed) {
  Random random(seed);
  for (int k = 0; k < 8; ++k) (void)random.bits();
  return random;
}

inline RandomPlate randomPlate(std::uint64_t seed) {
  Random random = randomOf(seed);
  RandomPlate plate;
  plate.input.shape = randomShape(random, plate.name);
  randomField(random, plate);
  randomParams(random, plate.params);
  return plate;
}

/// A drawing of many solids: some touch, some are bridged, some are hemmed in by others.
inline RandomPlate randomDrawing(std::uint64_t seed) {
  Random random = randomOf(seed);
  RandomPlate plate;
  randomParams(random, plate.params);
  std::vector<Ring> rings;
  Vec2 page;
  switch (random.index(3)) {
    case 0:
      plate.name = "halftone";
      rings = halftone(random, plate.params.spacing, page);
      break;
    case 1:
      plate.name = "tiles";
      rings = tiles(random, plate.params.spacing, page);
      break;
    default:
      plate.name = "icon";
      rings = icon(random, plate.params.spacing, page);
      break;
  }
  plate.input.shape = shapeOf(std::move(rings), page, sillon::FillRule::NonZero);
  randomField(random, plate);
  return plate;
}

/// What every plate that can be made keeps: joints looked at per cell. The most among 400 random plates is 12, among
/// 900 drawings 106.
constexpr double kMostWork = 300;

/// What a plate may spill [%]: a joint across a gap is a thread outside of the shape, two strands a raster pixel or two
/// wide. One pixel is the least that can be measured: more than 0.05 % of a shape of fewer than 2000.
inline double spillAllowed(const RandomPlate& plate, const sillon::ToolpathResult& made) {
  const double area = sillon::resolveOutline(plate.input.shape).value().area;
  const double gap = 2 * plate.params.bridge.value_or(plate.params.spacing) + plate.params.spacing;
  const double threads = made.gapJoints * 2 * gap * 0.1 * plate.params.spacing;
  const double pixel = plate.params.spacing / 20;
  return 0.05 + 100 * (threads + pixel * pixel) / area;
}

/// How far a path may leave the shape [mm]: by half a bridge and half a bead when it is joined, and what relaxing adds.
inline double outsideAllowed(const sillon::ToolpathParams& params) {
  return 0.5 * (params.bridge.value_or(params.spacing) + params.spacing) + 0.3 * params.spacing;
}

}  // namespace scenes
