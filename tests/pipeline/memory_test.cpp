// Memory that a plate takes while it is made, for which docs/internals/performance.md promises a bound per cell, and
// what reading a drawing takes.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>

#include "geometry/signed_distance.hpp"
#include "input/shaped_line.hpp"
#include "input/svg.hpp"
#include "sillon/pipeline/pipeline.hpp"
#include "support/scenes.hpp"

using namespace sillon;

namespace {

constexpr std::size_t kHeader = 16;  // keeps the alignment that new promises

std::atomic<std::size_t> held{0};
std::atomic<std::size_t> most{0};

void* counted(std::size_t size) {
  auto* const block = static_cast<std::byte*>(std::malloc(size + kHeader));
  if (block == nullptr) throw std::bad_alloc();
  *reinterpret_cast<std::size_t*>(block) = size;
  const std::size_t now = held += size;
  std::size_t before = most;
  while (now > before && !most.compare_exchange_weak(before, now)) {
  }
  return block + kHeader;
}

void uncounted(void* p) noexcept {
  if (p == nullptr) return;
  std::byte* const block = static_cast<std::byte*>(p) - kHeader;
  held -= *reinterpret_cast<std::size_t*>(block);
  std::free(block);
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* p) noexcept { uncounted(p); }
void operator delete[](void* p) noexcept { uncounted(p); }
void operator delete(void* p, std::size_t) noexcept { uncounted(p); }
void operator delete[](void* p, std::size_t) noexcept { uncounted(p); }

TEST_CASE("an outline that is too detailed for the memory is refused before it takes more") {
  // Every piece of a circle is nearest to some place about its middle.
  const Shape disc = scenes::shapeOf({scenes::circle({50, 50}, 50, 40000)}, {100, 100});
  const Outline outline = resolveOutline(disc).value();
  for (const int threads : {1, 2}) {
    CAPTURE(threads);
    RunContext run(threads);
    run.limitMemory(30e6);
    const std::size_t before = held;
    most = before;
    const auto border = buildBorderIndex(outline, makeGrid(outline.bounds, 0.4), run);
    REQUIRE(!border.ok());
    CHECK(border.error().code == ErrorCode::OutOfMemory);
    CHECK(static_cast<double>(most - before) < 30e6);
  }
}

TEST_CASE("a plate takes at most 120 bytes a cell while it is made") {
  const PlateInput input =
      scenes::plate(scenes::shapeOf({scenes::rectangle({0, 0}, {100, 100})}, {100, 100}), scenes::waves());
  for (const PerimeterMode mode : {PerimeterMode::Count, PerimeterMode::Soft}) {
    for (const int threads : {1, 2}) {
      CAPTURE(static_cast<int>(mode));
      CAPTURE(threads);
      ToolpathParams params;
      params.perimeterMode = mode;
      const RunContext run(threads);
      const std::size_t before = held;
      most = before;
      const auto plate = generateToolpath(input, params, run);
      REQUIRE(plate.ok());
      const double cells = static_cast<double>(plate.value().nx) * plate.value().ny;
      CHECK(static_cast<double>(most - before) / cells <= 120);
      CHECK(static_cast<double>(most - before) / cells > 60);  // it counts
    }
  }
}

TEST_CASE("a session keeps at most 45 bytes a cell, and an edit peaks no higher than a plate from nothing") {
  PlateInput input =
      scenes::plate(scenes::shapeOf({scenes::rectangle({0, 0}, {100, 100})}, {100, 100}), scenes::waves());
  const RunContext run(1);
  const std::size_t before = held;
  Session session;
  double cells = 0;
  {
    const auto plate = session.generateToolpath(input, {}, run);
    REQUIRE(plate.ok());
    cells = static_cast<double>(plate.value().nx) * plate.value().ny;
  }
  CHECK(static_cast<double>(held - before) / cells <= 45);
  CHECK(static_cast<double>(held - before) / cells > 15);  // it counts
  input.directions.angle[0] += 9000;
  most = held.load();
  REQUIRE(session.generateToolpath(input, {}, run).ok());
  CHECK(static_cast<double>(most - before) / cells <= 120);
}

TEST_CASE("the letters of a drawing share the style and the outlines in which they are set") {
  constexpr std::size_t kLetters = 5000;
  std::string places, dashes;
  for (std::size_t k = 0; k < kLetters; ++k) places += std::to_string(k % 90) + " ";
  for (int k = 0; k < 1000; ++k) dashes += "9 ";
  SvgOptions options;
  std::size_t lists = 0;
  options.letters.choose = [&](std::string_view families) {
    lists += families.size();
    return DrawingFont{"One", false};
  };
  options.letters.shape = [](const DrawingFont&, const std::string& line) -> Result<ShapedLine> {
    ShapedLine shaped;
    shaped.outlines = {"M0 0H500V700H0Z" + std::string(10'000, ' ')};
    shaped.letters.assign(line.size(), {0, {}, 600});
    return shaped;
  };
  const auto takes = [&](const std::string& text) {
    const std::string drawing = "<svg width='99mm' height='99mm' viewBox='0 0 99 99'>" + text + "</svg>";
    const std::size_t before = held;
    most = before;
    const auto shape = readSvg(drawing, options);
    REQUIRE(shape.ok());
    CHECK(shape.value().paths.size() == kLetters);
    return most - before;
  };
  const std::string families(200'000, 'a');
  CHECK(takes("<text y='20' font-family='" + families + "' x='" + places + "'>" + std::string(kLetters, 'A') +
              "</text>") < 10e6);
  CHECK(lists <= families.size());
  std::string parts;
  for (std::size_t k = 0; k < kLetters; ++k) parts += "<tspan x='" + std::to_string(k % 90) + "'>A</tspan>";
  CHECK(takes("<text y='20' stroke-dasharray='" + dashes + "'>" + parts + "</text>") < 10e6);
}
