#include "geometry/closed_curves.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "sillon/base/run_context.hpp"
#include "support/scenes.hpp"

using namespace sillon;

namespace {

using Pairs = std::vector<std::pair<int, int>>;

struct Whole {
  std::int64_t x, y;
  friend bool operator==(const Whole&, const Whole&) = default;
};

Whole wholeOf(Vec2f p) {
  return {std::llround(static_cast<double>(p.x) * 1000), std::llround(static_cast<double>(p.y) * 1000)};
}

// By the book, in whole numbers: two segments meet unless a line separates them.
bool meet(Whole a, Whole b, Whole c, Whole d) {
  const auto turn = [](Whole p, Whole q, Whole r) { return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x); };
  const auto apart = [](std::int64_t u, std::int64_t v) { return (u > 0 && v > 0) || (u < 0 && v < 0); };
  const auto boxesApart = [](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t s) {
    return std::max(p, q) < std::min(r, s) || std::max(r, s) < std::min(p, q);
  };
  return !boxesApart(a.x, b.x, c.x, d.x) && !boxesApart(a.y, b.y, c.y, d.y) && !apart(turn(a, b, c), turn(a, b, d)) &&
         !apart(turn(c, d, a), turn(c, d, b));
}

// All pairs with each other. Segments that vanish are passed over; those on either side of them are consecutive.
Pairs allCrossings(const ClosedCurves& curves, const std::vector<char>& among) {
  struct Segment {
    int id, curve, place, count;
    Whole a, b;
    bool looked;
  };
  std::vector<Segment> segments;
  for (int c = 0; c < curves.count(); ++c) {
    const std::size_t first = segments.size();
    const int begin = curves.begin[c];
    for (int k = 0; k < curves.size(c); ++k) {
      const int next = begin + (k + 1) % curves.size(c);
      const Whole a = wholeOf(curves.points[begin + k]);
      const Whole b = wholeOf(curves.points[next]);
      const bool looked = among.empty() || among[begin + k] != 0 || among[next] != 0;
      if (!(a == b)) segments.push_back({begin + k, c, static_cast<int>(segments.size() - first), 0, a, b, looked});
    }
    for (std::size_t k = first; k < segments.size(); ++k) segments[k].count = static_cast<int>(segments.size() - first);
  }
  Pairs found;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    for (std::size_t j = i + 1; j < segments.size(); ++j) {
      const Segment &s = segments[i], &t = segments[j];
      if (!s.looked || !t.looked) continue;
      const bool consecutive =
          s.curve == t.curve && ((s.place + 1) % s.count == t.place || (t.place + 1) % t.count == s.place);
      if (!consecutive && meet(s.a, s.b, t.a, t.b)) found.emplace_back(s.id, t.id);
    }
  }
  return found;
}

ClosedCurves randomCurves(scenes::Random& random, bool coarse) {
  ClosedCurves curves;
  const int count = 1 + static_cast<int>(random.in(0, 4));
  for (int c = 0; c < count; ++c) {
    curves.begin.push_back(static_cast<int>(curves.points.size()));
    const int n = 3 + static_cast<int>(random.in(0, 60));
    Vec2 p{random.in(0, 5), random.in(0, 5)};
    for (int k = 0; k < n; ++k) {
      // Some points stand still, and some of a coarse lattice lie on other segments.
      if (random.in(0, 1) > 0.15) p = p + Vec2{random.in(-1, 1), random.in(-1, 1)};
      const double step = coarse ? 0.5 : 0.001;
      curves.points.push_back(
          {static_cast<float>(std::round(p.x / step) * step), static_cast<float>(std::round(p.y / step) * step)});
    }
  }
  curves.begin.push_back(static_cast<int>(curves.points.size()));
  return curves;
}

}  // namespace

TEST_CASE("a figure of eight crosses once, a square never") {
  const ClosedCurves eight{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {0, 4}};
  CHECK(findCrossings(eight, RunContext(1)) == Pairs{{0, 2}});
  const ClosedCurves square{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {0, 4}};
  CHECK(findCrossings(square, RunContext(1)).empty());
}

TEST_CASE("curves that touch in one point meet there; a thousandth apart they do not") {
  const auto beside = [](float x) {
    return ClosedCurves{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {x, 0.5f}, {3, 0}, {3, 1}}, {0, 4, 7}};
  };
  CHECK(findCrossings(beside(1), RunContext(1)) == Pairs{{1, 4}, {1, 6}});
  CHECK(findCrossings(beside(1.001f), RunContext(1)).empty());
}

TEST_CASE("segments that vanish in rounding are passed over") {
  const ClosedCurves square{{{0, 0}, {0.0002f, 0}, {2, 0}, {2, 2}, {2, 2}, {0, 2}, {0, 0.0001f}}, {0, 7}};
  CHECK(findCrossings(square, RunContext(1)).empty());
}

TEST_CASE("curves of one point or none cross nothing") {
  const ClosedCurves curves{{{0, 0}, {2, 2}, {2, 0}, {0, 2}, {1, 1}}, {0, 0, 4, 4, 5, 5}};
  CHECK(findCrossings(curves, RunContext(1)) == Pairs{{0, 2}});
  CHECK(findCrossings(ClosedCurves{{}, {0, 0}}, RunContext(1)).empty());
  CHECK(findCrossings(ClosedCurves{{}, {0}}, RunContext(1)).empty());
  CHECK(findCrossings(ClosedCurves{}, RunContext(1)).empty());
}

TEST_CASE("crossings are those of all pairs, for any number of threads and some segments only") {
  scenes::Random random(11);
  std::size_t total = 0;
  for (int k = 0; k < 200; ++k) {
    const ClosedCurves curves = randomCurves(random, k % 2 == 0);
    std::vector<char> among;
    if (k % 3 == 0) {
      for (std::size_t p = 0; p < curves.points.size(); ++p) among.push_back(random.in(0, 1) < 0.3 ? 1 : 0);
    }
    const Pairs expected = allCrossings(curves, among);
    total += expected.size();
    CAPTURE(k);
    CHECK(findCrossings(curves, RunContext(1), among) == expected);
    CHECK(findCrossings(curves, RunContext(3), among) == expected);
  }
  CHECK(total > 5000);
}

TEST_CASE("many segments are shared out among threads, with the same crossings") {
  // Circles around two middles: each of one meets each of the other twice.
  ClosedCurves curves;
  constexpr int kCircles = 12;
  constexpr int kPoints = 3000;
  for (const float x : {0.0f, 9.0f}) {
    for (int c = 0; c < kCircles; ++c) {
      curves.begin.push_back(static_cast<int>(curves.points.size()));
      for (int k = 0; k < kPoints; ++k) {
        const double angle = 6.283185307179586 * k / kPoints;
        const double radius = 5 + 0.3 * c;
        curves.points.push_back(
            {x + static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle))});
      }
    }
  }
  curves.begin.push_back(static_cast<int>(curves.points.size()));
  const Pairs one = findCrossings(curves, RunContext(1));
  CHECK(one.size() >= 2 * kCircles * kCircles);  // a circle through a point of another meets two of its segments
  CHECK(one.size() <= 8 * kCircles * kCircles);
  CHECK(findCrossings(curves, RunContext(4)) == one);
}
