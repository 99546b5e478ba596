// Traces outlines of pictures by marching squares, and scales shapes.
#include "sillon/geometry/shape.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "base/refused.hpp"
#include "geometry/shape_points.hpp"

namespace sillon {
namespace {

constexpr std::int64_t kMaxMaskPoints = 4'000'000;

// Field whose zero level is the mask's outline: brightness or opacity of pixels minus 50 %, negative outside.
class MaskField {
 public:
  explicit MaskField(const Image& image) : image_(image) {
    const bool hasAlpha = image.channels == 2 || image.channels == 4;
    if (hasAlpha) {
      const std::size_t channels = image.channels;
      for (std::size_t i = channels - 1; i < image.samples.size() && !useAlpha_; i += channels) {
        useAlpha_ = image.samples[i] != 65535;
      }
    }
  }

  [[nodiscard]] double at(int x, int y) const {
    if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return -kHalf;
    if (useAlpha_) return image_.at(x, y, image_.channels - 1) - kHalf;
    if (image_.channels < 3) return image_.at(x, y, 0) - kHalf;
    // Rec. 709 luma with integer weights, so that white is exactly 65535.
    const int luma = 2126 * image_.at(x, y, 0) + 7152 * image_.at(x, y, 1) + 722 * image_.at(x, y, 2);
    return luma / 10000.0 - kHalf;
  }
  [[nodiscard]] bool inside(int x, int y) const { return at(x, y) >= 0; }

 private:
  static constexpr double kHalf = 32767.5;
  const Image& image_;
  bool useAlpha_ = false;
};

enum class CellSide { Top, Right, Bottom, Left };

// Returns the side through which a contour leaves a cell that it enters through `entry`. The cell's corners are the
// samples (x, y) .. (x+1, y+1).
CellSide exitOf(const MaskField& field, int x, int y, CellSide entry) {
  const double topLeft = field.at(x, y);
  const double topRight = field.at(x + 1, y);
  const double bottomLeft = field.at(x, y + 1);
  const double bottomRight = field.at(x + 1, y + 1);
  const std::array<bool, 4> crossed{(topLeft >= 0) != (topRight >= 0), (topRight >= 0) != (bottomRight >= 0),
                                    (bottomLeft >= 0) != (bottomRight >= 0), (topLeft >= 0) != (bottomLeft >= 0)};
  if (crossed[0] && crossed[1] && crossed[2] && crossed[3]) {
    // A saddle: the mean decides whether the two inner corners join; the contour goes round a corner of the other kind.
    const bool joined = topLeft + topRight + bottomLeft + bottomRight >= 0;
    const bool aroundTopLeft = (topLeft >= 0) != joined;
    constexpr std::array<CellSide, 4> kTopLeft{CellSide::Left, CellSide::Bottom, CellSide::Right, CellSide::Top};
    constexpr std::array<CellSide, 4> kTopRight{CellSide::Right, CellSide::Top, CellSide::Left, CellSide::Bottom};
    return (aroundTopLeft ? kTopLeft : kTopRight)[toSize(entry)];
  }
  for (const CellSide side : {CellSide::Top, CellSide::Right, CellSide::Bottom, CellSide::Left}) {
    if (side != entry && crossed[toSize(side)]) return side;
  }
  return entry;  // unreachable, because crossings come in pairs
}

// Follows the zero level of a mask. Every ring crosses horizontal edges (between samples side by side), so that marking
// these suffices to find each ring once.
class MaskTracer {
 public:
  MaskTracer(const Image& image, double scale)
      : field_(image),
        width_(image.width),
        height_(image.height),
        scale_(scale),
        visited_(cellCount(width_ + 1, height_)) {}

  // Traces all rings. Returns false if they have too many points.
  bool trace(std::vector<Ring>& rings) {
    std::int64_t points = 0;
    for (int y = 0; y < height_; ++y) {
      bool left = false;
      for (int x = -1; x < width_; ++x) {
        const bool right = field_.inside(x + 1, y);
        if (left != right && !visited_[edge(x, y)]) {
          Ring ring = follow(x, y, left, kMaxMaskPoints - points);
          points += static_cast<std::int64_t>(ring.size());
          if (points > kMaxMaskPoints) return false;
          if (ring.size() >= 3) rings.push_back(std::move(ring));
        }
        left = right;
      }
    }
    return true;
  }

 private:
  [[nodiscard]] std::size_t edge(int x, int y) const { return indexOf(x + 1, y, width_ + 1); }

  // Converts sample units (y down, pixel centres at integers) to mm.
  [[nodiscard]] Vec2 world(double x, double y) const {
    return snapped(Vec2{(x + 0.5) * scale_, (height_ - y - 0.5) * scale_});
  }

  // Returns the point where the level crosses a side of a cell.
  [[nodiscard]] Vec2 crossing(int x, int y, CellSide side) const {
    if (side == CellSide::Bottom) ++y;
    if (side == CellSide::Right) ++x;
    const bool horizontal = side == CellSide::Top || side == CellSide::Bottom;
    const double a = field_.at(x, y);
    const double b = horizontal ? field_.at(x + 1, y) : field_.at(x, y + 1);
    const double t = a / (a - b);
    return horizontal ? world(x + t, y) : world(x, y + t);
  }

  // Follows a ring, with the inside always on the same hand. Gives up after `limit` points.
  Ring follow(int startX, int startY, bool leftInside, std::int64_t limit) {
    Ring ring;
    // Passes the start edge downwards if its left sample is inside, upwards otherwise.
    int x = startX;
    int y = leftInside ? startY : startY - 1;
    CellSide entry = leftInside ? CellSide::Top : CellSide::Bottom;
    while (true) {
      if (entry == CellSide::Top || entry == CellSide::Bottom) {
        const std::size_t mark = edge(x, entry == CellSide::Top ? y : y + 1);
        if (visited_[mark]) break;
        visited_[mark] = true;
      }
      add(ring, crossing(x, y, entry));
      if (static_cast<std::int64_t>(ring.size()) > limit) return ring;
      const CellSide exit = exitOf(field_, x, y, entry);
      // In a corner cell of the picture, add the corner itself: otherwise the outline would cut it off.
      if ((x < 0 || x == width_ - 1) && (y < 0 || y == height_ - 1)) {
        const bool across = entry == CellSide::Top || entry == CellSide::Bottom;
        add(ring, {crossing(x, y, across ? entry : exit).x, crossing(x, y, across ? exit : entry).y});
      }
      switch (exit) {
        case CellSide::Top:
          --y;
          entry = CellSide::Bottom;
          break;
        case CellSide::Right:
          ++x;
          entry = CellSide::Left;
          break;
        case CellSide::Bottom:
          ++y;
          entry = CellSide::Top;
          break;
        case CellSide::Left:
          --x;
          entry = CellSide::Right;
          break;
      }
    }
    dropRepeatedPoints(ring);
    while (ring.size() > 3 && straight(ring[ring.size() - 2], ring.back(), ring.front())) ring.pop_back();
    if (ring.size() > 3 && straight(ring.back(), ring[0], ring[1])) ring.erase(ring.begin());
    return ring;
  }

  static bool straight(Vec2 a, Vec2 b, Vec2 c) { return (a.x == b.x && b.x == c.x) || (a.y == b.y && b.y == c.y); }

  // Adds a point. Of straight borders along rows and columns, which are most of many masks, only the ends are kept.
  static void add(Ring& ring, Vec2 p) {
    if (!ring.empty() && ring.back() == p) return;
    if (ring.size() >= 2 && straight(ring[ring.size() - 2], ring.back(), p)) ring.pop_back();
    ring.push_back(p);
  }

  MaskField field_;
  int width_;
  int height_;
  double scale_;
  std::vector<bool> visited_;  // horizontal edges of rows 0 .. height-1; nothing is inside beyond them
};

Error heightError(double width, double height) {
  return refusedArgument("HeightOutOfRange", {{"width", width}, {"height", height}, {"most", kMaxSize}});
}

}  // namespace

Result<Shape> shapeFromMask(const Image& mask, double width) {
  if (mask.width <= 0 || mask.height <= 0 || mask.channels < 1 || mask.channels > 4 ||
      mask.samples.size() != cellCount(mask.width, mask.height) * toSize(mask.channels)) {
    return refusedArgument("MaskWithoutPixels");
  }
  if (!validSize(width)) return sizeError("shape.size.x", width);
  const double scale = width / mask.width;
  const double height = snapped(mask.height * scale);
  if (!validSize(height)) return heightError(width, height);

  Shape shape;
  shape.page = {width, height};
  FilledPath path;
  if (!MaskTracer(mask, scale).trace(path.rings)) {
    return refused(ErrorCode::TooLarge, "MaskTooDetailed");
  }
  if (path.rings.empty()) {
    return refused(ErrorCode::EmptyShape, "MaskEmpty");
  }
  shape.paths.push_back(std::move(path));
  return shape;
}

Bounds bounds(const Shape& shape) {
  Bounds box;
  for (const FilledPath& path : shape.paths) {
    for (const Ring& ring : path.rings) {
      for (const Vec2 p : ring) box.add(p);
    }
  }
  return box;
}

}  // namespace sillon
