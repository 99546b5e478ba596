#include "look/preview_parts.hpp"

#include "sillon/input/image_io.hpp"

namespace sillon {

// Puts the two panels side by side or above each other, whichever gives a picture nearer to 4 : 3.
Layout layOut(Vec2 page, int panelWidth) {
  Layout layout;
  // Margins and footers grow with the panel, so that pictures of any size look alike.
  const int margin = std::max(1, panelWidth / 14);
  const int pageWidth = panelWidth - 2 * margin;
  layout.pixelsPerMm = pageWidth / page.x;
  const double exactHeight = page.y * layout.pixelsPerMm;
  // Checked before the conversion to int, which very long pages would overflow.
  if (!(exactHeight <= kMaxImageSide)) return layout;
  const int pageHeight = std::max(1, static_cast<int>(std::ceil(exactHeight)));
  const int footer = std::max(2, panelWidth / 9);  // space under each page, with the legend
  const int panelHeight = margin + pageHeight + footer;

  // Distance of the proportions from 4 : 3, the same for too wide and too high by one factor.
  const auto strangeness = [](double w, double h) { return std::abs(std::log(w / h * 3 / 4)); };
  const bool stacked = strangeness(panelWidth, 2.0 * panelHeight) < strangeness(2.0 * panelWidth, panelHeight);
  const std::int64_t width = stacked ? panelWidth : 2 * panelWidth;
  const std::int64_t height = stacked ? 2 * panelHeight : panelHeight;
  if (width > kMaxImageSide || height > kMaxImageSide || width * height > kMaxImagePixels) return layout;

  layout.width = static_cast<int>(width);
  layout.height = static_cast<int>(height);
  layout.directions = {margin, margin, pageWidth, pageHeight};
  layout.look = layout.directions;
  (stacked ? layout.look.y : layout.look.x) += stacked ? panelHeight : panelWidth;
  // The legend lies under the first page on the left, the lamp's ring under the second.
  layout.legendRadius = footer * 0.42;
  layout.legendX = margin + layout.legendRadius;
  layout.legendY = margin + pageHeight + footer * 0.78;
  layout.lampRadius = layout.legendRadius * 0.43;
  layout.lampX = layout.look.x + layout.lampRadius;
  layout.lampY = layout.look.y + layout.legendY - margin - layout.lampRadius;
  return layout;
}

// The page fills 92 % of the picture along its tighter side, in the middle.
Layout layOutLook(Vec2 page, int width, int height) {
  constexpr double kFill = 0.92;
  Layout layout;
  layout.width = width;
  layout.height = height;
  layout.pixelsPerMm = kFill * std::min(width / page.x, height / page.y);
  layout.look.width = std::max(1, static_cast<int>(page.x * layout.pixelsPerMm));
  layout.look.height = std::max(1, static_cast<int>(page.y * layout.pixelsPerMm));
  layout.look.x = (width - layout.look.width) / 2;
  layout.look.y = (height - layout.look.height) / 2;
  return layout;
}

}  // namespace sillon
