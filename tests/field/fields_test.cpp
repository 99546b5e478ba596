// Constraints, lines, phases and the sine field.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>

#include "base/fast_math.hpp"
#include "field/fields.hpp"
#include "pipeline/stages.hpp"
#include "sillon/quality/metrics.hpp"
#include "support/about.hpp"
#include "support/scenes.hpp"

using namespace sillon;
using scenes::circle;
using scenes::mapOf;
using scenes::rectangle;
using scenes::shapeOf;

namespace {

Stages fieldsOf(const PlateInput& input, const ToolpathParams& params = {}, const RunContext& run = RunContext(1)) {
  return generateStages(input, params, run).value();
}

PlateInput square(double side, DirectionMap map, DirectionMode mode = DirectionMode::Constrained) {
  return scenes::plate(shapeOf({rectangle({0, 0}, {side, side})}, {side, side}), std::move(map), mode);
}

DirectionMap uniform(double angle) {
  return mapOf(1, [=](double, double) { return angle; });
}

// |cos| of the angle between a direction and the bead direction `angle` turned by 90 degrees.
double agreement(Vec2f d, double angle) {
  return std::abs(static_cast<double>(d.x) * -std::sin(angle) + static_cast<double>(d.y) * std::cos(angle));
}

constexpr float kFrequency = kPi / 0.4f;

// Eq. 7: the squared difference of two waves along d_j, over one period.
double alignmentEnergy(Vec2f offset, Vec2f di, Vec2f dj, double phaseI, double phaseJ) {
  const double s = dot(di, dj) > 0 ? 1 : -1;
  const double along = static_cast<double>(dot(offset, dj));
  double sum = 0;
  for (int k = 0; k < 400; ++k) {
    const double x = 0.8 * k / 400;
    const double difference = std::sin(s * static_cast<double>(kFrequency) * (x - along) + phaseI) -
                              std::sin(static_cast<double>(kFrequency) * x + phaseJ);
    sum += difference * difference;
  }
  return sum / 400;
}

// Phase of i [rad, not wrapped] with which its wave agrees best with that of j: Eq. 8 at the midpoint, which is second
// order. `offset` is p_i - p_j [mm].
float alignedPhase(Vec2f offset, Vec2f di, Vec2f dj, float phaseJ, float frequency) {
  // Eq. 8, the phase at which the difference of the two waves, Eq. 7, is least.
  const float s = dot(di, dj) > 0 ? 1.0f : -1.0f;
  const float along = phaseJ + 0.5f * frequency * dot(offset, dj + di * s);
  return s > 0 ? along : kPi - along;  // opposed lines run backwards
}

// How well waves continue each other: the mean cosine of what is between the phases of neighbours; 1 is perfect.
double alignment(const SineField& field) {
  const Grid& grid = field.grid;
  double sum = 0, count = 0;
  for (int y = 0; y < grid.ny; ++y) {
    for (int x = 0; x < grid.nx; ++x) {
      for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}}) {
        if (x + dx >= grid.nx || y + dy >= grid.ny) continue;
        const std::size_t i = grid.index(x, y);
        const std::size_t j = grid.index(x + dx, y + dy);
        const Vec2f qi = field.phase[i];
        const Vec2f qj = field.phase[j];
        if (qi == Vec2f{} || qj == Vec2f{}) continue;
        const float cell = static_cast<float>(grid.cell);
        const Vec2f offset{-cell * static_cast<float>(dx), -cell * static_cast<float>(dy)};
        const float expected = alignedPhase(offset, field.wave[i], field.wave[j], std::atan2(qj.y, qj.x), kFrequency);
        sum += static_cast<double>(qi.x * std::cos(expected) + qi.y * std::sin(expected));
        ++count;
      }
    }
  }
  return sum / count;
}

}  // namespace

TEST_CASE("our sine and cosine keep their stated error") {
  double worst = 0;
  double far = 0;
  for (int k = -100000; k <= 100000; ++k) {
    const float x = static_cast<float>(k) * 1e-4f;
    const SinCos v = sinCos(x);
    worst = std::max({worst, std::abs(static_cast<double>(v.sin) - std::sin(static_cast<double>(x))),
                      std::abs(static_cast<double>(v.cos) - std::cos(static_cast<double>(x)))});
    const float y = static_cast<float>(k) * 0.0819f;
    const double error = std::abs(static_cast<double>(sinCos(y).sin) - std::sin(static_cast<double>(y)));
    far = std::max(far, error - 1e-7 * std::abs(static_cast<double>(y)));
  }
  CHECK(worst < 3e-7);
  CHECK(far < 2e-6);
}

TEST_CASE("our arc sine keeps its stated error") {
  for (int k = -1000; k <= 1000; ++k) {
    const float x = static_cast<float>(k) / 1000;
    CHECK(std::abs(static_cast<double>(asinApprox(x)) - std::asin(static_cast<double>(x))) < 1e-4);
  }
}

TEST_CASE("lines of a map are averaged as numbers e^{2i angle}: 89 and -89 degrees give 90, not 0") {
  DirectionMap map{2, 1, {65535 * 179 / 180, 65535 * 1 / 180}};  // 89 and -89 degrees
  const Stages f = fieldsOf(square(4, map));
  const Grid& grid = f.cells.grid;
  const Vec2f z = f.cells.mapLine[grid.index(grid.nx / 2, grid.ny / 2)];
  CHECK(z.x == about(1, 1e-2));  // bead at 90 degrees: z(t) = -1, z(d) = 1
}

TEST_CASE("where the average of lines vanishes the nearest texel decides") {
  DirectionMap map{2, 1, {32768, 65535}};  // 0 and 90 degrees
  const Stages f = fieldsOf(square(4, map));
  for (const Vec2f z : f.cells.mapLine) {
    if (z == Vec2f{}) continue;
    CHECK(length(z) == doctest::Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("the average of lines in closed form is the top eigenvector of their covariance (Eq. 1-4)") {
  scenes::Random random(13);
  for (int k = 0; k < 200; ++k) {
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
    Vec2f sum{};
    for (int j = 0; j < 8; ++j) {
      const double a = random.in(0, std::numbers::pi);
      const double w = random.in(0.1, 1);
      const Eigen::Vector2d d(std::cos(a), std::sin(a));
      covariance += w * d * d.transpose();
      sum = sum + Vec2f{static_cast<float>(w * std::cos(2 * a)), static_cast<float>(w * std::sin(2 * a))};
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance);
    const Eigen::Vector2d top = solver.eigenvectors().col(1);
    const double angle = 0.5 * std::atan2(static_cast<double>(sum.y), static_cast<double>(sum.x));
    CHECK(std::abs(top.x() * std::cos(angle) + top.y() * std::sin(angle)) == doctest::Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("zones follow the distance") {
  ToolpathParams params;
  params.perimeters = 3;
  const Stages f = fieldsOf(square(8, uniform(0)), params);
  for (std::size_t i = 0; i < f.cells.zone.size(); ++i) {
    const float sd = f.sdf.distance[i];
    const Zone expected =
        sd > -0.2f ? Zone::Masked : (sd > -0.4f ? Zone::Ring : (sd > -1.2f ? Zone::Shell : Zone::Infill));
    CHECK(f.cells.zone[i] == expected);
  }
}

TEST_CASE("parallel beads in a disc follow its border, orthogonal ones meet it; two half-index singularities remain") {
  for (const DirectionMode mode : {DirectionMode::Parallel, DirectionMode::Orthogonal}) {
    const Stages f = fieldsOf(scenes::plate(shapeOf({circle({8, 8}, 8)}, {16, 16}), uniform(0), mode));
    const Grid& grid = f.lines.grid;
    for (int y = 0; y < grid.ny; ++y) {
      for (int x = 0; x < grid.nx; ++x) {
        const std::size_t i = grid.index(x, y);
        const Vec2 out = grid.centre(x, y) - Vec2{8, 8};
        if (f.cells.zone[i] != Zone::Infill || length(out) < 7) continue;
        const double bead = std::atan2(out.y, out.x) + (mode == DirectionMode::Parallel ? std::numbers::pi / 2 : 0);
        REQUIRE(agreement(f.lines.direction[i], bead) > 0.98);
      }
    }
    // Going round each square of cells, the line comes back turned by half a turn around a half-index singularity.
    const auto at = [&](int x, int y) {
      return f.cells.zone[grid.index(x, y)] == Zone::Infill ? f.lines.direction[grid.index(x, y)] : Vec2f{};
    };
    int singularities = 0;
    for (int y = 1; y < grid.ny; ++y) {
      for (int x = 1; x < grid.nx; ++x) {
        const Vec2f corners[4] = {at(x - 1, y - 1), at(x, y - 1), at(x, y), at(x - 1, y)};
        bool masked = false;
        int flips = 0;
        for (int k = 0; k < 4; ++k) {
          masked = masked || corners[k] == Vec2f{};
          flips += dot(corners[k], corners[(k + 1) % 4]) < 0 ? 1 : 0;
        }
        if (!masked && flips % 2 == 1) ++singularities;
      }
    }
    CHECK(singularities == 2);
  }
}

TEST_CASE("constrained lines come back as asked; smoothest ones fill in between") {
  // Left third at 30 degrees, right third at 60, free between.
  PlateInput input =
      square(12, mapOf(60, [](double x, double) { return x < 0.5 ? std::numbers::pi / 6 : std::numbers::pi / 3; }));
  input.modes = {3, 1, {DirectionMode::Constrained, DirectionMode::Smoothest, DirectionMode::Constrained}};
  ToolpathParams params;
  params.perimeterMode = PerimeterMode::None;
  params.sweepsPerLevel = 64;
  const Stages f = fieldsOf(input, params);
  const Grid& grid = f.lines.grid;
  const int y = grid.ny / 2;
  double before = 0;
  for (int x = 0; x < grid.nx; ++x) {
    const std::size_t i = grid.index(x, y);
    if (f.cells.zone[i] == Zone::Masked) continue;
    const double px = grid.centre(x, y).x;
    const Vec2f d = f.lines.direction[i];
    double angle = std::atan2(-static_cast<double>(d.x), static_cast<double>(d.y));
    if (angle < 0) angle += std::numbers::pi;
    angle *= 180 / std::numbers::pi;
    if (px < 3.8) CHECK(angle == about(30, 1e-2));
    if (px > 8.2) CHECK(angle == about(60, 1e-2));
    CHECK(angle >= before - 0.5);  // monotonic in between
    before = angle;
  }
}

TEST_CASE("no phase found by search beats the aligned phase in the energy of Eq. 7") {
  scenes::Random random(7);
  for (int k = 0; k < 60; ++k) {
    const double angle = random.in(0, 2 * std::numbers::pi);
    const Vec2f dj{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
    const Vec2f di = k % 2 == 0 ? dj : -dj;  // Eq. 7 compares along one line: equal or opposed directions
    const Vec2f offset{static_cast<float>(random.in(-0.4, 0.4)), static_cast<float>(random.in(-0.4, 0.4))};
    const double phaseJ = random.in(-3, 3);
    const float best = alignedPhase(offset, di, dj, static_cast<float>(phaseJ), kFrequency);
    const double energy = alignmentEnergy(offset, di, dj, static_cast<double>(best), phaseJ);
    CHECK(energy < 1e-9);
    for (int p = 0; p < 64; ++p) {
      CHECK(energy <= alignmentEnergy(offset, di, dj, 2 * std::numbers::pi * p / 64, phaseJ) + 1e-9);
    }
  }
}

TEST_CASE("neighbouring waves continue each other") {
  for (const DirectionMap& map : {scenes::waves(), scenes::swirl()}) {
    for (const PerimeterMode mode : scenes::kPerimeterModes) {
      CAPTURE(static_cast<int>(mode));
      ToolpathParams params;
      params.perimeterMode = mode;
      params.seed = 3;
      CHECK(alignment(fieldsOf(square(20, map), params).waves) > 0.96);
    }
  }
}

TEST_CASE("(d, phi) and (-d, pi - phi) are the same wave, for alignment too") {
  scenes::Random random(11);
  for (int k = 0; k < 100; ++k) {
    const double a = random.in(0, 2 * std::numbers::pi);
    const double b = a + random.in(-1, 1);
    const Vec2f di{static_cast<float>(std::cos(a)), static_cast<float>(std::sin(a))};
    const Vec2f dj{static_cast<float>(std::cos(b)), static_cast<float>(std::sin(b))};
    const Vec2f offset{static_cast<float>(random.in(-0.4, 0.4)), static_cast<float>(random.in(-0.4, 0.4))};
    const float phase = static_cast<float>(random.in(-3, 3));
    const double plain = static_cast<double>(alignedPhase(offset, di, dj, phase, kFrequency));
    const double sameWave = static_cast<double>(alignedPhase(offset, di, -dj, kPi - phase, kFrequency));
    const double flipped =
        static_cast<double>(kPi) - static_cast<double>(alignedPhase(offset, -di, dj, phase, kFrequency));
    CHECK(std::cos(plain - sameWave) == doctest::Approx(1).epsilon(1e-5));
    CHECK(std::cos(plain - flipped) == doctest::Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("a uniform field becomes one plane wave at any angle, without a single dislocation") {
  for (const PhaseTransport transport : {PhaseTransport::Midpoint, PhaseTransport::Neighbour}) {
    for (const double angle : {0.0, 0.4, 1.1, 2.5}) {
      ToolpathParams params;
      params.perimeterMode = PerimeterMode::None;
      params.phaseTransport = transport;
      const Stages f = fieldsOf(square(12, uniform(angle)), params);
      const Grid& grid = f.waves.grid;
      for (int y = 1; y < grid.ny; ++y) {
        for (int x = 1; x < grid.nx; ++x) {
          const std::size_t i = grid.index(x, y);
          const std::size_t j = grid.index(x - 1, y);
          if (f.cells.zone[i] == Zone::Masked || f.cells.zone[j] == Zone::Masked) continue;
          const Vec2f q = f.waves.phase[i];
          const float expected = alignedPhase({0.2f, 0}, f.waves.wave[i], f.waves.wave[j],
                                              std::atan2(f.waves.phase[j].y, f.waves.phase[j].x), kFrequency);
          REQUIRE(q.x * std::cos(expected) + q.y * std::sin(expected) > 0.999f);
        }
      }
    }
  }
}

TEST_CASE("rings come out as rings: transport at the midpoint is second order, by the neighbour's line first order") {
  // Beads round a point outside of the shape, 20 spacings away: the wave is sin(pi r / tau + c), known everywhere.
  const Vec2 middle{-2, 6};
  const DirectionMap rings =
      mapOf(256, [&](double x, double y) { return std::atan2(12 * y - middle.y, 12 * x - middle.x) + kPi / 2; });
  const auto spread = [&](PhaseTransport transport) {
    ToolpathParams params;
    params.perimeterMode = PerimeterMode::None;
    params.spacingVariation = 0;
    params.phaseTransport = transport;
    const Stages f = fieldsOf(square(12, rings), params);
    const Grid& grid = f.waves.grid;
    double re = 0, im = 0, count = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (f.cells.zone[i] == Zone::Masked) continue;
      const Vec2 to = grid.centre(static_cast<int>(i) % grid.nx, static_cast<int>(i) / grid.nx) - middle;
      const bool outward = dot(to, Vec2{f.waves.wave[i].x, f.waves.wave[i].y}) > 0;
      const double phase = std::atan2(f.waves.phase[i].y, outward ? f.waves.phase[i].x : -f.waves.phase[i].x);
      const double rest = phase - static_cast<double>(kFrequency) * length(to);
      re += std::cos(rest);
      im += std::sin(rest);
      ++count;
    }
    return 1 - std::hypot(re, im) / count;  // 0: one constant c all over the plate
  };
  const double midpoint = spread(PhaseTransport::Midpoint);
  CHECK(midpoint < 0.006);
  CHECK(spread(PhaseTransport::Neighbour) > 5 * midpoint);
}

TEST_CASE("the ring's wave vanishes half a bead inside the border") {
  const Stages f = fieldsOf(scenes::plate(shapeOf({circle({7, 7}, 7)}, {14, 14}), scenes::waves()));
  int rings = 0;
  for (std::size_t i = 0; i < f.cells.zone.size(); ++i) {
    if (f.cells.zone[i] != Zone::Ring) continue;
    ++rings;
    const float along = dot(f.waves.wave[i], f.sdf.normal[i]) > 0 ? 1.0f : -1.0f;
    CHECK(std::abs(dot(f.waves.wave[i], f.sdf.normal[i])) > 0.999f);
    // sin(phi + along w (-tau/2 - sd)) = 0, falling inwards
    const float angle =
        std::atan2(f.waves.phase[i].y, f.waves.phase[i].x) + along * kFrequency * (-0.2f - f.sdf.distance[i]);
    CHECK(std::abs(std::sin(angle)) < 2e-3f);
  }
  CHECK(rings > 200);
}

TEST_CASE("a soft border pulls beads along it where the map agrees and leaves them alone where it does not") {
  ToolpathParams params;
  params.perimeterMode = PerimeterMode::Soft;
  const Stages f = fieldsOf(square(12, uniform(0)), params);
  const Grid& grid = f.waves.grid;
  // Beads run along x: at the lower border the first one lies half a spacing inside.
  for (int x = 20; x < grid.nx - 20; ++x) {
    for (int y = 0; y < grid.ny; ++y) {
      const std::size_t i = grid.index(x, y);
      if (f.cells.zone[i] != Zone::Ring) continue;
      const float along = dot(f.waves.wave[i], f.sdf.normal[i]) > 0 ? 1.0f : -1.0f;
      const float angle =
          std::atan2(f.waves.phase[i].y, f.waves.phase[i].x) + along * kFrequency * (-0.2f - f.sdf.distance[i]);
      CHECK(std::abs(std::sin(angle)) < 0.15f);
    }
  }
  for (std::size_t i = 0; i < f.lines.direction.size(); ++i) {
    if (f.cells.zone[i] != Zone::Masked) CHECK(agreement(f.lines.direction[i], 0) > 0.999);
  }
}

TEST_CASE("the sine field of a plane wave is that wave, times the Gaussian's loss at the border only") {
  ToolpathParams params;
  params.perimeterMode = PerimeterMode::None;
  const Stages f = fieldsOf(square(10, uniform(0.3)), params);
  const Grid nodes = nodeLattice(f.waves.grid);
  const Grid& grid = f.waves.grid;
  const std::size_t i0 = grid.index(grid.nx / 2, grid.ny / 2);
  const Vec2 p0 = grid.centre(grid.nx / 2, grid.ny / 2);
  for (int y = 0; y < nodes.ny; ++y) {
    for (int x = 0; x < nodes.nx; ++x) {
      const std::size_t n = nodes.index(x, y);
      const float sd = f.nodeDistance[n];
      if (sd >= 0) REQUIRE(f.nodeValues[n] == 1);
      if (sd < 0 && sd >= -0.2f) REQUIRE(f.nodeValues[n] == doctest::Approx(2 * sd / 0.4f + 1));
      const Vec2 p = nodes.centre(x, y);
      if (std::abs(p.x - p0.x) > 2 || std::abs(p.y - p0.y) > 2) continue;
      const Vec2f to{static_cast<float>(p.x - p0.x), static_cast<float>(p.y - p0.y)};
      const float expected =
          std::sin(kFrequency * dot(to, f.waves.wave[i0]) + std::atan2(f.waves.phase[i0].y, f.waves.phase[i0].x));
      REQUIRE(std::abs(f.nodeValues[n] - expected) < 0.02f);
    }
  }
}

TEST_CASE("fields are equal for any number of threads") {
  const PlateInput input = scenes::plate(shapeOf({scenes::star({9, 9}, 9, 4, 5)}, {18, 18}), scenes::waves());
  for (const PerimeterMode mode : scenes::kPerimeterModes) {
    ToolpathParams params;
    params.perimeterMode = mode;
    params.seed = 5;
    const Stages one = fieldsOf(input, params, RunContext(1));
    for (const int threads : {2, 3, 8}) {
      const Stages many = fieldsOf(input, params, RunContext(threads));
      CHECK(one.lines.direction == many.lines.direction);
      CHECK(one.frequency == many.frequency);
      CHECK(one.waves.phase == many.waves.phase);
      CHECK(one.nodeValues == many.nodeValues);
    }
  }
}

TEST_CASE("lines turn towards the beads that are there, as far as they may, and the spacing follows") {
  ToolpathParams params;
  params.perimeterMode = PerimeterMode::None;
  const Stages f = fieldsOf(square(12, uniform(0.5)), params);
  // Asked were lines 0.05 rad further on, at a spacing that is the waves' own.
  LineField asked = f.lines;
  for (Vec2f& d : asked.direction) {
    const SinCos turn = sinCos(0.05f);
    if (d != Vec2f{}) d = {d.x * turn.cos - d.y * turn.sin, d.x * turn.sin + d.y * turn.cos};
  }
  for (const double most : {1.0, 5.0}) {
    params.directionTolerance = most;
    const RelaxedDirections given =
        relaxDirections(asked, f.frequency, f.waves, f.cells, params, RunContext(2)).value();
    const float wanted = std::min(0.05f, static_cast<float>(most) * kPi / 180);
    int count = 0;
    for (std::size_t i = 0; i < asked.direction.size(); ++i) {
      if (f.cells.zone[i] != Zone::Infill) continue;
      CHECK(cross(given.lines.direction[i], asked.direction[i]) == about(wanted, 0.02));
      CHECK(given.frequency[i] == about(1, 0.01));
      ++count;
    }
    CHECK(count > 1000);
  }
}

TEST_CASE("what one line gives way is averaged twice over three by three cells") {
  ToolpathParams params;
  params.perimeterMode = PerimeterMode::None;
  params.directionTolerance = 5;
  const Stages f = fieldsOf(square(12, uniform(0.5)), params);
  const Grid& grid = f.lines.grid;
  LineField asked = f.lines;
  const SinCos turn = sinCos(0.05f);
  const int cx = grid.nx / 2, cy = grid.ny / 2;
  Vec2f& d = asked.direction[grid.index(cx, cy)];
  d = {d.x * turn.cos - d.y * turn.sin, d.x * turn.sin + d.y * turn.cos};
  const RelaxedDirections given = relaxDirections(asked, f.frequency, f.waves, f.cells, params, RunContext(1)).value();
  for (int y = -3; y <= 3; ++y) {
    for (int x = -3; x <= 3; ++x) {
      const std::size_t i = grid.index(cx + x, cy + y);
      const float weight = static_cast<float>(std::max(3 - std::abs(x), 0) * std::max(3 - std::abs(y), 0)) / 81;
      CHECK(std::abs(cross(given.lines.direction[i], asked.direction[i]) - 0.05f * weight) < 4e-4f);
    }
  }
}

TEST_CASE("parallel lines keep one spacing") {
  const Stages f = fieldsOf(square(12, mapOf(1, [](double, double) { return 0.4; })));
  for (const float frequency : f.frequency) CHECK(frequency == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("where beads fan out they widen, by no more than asked, and the signs of lines mean nothing") {
  // Beads on rays from a point left of the page: at distance r their spacing wants to be proportional to r.
  PlateInput input = square(12, mapOf(256, [](double x, double y) { return std::atan2(12 * y - 6, 12 * x + 14); }));
  ToolpathParams params;
  params.perimeterMode = PerimeterMode::None;
  params.spacingVariation = 0.25;
  Stages f = fieldsOf(input, params);
  const Grid& grid = f.lines.grid;
  const auto meanAt = [&](double x) {
    double sum = 0;
    int count = 0;
    for (int iy = 0; iy < grid.ny; ++iy) {
      for (int ix = 0; ix < grid.nx; ++ix) {
        const Vec2 p = grid.centre(ix, iy);
        if (std::abs(p.x - x) > 0.5 || std::abs(p.y - 6) > 3) continue;
        sum += std::log(f.frequency[grid.index(ix, iy)]);
        ++count;
      }
    }
    return sum / count;
  };
  // On a line of length 30 tau the best u of (u' - kappa)² + (u / 8 tau)² is kappa 8 tau sinh(x / 8 tau) / cosh(15 /
  // 8), x from the middle; 7.5 tau to either side that is 0.345 of log(r2 / r1).
  const double wanted = std::log((14 + 9.0) / (14 + 3.0));
  CHECK((meanAt(3) - meanAt(9)) / wanted == about(0.345, 0.15));
  for (const float frequency : f.frequency) CHECK(std::abs(std::log(frequency)) <= 0.2501f);

  // Asked for less than the best u, it goes as far as it may at both ends and no further.
  params.spacingVariation = 0.05;
  const std::vector<float> held = spacingField(f.lines, f.cells, params, RunContext(1)).value();
  const auto [low, high] = std::minmax_element(held.begin(), held.end());
  CHECK(std::log(*low) == about(-0.05, 1e-3));
  CHECK(std::log(*high) == about(0.05, 1e-3));
  params.spacingVariation = 0.25;

  LineField flipped = f.lines;
  for (std::size_t i = 0; i < flipped.direction.size(); i += 3) flipped.direction[i] = -flipped.direction[i];
  CHECK(spacingField(flipped, f.cells, params, RunContext(1)).value() == f.frequency);

  const PlateInput waves = square(40, scenes::waves());
  params.order = BeadOrder::Plain;  // the even order adds and takes turns of its own
  const auto turnsWith = [&](double bend) {
    params.spacingVariation = bend;
    const ToolpathResult plate = generateToolpath(waves, params, RunContext(2)).value();
    return measureToolpath(plate.toolpath, waves, params, RunContext(2)).value().uTurns;
  };
  CHECK(turnsWith(0.2) < 0.95 * static_cast<double>(turnsWith(0)));
}
