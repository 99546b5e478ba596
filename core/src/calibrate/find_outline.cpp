#include "calibrate/photo.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "base/refused.hpp"

namespace sillon {
namespace {

constexpr int kSmall = 480;  // [pixels] longest side of the shrunken picture in which the outline is found

/// A photograph shrunk by a whole factor; each pixel is the mean of a square of samples.
struct SmallPicture {
  int width = 0, height = 0;
  double scale = 1;                        // side of a pixel [pixels of the photograph]
  std::array<std::vector<float>, 3> code;  // red, green and blue, 0..1
};

/// Shrinks a photograph until its longer side has at most kSmall pixels; grey becomes three equal channels.
SmallPicture shrunk(const Image& image) {
  SmallPicture out;
  const int longer = std::max(image.width, image.height);
  const int step = std::max(1, (longer + kSmall - 1) / kSmall);
  out.scale = step;
  out.width = image.width / step;
  out.height = image.height / step;
  const int colours = image.channels >= 3 ? 3 : 1;
  for (int c = 0; c < 3; ++c) {
    std::vector<float>& plane = out.code[c];
    plane.reserve(cellCount(out.width, out.height));
    for (int y = 0; y < out.height; ++y) {
      for (int x = 0; x < out.width; ++x) {
        std::uint64_t sum = 0;
        for (int j = 0; j < step; ++j) {
          for (int i = 0; i < step; ++i) sum += image.at(x * step + i, y * step + j, std::min(c, colours - 1));
        }
        plane.push_back(static_cast<float>(static_cast<double>(sum) / (65535.0 * step * step)));
      }
    }
  }
  return out;
}

/// Finds the distance of each pixel's code from the ground's, the largest of the three channels. The ground is a
/// quadratic function of the place, fitted to the picture's border without outliers.
/// \param[out] spread  standard deviation of the border about that function, the largest of the channels.
std::vector<float> offGround(const SmallPicture& picture, double& spread) {
  using Terms = std::array<double, 6>;
  const int w = picture.width, h = picture.height;
  const auto basis = [&](int x, int y) {
    const double u = (x + 0.5) / w * 2 - 1, v = (y + 0.5) / h * 2 - 1;
    return Terms{1, u, v, u * u, u * v, v * v};
  };
  const auto valueOf = [](const std::vector<double>& terms, const Terms& b) {
    double sum = 0;
    for (std::size_t k = 0; k < b.size(); ++k) sum += terms[k] * b[k];
    return sum;
  };
  const int ring = std::max(2, std::min(w, h) / 40);
  std::vector<float> off(cellCount(w, h), 0);
  spread = 0;
  for (const std::vector<float>& plane : picture.code) {
    std::vector<double> ground(6, 0);
    double most = 1e9;
    for (int round = 0; round < 4; ++round) {
      NormalEquations normal{ground.size()};
      for (std::size_t k = 0; k < ground.size(); ++k) normal.at(k, k) = 1e-9;
      std::vector<double> rests;
      for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
          if (x >= ring && y >= ring && x < w - ring && y < h - ring) continue;
          const Terms b = basis(x, y);
          const double value = static_cast<double>(plane[indexOf(x, y, w)]);
          const double rest = std::abs(value - valueOf(ground, b));
          rests.push_back(rest);
          if (round > 0 && rest > most) continue;
          normal.add(b.data(), value, 1);
        }
      }
      if (round > 0) {
        std::nth_element(rests.begin(), rests.begin() + static_cast<std::ptrdiff_t>(rests.size() / 2), rests.end());
        most = std::max(0.01, 3 * 1.4826 * rests[rests.size() / 2]);
      }
      ground = normal.solved();
    }
    spread = std::max(spread, most / 3);
    std::size_t k = 0;
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x, ++k) {
        const auto rest = static_cast<float>(std::abs(static_cast<double>(plane[k]) - valueOf(ground, basis(x, y))));
        off[k] = std::max(off[k], rest);
      }
    }
  }
  return off;
}

/// Sets the pixels of which at least this share of neighbours within `reach` is set: 0 (any of them) dilates the
/// mask, 1 (all of them) erodes it.
std::vector<std::uint8_t> filtered(const std::vector<std::uint8_t>& mask, int w, int h, int reach, double share) {
  std::vector<int> sums(cellCount(w + 1, h + 1), 0);
  const auto at = [&](int x, int y) -> int& { return sums[indexOf(x, y, w + 1)]; };
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const int own = mask[indexOf(x, y, w)];
      at(x + 1, y + 1) = own + at(x, y + 1) + at(x + 1, y) - at(x, y);
    }
  }
  std::vector<std::uint8_t> out(mask.size());
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const int x0 = std::max(0, x - reach), x1 = std::min(w, x + reach + 1);
      const int y0 = std::max(0, y - reach), y1 = std::min(h, y + reach + 1);
      const int count = at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0);
      const double needed = share * (x1 - x0) * (y1 - y0);
      out[indexOf(x, y, w)] = count > 0 && count >= needed - 1e-9 ? 1 : 0;
    }
  }
  return out;
}

/// Finds the pixels of the largest part of a mask that is connected by the sides of pixels.
std::vector<Vec2> largestPart(const std::vector<std::uint8_t>& mask, int w, int h) {
  std::vector<std::uint8_t> seen(mask.size(), 0);
  std::vector<Vec2> best;
  std::vector<int> stack;
  for (int start = 0; start < w * h; ++start) {
    if (mask[start] == 0 || seen[start] != 0) continue;
    std::vector<Vec2> part;
    stack.push_back(start);
    seen[start] = 1;
    while (!stack.empty()) {
      const int k = stack.back();
      stack.pop_back();
      const int x = k % w, y = k / w;
      part.push_back({static_cast<double>(x), static_cast<double>(y)});
      const auto visit = [&](bool exists, int next) {
        if (!exists || mask[next] == 0 || seen[next] != 0) return;
        seen[next] = 1;
        stack.push_back(next);
      };
      visit(x > 0, k - 1);
      visit(x + 1 < w, k + 1);
      visit(y > 0, k - w);
      visit(y + 1 < h, k + w);
    }
    if (part.size() > best.size()) best = std::move(part);
  }
  return best;
}

/// Signed area of a ring, positive if it is counter-clockwise where x points right and y up.
double areaOf(const std::vector<Vec2>& ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) sum += cross(ring[k], ring[(k + 1) % ring.size()]);
  return sum / 2;
}

/// Convex hull by Andrew's monotone chain, counter-clockwise where x points right and y up.
std::vector<Vec2> convexHull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Vec2> hull;
  const auto half = [&](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0) {
        hull.pop_back();
      }
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  half(points.begin(), points.end());
  half(points.rbegin(), points.rend());
  return hull;
}

/// Point in which the lines through a, b and through c, d meet; none if they are parallel.
std::optional<Vec2> crossing(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double turn = cross(b - a, d - c);
  if (std::abs(turn) < 1e-9) return std::nullopt;
  return a + (cross(c - a, d - c) / turn) * (b - a);
}

/// Reduces a convex ring to four sides: removes one side at a time, and extends its neighbours until they meet. The
/// side whose removal adds the least area goes first. \return nothing if no side can be removed.
std::vector<Vec2> quadAround(std::vector<Vec2> ring) {
  while (ring.size() > 4) {
    const std::size_t n = ring.size();
    double least = 1e300;
    std::size_t which = n;
    Vec2 corner;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 a = ring[(k + n - 1) % n], b = ring[k], c = ring[(k + 1) % n], d = ring[(k + 2) % n];
      const std::optional<Vec2> meet = crossing(a, b, d, c);
      if (!meet || dot(*meet - b, b - a) <= 0 || dot(*meet - c, c - d) <= 0) continue;
      const double added = std::abs(cross(*meet - b, c - b));
      if (added < least) least = added, which = k, corner = *meet;
    }
    if (which == n) return {};
    ring[which] = corner;
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>((which + 1) % n));
  }
  return ring;
}

}  // namespace

Result<std::vector<Vec2>> findOutline(const Image& photograph) {
  const SmallPicture picture = shrunk(photograph);
  const int w = picture.width, h = picture.height;
  double spread = 0;
  const std::vector<float> off = offGround(picture, spread);
  if (spread > 0.15) return refusedFile("NoPlainGround");
  const auto threshold = static_cast<float>(std::max(0.05, 4.5 * spread));
  std::vector<std::uint8_t> mask;
  mask.reserve(off.size());
  for (const float v : off) mask.push_back(v > threshold ? 1 : 0);
  mask = filtered(filtered(mask, w, h, 3, 0), w, h, 3, 1);  // closing fills narrow gaps
  mask = filtered(filtered(mask, w, h, 2, 1), w, h, 2, 0);  // opening removes thin specks
  const std::vector<Vec2> part = largestPart(mask, w, h);
  if (static_cast<double>(part.size()) < 0.03 * w * h) return refusedFile("NoCoupon");
  const auto border =
      std::count_if(part.begin(), part.end(), [&](Vec2 p) { return p.x < 1 || p.y < 1 || p.x > w - 2 || p.y > h - 2; });
  if (border > 2) return refusedFile("CouponCutOff");
  std::vector<Vec2> hull = convexHull(part);
  if (hull.size() < 4) return refusedFile("NotSquare");
  const double hullArea = areaOf(hull);
  const std::vector<Vec2> quad = quadAround(hull);
  if (quad.size() != 4 || static_cast<double>(part.size()) < 0.8 * hullArea || hullArea < 0.9 * areaOf(quad)) {
    return refusedFile("NotSquare");
  }
  // Points of the hull are indices of pixels; half a pixel more is the pixel's middle.
  std::vector<Vec2> corners;
  for (const Vec2 p : quad) corners.push_back(picture.scale * (p + Vec2{0.5, 0.5}));
  return corners;
}

}  // namespace sillon
