#include "wave_preview.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fast_math.hpp"
#include "parallel_for.hpp"

namespace sillon {
namespace {

constexpr int kNowhere = -1;

// Where a row or column of pixels meets a grid.
struct Along {
  int cell = kNowhere;  ///< of the wave's grid
  int fine = kNowhere;  ///< of the distances' grid
  float offset = 0;     ///< from the centre of `cell` [mm]
};

int cellAt(double position, double cell, int count) {
  const double at = std::floor(position / cell);
  return at >= 0 && at < count ? static_cast<int>(at) : kNowhere;
}

}  // namespace

Result<RgbImage> drawWaves(const SineField& field, const SignedDistanceField& sdf, Vec2 page, int width,
                           const RunContext& run) {
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
  const float border = static_cast<float>(-0.5 * field.spacing);

  std::vector<Along> columns(static_cast<std::size_t>(width + 3) / 4 * 4);  // whole vectors
  for (std::size_t column = 0; column < static_cast<std::size_t>(width); ++column) {
    const double x = (static_cast<double>(column) + 0.5) * pixel;
    Along& along = columns[column];
    along.fine = cellAt(x - sdf.grid.origin.x, sdf.grid.cell, sdf.grid.nx);
    along.cell = along.fine == kNowhere ? kNowhere : cellAt(x - grid.origin.x, grid.cell, grid.nx);
    if (along.cell != kNowhere) along.offset = static_cast<float>(x - grid.centre(along.cell, 0).x);
  }
  parallelFor(run, image.height, rowGrain(run, image.height, 8.0 * image.width), [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      const double y = page.y - (row + 0.5) * pixel;
      const int cy = cellAt(y - grid.origin.y, grid.cell, grid.ny);
      const int fine = cellAt(y - sdf.grid.origin.y, sdf.grid.cell, sdf.grid.ny);
      if (cy == kNowhere || fine == kNowhere) continue;
      const F4 up = splat(static_cast<float>(y - grid.centre(0, cy).y));
      std::uint8_t* out = &image.rgb[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) * 3];
      for (int column = 0; column < width; column += 4) {
        F4 right = splat(0), kx = splat(0), ky = splat(0), qr = splat(0), qi = splat(0);
        bool inside[4] = {};
        for (int k = 0; k < 4; ++k) {
          const Along& along = columns[static_cast<std::size_t>(column + k)];
          if (along.cell == kNowhere || sdf.distance[sdf.grid.index(along.fine, fine)] > border) continue;
          const std::size_t i = grid.index(along.cell, cy);
          inside[k] = true;
          right[k] = along.offset;
          kx[k] = field.wave[i].x;
          ky[k] = field.wave[i].y;
          qr[k] = field.phase[i].x;
          qi[k] = field.phase[i].y;
        }
        const SinCos4 turn = sinCos(splat(radians) * (right * kx + up * ky));
        const F4 value = abs4(qr * turn.sin + qi * turn.cos);  // |sin(angle + phi)|
        const I4 grey = toInt(splat(40) + splat(215) * (splat(1) - min4(value, splat(1))));
        for (int k = 0; k < 4 && column + k < width; ++k, out += 3) {
          if (inside[k]) out[0] = out[1] = out[2] = static_cast<std::uint8_t>(grey[k]);
        }
      }
    }
  });
  if (run.cancelled()) return Error{ErrorCode::Cancelled, "the run was cancelled"};
  return image;
}

}  // namespace sillon
