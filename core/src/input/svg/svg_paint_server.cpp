#include "input/svg/svg_style.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace sillon::svg {
namespace {

constexpr int kMaxLinks = 32;       // limit on references from gradient to gradient, which may form a cycle
constexpr double kLeastSeen = 0.2;  // share of a gradient's greatest opacity from which on it is visible
constexpr int kSteps = 1024;        // samples across the place, far finer than beads
constexpr double kFinest = 1e-3;    // tolerance of the ellipses of a radial gradient [mm]

const Node* find(const Ids& ids, std::string_view id) {
  const auto found = ids.find(id);
  return found == ids.end() ? nullptr : found->second;
}

const Node* nextOf(const Node& gradient, const Ids& ids) {
  const std::string_view href = trimmed(hrefOf(gradient).value_or(""));
  return startsWith(href, "#") ? find(ids, href.substr(1)) : nullptr;
}

/// Returns the first of the gradient and those that it refers to for which `holds` is true, or null.
template <class Holds>
const Node* linked(const Node& gradient, const Ids& ids, const Holds& holds) {
  const Node* node = &gradient;
  for (int links = 0; node && links < kMaxLinks; ++links) {
    if (holds(*node)) return node;
    node = nextOf(*node, ids);
  }
  return nullptr;
}

/// Opacity of a gradient as a function of the place along it.
class Fade {
 public:
  void add(const Node& stop, double alpha) {
    std::string_view unit;
    const double at = leadingNumber(attribute(stop, "offset").value_or("0"), unit).value_or(0);
    const double last = stops_.empty() ? 0 : stops_.back().first;
    stops_.emplace_back(std::clamp(unit == "%" ? at / 100 : at, last, 1.0), alpha);
  }

  /// Returns the places between `low` and `high` where the gradient alternately becomes visible and invisible.
  [[nodiscard]] std::vector<double> turns(double low, double high, std::string_view spread) const {
    double most = 0;
    for (const auto& [at, alpha] : stops_) most = std::max(most, alpha);
    std::vector<double> found;
    for (int k = 0; k <= kSteps; ++k) {
      const double at = low + (high - low) * k / kSteps;
      const double middle = low + (high - low) * (k + 0.5) / kSteps;
      const bool seen = k < kSteps && alphaAt(middle, spread) >= kLeastSeen * most;
      if (seen == (found.size() % 2 == 0)) found.push_back(at);
    }
    return found;
  }

 private:
  /// Returns the opacity at a place along the gradient.
  [[nodiscard]] double alphaAt(double t, std::string_view spread) const {
    if (spread == "repeat") t -= std::floor(t);
    if (spread == "reflect") t = std::abs(t - 2 * std::floor(t / 2 + 0.5));
    const auto after =
        std::upper_bound(stops_.begin(), stops_.end(), t, [](double at, const auto& stop) { return at < stop.first; });
    if (after == stops_.begin()) return stops_.front().second;
    const auto [from, alpha] = *(after - 1);
    if (after == stops_.end()) return alpha;
    return alpha + (after->second - alpha) * (t - from) / (after->first - from);
  }

  std::vector<std::pair<double, double>> stops_;
};

}  // namespace

std::optional<FilledPath> seenOfGradient(const Node& gradient, const GradientPlace& place, const Ids& ids,
                                         const StyleSheet& styles, Work& work) {
  const auto holder = [&](const char* name) {
    const Node* const node = linked(gradient, ids, [&](const Node& one) { return attribute(one, name).has_value(); });
    return node ? node : &gradient;
  };
  const auto word = [&](const char* name) { return trimmed(attribute(*holder(name), name).value_or("")); };
  Fade fade;
  const auto isStop = [](const Node& child) { return elementName(child) == "stop"; };
  const Node* const stops = linked(gradient, ids, [&](const Node& one) {
    const Node* child = one.first_node();
    while (child && !isStop(*child)) child = child->next_sibling();
    return child != nullptr;
  });
  if (!stops) return std::nullopt;
  for (const Node* child = stops->first_node(); child; child = child->next_sibling()) {
    if (!isStop(*child)) continue;
    work.spend(*child);
    fade.add(*child, stopPaint(styles.styleOf(*child, work), Paint{}).alpha);
  }

  const bool byUser = word("gradientUnits") == "userSpaceOnUse";
  const Vec2 full = byUser ? place.viewport : Vec2{1, 1};
  const auto at = [&](const char* name, double all, double missing) {
    return place.units.of(*holder(name), name, all, missing);
  };
  Matrix frame = place.toWorld;
  const Vec2 size = place.box.size();
  if (!byUser) frame = frame * matrix(size.x, 0, 0, size.y, place.box.min.x, place.box.min.y);
  frame = frame * parseTransform(word("gradientTransform"));
  const bool round = elementName(gradient) == "radialGradient";
  const double diagonal = byUser ? length(full) / std::sqrt(2.0) : 1;
  Vec2 middle, focus;
  double radius = 0;
  if (round) {
    middle = {at("cx", full.x, full.x / 2), at("cy", full.y, full.y / 2)};
    focus = {at("fx", full.x, middle.x), at("fy", full.y, middle.y)};
    radius = at("r", diagonal, diagonal / 2);
    if (radius - length(middle - focus) < 1e-3 * radius) return std::nullopt;
  } else {
    const Vec2 from{at("x1", full.x, 0), at("y1", full.y, 0)};
    const Vec2 along = Vec2{at("x2", full.x, full.x), at("y2", full.y, 0)} - from;
    frame = frame * matrix(along.x, along.y, -along.y, along.x, from.x, from.y);
  }
  if (std::abs(frame.linear().determinant()) < 1e-30) return std::nullopt;

  const Matrix back = frame.inverse();
  Bounds reach;
  double most = 0;
  const Bounds& around = place.around;
  for (const Vec2 corner :
       {around.min, around.max, Vec2{around.min.x, around.max.y}, Vec2{around.max.x, around.min.y}}) {
    const Eigen::Vector2d p = back * Eigen::Vector2d(corner.x, corner.y);
    reach.add({p.x(), p.y()});
    if (round) most = std::max(most, length(Vec2{p.x(), p.y()} - focus) / (radius - length(middle - focus)));
  }
  const std::vector<double> turns =
      round ? fade.turns(0, most, word("spreadMethod")) : fade.turns(reach.min.x, reach.max.x, word("spreadMethod"));
  std::int64_t points = kMaxPoints;
  Outliner out(frame, kFinest, points);
  for (std::size_t k = 0; k < turns.size(); ++k) {
    if (!round) {
      if (k % 2 == 0) drawRectangle(out, {turns[k], reach.min.y}, {turns[k + 1] - turns[k], reach.size().y}, {});
    } else if (turns[k] > 0) {
      drawEllipse(out, focus + turns[k] * (middle - focus), Vec2{radius, radius} * turns[k]);
    }
  }
  return FilledPath{out.rings(), FillRule::EvenOdd};
}

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
  double least = 1;
  paint.alpha = 0;
  const Node* const gradient = node;
  for (int links = 0; node && stops == 0 && links < kMaxLinks; ++links) {
    for (const Node* child = node->first_node(); child; child = child->next_sibling()) {
      if (elementName(*child) != "stop") continue;
      work.spend(*child);
      const Paint stop = stopPaint(styles.styleOf(*child, work), current);
      ++stops;
      for (std::size_t part = 0; part < 3; ++part) sums[part] += stop.colour >> (8 * part) & 255;
      black = black && stop.black();
      paint.alpha = std::max(paint.alpha, stop.alpha);
      least = std::min(least, stop.alpha);
    }
    node = nextOf(*node, ids);
  }
  if (least < kLeastSeen * paint.alpha) paint.fading = gradient;
  if (black) {
    paint.colour = 0;
  } else {
    const auto mean = [&](std::size_t part) { return (sums[part] + stops / 2) / stops << (8 * part); };
    paint.colour = otherColour(id, mean(0) | mean(1) | mean(2));
  }
  return paint;
}

}  // namespace sillon::svg
