#include "input/svg/svg_style.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace sillon::svg {
namespace {

constexpr int kMaxLinks = 32;  // from gradient to gradient: they may go round in circles

const Node* find(const Ids& ids, std::string_view id) {
  const auto found = ids.find(id);
  return found == ids.end() ? nullptr : found->second;
}

}  // namespace

std::optional<Paint> serverPaint(std::string_view id, const Ids& ids, const StyleSheet& styles, const Paint& current,
                                 Work& work) {
  const Node* node = find(ids, id);
  const std::string_view name = node ? elementName(*node) : std::string_view();
  Paint paint{1, otherColour(id)};
  paint.pattern = name == "pattern";
  paint.gradient = name == "linearGradient" || name == "radialGradient";
  if (paint.pattern) return paint;
  if (!paint.gradient) return std::nullopt;

  std::uint64_t stops = 0;
  std::array<std::uint64_t, 3> sums{};
  bool black = true;
  paint.alpha = 0;
  for (int links = 0; node && stops == 0 && links < kMaxLinks; ++links) {
    for (const Node* child = node->first_node(); child; child = child->next_sibling()) {
      if (elementName(*child) != "stop") continue;
      work.spend(*child);
      const Paint stop = stopPaint(styles.styleOf(*child, work), current);
      ++stops;
      for (std::size_t part = 0; part < 3; ++part) sums[part] += stop.colour >> (8 * part) & 255;
      black = black && stop.black();
      paint.alpha = std::max(paint.alpha, stop.alpha);
    }
    const std::string_view href = trimmed(hrefOf(*node).value_or(""));
    node = startsWith(href, "#") ? find(ids, href.substr(1)) : nullptr;
  }
  if (black) {
    paint.colour = 0;
  } else {
    const auto mean = [&](std::size_t part) { return (sums[part] + stops / 2) / stops << (8 * part); };
    paint.colour = otherColour(id, mean(0) | mean(1) | mean(2));
  }
  return paint;
}

}  // namespace sillon::svg
