#include "compose/visible.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "base/exact_math.hpp"
#include "compose/background.hpp"
#include "compose/lines.hpp"
#include "geometry/outline.hpp"
#include "text/qr_code.hpp"

namespace sillon {
namespace {

using Texel = LayerStack::Texel;
using Ink = LayerStack::Ink;
using Place = LayerStack::Place;

/// Lines 15 degrees or more apart are distinguishable under a lamp.
constexpr double kAlikeFrom = 0.8660254037844386;  // cosine of 30 degrees, twice that angle

bool alike(Vec2 a, Vec2 b) { return dot(a, b) >= kAlikeFrom * std::sqrt(dot(a, a) * dot(b, b)); }

/// Part of a raster that extends beyond the page: cells of `step` by `step` texels, row 0 on top.
struct Window {
  std::int64_t left = 0;  ///< texel of the lower left corner, counted from that of the page
  std::int64_t bottom = 0;
  int step = 1;  ///< odd, so that the middle of a cell is the middle of a texel
  int columns = 0;
  int rows = 0;
};

/// Returns the smallest window around a layer's box, with cells as small as the limit on their number allows.
Window windowAround(const Placement& place, const LayerPlate& plate) {
  constexpr std::int64_t kMostCells = 1 << 22;
  const Vec2 page = plate.shape.page;
  const Bounds box = bounds(place.box(page));
  const auto texel = [](double at, double side, int count) {
    return static_cast<std::int64_t>(std::floor(at / side * count));
  };
  Window window{texel(box.min.x, page.x, plate.width), texel(box.min.y, page.y, plate.height)};
  const std::int64_t across = texel(box.max.x, page.x, plate.width) + 1 - window.left;
  const std::int64_t up = texel(box.max.y, page.y, plate.height) + 1 - window.bottom;
  const auto cells = [&](std::int64_t texels) { return (texels + window.step - 1) / window.step; };
  while (cells(across) * cells(up) > kMostCells) window.step += 2;
  window.columns = static_cast<int>(cells(across));
  window.rows = static_cast<int>(cells(up));
  return window;
}

/// Tells whether a layer's region ends at the page, so that nothing of it lies beyond.
bool endsAtPage(const Layer& layer) {
  const bool everywhere = layer.mask == LayerMask::Page || layer.mask == LayerMask::Outside || unbounded(layer);
  return layer.as<BorderLayer>() != nullptr || (everywhere && !outlined(layer));
}

/// Ink of a layer in a window, counted by its place.
struct InkCount {
  std::size_t beside = 0;
  std::size_t underRim = 0;
  std::size_t open = 0;

  void add(Place place) { ++(place == Place::Open ? open : place == Place::UnderRim ? underRim : beside); }
};

/// Counts the ink in a window by its place.
InkCount countIn(const Window& window, const Region& region, const LayerStack& stack) {
  const Cells& drawn = region.content.empty() ? region.shown : region.content;
  InkCount count;
  for (int row = 0; row < window.rows; ++row) {
    for (int column = 0; column < window.columns; ++column) {
      if (drawn[indexOf(column, row, window.columns)] == 0) {
        continue;
      }
      const std::int64_t x = window.left + static_cast<std::int64_t>(column) * window.step + window.step / 2;
      const std::int64_t up =
          window.bottom + static_cast<std::int64_t>(window.rows - 1 - row) * window.step + window.step / 2;
      const std::int64_t y = stack.height - 1 - up;
      const bool onPage = x >= 0 && y >= 0 && x < stack.width && y < stack.height;
      count.add(onPage ? stack.texels[toSize(y * stack.width + x)].place : Place::Beside);
    }
  }
  return count;
}

/// Finds the texel in the middle of each module of a code; -1 beside the page.
PlacedCode placedCode(const LayerContent& content, const Placement& place, const LayerPlate& plate) {
  const Image& modules = *content.modules;
  const Vec2 page = plate.shape.page;
  PlacedCode code{modules, {}};
  for (int row = 0; row < modules.height; ++row) {
    for (int column = 0; column < modules.width; ++column) {
      const Vec2 at = place.toPage({((column + 0.5) / modules.width - 0.5) * content.size.x,
                                    (0.5 - (row + 0.5) / modules.height) * content.size.y});
      const bool onPage = at.x >= 0 && at.y >= 0 && at.x < page.x && at.y < page.y;
      const int x = std::min(static_cast<int>(at.x / page.x * plate.width), plate.width - 1);
      const int y = std::min(static_cast<int>((1 - at.y / page.y) * plate.height), plate.height - 1);
      code.texels.push_back(onPage ? y * plate.width + x : -1);
    }
  }
  return code;
}

/// A stack of layers on the directions below it.
class LaidLayers {
 public:
  LaidLayers(const LayerStack& stack, const DirectionMap& below)
      : stack_(stack), background_(below, stack.width, stack.height) {}

  [[nodiscard]] Vec2 below(std::size_t k) const {
    const std::size_t width = stack_.width;
    const auto x = static_cast<int>(k % width), y = static_cast<int>(k / width);
    const exact::SinCos turn = exact::sinCos(2 * angleOf(background_.angleAt(x, y)));
    return {turn.cos, turn.sin};
  }
  [[nodiscard]] Vec2 line(std::size_t k) const {
    const Texel& texel = stack_.texels[k];
    const Vec2 own = wide(texel.line);
    return texel.through == 0 ? own : own + below(k) * static_cast<double>(texel.through);
  }

 private:
  const LayerStack& stack_;
  Background background_;
};

/// Tells whether a code can be read. \param spacing  spacing of the beads [mm]; narrower modules contain none.
bool reads(const PlacedCode& code, const Layer& layer, double module, double spacing, const LayerStack& stack,
           const LaidLayers& laid) {
  constexpr double kContrast = 0.5;  // contrast of directions 30 degrees apart, 1 - cos 60 degrees
  constexpr double kClear = 0.25;    // share of the way from midway between the directions to either
  const CodeLines lines = codeLines(*layer.as<CodeLayer>());
  const Vec2 dark = wide(lines.dark), light = wide(lines.light);
  const double contrast = 1 - dot(dark, light);
  if (contrast < kContrast || module < spacing) return false;
  std::vector<char> wrong;
  for (std::size_t k = 0; k < code.texels.size(); ++k) {
    bool right = false;
    const int texel = code.texels[k];
    if (texel >= 0 && stack.texels[texel].place == Place::Open) {
      const Vec2 seen = laid.line(texel);
      const double nearer = dot(seen, dark - light);
      right = (code.modules.samples[k] == 0 ? nearer : -nearer) >= kClear * contrast;
    }
    wrong.push_back(right ? 0 : 1);
  }
  return qrReads(code.modules, wrong);
}

}  // namespace

void markPlate(const LayerPlate& plate, LayerStack& stack) {
  const Cells inside = insideCells(plate.shape, plate.width, plate.height);
  const PrintParams& print = plate.project.print;
  Cells rim;
  if (print.rim > 0 && print.showSide != ShowSide::Bed) {
    const double line = plate.project.printer.nozzle;
    rim = borderCells(plate, rimLoops(print, line) * line);
  }
  for (std::size_t k = 0; k < inside.size(); ++k) {
    const bool hidden = !rim.empty() && rim[k] != 0;
    stack.texels[k].place = inside[k] == 0 ? Place::Beside : hidden ? Place::UnderRim : Place::Open;
    if (stack.texels[k].place == Place::Open) ++stack.open;
  }
}

LayerInk inkOf(std::size_t number, const LayerContent& content, const Placement& place, const LayerPlate& plate,
               const Region& region, const LayerStack& stack) {
  const Layer& layer = plate.project.layers[number];
  LayerInk ink;
  ink.layer = number;
  const InkCount drawn = countIn({0, 0, 1, plate.width, plate.height}, region, stack);
  InkCount count = drawn;
  const Window window = windowAround(place, plate);
  const bool onPage = window.left >= 0 && window.bottom >= 0 &&
                      window.left + window.columns * window.step <= plate.width &&
                      window.bottom + window.rows * window.step <= plate.height;
  if (!onPage && !endsAtPage(layer)) {
    const double width = plate.shape.page.x / plate.width, height = plate.shape.page.y / plate.height;
    Shape around;
    around.page = {window.columns * window.step * width, window.rows * window.step * height};
    const Vec2 origin{static_cast<double>(window.left) * width, static_cast<double>(window.bottom) * height};
    const Placement moved(layer, place.middle() - origin, place.size());
    const LayerPlate all{plate.project, around, window.columns, window.rows};
    count = countIn(window, regionOf(layer, content, moved, all), stack);
  }
  const auto whole = static_cast<double>(count.beside + count.underRim + count.open);
  ink.beside = whole > 0 ? static_cast<double>(count.beside) / whole : 1;
  ink.underRim = whole > 0 ? static_cast<double>(count.underRim) / whole : 0;
  ink.texels = drawn.open;
  ink.ground = drawn.open == stack.open;
  if (content.modules) ink.code = placedCode(content, place, plate);
  return ink;
}

Ink inkOver(const Texel& texel, std::optional<Vec2f> line, std::optional<Vec2f> ground) {
  if (!line && !ground) return Ink::Turned;
  if (line && ground) return alike(wide(*line), wide(*ground)) ? Ink::Alike : Ink::Turned;
  const double sign = line ? 1 : -1;
  if (std::abs(texel.through) > 0.5F) return sign * texel.through > 0 ? Ink::OnBelow : Ink::AcrossBelow;
  return alike(wide(line ? *line : *ground), wide(texel.line) * sign) ? Ink::Alike : Ink::Turned;
}

std::vector<SeenLayer> seeLayers(const Project& project, const std::vector<PlacedLayer>& placed,
                                 const Composition& composition) {
  const LayerStack& stack = composition.layers;
  std::vector<SeenLayer> seen;
  if (stack.inks.empty()) return seen;
  const LaidLayers laid(stack, composition.ground.directions);
  std::vector<std::size_t> onTop(project.layers.size() + 1), turned(onTop.size());
  for (std::size_t k = 0; k < stack.texels.size(); ++k) {
    const Texel& texel = stack.texels[k];
    if (texel.ink == Ink::None || texel.place != Place::Open) continue;
    bool differs = texel.ink == Ink::Turned;
    if (texel.ink == Ink::OnBelow || texel.ink == Ink::AcrossBelow) {
      const Layer& layer = project.layers[texel.top - 1U];
      const bool grounded = outlined(layer) && layer.as<LayerGround>()->ground;
      const Vec2 own =
          grounded ? wide(lineOf(*layer.as<LayerGround>()->ground * std::numbers::pi / 180)) : laid.line(k);
      differs = !alike(own, laid.below(k) * (texel.ink == Ink::OnBelow ? 1 : -1));
    }
    ++onTop[texel.top];
    if (differs) ++turned[texel.top];
  }
  for (const LayerInk& ink : stack.inks) {
    const Layer& layer = project.layers[ink.layer];
    SeenLayer& one = seen.emplace_back();
    one.layer = ink.layer + 1;
    one.size = placed[ink.layer].size;
    one.thin = placed[ink.layer].thin;
    one.kind = layer.kind();
    one.beside = ink.beside;
    one.underRim = ink.underRim;
    if (ink.texels > 0) {
      const double texel = (1 - ink.beside - ink.underRim) / static_cast<double>(ink.texels);
      one.covered = texel * static_cast<double>(ink.texels - onTop[one.layer]);
      // A layer that fills the plate is the ground for the others, whatever lies below.
      if (!ink.ground) one.alike = texel * static_cast<double>(onTop[one.layer] - turned[one.layer]);
    }
    if (!ink.code) continue;
    one.module = std::min(one.size.x, one.size.y) / ink.code->modules.width;
    one.readable = reads(*ink.code, layer, one.module, project.toolpath.spacing, stack, laid);
  }
  return seen;
}

}  // namespace sillon
