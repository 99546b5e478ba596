// Draws every picture and outline in examples/inputs. Same program, same bytes: run `./dev inputs` after a change.
//
// Everything is drawn in mm on the plate's page, x right, y up. Direction pictures hold angles, not tones: grey 0..255
// is -90..90 degrees, or 0..180 degrees where a project says "rotation".
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <locale>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "sillon/base/types.hpp"
#include "sillon/input/image_io.hpp"

namespace {

using sillon::Vec2;
constexpr double kPi = std::numbers::pi;

std::filesystem::path folder;
bool failed = false;

void writeFile(const std::string& name, const char* bytes, std::size_t size) {
  std::ofstream file(folder / name, std::ios::binary);
  file.write(bytes, static_cast<std::streamsize>(size));
  file.close();
  if (!file) {
    std::cerr << "cannot write " << (folder / name).string() << "\n";
    failed = true;
  }
}

// ---------------------------------------------------------------------------------------------------------------------
// Pictures

/// Calls grey(p) at the centre of each texel; p in mm.
template <class Grey>
void writePng(const std::string& name, Vec2 page, double texelsPerMm, Grey grey) {
  const int width = static_cast<int>(std::lround(page.x * texelsPerMm));
  const int height = static_cast<int>(std::lround(page.y * texelsPerMm));
  std::vector<std::uint8_t> rgb;
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const Vec2 p{(i + 0.5) * page.x / width, page.y - (j + 0.5) * page.y / height};
      const auto value = static_cast<std::uint8_t>(std::lround(std::clamp(grey(p), 0.0, 255.0)));
      rgb.insert(rgb.end(), 3, value);
    }
  }
  const std::vector<std::uint8_t> png = sillon::encodePng(width, height, rgb);
  writeFile(name, reinterpret_cast<const char*>(png.data()), png.size());
}

/// Bead direction as grey. \param degrees  counter-clockwise from +x; any angle, 180 degrees are none.
double angleGrey(double degrees) {
  const double turns = (degrees + 90) / 180;
  return (turns - std::floor(turns)) * 255;
}

/// Tone 0..1 as the rotation 60..150 degrees. Beads that point at a light at 60 degrees are dark, beads across it are
/// bright, so that the plate shows the picture under the preview's light, and its negative after a quarter turn.
double toneGrey(double tone) { return (60 + 90 * std::clamp(tone, 0.0, 1.0)) / 180 * 255; }

/// Mean of four points in a texel: soft edges for tones. Angles must not be averaged so.
template <class Tone>
double antialiased(Vec2 p, double texel, Tone tone) {
  const double d = texel / 4;
  return (tone(p + Vec2{-d, -d}) + tone(p + Vec2{d, -d}) + tone(p + Vec2{-d, d}) + tone(p + Vec2{d, d})) / 4;
}

constexpr double kParallel = 0;
constexpr double kOrthogonal = 85;
constexpr double kSmoothest = 170;
constexpr double kConstrained = 255;

double degrees(double radians) { return radians * 180 / kPi; }
double radians(double degrees) { return degrees * kPi / 180; }
double angleOf(Vec2 v) { return std::atan2(v.y, v.x); }
double mix(double a, double b, double t) { return a + (b - a) * t; }

double smoothstep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Hash of a grid point to [0, 1).
double random(int x, int y, std::uint32_t seed) {
  std::uint32_t h = seed * 0x9e3779b9U + static_cast<std::uint32_t>(x) * 0x85ebca6bU;
  h = (h ^ (h >> 15)) * 0x2c1b3c6dU + static_cast<std::uint32_t>(y) * 0xc2b2ae35U;
  h = (h ^ (h >> 12)) * 0x297a2d39U;
  h = (h ^ (h >> 15)) * 0x2c1b3c6dU;
  return static_cast<double>(h ^ (h >> 16)) / 4294967296.0;
}

/// Smooth noise in [0, 1) with features of size 1.
double noise(Vec2 p, std::uint32_t seed) {
  const int x = static_cast<int>(std::floor(p.x));
  const int y = static_cast<int>(std::floor(p.y));
  const double u = smoothstep(0, 1, p.x - x);
  const double v = smoothstep(0, 1, p.y - y);
  return mix(mix(random(x, y, seed), random(x + 1, y, seed), u),
             mix(random(x, y + 1, seed), random(x + 1, y + 1, seed), u), v);
}

double fractalNoise(Vec2 p, std::uint32_t seed, int octaves) {
  double sum = 0;
  double weight = 0.5;
  for (int k = 0; k < octaves; ++k, weight /= 2, p = p * 2.03)
    sum += weight * noise(p, seed + 17U * static_cast<std::uint32_t>(k));
  return sum / (1 - 2 * weight);
}

// ---------------------------------------------------------------------------------------------------------------------
// Outlines

/// Path data with y up, in mm.
class PathText {
 public:
  explicit PathText(double pageHeight) : height_(pageHeight) {
    text_.imbue(std::locale::classic());
    text_.setf(std::ios::fixed);
    text_.precision(3);
  }

  PathText& moveTo(Vec2 p) { return command("M", {p}); }
  PathText& lineTo(Vec2 p) { return command("L", {p}); }
  PathText& cubicTo(Vec2 a, Vec2 b, Vec2 p) { return command("C", {a, b, p}); }
  PathText& close() {
    text_ << "Z ";
    return *this;
  }
  /// The shorter arc to p, counter-clockwise or clockwise as seen on the plate.
  PathText& arcTo(double radius, bool clockwise, Vec2 p) {
    text_ << "A" << radius << " " << radius << " 0 0 " << (clockwise ? 1 : 0);
    return command(" ", {p});
  }
  PathText& circle(Vec2 centre, double radius) {
    const Vec2 right{radius, 0};
    return moveTo(centre + right).arcTo(radius, false, centre - right).arcTo(radius, false, centre + right).close();
  }
  /// Smooth closed curve through points (Catmull-Rom).
  PathText& closedCurve(const std::vector<Vec2>& p) {
    const std::size_t n = p.size();
    moveTo(p[0]);
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 from = p[k];
      const Vec2 to = p[(k + 1) % n];
      cubicTo(from + (to - p[(k + n - 1) % n]) * (1.0 / 6), to - (p[(k + 2) % n] - from) * (1.0 / 6), to);
    }
    return close();
  }
  PathText& polygon(const std::vector<Vec2>& p) {
    moveTo(p[0]);
    for (std::size_t k = 1; k < p.size(); ++k) lineTo(p[k]);
    return close();
  }

  [[nodiscard]] std::string text() const { return text_.str(); }

 private:
  PathText& command(const char* letter, std::initializer_list<Vec2> points) {
    text_ << letter;
    for (const Vec2 p : points) text_ << p.x << " " << height_ - p.y << " ";
    return *this;
  }

  double height_;
  std::ostringstream text_;
};

void writeSvg(const std::string& name, Vec2 page, const PathText& path) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << page.x << "mm\" height=\"" << page.y
       << "mm\" viewBox=\"0 0 " << page.x << " " << page.y << "\">\n  <path fill-rule=\"evenodd\" d=\"" << path.text()
       << "\"/>\n</svg>\n";
  const std::string svg = text.str();
  writeFile(name, svg.data(), svg.size());
}

// ---------------------------------------------------------------------------------------------------------------------
// logo: a medal with an S of furrows, one mode per zone

/// Where a point lies relative to the S: distance to its spine and the spine's direction there.
struct Stroke {
  double distance = 1e30;
  double angle = 0;  ///< [rad]
};

/// Upper arc of the S around (0, r), from the origin clockwise to its end; the lower arc is its half-turn.
Stroke upperArc(Vec2 p) {
  constexpr double r = 12.8;
  constexpr double kStretch = 1.18;  // sideways
  constexpr double kEnd = 25;        // degrees above the horizontal where the arc ends
  const Vec2 q{p.x / kStretch, p.y - r};
  const double around = degrees(angleOf(q));
  const Vec2 tip{r * std::cos(radians(kEnd)), r * std::sin(radians(kEnd))};
  const bool beside = around > kEnd || around < -90;
  const double distance = beside ? std::abs(length(q) - r) : std::min(length(q - tip), length(q - Vec2{0, -r}));
  return {distance, angleOf({-q.y * kStretch, q.x})};
}

Stroke letterS(Vec2 p) {
  const Stroke upper = upperArc(p);
  const Stroke lower = upperArc(-p);
  return upper.distance < lower.distance ? upper : lower;
}

void logo() {
  const Vec2 page{100, 100};
  const Vec2 middle{50, 50};
  constexpr double kHalfStroke = 6.4;
  writeSvg("logo.svg", page, PathText(page.y).circle(middle, 49).circle({50, 91.5}, 2.6));
  writePng("logo_angle.png", page, 5, [&](Vec2 p) {
    const Stroke s = letterS(p - middle);
    return angleGrey(s.distance < kHalfStroke + 1 ? degrees(s.angle) : 60);
  });
  writePng("logo_mode.png", page, 5, [&](Vec2 p) {
    const double radius = length(p - middle);
    const double distance = letterS(p - middle).distance;
    if (radius > 45.5) return kParallel;
    if (radius > 38) return kOrthogonal;
    if (radius > 36.5) return kSmoothest;
    return distance > kHalfStroke && distance < kHalfStroke + 1.5 ? kSmoothest : kConstrained;
  });
}

// ---------------------------------------------------------------------------------------------------------------------
// photo: evening at the sea

double ridge(double x, double size, std::uint32_t seed) { return fractalNoise({x / size, 0.5}, seed, 5); }

double cypress(Vec2 p, Vec2 foot, double height) {
  const double t = (p.y - foot.y) / height;
  const double half = 0.13 * height * std::sqrt(std::max(0.0, t)) * (1 - t) * 1.9;
  const double ragged = half * (0.85 + 0.3 * noise(p * 1.3, 91));
  return t > 0 && t < 1 && std::abs(p.x - foot.x) < ragged ? 1 : 0;
}

double landscapeTone(Vec2 p) {
  const Vec2 sun{79, 51};
  constexpr double kHorizon = 33;
  const double toSun = length(p - sun);

  if (p.y < kHorizon) {  // sea: wave crests lie denser towards the horizon
    const double depth = (kHorizon - p.y) / kHorizon;
    const double crest = fractalNoise({p.x / (2 + 26 * depth), 9 / (depth + 0.08)}, 5, 3);
    const double path = std::exp(-std::pow((p.x - sun.x) / (4.5 + 15 * depth), 2));
    double tone = mix(0.50, 0.16, std::sqrt(depth)) + 0.22 * (crest - 0.5);
    tone += path * (0.75 * smoothstep(0.36, 0.62, crest) - 0.05);
    const double shore = 15 * smoothstep(66, 4, p.x) + 2.2 * ridge(p.x, 9, 31) - 1;
    if (p.y < shore) tone = 0.05 + 0.16 * fractalNoise(p * 0.45, 33, 4) + 0.10 * smoothstep(1.2, 0, shore - p.y);
    return std::clamp(tone, 0.0, 1.0);
  }

  double tone = 0.20 + 0.42 * std::exp(-(p.y - kHorizon) / 24) + 0.42 * std::exp(-toSun / 12);
  const double cloud = smoothstep(0.50, 0.72, fractalNoise({p.x / 26, p.y / 5.5}, 8, 5)) * smoothstep(36, 56, p.y);
  tone = mix(tone, 0.30 + 0.62 * std::exp(-toSun / 26), 0.8 * cloud);
  if (toSun < 7.5) tone = 1;

  const double far = kHorizon + 17 * smoothstep(74, 18, p.x) * (0.35 + ridge(p.x, 21, 12)) +
                     7 * smoothstep(96, 122, p.x) * (0.4 + ridge(p.x, 15, 14));
  if (p.y < far) tone = 0.50 - 0.010 * (p.y - kHorizon) + 0.10 * (fractalNoise(p * 0.22, 15, 4) - 0.5);
  const double near = kHorizon + 13 * smoothstep(47, 0, p.x) * (0.3 + ridge(p.x, 16, 22));
  if (p.y < near) tone = 0.27 + 0.16 * (fractalNoise(p * 0.3, 25, 4) - 0.5) + 0.10 * smoothstep(3, 0, p.y - kHorizon);
  return tone;
}

/// Cypresses and a sail stand before both sea and sky.
double photoTone(Vec2 p) {
  double tone = landscapeTone(p);
  const Vec2 mast{61, 31.5};
  const Vec2 sail = p - mast;
  if (sail.y > 0 && sail.y < 9 && sail.x > 0.3 && sail.x < 4.6 * (1 - sail.y / 9)) tone = 0.95;
  if (sail.y > 1 && sail.y < 8 && sail.x < -0.2 && sail.x > -3 * (1 - sail.y / 8)) tone = 0.75;
  if (sail.y > -1.5 && sail.y < -0.1 && std::abs(sail.x) < 4.2 + sail.y * 0.7) tone = 0.04;
  const double trees = cypress(p, {13, 11}, 34) + cypress(p, {21, 12}, 25) + cypress(p, {6.5, 12}, 22);
  return trees > 0 ? 0.03 + 0.15 * fractalNoise({p.x * 0.9, p.y * 0.35}, 41, 3) : tone;
}

void photo() {
  const Vec2 page{120, 80};
  constexpr double kTexels = 4;
  // A bead's highlight is narrow: lifted middle tones look right on the plate.
  const auto lifted = [](Vec2 p) {
    return std::pow(antialiased(p, 1 / kTexels, [](Vec2 q) { return photoTone(q); }), 0.65);
  };
  writePng("photo.png", page, kTexels, [&](Vec2 p) { return toneGrey(lifted(p)); });
}

// ---------------------------------------------------------------------------------------------------------------------
// mosaic: the cells of a sunflower's seeds, each with its own direction

void mosaic() {
  const Vec2 page{90, 90};
  constexpr int kSeeds = 190;
  std::vector<Vec2> seeds;
  for (int k = 0; k < kSeeds; ++k) {
    const double golden = kPi * (3 - std::sqrt(5.0));
    const double radius = 47 * std::sqrt((k + 0.5) / kSeeds);
    seeds.push_back({45 + radius * std::cos(k * golden), 45 + radius * std::sin(k * golden)});
  }
  writePng("mosaic.png", page, 6, [&](Vec2 p) {
    int nearest = 0;
    for (int k = 1; k < kSeeds; ++k) {
      if (length(p - seeds[k]) < length(p - seeds[nearest])) nearest = k;
    }
    return angleGrey(180 * random(nearest, 0, 7));
  });
}

// ---------------------------------------------------------------------------------------------------------------------
// noise: from calm to storm

void noiseBand() {
  constexpr double kTexels = 2;
  writePng("noise.png", {120, 40}, kTexels, [](Vec2 p) {
    const double strength = smoothstep(6, 114, p.x);
    const int i = static_cast<int>(p.x * kTexels);
    const int j = static_cast<int>(p.y * kTexels);
    return angleGrey(180 * strength * (random(i, j, 3) - 0.5));
  });
}

// ---------------------------------------------------------------------------------------------------------------------
// tiles: a parquet whose squares stand across each other and turn along the diagonal

void tiles() {
  writePng("tiles.png", {96, 96}, 4, [](Vec2 p) {
    const int sum = static_cast<int>(p.x / 8) + static_cast<int>(p.y / 8);
    return angleGrey(45 + 7.5 * sum + (sum % 2 == 0 ? 0 : 90));
  });
}

// ---------------------------------------------------------------------------------------------------------------------
// qr: a code of version 1, correction level H (ISO/IEC 18004)

constexpr int kQrSide = 21;
using QrModules = std::array<std::array<bool, kQrSide>, kQrSide>;  ///< [row][column], true is dark

std::uint8_t galoisProduct(std::uint8_t a, std::uint8_t b) {
  unsigned product = 0;
  for (int bit = 7; bit >= 0; --bit) {
    product = (product << 1) ^ ((product >> 7) * 0x11dU);
    product ^= ((b >> bit) & 1U) * a;
  }
  return static_cast<std::uint8_t>(product);
}

/// Remainder of the data polynomial divided by (x - 1)(x - 2)(x - 4)... with `count` factors.
std::vector<std::uint8_t> reedSolomon(const std::vector<std::uint8_t>& data, std::size_t count) {
  std::vector<std::uint8_t> divisor(count, 0);
  divisor.back() = 1;
  std::uint8_t root = 1;
  for (std::size_t k = 0; k < count; ++k, root = galoisProduct(root, 2)) {
    for (std::size_t i = 0; i < count; ++i) {
      divisor[i] = galoisProduct(divisor[i], root);
      if (i + 1 < count) divisor[i] ^= divisor[i + 1];
    }
  }
  std::vector<std::uint8_t> remainder(count, 0);
  for (const std::uint8_t byte : data) {
    const auto factor = static_cast<std::uint8_t>(byte ^ remainder.front());
    remainder.erase(remainder.begin());
    remainder.push_back(0);
    for (std::size_t i = 0; i < count; ++i) remainder[i] ^= galoisProduct(divisor[i], factor);
  }
  return remainder;
}

/// \param text  at most 10 capital letters.
std::vector<std::uint8_t> qrCodewords(const std::string& text) {
  constexpr std::size_t kData = 9;
  constexpr std::size_t kCorrection = 17;
  std::vector<bool> bits;
  const auto append = [&](unsigned value, int count) {
    for (int k = count - 1; k >= 0; --k) bits.push_back(((value >> k) & 1U) != 0);
  };
  const auto digit = [](char letter) { return static_cast<unsigned>(letter - 'A') + 10U; };
  append(2, 4);  // alphanumeric
  append(static_cast<unsigned>(text.size()), 9);
  for (std::size_t k = 0; k < text.size(); k += 2) {
    if (k + 1 < text.size()) {
      append(digit(text[k]) * 45 + digit(text[k + 1]), 11);
    } else {
      append(digit(text[k]), 6);
    }
  }
  append(0, 4);
  while (bits.size() % 8 != 0) bits.push_back(false);
  std::vector<std::uint8_t> data;
  for (std::size_t k = 0; k < bits.size(); k += 8) {
    unsigned byte = 0;
    for (std::size_t i = 0; i < 8; ++i) byte = byte * 2 + (bits[k + i] ? 1U : 0U);
    data.push_back(static_cast<std::uint8_t>(byte));
  }
  for (bool odd = true; data.size() < kData; odd = !odd) data.push_back(odd ? 0xec : 0x11);
  const std::vector<std::uint8_t> correction = reedSolomon(data, kCorrection);
  data.insert(data.end(), correction.begin(), correction.end());
  return data;
}

bool isQrFunction(int row, int column) {
  const bool finder =
      (row < 9 && column < 9) || (row < 9 && column >= kQrSide - 8) || (row >= kQrSide - 8 && column < 9);
  return finder || row == 6 || column == 6;
}

QrModules qrCode(const std::string& text) {
  QrModules dark{};
  const auto set = [&](int row, int column, bool value) { dark[row][column] = value; };
  for (int k = 0; k < kQrSide; ++k) {
    set(6, k, k % 2 == 0);
    set(k, 6, k % 2 == 0);
  }
  const std::array<std::array<int, 2>, 3> finders{{{3, 3}, {3, kQrSide - 4}, {kQrSide - 4, 3}}};
  for (const auto& [centreRow, centreColumn] : finders) {
    for (int y = -4; y <= 4; ++y) {
      for (int x = -4; x <= 4; ++x) {
        const int row = centreRow + y;
        const int column = centreColumn + x;
        const int ring = std::max(std::abs(x), std::abs(y));
        if (row >= 0 && row < kQrSide && column >= 0 && column < kQrSide) set(row, column, ring != 2 && ring != 4);
      }
    }
  }

  // Level H and mask 0, protected by a BCH code.
  constexpr unsigned kFormat = 0b10000;
  unsigned remainder = kFormat;
  for (int k = 0; k < 10; ++k) remainder = (remainder << 1) ^ ((remainder >> 9) * 0x537U);
  const unsigned format = (kFormat << 10 | remainder) ^ 0x5412U;
  for (int k = 0; k < 15; ++k) {
    const bool bit = ((format >> k) & 1U) != 0;
    const int near = k < 6 ? k : k + 1;  // skips the timing pattern
    if (k < 8) {
      set(near, 8, bit);
      set(8, kQrSide - 1 - k, bit);
    } else {
      set(8, k == 8 ? 7 : 14 - k, bit);
      set(kQrSide - 15 + k, 8, bit);
    }
  }
  set(kQrSide - 8, 8, true);

  // Data runs in columns of two, up and down, from the right.
  const std::vector<std::uint8_t> codewords = qrCodewords(text);
  std::size_t next = 0;
  for (int right = kQrSide - 1; right >= 1; right -= 2) {
    if (right == 6) right = 5;
    const bool upward = ((right + 1) & 2) == 0;
    for (int k = 0; k < kQrSide; ++k) {
      const int row = upward ? kQrSide - 1 - k : k;
      for (int column = right; column > right - 2; --column) {
        if (isQrFunction(row, column)) continue;
        const bool bit = ((codewords[next / 8] >> (7 - next % 8)) & 1U) != 0;
        set(row, column, bit != ((row + column) % 2 == 0));
        ++next;
      }
    }
  }
  return dark;
}

void qr() {
  constexpr double kModule = 2;  // mm
  constexpr int kQuiet = 4;      // modules of margin
  const double side = kModule * (kQrSide + 2 * kQuiet);
  const QrModules dark = qrCode("SILLON");
  writePng("qr.png", {side, side}, 5, [&](Vec2 p) {
    const int column = static_cast<int>(p.x / kModule) - kQuiet;
    const int row = static_cast<int>((side - p.y) / kModule) - kQuiet;
    const bool inside = column >= 0 && column < kQrSide && row >= 0 && row < kQrSide;
    return angleGrey(inside && dark[row][column] ? 90 : 0);
  });
}

// ---------------------------------------------------------------------------------------------------------------------
// relief: an ammonite in low relief

/// Height of the medal's surface [mm]: the whorls of a logarithmic spiral, ribbed, on a slightly domed ground.
double ammoniteHeight(Vec2 p) {
  constexpr double kGrowth = 2.35;  // of the radius per turn
  constexpr double kMouth = 43;     // radius of the last whorl's outer edge where it ends
  const Vec2 d = p - Vec2{49.5, 48};
  const double radius = std::max(length(d), 1e-6);
  const double turn = (angleOf(d) + kPi) / (2 * kPi);  // 0..1 from the mouth on the left
  const double ground = -0.0006 * dot(d, d);

  // The whorl that holds this point: edges at kMouth * growth^(-turn - k), the outermost ends at the mouth.
  const double position = std::log(kMouth / radius) / std::log(kGrowth) - turn;
  const double whorl = std::floor(position);
  if (whorl < 0) return ground;
  const double across = position - whorl;  // 0 outer edge, 1 inner edge
  const double along = turn + whorl;       // turns back from the mouth
  const double tube = kMouth * std::pow(kGrowth, -along);
  const double profile = std::sqrt(std::max(0.0, 1 - std::pow(2 * across - 1, 2)));
  const double ribs = std::cos(2 * kPi * (26 * along / (1 + 0.06 * along) + 0.9 * std::pow(across - 0.1, 2)));
  const double ribbed = 0.085 * ribs * smoothstep(0, 0.35, profile);
  return ground + tube * (0.30 * profile + 0.30 * ribbed) * smoothstep(6.5, 0.5, along);
}

double ammoniteTone(Vec2 p) {
  constexpr double h = 0.15;
  const double dx = (ammoniteHeight(p + Vec2{h, 0}) - ammoniteHeight(p - Vec2{h, 0})) / (2 * h);
  const double dy = (ammoniteHeight(p + Vec2{0, h}) - ammoniteHeight(p - Vec2{0, h})) / (2 * h);
  const Vec2 light{-0.50, 0.56};
  constexpr double kUp = 0.66;
  const double lambert = (kUp - light.x * dx - light.y * dy) / std::sqrt(1 + dx * dx + dy * dy);
  return std::clamp(0.06 + 0.94 * std::max(0.0, lambert), 0.0, 1.0);
}

void relief() {
  constexpr double kTexels = 5;
  writePng("relief.png", {84, 84}, kTexels,
           [&](Vec2 p) { return toneGrey(antialiased(p, 1 / kTexels, [](Vec2 q) { return ammoniteTone(q); })); });
}

// ---------------------------------------------------------------------------------------------------------------------
// stress: teeth, holes and turns that grow finer, in each quadrant under another mode

void stress() {
  const Vec2 page{140, 140};
  const Vec2 middle{70, 70};
  const auto polar = [&](double radius, double angle) {
    return middle + Vec2{radius * std::cos(radians(angle)), radius * std::sin(radians(angle))};
  };
  constexpr int kTeeth = 10;
  constexpr double kShrink = 0.78;
  PathText path(page.y);
  std::vector<Vec2> teeth;
  for (int quadrant = 0; quadrant < 4; ++quadrant) {
    double width = 45 * (1 - kShrink) / (1 - std::pow(kShrink, kTeeth));
    double angle = 90 * quadrant;
    for (int k = 0; k < kTeeth; ++k, width *= kShrink) {
      const int steps = 1 + static_cast<int>(width / 2);
      for (int i = 0; i <= steps; ++i) teeth.push_back(polar(68, angle + width * i / steps));
      angle += width;
      for (int i = 0; i <= steps; ++i) teeth.push_back(polar(46, angle + width * i / steps));
      angle += width;
    }
    double radius = 4.2;
    double at = 90 * quadrant + 12;
    for (int k = 0; k < 6; ++k) {
      path.circle(polar(37, at), radius);
      at += 2.05 * radius + 4.2;
      radius *= 0.66;
    }
  }
  path.polygon(teeth);
  writeSvg("stress.svg", page, path);
  writePng("stress_angle.png", page, 4, [&](Vec2 p) {
    const Vec2 d = p - middle;
    return angleGrey(8 * 180 * dot(d, d) / (70 * 70));
  });
  writePng("stress_mode.png", page, 2, [&](Vec2 p) {
    const Vec2 d = p - middle;
    if (length(d) < 28) return kConstrained;
    const int quadrant = d.y >= 0 ? (d.x >= 0 ? 0 : 1) : (d.x < 0 ? 2 : 3);
    return std::array{kParallel, kOrthogonal, kSmoothest, kConstrained}[quadrant];
  });
}

// ---------------------------------------------------------------------------------------------------------------------
// strokes: a leaf; only its veins say where beads run

constexpr Vec2 kLeafPage{120, 72};

double midrib(double x) { return 36 + 4 * std::sin((x - 8) / 110 * kPi * 1.6); }

double leafHalfWidth(double x) {
  const double t = std::clamp((x - 14) / 100, 0.0, 1.0);
  return 66 * std::pow(t, 0.62) * std::pow(1 - t, 0.95);
}

/// Polylines: the midrib, then pairs of veins that leave it and bend forward.
std::vector<std::vector<Vec2>> leafVeins() {
  std::vector<std::vector<Vec2>> veins(1);
  for (int k = 0; k <= 80; ++k) veins[0].push_back({5 + 108.0 * k / 80, midrib(5 + 108.0 * k / 80)});
  for (int pair = 0; pair < 7; ++pair) {
    for (const int side : {-1, 1}) {
      std::vector<Vec2> vein;
      const double start = 18 + 12 * pair + (side > 0 ? 3 : 0);
      for (int k = 0; k < 60; ++k) {
        const double s = 0.6 * k;
        const double x = start + 0.50 * s + 0.016 * s * s;
        const double away = 0.95 * s - 0.006 * s * s;
        if (away > leafHalfWidth(x) - 3) break;
        vein.push_back({x, midrib(x) + side * away});
      }
      if (vein.size() > 4) veins.push_back(vein);
    }
  }
  return veins;
}

Stroke nearestStroke(const std::vector<std::vector<Vec2>>& strokes, Vec2 p) {
  Stroke nearest;
  for (const std::vector<Vec2>& points : strokes) {
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const Vec2 along = points[k + 1] - points[k];
      const double t = std::clamp(dot(p - points[k], along) / dot(along, along), 0.0, 1.0);
      const double distance = length(p - points[k] - along * t);
      if (distance < nearest.distance) nearest = {distance, angleOf(along)};
    }
  }
  return nearest;
}

void strokes() {
  std::vector<Vec2> outline;
  constexpr int kSteps = 22;
  outline.push_back({5, midrib(5) - 1.4});
  for (int k = 0; k < kSteps; ++k) {
    const double x = 14 + 100.0 * k / kSteps;
    outline.push_back({x, midrib(x) - std::max(1.5, leafHalfWidth(x))});
  }
  outline.push_back({115, midrib(114)});
  for (int k = kSteps - 1; k >= 0; --k) {
    const double x = 14 + 100.0 * k / kSteps;
    outline.push_back({x, midrib(x) + std::max(1.5, leafHalfWidth(x))});
  }
  outline.push_back({5, midrib(5) + 1.4});
  writeSvg("strokes.svg", kLeafPage, PathText(kLeafPage.y).closedCurve(outline).circle({71, 22.5}, 3));

  constexpr double kHalfVein = 0.9;
  const auto veins = leafVeins();
  writePng("strokes_angle.png", kLeafPage, 5, [&](Vec2 p) {
    const Stroke s = nearestStroke(veins, p);
    return angleGrey(s.distance < kHalfVein + 0.4 ? degrees(s.angle) : 0);
  });
  writePng("strokes_mode.png", kLeafPage, 5,
           [&](Vec2 p) { return nearestStroke(veins, p).distance < kHalfVein ? kConstrained : kSmoothest; });
}

// ---------------------------------------------------------------------------------------------------------------------
// islands: a chart with a lagoon, canals and a letter

std::vector<Vec2> blob(Vec2 centre, Vec2 size, double roughness, std::uint32_t seed) {
  constexpr int kPoints = 18;
  std::vector<Vec2> points;
  for (int k = 0; k < kPoints; ++k) {
    const double angle = 2 * kPi * k / kPoints;
    const double radius = 1 + roughness * (random(k / 2, 0, seed) + 0.6 * random(k, 1, seed) - 0.8);
    points.push_back(centre + Vec2{size.x * radius * std::cos(angle), size.y * radius * std::sin(angle)});
  }
  return points;
}

/// A disc cut in two by a canal. \param gap  width of the canal [mm].
void canal(PathText& path, Vec2 centre, double radius, double gap) {
  for (const double side : {-1.0, 1.0}) {
    const Vec2 top = centre + Vec2{side * gap / 2, radius};
    const Vec2 bottom = centre + Vec2{side * gap / 2, -radius};
    path.moveTo(top)
        .arcTo(radius, side > 0, centre + Vec2{side * (gap / 2 + radius), 0})
        .arcTo(radius, side > 0, bottom)
        .close();
  }
}

void islands() {
  const Vec2 page{120, 80};
  PathText path(page.y);
  path.closedCurve(blob({31, 49.5}, {24, 22}, 0.34, 4));   // atoll,
  path.closedCurve(blob({30, 49.5}, {11, 10}, 0.30, 21));  // its lagoon,
  path.closedCurve(blob({30, 49.5}, {4.5, 4}, 0.30, 9));   // and an islet in it
  // A letter with two holes.
  path.moveTo({66, 36}).lineTo({66, 73}).lineTo({79, 73});
  path.cubicTo({92, 73}, {92, 56}, {82, 55.2}).cubicTo({95, 54}, {94, 36}, {80, 36}).close();
  path.moveTo({72, 58.5}).lineTo({72, 67.5}).lineTo({78, 67.5}).cubicTo({84, 67.5}, {84, 58.5}, {78, 58.5}).close();
  path.moveTo({72, 42}).lineTo({72, 52}).lineTo({79, 52}).cubicTo({86.5, 52}, {86.5, 42}, {79, 42}).close();
  canal(path, {22, 11}, 8, 0.25);  // narrower than a bead: both halves become one path
  canal(path, {45, 11}, 8, 1);     // wider: two paths
  path.closedCurve(blob({80, 17}, {20, 11}, 0.40, 33));
  path.circle({74, 17}, 2.6).circle({83, 19}, 1.6);
  path.closedCurve(blob({108, 57}, {8, 17}, 0.34, 40));
  path.closedCurve(blob({111, 25}, {5, 6}, 0.30, 52));
  path.circle({111.5, 11}, 3);
  writeSvg("islands.svg", page, path);
}

// ---------------------------------------------------------------------------------------------------------------------
// star and heart, sun and moon: one plate, two pictures. These hold tones.

/// White where inside(p), with p in [-1, 1] and edges a texel soft.
template <class Inside>
void writeEmblem(const std::string& name, Inside inside) {
  constexpr double kSide = 100, kTexelsPerMm = 4;
  constexpr int kSamples = 4;  // per texel and axis
  writePng(name, {kSide, kSide}, kTexelsPerMm, [&](Vec2 p) {
    int hits = 0;
    for (int k = 0; k < kSamples * kSamples; ++k) {
      const Vec2 off{(k % kSamples + 0.5) / kSamples - 0.5, (k / kSamples + 0.5) / kSamples - 0.5};
      const Vec2 q = (p + off * (1 / kTexelsPerMm)) * (2 / kSide) - Vec2{1, 1};
      hits += inside(q) ? 1 : 0;
    }
    return 255.0 * hits / (kSamples * kSamples);
  });
}

/// Five points, one of them up. \param point, notch  their radii
bool inStar(Vec2 p, double point, double notch) {
  const double turn = std::atan2(p.x, p.y) * 5 / (2 * kPi) + 0.5;  // a point at every whole number and a half
  const double from = std::abs(turn - std::floor(turn) - 0.5) * 2 * kPi / 5;  // [rad] from the nearest point's axis
  // The edge runs from (point, 0) to the notch at 36 degrees.
  const Vec2 q{length(p) * std::cos(from), length(p) * std::sin(from)};
  const Vec2 n{notch * std::cos(kPi / 5), notch * std::sin(kPi / 5)};
  return (q.x - point) * n.y - q.y * (n.x - point) < 0;
}

/// Clockwise. \param by  [degrees]
Vec2 turned(Vec2 p, double by) {
  const double c = std::cos(radians(by)), s = std::sin(radians(by));
  return {c * p.x + s * p.y, c * p.y - s * p.x};
}

/// A round stroke along an arc. \param from, to  [degrees], counter-clockwise
bool onArc(Vec2 p, Vec2 centre, double radius, double from, double to, double halfWidth) {
  const Vec2 q = p - centre;
  const double past = degrees(angleOf(q)) - from;
  const double turned = past - 360 * std::floor(past / 360);
  if (turned <= to - from) return std::abs(length(q) - radius) < halfWidth;
  const auto end = [&](double at) { return Vec2{radius * std::cos(radians(at)), radius * std::sin(radians(at))}; };
  return std::min(length(q - end(from)), length(q - end(to))) < halfWidth;
}

/// A smiling face in a ring of rays, straight ones and flames by turns.
bool inSun(Vec2 p) {
  constexpr double kFace = 0.46, kRays = 0.53, kTip = 0.95, kPairs = 8;
  const double r = length(p);
  if (r < kFace) {
    const Vec2 q{std::abs(p.x), p.y};  // both halves are alike
    const bool eye = onArc(q, {0.17, 0.09}, 0.085, 10, 170, 0.027);
    const bool brow = onArc(q, {0.18, 0.08}, 0.19, 45, 125, 0.02);
    const bool mouth = onArc(q, {0, -0.06}, 0.2, -140, -40, 0.03);
    const bool cheek = length(q - Vec2{0.27, -0.09}) < 0.05;
    return !(eye || brow || mouth || cheek);
  }
  if (r < kRays) return false;
  const double turn = std::atan2(p.x, p.y) * kPairs / kPi;  // straight rays at even numbers, flames at odd ones
  const double nearest = std::round(turn);
  const bool flame = std::fmod(std::abs(nearest), 2) == 1;
  const double t = (r - kRays) / ((flame ? 0.88 : kTip) - kRays);
  const double aside = (turn - nearest) * kPi / kPairs * r - (flame ? 0.045 * std::sin(2 * kPi * t) : 0);
  return std::abs(aside) < (flame ? 0.085 : 0.1) * (1 - t);
}

/// A sleeping crescent among stars.
bool inMoon(Vec2 p) {
  const Vec2 n = turned(p - Vec2{-0.3, 0.015}, 25);
  const bool nose = length(Vec2{n.x / 1.6, n.y}) < 0.075;
  if ((length(p - Vec2{-0.1, 0}) < 0.8 && length(p - Vec2{0.31, 0.1}) > 0.63) || nose) {
    const bool eye = onArc(p, {-0.54, 0.2}, 0.13, 200, 340, 0.03);
    const bool brow = onArc(p, {-0.53, 0.22}, 0.21, 60, 120, 0.024);
    const bool mouth = onArc(p, {-0.4, -0.14}, 0.15, 225, 320, 0.03);
    const bool cheek = length(p - Vec2{-0.64, -0.13}) < 0.055;
    return !(eye || brow || mouth || cheek);
  }
  return inStar(p - Vec2{0.34, 0.24}, 0.29, 0.125) || inStar(p - Vec2{0.7, -0.16}, 0.19, 0.08) ||
         inStar(p - Vec2{0.22, -0.22}, 0.15, 0.064) || length(p - Vec2{0.66, 0.5}) < 0.045 ||
         length(p - Vec2{0.78, 0.2}) < 0.035 || length(p - Vec2{0.05, 0.45}) < 0.035;
}

void emblems() {
  writeEmblem("star.png", [](Vec2 p) { return inStar(p, 0.86, 0.4); });
  writeEmblem("heart.png", [](Vec2 p) {
    const double x = p.x / 0.68, y = (p.y + 0.05) / 0.68;
    const double ring = x * x + y * y - 1;
    return ring * ring * ring < x * x * y * y * y;
  });
  writeEmblem("sun.png", inSun);
  writeEmblem("moon.png", inMoon);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: make_inputs FOLDER\n";
    return 2;
  }
  folder = argv[1];
  logo();
  photo();
  mosaic();
  noiseBand();
  tiles();
  qr();
  relief();
  stress();
  strokes();
  islands();
  emblems();
  return failed ? 1 : 0;
}
