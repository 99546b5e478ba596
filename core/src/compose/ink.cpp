#include "compose/ink.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "base/exact_math.hpp"
#include "compose/visible.hpp"
#include "geometry/signed_distance.hpp"
#include "input/stored_angle.hpp"
#include "sillon/geometry/outline.hpp"
#include "sillon/pictures/pictures.hpp"

namespace sillon {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

Vec2f lineOf(double radians) {
  const exact::SinCos turn = exact::sinCos(2 * radians);
  return {static_cast<float>(turn.cos), static_cast<float>(turn.sin)};
}

CodeLines codeLines(const Layer& layer) {
  return {lineOf(layer.angle * kDegree), lineOf(layer.ground.value_or(layer.angle + 90) * kDegree)};
}

namespace {

/// The line of a direction of any length > 0.
Vec2f lineAlong(Vec2 direction) {
  const double square = dot(direction, direction);
  if (!(square > 0)) return {1, 0};
  return {static_cast<float>((direction.x * direction.x - direction.y * direction.y) / square),
          static_cast<float>(2 * direction.x * direction.y / square)};
}

Vec2f turned(Vec2f line, Vec2f by) { return {line.x * by.x - line.y * by.y, line.x * by.y + line.y * by.x}; }

using LineAt = std::function<Vec2f(Vec2 page)>;

LineAt oneLine(double degrees) {
  return [line = lineOf(degrees * kDegree)](Vec2 /*anywhere*/) { return line; };
}

/// Along contours of equal distance from a border, on cells of half a spacing.
Result<LineAt> along(const Shape& shape, double spacing, const RunContext& run) {
  const Result<Outline> outline = resolveOutline(shape);
  if (!outline) return outline.error();
  Bounds page;
  page.add({0, 0});
  page.add(shape.page);
  const Grid grid = makeGrid(page, spacing);
  const Result<BorderIndex> index = buildBorderIndex(outline.value(), grid, run);
  if (!index) return index.error();
  Result<SignedDistanceField> field = signedDistanceField(shape, index.value(), grid, run);
  if (!field) return field.error();
  return LineAt([field = std::move(field).value()](Vec2 at) {
    const Vec2f normal = field.normal[field.grid.cellAt(at)];
    return lineAlong(Vec2{-static_cast<double>(normal.y), static_cast<double>(normal.x)});
  });
}

/// Tells which texel of a picture lies at a place, in the layer's own millimetres.
template <class Picture>
std::optional<std::size_t> texelOf(const Picture& picture, Vec2 own, Vec2 size) {
  const double x = (own.x / size.x + 0.5) * picture.width, y = (0.5 - own.y / size.y) * picture.height;
  if (!(x >= 0 && y >= 0 && x < picture.width && y < picture.height)) return std::nullopt;
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
}

/// The directions that show a picture under its lamp, solved for within its box and the plate.
class SolvedPicture {
 public:
  SolvedPicture(const Layer& layer, const LayerContent& content, const Placement& place, const LayerPlate& plate)
      : layer_(layer), content_(content), place_(place), plate_(plate) {}

  /// \param picture  what is known of it; filled.
  Result<LineAt> solve(LayerPicture& picture, const RunContext& run) {
    const Project& project = plate_.project;
    Bounds box = bounds(place_.box(plate_.shape.page));
    origin_ = {std::max(box.min.x, 0.0), std::max(box.min.y, 0.0)};
    const Vec2 end{std::min(box.max.x, plate_.shape.page.x), std::min(box.max.y, plate_.shape.page.y)};
    size_ = end - origin_;
    if (!(size_.x > 0 && size_.y > 0)) return oneLine(layer_.angle);
    const double cell = project.toolpath.spacing / 2;
    const int width = std::clamp(static_cast<int>(std::ceil(size_.x / cell)), 1, kMostTexels);
    const int height = std::clamp(static_cast<int>(std::ceil(size_.y / cell)), 1, kMostTexels);
    const bool again = !picture.solved.value.empty();
    picture.lamp = lamp();
    picture.origin = origin_;
    picture.size = size_;
    const LitPicture lit{again ? picture.solved : tonesOn(width, height), picture.lamp, false};
    const InsideCells inside = [this](int columns, int rows) { return insideOn(columns, rows); };
    InversionParams inversion = inversionOf(project.pictures);
    if (again) inversion.level = picture.level;
    auto solved =
        solveDirections({&lit, 1}, roughnessOf(project), {size_, project.toolpath.spacing, inside}, inversion, run);
    if (!solved) return solved.error();
    if (!again) {
      picture.level = solved.value().level;
      picture.asked = std::move(solved.value().shown[0]);
      picture.solved = picture.asked;
    }
    return LineAt([map = std::move(solved.value().directions), origin = origin_, size = size_](Vec2 at) {
      const auto texel = texelOf(map, at - origin - size * 0.5, size);
      return texel ? lineOf(angleOf(map.angle[*texel])) : Vec2f{1, 0};
    });
  }

 private:
  [[nodiscard]] Lamp lamp() const {
    const PictureParams& pictures = plate_.project.pictures;
    Lamp lamp;
    lamp.slope = pictures.lampSize;
    std::optional<Vec2> asked = layer_.lamp;
    if (!asked && !pictures.files.empty()) asked = pictures.files[0].lamp;
    if (asked) {
      lamp.azimuth = asked->x;
      lamp.elevation = asked->y;
    }
    return lamp;
  }
  [[nodiscard]] Vec2 centre(int x, int y, int width, int height) const {
    return origin_ + Vec2{(x + 0.5) * size_.x / width, (height - y - 0.5) * size_.y / height};
  }
  /// Means over what a cell covers: the picture shrinks first, then its nearest texel is taken.
  [[nodiscard]] Tones tonesOn(int width, int height) const {
    const Tones& given = *content_.tones;
    const double cell = size_.x / width;
    const int columns = std::clamp(static_cast<int>(std::lround(content_.size.x / cell)), 1, kMostTexels);
    const int rows = std::clamp(static_cast<int>(std::lround(content_.size.y / cell)), 1, kMostTexels);
    const Tones tones = resampled(given, columns, rows);
    Tones out{width, height, {}};
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto texel = texelOf(tones, place_.toOwn(centre(x, y, width, height)), content_.size);
        out.value.push_back(texel ? tones.value[*texel] : 1);
      }
    }
    return out;
  }
  [[nodiscard]] std::vector<char> insideOn(int width, int height) const {
    Shape window = plate_.shape;
    for (FilledPath& path : window.paths) {
      for (Ring& ring : path.rings) {
        for (Vec2& point : ring) point = point - origin_;
      }
    }
    window.page = size_;
    std::vector<char> inside = insideCells(window, width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Vec2 own = place_.toOwn(centre(x, y, width, height));
        const bool covered = std::abs(own.x) <= content_.size.x / 2 && std::abs(own.y) <= content_.size.y / 2;
        if (!covered)
          inside[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] = 0;
      }
    }
    const bool none = std::find(inside.begin(), inside.end(), 1) == inside.end();
    const bool all = std::find(inside.begin(), inside.end(), 0) == inside.end();
    return none || all ? std::vector<char>() : inside;
  }

  static constexpr int kMostTexels = 4096;  // as solveDirections
  const Layer& layer_;
  const LayerContent& content_;
  const Placement& place_;
  const LayerPlate& plate_;
  Vec2 origin_;
  Vec2 size_;
};

LineAt radial(const Layer& layer, const Placement& place) {
  return [middle = place.middle(), by = lineOf(layer.angle * kDegree)](Vec2 at) {
    return turned(lineAlong(at - middle), by);
  };
}

LineAt waves(const Layer& layer, const Placement& place) {
  const double main = layer.angle * kDegree + place.rotation();
  const exact::SinCos way = exact::sinCos(main);
  const double turns = 2 * std::numbers::pi / layer.waveLength, swing = layer.amplitude * kDegree;
  return [=, middle = place.middle()](Vec2 at) {
    const Vec2 from = at - middle;
    return lineOf(main + swing * exact::sin((from.x * way.cos + from.y * way.sin) * turns));
  };
}

LineAt mapped(const LayerContent& content, const Placement& place) {
  return [&content, &place](Vec2 at) {
    const auto texel = texelOf(*content.map, place.toOwn(at), content.size);
    if (!texel) return Vec2f{1, 0};
    const double own = angleOf(content.map->angle[*texel]);
    return lineOf(place.rotation() + (place.mirror() ? -own : own));
  };
}

LineAt coded(const Layer& layer, const LayerContent& content, const Placement& place) {
  return [lines = codeLines(layer), &content, &place](Vec2 at) {
    const auto texel = texelOf(*content.modules, place.toOwn(at), content.size);
    return texel && content.modules->samples[*texel] == 0 ? lines.dark : lines.light;
  };
}

/// Directions of a layer wherever it shows.
Result<LineAt> linesOf(const Layer& layer, const LayerContent& content, const Placement& place, const LayerPlate& plate,
                       LayerPicture& picture, const RunContext& run) {
  const double spacing = plate.project.toolpath.spacing;
  switch (layer.kind) {
    case LayerKind::Map:
      return mapped(content, place);
    case LayerKind::Picture:
      return SolvedPicture(layer, content, place, plate).solve(picture, run);
    case LayerKind::Qr:
      return coded(layer, content, place);
    case LayerKind::Pattern:
      if (layer.pattern == LayerPattern::Radial) return radial(layer, place);
      if (layer.pattern == LayerPattern::Waves) return waves(layer, place);
      return along(place.stretched(*content.shape, plate.shape.page), spacing, run);
    case LayerKind::Text:
    case LayerKind::Drawing:
      if (layer.fill == LayerFill::Along) return along(place.stretched(*content.shape, plate.shape.page), spacing, run);
      break;
    case LayerKind::Border:
      if (layer.fill == LayerFill::Along) return along(plate.shape, spacing, run);
      break;
    case LayerKind::Direction:
      break;
  }
  return oneLine(layer.angle);
}

/// Share that a layer has in each cell: 1 inside and 0 outside of it, and in between over the width of its soft edge.
std::vector<float> coverOf(const Cells& shown, const LayerPlate& plate, double soft) {
  std::vector<float> cover(shown.begin(), shown.end());
  const double cell = plate.shape.page.x / plate.width;
  if (!(soft > cell)) return cover;
  Cells walls = shown;
  const std::vector<float> outside = chamferDistance(walls, plate.width, plate.height);
  for (char& wall : walls) wall = wall == 0 ? 1 : 0;
  const std::vector<float> inside = chamferDistance(walls, plate.width, plate.height);
  const auto scale = static_cast<float>(cell / soft);
  for (std::size_t k = 0; k < cover.size(); ++k) {
    const float depth = shown[k] != 0 ? inside[k] - 0.5F : 0.5F - outside[k];
    cover[k] = std::clamp(0.5F + depth * scale, 0.0F, 1.0F);
  }
  return cover;
}

/// \param line  none: across what is there.
void blend(LayerStack::Texel& texel, std::optional<Vec2f> line, float cover) {
  const float kept = line ? 1 - cover : 1 - 2 * cover;  // across a line is its negative
  texel.line = texel.line * kept;
  if (line) texel.line = texel.line + *line * cover;
  texel.through *= kept;
  texel.cover = cover + texel.cover * (1 - cover);
}

}  // namespace

Cells borderCells(const LayerPlate& plate, double width) {
  Cells cells = insideCells(plate.shape, plate.width, plate.height);
  const double cell = plate.shape.page.x / plate.width;
  // Cells beyond the page are outside, too: a margin of one cell.
  const int columns = plate.width + 2, rows = plate.height + 2;
  Cells outside(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 1);
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x + 1);
  };
  const auto own = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(plate.width) + static_cast<std::size_t>(x);
  };
  for (int y = 0; y < plate.height; ++y) {
    for (int x = 0; x < plate.width; ++x) outside[at(x, y)] = cells[own(x, y)] == 0 ? 1 : 0;
  }
  const std::vector<float> depth = chamferDistance(outside, columns, rows);
  for (int y = 0; y < plate.height; ++y) {
    for (int x = 0; x < plate.width; ++x) {
      if ((depth[at(x, y)] - 0.5F) * cell > width) cells[own(x, y)] = 0;
    }
  }
  return cells;
}

bool unbounded(const Layer& layer) {
  const bool echo = layer.kind == LayerKind::Pattern && layer.pattern == LayerPattern::Echo;
  const bool formula = layer.kind == LayerKind::Direction || layer.kind == LayerKind::Pattern;
  return layer.mask == LayerMask::Own && (echo || (formula && layer.size == Vec2{}));
}

Region regionOf(const Layer& layer, const LayerContent& content, const Placement& place, const LayerPlate& plate) {
  const Vec2 page = plate.shape.page;
  const auto cellsOf = [&](const Shape& shape) { return insideCells(shape, plate.width, plate.height); };
  const auto everywhere = [&] {
    return Cells(static_cast<std::size_t>(plate.width) * static_cast<std::size_t>(plate.height), 1);
  };
  Region region;
  if (layer.kind == LayerKind::Border) {
    region.shown = borderCells(plate, layer.width);
  } else if (layer.mask == LayerMask::Page || unbounded(layer)) {
    region.shown = everywhere();
  } else {
    region.shown =
        cellsOf(layer.mask == LayerMask::Disc ? place.stretched(makeDisc(200).value(), page) : place.box(page));
  }
  if (layer.mask == LayerMask::Inside || layer.mask == LayerMask::Outside) {
    const Cells mask = cellsOf(place.stretched(*content.mask, page));
    const bool inside = layer.mask == LayerMask::Inside;
    if (!inside && layer.kind != LayerKind::Map && layer.kind != LayerKind::Picture &&
        layer.kind != LayerKind::Border) {
      region.shown = everywhere();
    }
    for (std::size_t k = 0; k < mask.size(); ++k) {
      if ((mask[k] != 0) != inside) region.shown[k] = 0;
    }
  }
  if (outlined(layer.kind)) {
    region.content = cellsOf(place.stretched(*content.shape, page));
    for (std::size_t k = 0; k < region.shown.size(); ++k) {
      if (!layer.ground && region.content[k] == 0) region.shown[k] = 0;
      if (region.shown[k] == 0) region.content[k] = 0;
    }
  }
  return region;
}

std::optional<Error> drawLayer(std::size_t number, const LayerContent& content, const Placement& place,
                               const LayerPlate& plate, LayerStack& stack, const RunContext& run) {
  const Layer& layer = plate.project.layers[number];
  LayerPicture picture;
  const auto known = stack.pictures.find(number);
  if (known != stack.pictures.end()) picture = known->second;
  const Result<LineAt> lines = linesOf(layer, content, place, plate, picture, run);
  if (!lines) return lines.error();
  const Region region = regionOf(layer, content, place, plate);
  const std::vector<float> cover = coverOf(region.shown, plate, layer.soft);
  const bool codes = layer.kind == LayerKind::Qr, across = hasFill(layer.kind) && layer.fill == LayerFill::Across;
  const Vec2 step{plate.shape.page.x / plate.width, plate.shape.page.y / plate.height};
  std::optional<Vec2f> ground;
  if (outlined(layer.kind) && layer.ground) ground = lineOf(*layer.ground * kDegree);
  stack.inks.push_back(inkOf(number, content, place, plate, region, stack));
  for (int y = 0; y < plate.height; ++y) {
    if (run.poll()) return Error{ErrorCode::Cancelled, "cancelled"};
    for (int x = 0; x < plate.width; ++x) {
      const std::size_t k =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(plate.width) + static_cast<std::size_t>(x);
      if (cover[k] == 0) continue;
      const bool drawn = region.content.empty() || region.content[k] != 0;
      const Vec2 at{(x + 0.5) * step.x, (plate.height - y - 0.5) * step.y};
      std::optional<Vec2f> line;
      if (!drawn && ground) {
        line = ground;
      } else if (!across) {
        line = lines.value()(at);
      }
      LayerStack::Texel& texel = stack.texels[k];
      if (cover[k] >= 0.5F) {
        texel.top = static_cast<std::uint8_t>(number + 1);
        texel.ink = !drawn ? LayerStack::Ink::None : codes ? LayerStack::Ink::Turned : inkOver(texel, line, ground);
      }
      blend(texel, line, cover[k]);
    }
  }
  // Beside the page, nothing has been solved for.
  if (!picture.solved.value.empty()) stack.pictures[number] = std::move(picture);
  return std::nullopt;
}

double thinShare(const Shape& shape, double spacing) {
  constexpr double kCellsPerBead = 4;
  constexpr double kMostCells = 2048;
  const double cell = std::max(spacing / kCellsPerBead, std::max(shape.page.x, shape.page.y) / kMostCells);
  const auto radius = static_cast<float>(spacing / cell);
  const int width = static_cast<int>(std::ceil(shape.page.x / cell)) + 2;
  const int height = static_cast<int>(std::ceil(shape.page.y / cell)) + 2;
  Shape padded = shape;  // a margin of one cell, since borders of the raster are no walls
  padded.page = {width * cell, height * cell};
  for (FilledPath& path : padded.paths) {
    for (Ring& ring : path.rings) {
      for (Vec2& point : ring) point = point + Vec2{cell, cell};
    }
  }
  const Cells inside = insideCells(padded, width, height);
  Cells walls = inside;
  for (char& wall : walls) wall = wall == 0 ? 1 : 0;
  const std::vector<float> depth = chamferDistance(walls, width, height);
  Cells core(inside.size(), 0);
  for (std::size_t k = 0; k < core.size(); ++k) core[k] = depth[k] > radius - 0.5F ? 1 : 0;
  const std::vector<float> fromCore = chamferDistance(core, width, height);
  std::size_t all = 0, lost = 0;
  for (std::size_t k = 0; k < core.size(); ++k) {
    if (inside[k] == 0) continue;
    ++all;
    if (fromCore[k] > 1.5F * radius) ++lost;  // square corners lie up to sqrt 2 radii from the core
  }
  return all == 0 ? 0 : static_cast<double>(lost) / static_cast<double>(all);
}

}  // namespace sillon
