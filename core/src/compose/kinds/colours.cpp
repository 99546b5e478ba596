// Assigns a direction to each flat colour of a picture.
#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "compose/kinds/tones.hpp"

namespace sillon {
namespace {

constexpr int kFaintest = 16;  // opacity below which a pixel does not count as painted, of 255
constexpr int kAlike = 10;     // largest step between cells of a gradient, in any channel of 255
constexpr int kSame = 4;       // difference from a listed colour, in any channel of 255, that counts as rounding

struct ByteColour {
  int red = 0, green = 0, blue = 0;  ///< 0..255
  bool painted = false;
};

ByteColour colourAt(const Image& image, int x, int y) {
  const auto byte = [&](int channel) { return (image.at(x, y, channel) + 128) / 257; };
  const bool grey = image.channels < 3;
  const bool painted = image.channels % 2 == 1 || byte(image.channels - 1) >= kFaintest;
  return {byte(0), byte(grey ? 0 : 1), byte(grey ? 0 : 2), painted};
}

/// Parses a colour. \param text  "#rrggbb"
ByteColour colourOf(const std::string& text) {
  int all = 0;
  std::from_chars(text.data() + 1, text.data() + text.size(), all, 16);
  return {all >> 16, all >> 8 & 255, all & 255, true};
}

/// Returns the largest difference in any channel.
int farthest(const ByteColour& a, const ByteColour& b) {
  return std::max({std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

int squaredDistance(const ByteColour& a, const ByteColour& b) {
  const int red = a.red - b.red, green = a.green - b.green, blue = a.blue - b.blue;
  return red * red + green * green + blue * blue;
}

/// Cells with the index of their colour in the list.
struct ListedCells {
  int width = 0;
  int height = 0;
  std::vector<std::int8_t> number;  ///< -1 if it is not known yet
};

/// Finds the listed colour of each cell; cells that nobody painted stay unknown.
/// \param edges  if true, smoothed edges get colours, too.
ListedCells listed(const Image& image, const std::vector<ByteColour>& list, const BoxCells& cells, bool edges) {
  // Cells finer than pixels would take the mixed colour of a smoothed edge for an area.
  const int width = std::min(cells.width, image.width), height = std::min(cells.height, image.height);
  ListedCells out{width, height, {}};
  const auto at = [&](int cell, int count, int pixels) {
    return static_cast<int>((cell + 0.5) * pixels / count);  // below `pixels`: there are no more cells than pixels
  };
  const auto shown = [&](int x, int y) {
    x = std::clamp(x, 0, width - 1);
    y = std::clamp(y, 0, height - 1);
    return colourAt(image, at(x, width, image.width), at(y, height, image.height));
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const ByteColour own = shown(x, y);
      const auto nearer = [&](const ByteColour& a, const ByteColour& b) {
        return squaredDistance(a, own) < squaredDistance(b, own);
      };
      const auto nearest = std::min_element(list.begin(), list.end(), nearer);
      const auto goesOn = [&](int besideX, int besideY) {
        const ByteColour other = shown(besideX, besideY);
        return other.painted && farthest(other, own) <= kAlike;
      };
      const bool known =
          own.painted && (edges || farthest(*nearest, own) <= kSame ||
                          (goesOn(x - 1, y) && goesOn(x + 1, y) && goesOn(x, y - 1) && goesOn(x, y + 1)));
      out.number.push_back(static_cast<std::int8_t>(known ? nearest - list.begin() : -1));
    }
  }
  return out;
}

/// Gives cells without a number that of the nearest numbered cell, by breadth-first search.
void spread(ListedCells& cells) {
  const std::size_t width = cells.width;
  std::vector<std::size_t> front, next;
  for (std::size_t k = 0; k < cells.number.size(); ++k) {
    if (cells.number[k] >= 0) front.push_back(k);
  }
  while (!front.empty()) {
    next.clear();
    for (const std::size_t k : front) {
      const auto give = [&](std::size_t to) {
        if (cells.number[to] >= 0) return;
        cells.number[to] = cells.number[k];
        next.push_back(to);
      };
      if (k % width > 0) give(k - 1);
      if (k % width + 1 < width) give(k + 1);
      if (k >= width) give(k - width);
      if (k + width < cells.number.size()) give(k + width);
    }
    front.swap(next);
  }
}

}  // namespace

LineAt colourLines(const TonesLayer& tones, const LayerContent& content, const Placement& place, double spacing) {
  std::vector<ByteColour> list;
  std::vector<Vec2f> lines;
  for (const ColourAngle& one : tones.colours) {
    list.push_back(colourOf(one.colour));
    lines.push_back(lineOf(one.angle * kDegree));
  }
  if (list.empty()) return [](Vec2 /*anywhere*/) { return Vec2f{1, 0}; };
  const BoxCells on = cellsOn(content.size, spacing);
  ListedCells cells = listed(*content.picture, list, on, false);
  const auto knows = [](std::int8_t number) { return number >= 0; };
  if (std::none_of(cells.number.begin(), cells.number.end(), knows)) {
    cells = listed(*content.picture, list, on, true);  // the picture has nothing but edges
  }
  spread(cells);
  return [kept = std::make_shared<const ListedCells>(std::move(cells)), place, box = content.size, lines](Vec2 at) {
    const auto texel = texelOf(*kept, place.toOwn(at), box);
    const int number = texel ? kept->number[*texel] : -1;
    return number >= 0 ? lines[number] : Vec2f{1, 0};
  };
}

}  // namespace sillon
