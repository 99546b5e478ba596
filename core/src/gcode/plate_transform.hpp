// A plate turned and mirrored on its page, before it is placed on the bed.
#pragma once

#include "sillon/base/types.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/settings/print_params.hpp"
#include "sillon/settings/printer.hpp"

namespace sillon {

/// Mirrored left to right if asked, then turned counter-clockwise, both about the page's middle; the page becomes the
/// box around the turned one, with its lower left corner at the origin again. Quarter turns are exact.
class PlateTransform {
 public:
  PlateTransform(const PrintParams& params, Vec2 page);

  [[nodiscard]] bool none() const { return none_; }
  [[nodiscard]] Vec2 apply(Vec2 p) const;
  /// The point that apply() brings to p.
  [[nodiscard]] Vec2 invert(Vec2 p) const;
  [[nodiscard]] Toolpath apply(const Toolpath& toolpath) const;
  [[nodiscard]] Shape apply(const Shape& shape) const;

 private:
  bool none_;
  double mirror_;
  double cos_;
  double sin_;
  Vec2 from_;  ///< middle of the page
  Vec2 to_;    ///< middle of the turned page
};

}  // namespace sillon
