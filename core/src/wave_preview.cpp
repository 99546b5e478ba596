#include "wave_preview.hpp"

#include <algorithm>
#include <cmath>

#include "fast_math.hpp"
#include "parallel_for.hpp"

namespace sillon {

Result<RgbImage> drawWaves(const SineField& field, Vec2 page, int width, const RunContext& run) {
  const double pixel = page.x / width;
  const double height = std::max(1.0, std::round(page.y / pixel));
  if (height > 32768) {
    return Error{ErrorCode::TooLarge, "the picture would be " + std::to_string(std::llround(std::min(height, 1e15))) +
                                          " pixels high; at most 32768 are possible"};
  }
  RgbImage image{width, static_cast<int>(height), {}};
  image.rgb.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
  const Grid& grid = field.grid;
  const float radians = static_cast<float>(static_cast<double>(kPi) / field.spacing);
  parallelFor(run, image.height, rowGrain(run, image.height, 4.0 * image.width), [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      const double y = page.y - (row + 0.5) * pixel;
      const int cy = static_cast<int>(std::floor((y - grid.origin.y) / grid.cell));
      if (cy < 0 || cy >= grid.ny) continue;
      std::uint8_t* out = &image.rgb[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) * 3];
      for (int column = 0; column < width; ++column, out += 3) {
        const double x = (column + 0.5) * pixel;
        const int cx = static_cast<int>(std::floor((x - grid.origin.x) / grid.cell));
        if (cx < 0 || cx >= grid.nx) continue;
        const std::size_t i = grid.index(cx, cy);
        const Vec2f q = field.phase[i];
        if (q == Vec2f{}) continue;
        const Vec2 centre = grid.centre(cx, cy);
        const Vec2f to{static_cast<float>(x - centre.x), static_cast<float>(y - centre.y)};
        const SinCos turn = sinCos(radians * dot(to, field.wave[i]));
        const float value = q.x * turn.sin + q.y * turn.cos;  // sin(angle + phi)
        out[0] = out[1] = out[2] = static_cast<std::uint8_t>(40 + 215 * (1 - std::min(std::abs(value), 1.0f)));
      }
    }
  });
  if (run.cancelled()) return Error{ErrorCode::Cancelled, "the run was cancelled"};
  return image;
}

}  // namespace sillon
