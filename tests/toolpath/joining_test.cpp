// Joints against a slow model of them that looks at every edge, and stitching against one that looks at every pair of
// points.
#include "toolpath/joining.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "geometry/closed_curves.hpp"
#include "support/about.hpp"
#include "support/scenes.hpp"
#include "toolpath/path.hpp"

using namespace sillon;

namespace {

constexpr double kGapLeft = 20;  // of the strip between two solids [mm]
constexpr double kGapRight = 20.5;

// Two solids with a gap between them, circles and long loops on both, and beads that turn over the page.
struct Page {
  ToolpathParams params;
  BorderIndex border;
  LineField lines;
  ClosedCurves curves;

  Page() {
    params.order = BeadOrder::Plain;
    const RunContext run(1);
    const Outline outline = resolveOutline(scenes::shapeOf({scenes::rectangle({0, 0}, {kGapLeft, 30}),
                                                            scenes::rectangle({kGapRight, 0}, {40, 30})},
                                                           {40, 30}))
                                .value();
    const Grid grid = makeGrid(outline.bounds, params.spacing);
    border = buildBorderIndex(outline, grid, run).value();
    lines = {grid, std::vector<Vec2f>(grid.size()), std::vector<std::uint8_t>(grid.size(), 1)};
    for (int y = 0; y < grid.ny; ++y) {
      for (int x = 0; x < grid.nx; ++x) {
        const double angle = 0.07 * x + 0.11 * y;
        lines.direction[grid.index(x, y)] = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
      }
    }
    scenes::Random random(5);
    std::vector<std::vector<Vec2f>> all;
    const auto add = [&](Vec2 centre, double rx, double ry, bool left) {
      const int count = static_cast<int>(2 * std::numbers::pi * std::max(rx, ry) / 0.1);
      std::vector<Vec2f> curve;
      for (int k = 0; k < std::max(count, 6); ++k) {
        const double a = (left ? 2 : -2) * std::numbers::pi * k / std::max(count, 6);
        curve.push_back(
            {static_cast<float>(centre.x + rx * std::cos(a)), static_cast<float>(centre.y + ry * std::sin(a))});
      }
      all.push_back(curve);
    };
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 14; ++x) {
        const double side = x < 7 ? 1.9 : kGapRight + 1.4 - 7 * 2.75;
        const double radius = random.index(4) == 0 ? 0.15 : random.in(0.6, 1.15);
        add({side + 2.75 * x, 2 + 3.1 * y + random.in(-0.2, 0.2)}, radius, radius * random.in(0.6, 1),
            random.index(3) > 0);
      }
    }
    curves = scenes::closed(all);
    REQUIRE(findCrossings(curves, run).empty());
  }
};

// The same rules, edge by edge.
struct Model {
  const ClosedCurves& curves;
  std::vector<int> curveOf, next, set;
  std::vector<char> used, inner;
  double longest = 0;
  int gaps = 0;

  explicit Model(const ClosedCurves& given) : curves(given), used(given.points.size(), 0), inner(used) {
    for (int c = 0; c < curves.count(); ++c) {
      const int first = curves.begin[c];
      for (int k = 0; k < curves.size(c); ++k) {
        curveOf.push_back(c);
        next.push_back(first + (k + 1) % curves.size(c));
      }
      set.push_back(c);
    }
  }

  [[nodiscard]] Vec2f at(int p) const { return curves.points[p]; }
  [[nodiscard]] int setAt(int p) const { return set[curveOf[p]]; }

  // `span` segments with the point in their middle: their points.
  [[nodiscard]] std::vector<int> piece(int point, int span) const {
    const int c = curveOf[point];
    const int first = curves.begin[c];
    const int n = curves.size(c);
    span = std::min(span, n / 2);
    std::vector<int> points;
    for (int k = 0; k <= span; ++k) points.push_back(first + ((point - first - span / 2 + k) % n + n) % n);
    return points;
  }

  [[nodiscard]] static double outside(Vec2f a, Vec2f b) {
    const double low = static_cast<double>(std::min(a.x, b.x)), high = static_cast<double>(std::max(a.x, b.x));
    if (low > kGapLeft || high < kGapRight) return 0;  // no point lies in the strip
    return static_cast<double>(length(b - a)) * (kGapRight - kGapLeft) / (high - low);
  }

  // Whether ab meets an edge of the path as it is, without the pieces.
  [[nodiscard]] bool blocked(int a, int b, const std::set<int>& removed) const {
    for (int p = 0; p < static_cast<int>(next.size()); ++p) {
      const int q = next[p];
      if (inner[p] || (removed.count(p) > 0 && q == original(p))) continue;
      if (p == a || p == b || q == a || q == b) continue;
      if (segmentsMeet(at(a), at(b), at(p), at(q))) return true;
    }
    return false;
  }
  [[nodiscard]] int original(int p) const { return nextOf(curves, curveOf[p], p); }

  bool join(const Candidate& candidate, double gap) {
    if (setAt(candidate.i) == setAt(candidate.j)) return false;
    const std::vector<int> a = piece(candidate.i, candidate.span), b = piece(candidate.j, candidate.span);
    for (const auto& some : {a, b}) {
      for (const int p : some) {
        if (used[p]) return false;
      }
    }
    const double e = outside(at(a.front()), at(b.back())), f = outside(at(b.front()), at(a.back()));
    if (e > gap || f > gap) return false;
    if (segmentsMeet(at(a.front()), at(b.back()), at(b.front()), at(a.back()))) return false;
    std::set<int> removed(a.begin(), a.end() - 1);
    removed.insert(b.begin(), b.end() - 1);
    if (blocked(a.front(), b.back(), removed) || blocked(b.front(), a.back(), removed)) return false;
    if (blocked(candidate.i, candidate.j, removed)) return false;
    for (const auto& some : {a, b}) {
      for (const int p : some) used[p] = 1;
      for (std::size_t k = 1; k + 1 < some.size(); ++k) inner[some[k]] = 1;
    }
    next[a.front()] = b.back();
    next[b.front()] = a.back();
    gaps += e + f > 0 ? 1 : 0;
    for (const double size : {length(at(a.front()) - at(b.back())), length(at(b.front()) - at(a.back()))}) {
      longest = std::max(longest, size);
    }
    const int one = setAt(candidate.i), other = setAt(candidate.j);
    for (int& s : set) {
      if (s == one || s == other) s = std::min(one, other);
    }
    return true;
  }
};

}  // namespace

TEST_CASE("a joint is made exactly where nothing stands against it, however long it is and whatever it has to pass") {
  const Page page;
  const RunContext run(1);
  const PointGrid grid(page.curves.points, static_cast<float>(page.params.spacing), run);
  scenes::Random random(11);
  int made = 0, longOnes = 0, refused = 0;
  for (const double reach : {1.5, 4.0, 16.0}) {
    Joining joining(page.curves, grid, page.lines, page.border, page.params);
    Model model(page.curves);
    const int count = static_cast<int>(page.curves.points.size());
    for (int tried = 0; tried < 1500;) {
      const int i = random.index(count), j = random.index(count);
      if (static_cast<double>(length(model.at(i) - model.at(j))) > reach) continue;
      ++tried;
      const Candidate candidate{0, i, j, std::array{4, 2, 1}[random.index(3)]};
      const float gap = random.index(2) == 0 ? 0.0f : 0.6f;
      // How much lies outside is sampled; what is nearly as much as allowed may go either way.
      const std::vector<int> a = model.piece(i, candidate.span), b = model.piece(j, candidate.span);
      const double e = Model::outside(model.at(a.front()), model.at(b.back()));
      const double f = Model::outside(model.at(b.front()), model.at(a.back()));
      if (gap > 0 && (std::abs(e - 0.6) < 0.06 || std::abs(f - 0.6) < 0.06)) continue;
      CHECK(static_cast<double>(joining.outsideLength(i, j, candidate.span)) == doctest::Approx(e + f).epsilon(0.06));
      const bool expected = model.join(candidate, static_cast<double>(gap));
      REQUIRE(joining.join(candidate, gap) == expected);
      (expected ? made : refused) += 1;
      longOnes += expected && reach > 10 && length(model.at(i) - model.at(j)) > 5 ? 1 : 0;
    }
    for (int p = 0; p < count; ++p) {
      if (joining.used(p) != (model.used[p] != 0)) FAIL_CHECK("a point's use differs");
      if (joining.setOf(joining.curveOf(p)) != model.setAt(p)) FAIL_CHECK("a point's set differs");
    }
    CHECK(static_cast<double>(joining.longestJoint()) == about(model.longest, 1e-6));
    CHECK(joining.gapJoints() == model.gaps);
    // The curves as they are: each set from its lowest curve's first point that is left.
    const ClosedCurves joined = joining.joined();
    CHECK(findCrossings(joined, run).empty());
    ClosedCurves expected;
    for (int c = 0; c < page.curves.count(); ++c) {
      if (model.set[c] != c) continue;
      int start = page.curves.begin[c];
      while (model.inner[start]) ++start;
      expected.begin.push_back(static_cast<int>(expected.points.size()));
      int p = start;
      do {
        expected.points.push_back(model.at(p));
        p = model.next[p];
      } while (p != start);
    }
    expected.begin.push_back(static_cast<int>(expected.points.size()));
    CHECK(joined.begin == expected.begin);
    CHECK(joined.points == expected.points);
  }
  CHECK(made > 100);
  CHECK(longOnes > 3);
  CHECK(refused > 1000);
}

TEST_CASE("joints toggled by chance never cross, and all toggled back leave the curves as they were") {
  const Page page;
  const RunContext run(1);
  const PointGrid grid(page.curves.points, static_cast<float>(page.params.spacing), run);
  scenes::Random random(29);
  Joining joining(page.curves, grid, page.lines, page.border, page.params);
  const int count = static_cast<int>(page.curves.points.size());
  const auto byChance = [&] { return Joint{random.index(count), random.index(count), 4, 0.6f}; };
  for (int tried = 0; tried < 100000; ++tried) {
    const Joint joint = byChance();
    if (length(joining.at(joint.i) - joining.at(joint.j)) < 2)
      joining.join({0, joint.i, joint.j, joint.span}, joint.gap);
  }
  const ClosedCurves before = joining.joined();
  const int gaps = joining.gapJoints();
  const float longest = joining.longestJoint();
  std::vector<Joint> joints = joining.made();
  REQUIRE(joints.size() > 20);
  for (int tried = 0; tried < 20000; ++tried) {
    const Joint joint = byChance();
    if (length(joining.at(joint.i) - joining.at(joint.j)) < 2) joints.push_back(joint);
  }
  std::vector<std::size_t> toggled;
  for (int tried = 0; tried < 3000; ++tried) {
    const std::size_t k = static_cast<std::size_t>(random.index(static_cast<int>(joints.size())));
    const bool on = joints[k].on;
    const bool blocked = joining.blocked(joints[k]);
    const bool done = joining.toggle(joints[k]);
    CHECK(joints[k].on == (done ? !on : on));
    CHECK(!(blocked && done));
    if (done) toggled.push_back(k);
    // Every edge of the path leads to a point whose edge leads back.
    for (int p = 0; p < count && tried % 100 == 0; ++p) {
      if (joining.onPath(p) && joining.before(joining.after(p)) != p) FAIL_CHECK("the path is torn");
    }
  }
  CHECK(toggled.size() > 200);
  for (; !toggled.empty(); toggled.pop_back()) REQUIRE(joining.toggle(joints[toggled.back()]));
  CHECK(joining.joined().points == before.points);
  CHECK(joining.joined().begin == before.begin);
  CHECK(joining.gapJoints() == gaps);
  CHECK(joining.longestJoint() == longest);
}

TEST_CASE("a joint costs 0.65 of the length it adds, and the price of the misaligned length it adds (Eq. 14)") {
  Page page;
  const RunContext run(1);
  const PointGrid grid(page.curves.points, static_cast<float>(page.params.spacing), run);
  scenes::Random random(17);
  for (const double price : {0.0, 1.1, 3.0}) {
    page.params.stitchAlignment = price;
    const Joining joining(page.curves, grid, page.lines, page.border, page.params);
    const Model model(page.curves);
    // Length, and the length times the square of the sine of the angle to the bead, which runs across the line.
    const auto measure = [&](Vec2f from, Vec2f to) {
      const Vec2 a{static_cast<double>(from.x), static_cast<double>(from.y)};
      const Vec2 b{static_cast<double>(to.x), static_cast<double>(to.y)};
      const Grid& cells = page.lines.grid;
      const Vec2 middle{0.5 * static_cast<double>(from.x + to.x), 0.5 * static_cast<double>(from.y + to.y)};
      const int x = static_cast<int>(std::floor((middle.x - cells.origin.x) / cells.cell));
      const int y = static_cast<int>(std::floor((middle.y - cells.origin.y) / cells.cell));
      const Vec2f line = page.lines.direction[cells.index(x, y)];
      const double bead = std::atan2(static_cast<double>(line.x), -static_cast<double>(line.y));
      const double sine = std::sin(std::atan2(b.y - a.y, b.x - a.x) - bead);
      return Vec2{length(b - a), length(b - a) * sine * sine};
    };
    for (int k = 0; k < 300; ++k) {
      const int count = static_cast<int>(page.curves.points.size());
      const int i = random.index(count), j = random.index(count), span = std::array{4, 2, 1}[k % 3];
      const std::vector<int> a = model.piece(i, span), b = model.piece(j, span);
      Vec2 added = measure(model.at(a.front()), model.at(b.back())) + measure(model.at(b.front()), model.at(a.back()));
      for (const auto& piece : {a, b}) {
        for (std::size_t n = 1; n < piece.size(); ++n)
          added = added - measure(model.at(piece[n - 1]), model.at(piece[n]));
      }
      CHECK(static_cast<double>(joining.cost(i, j, span)) ==
            doctest::Approx(0.65 * added.x + price * added.y).epsilon(1e-4));
    }
  }
}

namespace {

struct Searching {
  double reach;  // [spacings]
  std::size_t partners;
  std::vector<int> spans;
  double gap;  // [mm]
};

// One go of Alg. 2, pair by pair.
Stitched slowlyStitched(const Page& page, const ClosedCurves& curves, const Parts& parts) {
  const RunContext run(1);
  const double spacing = page.params.spacing;
  const PointGrid grid(curves.points, static_cast<float>(spacing), run);
  Joining joining(curves, grid, page.lines, page.border, page.params);
  const double gap = 1.2 * page.params.bridge.value_or(spacing) + spacing / 8;
  const Searching near[] = {
      {1.8, 2, {4}, 0}, {1.8, 6, {4, 2, 1}, 0}, {1.8, 6, {4, 2, 1}, gap}, {3.6, 24, {4, 2, 1}, 2 * gap}};
  const int count = static_cast<int>(curves.points.size());
  std::vector<int> partOf;
  for (int c = 0; c < curves.count(); ++c) {
    partOf.push_back(parts.label[cellInPart(parts, curves.points[curves.begin[c]])]);
  }
  const auto partAt = [&](int point) { return partOf[joining.curveOf(point)]; };
  Stitched out;
  std::size_t search = 0;
  for (int round = 0; search < 6; ++round) {
    // The largest set of each part, and the parts of several.
    std::map<int, std::map<int, int>> points;  // part, set, points
    for (int c = 0; c < curves.count(); ++c) points[partOf[c]][joining.setOf(c)] += curves.size(c);
    out.parts = static_cast<int>(points.size());
    std::map<int, int> largest;
    for (const auto& [part, sets] : points) {
      if (sets.size() < 2) continue;
      largest[part] = std::max_element(sets.begin(), sets.end(), [](const auto& a, const auto& b) {
                        return a.second < b.second;
                      })->first;
    }
    if (largest.empty()) break;
    const auto setAt = [&](int point) { return joining.setOf(joining.curveOf(point)); };

    std::vector<Candidate> candidates;
    if (search < 4) {
      const Searching& how = near[search];
      for (int i = 0; i < count; ++i) {
        const int c = joining.curveOf(i);
        if (round == 0 && (i - curves.begin[c]) % 4 != 0) continue;
        if (largest.count(partAt(i)) == 0 || setAt(i) == largest[partAt(i)] || joining.used(i)) continue;
        const Vec2f along = joining.at(nextOf(curves, c, i)) - joining.at(i);
        std::array<std::vector<std::pair<float, int>>, 2> sides;
        for (int j = 0; j < count; ++j) {
          const Vec2f to = joining.at(j) - joining.at(i);
          const float reach = static_cast<float>(how.reach) * static_cast<float>(spacing);
          if (partAt(j) != partAt(i) || setAt(j) == setAt(i) || joining.used(j) || dot(to, to) > reach * reach)
            continue;
          sides[search == 0 && cross(along, to) > 0 ? 1 : 0].emplace_back(dot(to, to), j);
        }
        std::vector<std::pair<float, int>> partners;
        for (auto& side : sides) {
          std::sort(side.begin(), side.end());
          if (search == 0 && side.size() > 1) side.resize(1);
          partners.insert(partners.end(), side.begin(), side.end());
        }
        std::sort(partners.begin(), partners.end());
        for (std::size_t k = 0; k < std::min(partners.size(), how.partners); ++k) {
          for (const int span : how.spans) {
            candidates.push_back({joining.cost(i, partners[k].second, span), i, partners[k].second, span});
          }
        }
      }
    } else {
      std::vector<int> sets(static_cast<std::size_t>(count), -1);
      for (int i = 0; i < count; ++i) {
        if (largest.count(partAt(i)) > 0 && !joining.used(i)) sets[i] = setAt(i);
      }
      std::vector<std::pair<int, int>> pairs = facingPoints(parts, curves.points, sets);
      if (search == 5) {  // all that lies around the nearest 16
        std::stable_sort(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) {
          return length(joining.at(a.first) - joining.at(a.second)) <
                 length(joining.at(b.first) - joining.at(b.second));
        });
        pairs.resize(std::min<std::size_t>(pairs.size(), 16));
        std::set<std::pair<int, int>> around;
        const Model model(curves);
        for (const auto& [i, j] : pairs) {
          const auto walk = [&](int p) {
            const int first = curves.begin[joining.curveOf(p)];
            const int n = curves.size(joining.curveOf(p));
            std::vector<int> some;
            for (int k = -4; k <= 4; ++k) some.push_back(first + ((p - first + k) % n + n) % n);
            for (int q = 0; q < count; ++q) {  // strands beside it
              const Vec2f to = joining.at(q) - joining.at(p);
              if (setAt(q) == setAt(p) && static_cast<double>(length(to)) <= 0.5 * spacing) some.push_back(q);
            }
            return some;
          };
          for (const int a : walk(i)) {
            for (const int b : walk(j)) around.insert({a, b});
          }
        }
        pairs.assign(around.begin(), around.end());
      }
      for (const auto& [i, j] : pairs) {
        for (const int span : {4, 2, 1}) {
          candidates.push_back({joining.cost(i, j, span) + 4 * joining.outsideLength(i, j, span), i, j, span});
        }
      }
    }
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
      return std::tuple(a.cost, a.i, a.j, -a.span) < std::tuple(b.cost, b.i, b.j, -b.span);
    });
    int made = 0;
    for (const Candidate& c : candidates) {
      out.work += 1 + static_cast<int>(static_cast<double>(length(joining.at(c.i) - joining.at(c.j))) / spacing);
      made += joining.join(c, search < 4 ? static_cast<float>(near[search].gap) : 1e30f) ? 1 : 0;
    }
    if (made == 0) ++search;
  }
  out.curves = joining.joined();
  out.longestJoint = static_cast<double>(joining.longestJoint());
  out.gapJoints = joining.gapJoints();
  return out;
}

}  // namespace

TEST_CASE("stitching makes the joints that looking at every pair of points would (Alg. 2)") {
  Page page;
  const RunContext run(1);
  scenes::Random random(23);
  int goes = 0;
  for (int round = 0; round < 5; ++round) {
    CAPTURE(round);
    // Curves of the page by chance, some of them a dot: apart by a bead, by several, on one part or on both.
    std::vector<std::vector<Vec2f>> some;
    for (int c = 0; c < page.curves.count() && round < 4; ++c) {
      if (random.index(3) == 0) continue;
      const auto begin = page.curves.points.begin();
      some.emplace_back(begin + page.curves.begin[c], begin + page.curves.begin[static_cast<std::size_t>(c) + 1]);
      if (random.index(3) > 0) continue;
      for (Vec2f& p : some.back()) p.x += random.index(2) == 0 ? 0.2f : -0.2f;
      if (!findCrossings(scenes::closed(some), run).empty()) some.pop_back();
    }
    // Squares of 1.5 mm with a point every eighth of a millimetre, every other column half a step higher: many pairs
    // are equally far apart, and many points lie midway between two of the next square.
    for (int k = 0; k < 12 && round == 4; ++k) {
      std::vector<Vec2f>& square = some.emplace_back();
      const Vec2f corner{2 + 2.125f * static_cast<float>(k % 4),
                         2 + 2.0f * static_cast<float>(k / 4) + 0.0625f * static_cast<float>(k % 2)};
      const Vec2f sides[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
      Vec2f p = corner;
      for (int n = 0; n < 48; ++n) {
        square.push_back(p);
        p = p + 0.125f * sides[n / 12];
      }
    }
    const ClosedCurves curves = scenes::closed(some);
    if (round == 2) page.params.bridge = 0.1;  // 2 x 0.17 mm are less than the gap, 4 x would be more
    if (round == 3) page.params.bridge = 0.5;
    const Grid& grid = page.lines.grid;
    Parts parts{grid, std::vector<std::int32_t>(grid.size(), 0), 1};
    if (round % 2 == 1) {
      parts.count = 2;
      for (int y = 0; y < grid.ny; ++y) {
        for (int x = 0; x < grid.nx; ++x) parts.label[grid.index(x, y)] = grid.centre(x, y).x < 20.25 ? 0 : 1;
      }
    }
    Stitched slow = slowlyStitched(page, curves, parts);
    // What is left apart goes again, as curves of equal steps.
    while (slow.unjoined() > 0) {
      Stitched more = slowlyStitched(page, resampledSimply(slow.curves, 0.1f, run), parts);
      more.work += slow.work;
      if (more.curves.count() == slow.curves.count()) {
        slow.work = more.work;
        break;
      }
      more.longestJoint = std::max(more.longestJoint, slow.longestJoint);
      more.gapJoints += slow.gapJoints;
      slow = std::move(more);
      ++goes;
    }
    const Stitched fast = stitchCycles(curves, page.lines, page.border, parts, page.params, run).value();
    CHECK(fast.curves.begin == slow.curves.begin);
    CHECK(fast.curves.points == slow.curves.points);
    CHECK(fast.parts == slow.parts);
    CHECK(fast.work == slow.work);
    CHECK(fast.gapJoints == slow.gapJoints);
    CHECK(fast.longestJoint == slow.longestJoint);
  }
  CHECK(goes > 0);
}
