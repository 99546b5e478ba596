#include "geometry/bead_room.hpp"

#include <doctest/doctest.h>

#include "support/scenes.hpp"

using namespace sillon;

TEST_CASE("whatever was asked before, a border is found exactly where one is nearer than the depth") {
  // A ring: depth grows and falls, and walks cross its hole and leave it.
  const Shape shape = scenes::shapeOf({scenes::circle({20, 20}, 15), scenes::circle({20, 20}, 6)}, {40, 40});
  const auto outline = resolveOutline(shape);
  REQUIRE(outline.ok());
  const auto border = buildBorderIndex(outline.value(), makeGrid(outline.value().bounds, 0.4), RunContext(1));
  REQUIRE(border.ok());

  scenes::Random random(7);
  BorderDepth depth(border.value());
  Vec2f p{10, 20};
  int deep = 0, found = 0;
  for (int step = 0; step < 20000; ++step) {
    const double most = step % 500 == 0 ? 20 : 0.2;  // mostly the next point of a path, at times another path
    p = p + Vec2f{static_cast<float>(random.in(-most, most)), static_cast<float>(random.in(-most, most))};
    p = {std::clamp(p.x, 4.0f, 36.0f), std::clamp(p.y, 4.0f, 36.0f)};
    const float asked = static_cast<float>(random.in(0.05, 2));
    const NearestBorder truth = border.value().nearest({static_cast<double>(p.x), static_cast<double>(p.y)});
    const auto answer = depth.nearerThan(asked, p);
    CAPTURE(p.x);
    CAPTURE(p.y);
    REQUIRE(answer.has_value() == (truth.distance > -asked));
    if (answer) CHECK((answer->distance == truth.distance && answer->normal == truth.normal));
    ++(answer ? found : deep);
  }
  CHECK(deep > 2000);
  CHECK(found > 2000);
}
