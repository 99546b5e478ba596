// Photographs of a coupon as a camera would take them, from the shapes of its beads: each point of a bead's round top
// has the slope of its height plus a random one, and sends light if that slope mirrors some point of a round lamp into
// the camera. No formula of the appearance model is used; camera, lamp and faults of the picture are known.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "look/rasters.hpp"
#include "sillon/calibrate/calibrate.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/look/inversion.hpp"
#include "support/scenes.hpp"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#include <stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace photo {

using scenes::Random;
using sillon::CalibrationPlate;
using sillon::Lamp;
using sillon::Roughness;
using sillon::Vec2;

struct V3 {
  double x, y, z;
};
inline V3 operator+(V3 a, V3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V3 operator-(V3 a, V3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V3 operator*(double s, V3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(V3 a, V3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V3 cross(V3 a, V3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline V3 unit(V3 a) { return (1 / std::sqrt(dot(a, a))) * a; }
inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// How a camera turns light into codes.
enum class ToneCurve {
  Srgb,   ///< as the standard says
  Soft,   ///< more contrast in the middle, a shoulder: a phone in its standard mode
  Vivid,  ///< the same, stronger
  Lifted  ///< shadows brightened, as phones do in the dark
};

struct Truth {
  Roughness slopes{2.36, 17.32};
  double extrusion = 1;              ///< plastic laid per plastic asked for
  Lamp lamp{60, 45, 0.02};           ///< seen from the coupon's middle
  double lampDistance = 1000;        ///< [mm]
  double secondLamp = 0;             ///< brightness of a further lamp, by that of the first
  double diffuse = 0.05;             ///< by the brightest direction's highlight
  double room = 0;                   ///< light from everywhere, likewise
  double tilt = 0, tiltAzimuth = 0;  ///< of the camera off the plate's normal [degrees]
  double roll = 0;                   ///< of the camera about its axis [degrees]
  double distance = 200;             ///< of the camera from the coupon's middle [mm]
  double focal = 1.9;                ///< by the picture's width: cut out of a larger one
  Vec2 shift;                        ///< of the coupon's middle from the picture's [pixels]
  int width = 1600, height = 1200;   ///< [pixels]
  double blur = 0.7;                 ///< of the lens, standard deviation [pixels]
  double vignette = 0.2;             ///< of the light lost in the corners
  double noise = 0.01;               ///< of full scale, at half of it
  ToneCurve curve = ToneCurve::Srgb;
  double exposure = 0.8;  ///< of the brightest beads, 1: full scale
  double veil = 0;        ///< stray light, 1: full scale
  double veilRight = 0;   ///< what it grows by from the left to the right
  double sharpen = 0;     ///< amount of an unsharp mask over the codes,
  double mask = 1;        ///< and its standard deviation [pixels]
  std::array<double, 3> filament{0.35, 0.5, 0.75};
  std::array<double, 3> ground{0.55, 0.54, 0.5};
  double groundTexture = 0.03;
  int quality = 90;  ///< of the JPEG; 0: PNG
  std::uint64_t seed = 1;
};

/// The coupon's top layer, looked up by place.
class Beads {
 public:
  static constexpr double kCell = 0.04;  // [mm]

  Beads(const CalibrationPlate& plate, double extrusion) : page_(plate.patches.shape.page) {
    nozzle_ = plate.printer.nozzle;
    height_ = plate.print.layerHeight;
    side_ = static_cast<int>(std::ceil(page_.x / kCell));
    cells_.assign(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), 0);
    pieces_.emplace_back();  // none
    for (const sillon::Patch& patch : plate.patches.patches) {
      for (const sillon::PatchLine& line : patch.lines) {
        for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
          lay(line.points[k], line.points[k + 1], line.widths[k] * patch.flow * extrusion,
              line.widths[k + 1] * patch.flow * extrusion);
        }
      }
    }
  }

  struct Place {
    bool top = false;   ///< on a bead of the upper layer
    double across = 0;  ///< -1..1, positive to the left of its direction
    Vec2 along{1, 0};
  };

  [[nodiscard]] bool within(Vec2 p) const { return p.x >= 0 && p.y >= 0 && p.x < page_.x && p.y < page_.y; }
  [[nodiscard]] double height() const { return height_; }

  [[nodiscard]] Place at(Vec2 p) const {
    const int i = static_cast<int>(p.x / kCell), j = static_cast<int>(p.y / kCell);
    const int di = p.x / kCell - i < 0.5 ? -1 : 1, dj = p.y / kCell - j < 0.5 ? -1 : 1;
    // A cell knows one bead; at its edge the next one may begin.
    for (int k = 0; k < 4; ++k) {
      const int x = std::clamp(i + (k % 2) * di, 0, side_ - 1), y = std::clamp(j + (k / 2) * dj, 0, side_ - 1);
      const std::uint32_t piece = cells_[cellOf(x, y)];
      if (piece == 0) continue;
      const double across = pieces_[piece].acrossAt(p);
      if (std::abs(across) <= 1) return {true, across, pieces_[piece].along};
    }
    // The base, hatched at 45 degrees.
    const Vec2 t{std::sqrt(0.5), std::sqrt(0.5)};
    const double v = cross(t, p) / nozzle_;
    return {false, 2 * (v - std::floor(v)) - 1, t};
  }

 private:
  /// A straight piece of a bead, with round ends.
  struct Piece {
    Vec2 begin, along{1, 0};            // the latter unit
    double size = 0, from = 0, to = 0;  // length; half widths of its ends [mm]

    /// By half the width there, positive to its left.
    [[nodiscard]] double acrossAt(Vec2 p) const {
      const double s = dot(along, p - begin), across = cross(along, p - begin);
      const double half = from + (to - from) * std::clamp(s / size, 0.0, 1.0);
      const double beyond = s < 0 ? -s : s > size ? s - size : 0;
      const double off = beyond > 0 ? std::sqrt(across * across + beyond * beyond) : std::abs(across);
      return (across < 0 ? -off : off) / half;
    }
  };

  [[nodiscard]] std::size_t cellOf(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(x);
  }

  void lay(Vec2 a, Vec2 b, double from, double to) {
    const double size = length(b - a);
    if (!(size > 0)) return;
    const Piece piece{a, (1 / size) * (b - a), size, from / 2, to / 2};
    const double reach = std::max(from, to) / 2 + kCell;
    const auto number = static_cast<std::uint32_t>(pieces_.size());
    pieces_.push_back(piece);
    const auto index = [&](double v) { return std::clamp(static_cast<int>(std::floor(v / kCell)), 0, side_ - 1); };
    for (int j = index(std::min(a.y, b.y) - reach); j <= index(std::max(a.y, b.y) + reach); ++j) {
      for (int i = index(std::min(a.x, b.x) - reach); i <= index(std::max(a.x, b.x) + reach); ++i) {
        const Vec2 p{(i + 0.5) * kCell, (j + 0.5) * kCell};
        const double across = std::abs(piece.acrossAt(p));
        if (across > 1 + 2 * kCell / std::min(from, to)) continue;
        std::uint32_t& cell = cells_[cellOf(i, j)];
        if (cell != 0 && std::abs(pieces_[cell].acrossAt(p)) <= across) continue;
        cell = number;
      }
    }
  }

  Vec2 page_;
  double nozzle_ = 0.4, height_ = 0.2;
  int side_ = 0;
  std::vector<Piece> pieces_;
  std::vector<std::uint32_t> cells_;  // which piece; 0: no bead
};

/// Where a camera sees the coupon: pixels to the plate and back.
class Camera {
 public:
  Camera(const Truth& truth, Vec2 middle) : middle_(middle) {
    const double tilt = radians(truth.tilt), turn = radians(truth.tiltAzimuth), roll = radians(truth.roll);
    const V3 out{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
    eye_ = truth.distance * out;
    forward_ = -1.0 * out;
    const V3 up = std::abs(out.y) < 0.9 ? V3{0, 1, 0} : V3{1, 0, 0};
    const V3 right = unit(photo::cross(forward_, up)), top = photo::cross(right, forward_);
    right_ = std::cos(roll) * right + std::sin(roll) * top;
    top_ = std::cos(roll) * top - std::sin(roll) * right;
    focal_ = truth.focal * truth.width;
    centre_ = Vec2{truth.width / 2.0, truth.height / 2.0} + truth.shift;
  }
  [[nodiscard]] V3 eye() const { return eye_; }
  /// On the plate, seen through a point of the picture. Points of the picture are pixels from its upper left.
  [[nodiscard]] Vec2 plateAt(Vec2 pixel) const {
    const V3 ray = forward_ + ((pixel.x - centre_.x) / focal_) * right_ + ((centre_.y - pixel.y) / focal_) * top_;
    const double s = -eye_.z / ray.z;
    return Vec2{eye_.x + s * ray.x, eye_.y + s * ray.y} + middle_;
  }
  [[nodiscard]] Vec2 pixelOf(Vec2 plate) const {
    const V3 p = V3{plate.x - middle_.x, plate.y - middle_.y, 0} - eye_;
    const double depth = dot(p, forward_);
    return {centre_.x + focal_ * dot(p, right_) / depth, centre_.y - focal_ * dot(p, top_) / depth};
  }

 private:
  Vec2 middle_;
  V3 eye_{}, forward_{}, right_{}, top_{};
  double focal_ = 1;
  Vec2 centre_;
};

inline double toneCurve(ToneCurve curve, double light) {
  const auto code = static_cast<double>(sillon::codeOfLight(static_cast<float>(light)));
  const double middle = code * code * (3 - 2 * code);
  switch (curve) {
    case ToneCurve::Srgb:
      return code;
    case ToneCurve::Soft:
      return code + 0.15 * (middle - code);
    case ToneCurve::Vivid:
      return code + 0.35 * (middle - code);
    case ToneCurve::Lifted:
      return std::pow(code, 0.92);
  }
  return code;
}

inline void blurred(std::vector<float>& plane, int width, int height, double sigma) {
  if (!(sigma > 0.05)) return;
  const int reach = static_cast<int>(std::ceil(3 * sigma));
  std::vector<float> kernel;
  double sum = 0;
  for (int k = -reach; k <= reach; ++k) {
    kernel.push_back(static_cast<float>(std::exp(-k * k / (2 * sigma * sigma))));
    sum += static_cast<double>(kernel.back());
  }
  for (float& v : kernel) v /= static_cast<float>(sum);
  const auto pass = [&](int count, int lines, int step, int next) {
    std::vector<float> line(static_cast<std::size_t>(count));
    for (int l = 0; l < lines; ++l) {
      float* at = plane.data() + static_cast<std::ptrdiff_t>(l) * next;
      for (int k = 0; k < count; ++k) line[k] = at[static_cast<std::ptrdiff_t>(k) * step];
      for (int k = 0; k < count; ++k) {
        float v = 0;
        for (int o = -reach; o <= reach; ++o) {
          v += kernel[o + reach] * line[std::clamp(k + o, 0, count - 1)];
        }
        at[static_cast<std::ptrdiff_t>(k) * step] = v;
      }
    }
  };
  pass(width, height, 1, width);
  pass(height, width, width, 1);
}

inline double gauss(Random& random) {  // Irwin-Hall of four, which are parts of one number
  const std::uint64_t bits = random.bits();
  double sum = -2;
  for (int k = 0; k < 64; k += 16) sum += (static_cast<double>((bits >> k) & 0xffff) + 0.5) / 65536;
  return sum * std::sqrt(3.0);
}

/// The lamp as points of its disc; their mean square is that of a Gaussian of its slope.
struct Lit {
  static constexpr int kPoints = 24;
  std::vector<V3> points;  // [mm] from the coupon's middle
  V3 middle;               // [mm]
  double reach;            // what slopes that mirror its points differ from its middle's, at the most
  Lit(double azimuth, double elevation, double slope, double distance) {
    const double a = radians(azimuth), e = radians(elevation);
    const V3 to{std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
    const V3 side{-std::sin(a), std::cos(a), 0}, up = photo::cross(to, side);
    // A slope turns the mirrored ray by twice as much, and a disc of radius 1 has a root mean square of 1/2 along an
    // axis. Half vectors of a lamp that is not overhead have slopes that differ by (1 + lz) / 2 and more.
    const double radius = 2 * slope * (1 + to.z);
    middle = distance * to;
    reach = radius;
    for (int k = 0; k < kPoints; ++k) {
      const double r = radius * std::sqrt((k + 0.5) / kPoints), turn = 2.399963229728653 * k;
      points.push_back(distance * (to + (r * std::cos(turn)) * side + (r * std::sin(turn)) * up));
    }
  }
};

/// Slopes that mirror the lamp's points into the eye from one place. They hardly change within a pixel.
struct Mirrored {
  Vec2 middle;
  std::array<Vec2, Lit::kPoints> points;
  double reach;

  Mirrored(const Lit& lamp, V3 at, V3 eye) : reach(lamp.reach) {
    const V3 e = unit(eye - at);
    const auto slopeOf = [&](V3 point) {
      const V3 h = unit(point - at) + e;
      return Vec2{h.x / h.z, h.y / h.z};
    };
    middle = slopeOf(lamp.middle);
    for (std::size_t k = 0; k < points.size(); ++k) points[k] = slopeOf(lamp.points[k]);
  }
};

/// Mean density of these slopes, relative to nothing.
inline double highlight(const Mirrored& lamp, Vec2 along, double top, double sa, double sc) {
  constexpr double kDark = 12;  // exp(-12) of the light is none in eight bits
  const auto slopesOf = [&](Vec2 m) { return Vec2{dot(m, along) / sa, (cross(along, m) - top) / sc}; };
  // Most beads run so that not even the lamp's nearest point shines.
  const Vec2 middle = slopesOf(lamp.middle);
  const double a = std::max(0.0, std::abs(middle.x) - lamp.reach / sa);
  const double c = std::max(0.0, std::abs(middle.y) - lamp.reach / sc);
  if (0.5 * (a * a + c * c) > kDark) return 0;
  double sum = 0;
  for (const Vec2 point : lamp.points) {
    const Vec2 m = slopesOf(point);
    const double off = 0.5 * dot(m, m);
    if (off < kDark) sum += std::exp(-off);
  }
  return sum / static_cast<double>(lamp.points.size());
}

/// The light that falls onto a camera's sensor, before lens, noise and development.
struct Exposed {
  double exposure = 1;
  std::array<std::vector<float>, 3> planes;
  Random random;  ///< for what comes after
};

/// Of a truth, what is up to and with its ground's texture.
inline Exposed exposed(const CalibrationPlate& plate, const Truth& truth) {
  const Vec2 page = plate.patches.shape.page, middle = 0.5 * page;
  const Beads beads(plate, truth.extrusion);
  const Camera camera(truth, middle);
  const double sa = std::tan(radians(truth.slopes.along)), sc = std::tan(radians(truth.slopes.across));
  const double profile = static_cast<double>(sillon::lobeOf({}, {}).profile);  // of the bead's top: its shape
  const Lit lamp(truth.lamp.azimuth, truth.lamp.elevation, truth.lamp.slope, truth.lampDistance);
  const Lit other(truth.lamp.azimuth + 75, truth.lamp.elevation + 5, truth.lamp.slope, truth.lampDistance);
  struct Lamps {
    Mirrored first, second;
  };
  const auto lampsAt = [&](V3 at) {
    const Mirrored first(lamp, at, camera.eye());
    return Lamps{first, truth.secondLamp > 0 ? Mirrored(other, at, camera.eye()) : first};
  };
  const auto shine = [&](const Lamps& lamps, Vec2 along, double top) {
    double v = highlight(lamps.first, along, top, sa, sc);
    if (truth.secondLamp > 0) v += truth.secondLamp * highlight(lamps.second, along, top, sa, sc);
    return v;
  };
  double brightest = 1e-12;  // of the beads' directions, in the middle
  const Lamps overMiddle = lampsAt({0, 0, 0});
  for (int k = 0; k < 36; ++k) {
    double mean = 0;
    const Vec2 along{std::cos(radians(5 * k)), std::sin(radians(5 * k))};
    for (int u = 0; u < 16; ++u) mean += shine(overMiddle, along, profile * ((u + 0.5) / 8 - 1)) / 16;
    brightest = std::max(brightest, mean);
  }
  const double body = truth.diffuse + truth.room;
  const auto shadowed = [&](Vec2 p, V3 towards) {
    const double flat = std::sqrt(towards.x * towards.x + towards.y * towards.y);
    const double reach = beads.height() * flat / std::max(0.05, towards.z);
    if (!(flat > 0)) return false;
    for (int k = 1; k <= 4; ++k) {
      const Vec2 q = p + (reach * (k - 0.5) / 4 / flat) * Vec2{towards.x, towards.y};
      if (beads.within(q) && beads.at(q).top) return true;
    }
    return false;
  };
  const double a = radians(truth.lamp.azimuth), el = radians(truth.lamp.elevation);
  const V3 lampward{std::cos(el) * std::cos(a), std::cos(el) * std::sin(a), std::sin(el)};

  const auto count = static_cast<std::size_t>(truth.width) * static_cast<std::size_t>(truth.height);
  Exposed out{truth.exposure, {}, Random(truth.seed)};
  Random& random = out.random;
  for (auto& plane : out.planes) plane.assign(count, 0);
  constexpr int kSamples = 2;  // per pixel and axis
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const std::size_t k =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(truth.width) + static_cast<std::size_t>(x);
      double rgb[3] = {0, 0, 0};
      const Vec2 centre = camera.plateAt({x + 0.5, y + 0.5});
      const bool ground = !beads.within(centre);
      std::optional<Lamps> lamps;
      for (int s = 0; s < kSamples * kSamples; ++s) {
        const Vec2 p = camera.plateAt({x + (s % kSamples + 0.5) / kSamples, y + (s / kSamples + 0.5) / kSamples});
        if (!beads.within(p)) {
          for (int c = 0; c < 3; ++c) rgb[c] += truth.ground[c] * truth.exposure;
          continue;
        }
        const V3 at{p.x - middle.x, p.y - middle.y, 0};
        const Beads::Place place = beads.at(p);
        double light = 0, soft = body;
        const V3 way = truth.lampDistance * lampward - at;
        const double near = truth.lampDistance * truth.lampDistance / dot(way, way);
        if (!place.top && (shadowed(p, lampward) || shadowed(p, unit(camera.eye() - at)))) {
          soft *= 0.3;
        } else {
          if (!lamps) lamps = lampsAt({centre.x - middle.x, centre.y - middle.y, 0});
          light = shine(*lamps, place.along, profile * place.across) / brightest;
        }
        for (int c = 0; c < 3; ++c) {
          const double own = truth.filament[c];
          rgb[c] += truth.exposure * (light * (0.5 + 0.5 * own) + soft * own) * near;
        }
      }
      const double dx = (x - truth.width / 2.0) / truth.width, dy = (y - truth.height / 2.0) / truth.width;
      const double shade = 1 - truth.vignette * (dx * dx + dy * dy) / (0.25 + 0.25 * 0.5625);
      const double grain = 1 + (ground ? truth.groundTexture * gauss(random) : 0);
      for (std::size_t c = 0; c < 3; ++c) {
        out.planes[c][k] = static_cast<float>(rgb[c] * shade * grain / (kSamples * kSamples));
      }
    }
  }
  return out;
}

/// As bytes of a PNG or a JPEG. Of the truth, exposure, blur, stray light, noise, tone curve, sharpening and quality
/// count.
inline std::vector<std::uint8_t> developed(Exposed film, const Truth& truth) {
  Random& random = film.random;
  const auto count = static_cast<std::size_t>(truth.width) * static_cast<std::size_t>(truth.height);
  const double brighter = truth.exposure / film.exposure;
  std::vector<std::uint8_t> pixels(3 * count);
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<float>& plane = film.planes[c];
    blurred(plane, truth.width, truth.height, truth.blur);
    for (std::size_t k = 0; k < count; ++k) {
      const double x = static_cast<double>(k % static_cast<std::size_t>(truth.width)) / truth.width;
      const double light = brighter * static_cast<double>(plane[k]) + truth.veil + truth.veilRight * x;
      const double noise = truth.noise * std::sqrt(0.1 + 1.8 * std::max(0.0, light)) * gauss(random);
      plane[k] = static_cast<float>(toneCurve(truth.curve, light + noise));
    }
    std::vector<float> soft;
    if (truth.sharpen > 0) {
      soft = plane;
      blurred(soft, truth.width, truth.height, truth.mask);
    }
    for (std::size_t k = 0; k < count; ++k) {
      auto code = static_cast<double>(plane[k]);
      if (truth.sharpen > 0) code += truth.sharpen * (code - static_cast<double>(soft[k]));
      pixels[3 * k + c] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(code, 0.0, 1.0)));
    }
  }
  if (truth.quality == 0) return sillon::encodePng(truth.width, truth.height, pixels);
  std::vector<std::uint8_t> bytes;
  const auto append = [](void* out, void* data, int size) {
    auto& all = *static_cast<std::vector<std::uint8_t>*>(out);
    const auto* from = static_cast<const std::uint8_t*>(data);
    for (int k = 0; k < size; ++k) all.push_back(from[k]);
  };
  stbi_write_jpg_to_func(append, &bytes, truth.width, truth.height, 3, pixels.data(), truth.quality);
  return bytes;
}

/// The photograph, as bytes of a PNG or a JPEG.
inline std::vector<std::uint8_t> taken(const CalibrationPlate& plate, const Truth& truth) {
  return developed(exposed(plate, truth), truth);
}

/// Taken, and read again.
inline sillon::Result<sillon::CouponReading> readBack(const CalibrationPlate& plate, const Truth& truth,
                                                      const sillon::PhotoRequest& request = {}) {
  const auto image = sillon::decodeImage(taken(plate, truth), "photograph");
  if (!image) return image.error();
  return sillon::readCouponPhoto(image.value(), request, sillon::RunContext(1));
}

/// As the guide asks for one.
inline Truth good() {
  Truth truth;
  truth.tilt = 20;
  truth.tiltAzimuth = 250;
  truth.roll = 12;
  truth.focal = 0.0094 * truth.distance;
  truth.exposure = 0.65;
  return truth;
}

/// Somebody's photograph: any spool, lamp, hand and telephone that the guide allows.
inline Truth randomTruth(Random& random) {
  Truth truth;
  truth.slopes = {std::exp(random.in(std::log(1.5), std::log(9.0))), random.in(11, 18)};
  truth.extrusion = random.in(0.98, 1.05);
  truth.lamp = {random.in(0, 360), random.in(35, 60), random.in(0.005, 0.03)};
  truth.lampDistance = random.in(500, 2000);
  truth.diffuse = random.in(0.03, 0.08);
  truth.tilt = random.in(5, 35);
  truth.tiltAzimuth = random.in(0, 360);
  truth.roll = random.in(0, 360);
  truth.distance = random.in(180, 320);
  truth.focal = 0.0094 * truth.distance;
  truth.shift = {random.in(-60, 60), random.in(-25, 25)};
  truth.blur = random.in(0.4, 1.0);
  truth.vignette = random.in(0, 0.3);
  truth.noise = random.in(0.003, 0.015);
  truth.curve = static_cast<ToneCurve>(random.index(4));
  truth.exposure = random.in(0.5, 0.75);
  for (double& c : truth.filament) c = random.in(0.1, 0.8);
  const double paper = random.index(2) == 0 ? random.in(0.35, 0.6) : random.in(0.001, 0.004);
  for (double& c : truth.ground) c = paper * random.in(0.9, 1.1);
  truth.quality = 60 + random.index(36);
  truth.seed = random.bits();
  return truth;
}

}  // namespace photo
