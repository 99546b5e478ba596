// Converts a layer's own millimetres to those of the page, and back.
#pragma once

#include "base/exact_math.hpp"
#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/layers.hpp"

namespace sillon {

/// Place of a layer. Its own coordinates have their origin in the middle of its box.
class Placement {
 public:
  Placement(const Layer& layer, Vec2 middle, Vec2 size);

  [[nodiscard]] Vec2 toPage(Vec2 own) const;
  [[nodiscard]] Vec2 toOwn(Vec2 page) const;
  [[nodiscard]] Vec2 middle() const { return middle_; }
  [[nodiscard]] Vec2 size() const { return size_; }
  [[nodiscard]] bool mirror() const { return mirror_; }
  /// Rotation [radians], counter-clockwise.
  [[nodiscard]] double rotation() const { return rotation_; }

  /// Returns the layer's box on a page.
  [[nodiscard]] Shape box(Vec2 page) const;
  /// Stretches a shape's page over the box. \param page  page of the result
  [[nodiscard]] Shape stretched(const Shape& shape, Vec2 page) const;

 private:
  Vec2 middle_;
  Vec2 size_;
  double rotation_;
  exact::SinCos turn_;
  bool mirror_;
};

}  // namespace sillon
