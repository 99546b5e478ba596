// Replays brush strokes in order.
#include "compose/strokes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/parallel_for.hpp"
#include "compose/ink.hpp"
#include "compose/lines.hpp"

namespace sillon {
namespace {

constexpr double kStep = 0.5;      // distance between points in brush radii; closer points would change nothing visible
constexpr double kTexelCost = 10;  // time for a texel under one piece, a rough figure to share out the work [ns]

/// Texels in columns left..right - 1 and rows top..bottom - 1.
struct TexelBox {
  int left = 0, top = 0, right = 0, bottom = 0;

  [[nodiscard]] bool empty() const { return left >= right || top >= bottom; }
  [[nodiscard]] std::size_t columns() const { return right - left; }
  [[nodiscard]] std::size_t count() const { return empty() ? 0 : columns() * (bottom - top); }
  void add(const TexelBox& other) {
    if (other.empty()) return;
    if (empty()) {
      *this = other;
      return;
    }
    *this = {std::min(left, other.left), std::min(top, other.top), std::max(right, other.right),
             std::max(bottom, other.bottom)};
  }
};

/// Trace of a brush in a box: its strength, and its direction as lines of any length.
struct Trace {
  TexelBox box;
  std::vector<float> strength;
  std::vector<Vec2f> line;
};

/// Straight way of a brush between two places.
struct BrushWay {
  Vec2 begin, end;
};

/// Splits a stroke into pieces about a step long, which also evens out a shaky hand. A stroke of one point becomes a
/// piece of length 0.
std::vector<BrushWay> piecesOf(const Stroke& stroke) {
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < stroke.points.size(); ++k) {
    const double moved = points.empty() ? stroke.radius : length(stroke.points[k] - points.back());
    const bool ends = k + 1 == stroke.points.size();
    if (moved >= kStep * stroke.radius || (ends && moved > 0)) points.push_back(stroke.points[k]);
  }
  if (points.size() == 1) points.push_back(points[0]);
  std::vector<BrushWay> pieces;
  for (std::size_t k = 1; k < points.size(); ++k) pieces.push_back({points[k - 1], points[k]});
  return pieces;
}

class Brushes {
 public:
  Brushes(const StrokesLayer& layer, std::size_t number, const LayerPlate& plate, LayerStack& stack)
      : layer_(layer),
        number_(number),
        plate_(plate),
        stack_(stack),
        step_{plate.shape.page.x / plate.width, plate.shape.page.y / plate.height} {
    const Layer* const ground = groundOf(plate.project.layers);
    if (ground != nullptr) ground_ = ground->mode;
  }

  /// Replays all strokes. \return false if cancelled.
  bool draw(const RunContext& run) {
    keepBelow();
    for (const Stroke& stroke : layer_.strokes) {
      Trace trace;
      if (!follow(stroke, run, trace)) return false;
      if (stroke.tool == StrokeTool::Comb) comb(trace);
      if (stroke.tool == StrokeTool::Mode) setMode(trace, stroke.mode);
      if (stroke.tool == StrokeTool::Erase) erase(trace);
    }
    return true;
  }

 private:
  /// Returns the texels within a radius of a piece.
  [[nodiscard]] TexelBox around(const BrushWay& piece, double radius) const {
    const auto& [a, b] = piece;
    const auto place = [](double texels, int count) {
      return static_cast<int>(std::clamp(texels, 0.0, static_cast<double>(count)));
    };
    return {place(std::floor((std::min(a.x, b.x) - radius) / step_.x), plate_.width),
            place(std::floor(plate_.height - (std::max(a.y, b.y) + radius) / step_.y), plate_.height),
            place(std::ceil((std::max(a.x, b.x) + radius) / step_.x), plate_.width),
            place(std::ceil(plate_.height - (std::min(a.y, b.y) - radius) / step_.y), plate_.height)};
  }
  [[nodiscard]] TexelBox boxOf(const std::vector<BrushWay>& pieces, double radius) const {
    TexelBox box;
    for (const BrushWay& piece : pieces) box.add(around(piece, radius));
    return box;
  }

  /// Keeps the texels below this layer where a stroke will erase.
  void keepBelow() {
    for (const Stroke& stroke : layer_.strokes) {
      if (stroke.tool == StrokeTool::Erase) erased_.add(boxOf(piecesOf(stroke), stroke.radius));
    }
    below_.reserve(erased_.count());
    forEachTexel(erased_, [&](std::size_t texel, std::size_t /*k*/) { below_.push_back(stack_.texels[texel]); });
  }

  /// Calls visit(index of the texel, index within the box).
  template <class Visit>
  void forEachTexel(const TexelBox& box, const Visit& visit) const {
    std::size_t k = 0;
    for (int y = box.top; y < box.bottom; ++y) {
      const std::size_t row = indexOf(0, y, plate_.width);
      for (int x = box.left; x < box.right; ++x) visit(row + x, k++);
    }
  }

  /// Fills the trace of a stroke. Threads share the rows, and each row takes the pieces in their order. \return false
  /// if cancelled.
  bool follow(const Stroke& stroke, const RunContext& run, Trace& trace) const {
    const std::vector<BrushWay> pieces = piecesOf(stroke);
    trace.box = boxOf(pieces, stroke.radius);
    trace.strength.resize(trace.box.count());
    trace.line.resize(trace.box.count());
    if (trace.box.empty()) return true;
    double texels = 0;
    for (const BrushWay& piece : pieces) texels += static_cast<double>(around(piece, stroke.radius).count());
    const int rows = trace.box.bottom - trace.box.top;
    parallelFor(run, rows, rowGrain(run, rows, kTexelCost * texels / rows), [&](int begin, int end) {
      for (const BrushWay& piece : pieces) {
        TexelBox box = around(piece, stroke.radius);
        box.top = std::max(box.top, trace.box.top + begin);
        box.bottom = std::min(box.bottom, trace.box.top + end);
        followPiece(stroke, piece, box, trace);
      }
    });
    return !run.cancelled();
  }

  /// Adds a piece to a trace. \param box  part of the piece's texels to fill.
  void followPiece(const Stroke& stroke, const BrushWay& piece, const TexelBox& box, Trace& trace) const {
    const Vec2 way = piece.end - piece.begin;
    const double square = dot(way, way), radius = stroke.radius;
    const Vec2f line = square > 0 ? lineAlong(way) : Vec2f{};
    const double rim = std::max(radius * std::min(1.0, std::max(0.0, stroke.soft)), 1e-9);
    for (int row = box.top; row < box.bottom; ++row) {
      std::size_t k = (row - trace.box.top) * trace.box.columns() + (box.left - trace.box.left);
      for (int column = box.left; column < box.right; ++column, ++k) {
        const Vec2 from = Vec2{(column + 0.5) * step_.x, (plate_.height - row - 0.5) * step_.y} - piece.begin;
        // Most texels lie beside an end of a piece, where no division is needed.
        const double ahead = dot(from, way), along = ahead <= 0 ? 0 : ahead >= square ? 1 : ahead / square;
        const Vec2 off = from - way * along;
        const double awaySquare = dot(off, off);
        if (awaySquare >= radius * radius) continue;
        const double away = std::sqrt(awaySquare);
        if (trace.strength[k] < 1) {
          const double inner = std::min(1.0, (radius - away) / rim);
          trace.strength[k] = std::max(trace.strength[k], static_cast<float>(inner * inner * (3 - 2 * inner)));
        }
        // The nearest piece of the stroke dominates; its neighbours round off corners.
        const auto share = static_cast<float>((1 - away / radius) * (1 - away / radius));
        trace.line[k] = trace.line[k] + line * share;
      }
    }
  }

  /// Blends the brush's direction in. Beads that were not constrained have no direction to blend with: there the brush
  /// counts fully, or not at all.
  void comb(const Trace& trace) {
    forEachTexel(trace.box, [&](std::size_t number, std::size_t k) {
      const float strength = trace.strength[k];
      if (!(strength > 0)) return;
      const float size = length(trace.line[k]);
      if (!(size > 0)) return;
      LayerStack::Texel& texel = stack_.texels[number];
      const bool held = texel.mode.value_or(ground_) == DirectionMode::Constrained;
      if (!held && strength < 0.5F) return;
      blend(texel, trace.line[k] * (1 / size), held ? strength : 1);
      texel.mode = DirectionMode::Constrained;
      if (strength >= 0.5F) cover(texel);
    });
  }

  /// Sets the mode of texels under the stroke's firm part.
  void setMode(const Trace& trace, DirectionMode mode) {
    forEachTexel(trace.box, [&](std::size_t number, std::size_t k) {
      if (trace.strength[k] < 0.5F) return;
      LayerStack::Texel& texel = stack_.texels[number];
      texel.mode = mode;
      if (mode != DirectionMode::Constrained) cover(texel);  // the directions below do not show there
    });
  }

  /// Mixes the texels below this layer back in.
  void erase(const Trace& trace) {
    forEachTexel(trace.box, [&](std::size_t number, std::size_t k) {
      const float strength = trace.strength[k];
      if (!(strength > 0)) return;
      LayerStack::Texel& texel = stack_.texels[number];
      const std::size_t x = number % plate_.width - erased_.left;
      const std::size_t y = number / plate_.width - erased_.top;
      const LayerStack::Texel& before = below_[y * erased_.columns() + x];
      LayerStack::Texel mixed = strength >= 0.5F ? before : texel;
      if (strength < 1) {
        mixed.line = before.line * strength + texel.line * (1 - strength);
        mixed.through = before.through * strength + texel.through * (1 - strength);
        mixed.cover = before.cover * strength + texel.cover * (1 - strength);
      }
      texel = mixed;
    });
  }

  /// Marks a texel as covered by this layer. Strokes are no ink that other layers could hide.
  void cover(LayerStack::Texel& texel) const {
    texel.top = static_cast<std::uint8_t>(number_ + 1);
    texel.ink = LayerStack::Ink::None;
  }

  const StrokesLayer& layer_;
  std::size_t number_;
  const LayerPlate& plate_;
  LayerStack& stack_;
  Vec2 step_;  // size of a texel [mm]
  DirectionMode ground_ = DirectionMode::Constrained;
  TexelBox erased_;
  std::vector<LayerStack::Texel> below_;  // texels below this layer, in the box erased_
};

}  // namespace

std::optional<Error> drawStrokes(const StrokesLayer& strokes, std::size_t number, const LayerPlate& plate,
                                 LayerStack& stack, const RunContext& run) {
  if (!Brushes(strokes, number, plate, stack).draw(run)) return cancelledRun();
  return std::nullopt;
}

}  // namespace sillon
