#include "sillon/input/image_io.hpp"
#include "sillon/look/inversion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "look/rasters.hpp"

namespace sillon {
namespace {

constexpr int kCurveSteps = 4096;  // steps of the tables of light and codes

/// x^(1/5) by Newton's method, which needs only + * /, so that the bytes are the same everywhere.
double fifthRoot(double x) {
  if (!(x > 0)) return 0;
  double y = 1;
  while (y * y * y * y * y > 2 * x) y *= 0.8;
  for (int k = 0; k < 12; ++k) y = (4 * y + x / (y * y * y * y)) / 5;
  return y;
}

/// x^(1/3) of x in [0, 1], in the same way.
double cubeRoot(double x) {
  if (!(x > 0)) return 0;
  double y = 1;
  for (int k = 0; k < 12; ++k) y = (2 * y + x / (y * y)) / 3;
  return y;
}

double power2p4(double x) {  // x^(12/5)
  const double root = fifthRoot(x);
  const double squared = root * root;
  return x * x * squared;
}

// The sRGB curve (IEC 61966-2-1): linear near black, a power of 2.4 above.
double lightOfCodeExactly(double c) { return c <= 0.04045 ? c / 12.92 : power2p4((c + 0.055) / 1.055); }

/// Code of the light root²: the power is root^(2/2.4) = root / root^(1/6).
double codeOfRootExactly(double root) {
  const double light = root * root;
  return light <= 0.04045 / 12.92 ? 12.92 * light : 1.055 * root / cubeRoot(std::sqrt(root)) - 0.055;
}

/// Tables of the sRGB curve and its inverse.
struct Curves {
  std::array<float, kCurveSteps + 2> light{};  // light of codes k / kCurveSteps
  std::array<float, kCurveSteps + 2> code{};   // codes of light (k / kCurveSteps)²: steps are finest in the dark
};

const Curves& curves() {
  static const Curves made = [] {
    Curves c;
    for (int k = 0; k <= kCurveSteps; ++k) {
      const double x = static_cast<double>(k) / kCurveSteps;
      c.light[k] = static_cast<float>(lightOfCodeExactly(x));
      c.code[k] = static_cast<float>(codeOfRootExactly(x));
    }
    // One more entry, so that interpolation at 1 reads no value past the end.
    c.light[kCurveSteps + 1] = c.light[kCurveSteps];
    c.code[kCurveSteps + 1] = c.code[kCurveSteps];
    return c;
  }();
  return made;
}

// Linear interpolation in a table over [0, 1].
float between(const std::array<float, kCurveSteps + 2>& curve, float x) {
  const float place = std::clamp(x, 0.0f, 1.0f) * kCurveSteps;
  const int k = static_cast<int>(place);
  return curve[k] + (curve[k + 1] - curve[k]) * (place - static_cast<float>(k));
}

float codeOf(const Curves& curve, float light) { return between(curve.code, std::sqrt(std::clamp(light, 0.0f, 1.0f))); }

float codeOfSample(std::uint16_t sample) { return static_cast<float>(sample) * (1.0f / 65535); }

/// Table of the light of each possible sample, as photographs have many more pixels than there are samples.
const std::vector<float>& lightOfSamples() {
  static const std::vector<float> made = [] {
    std::vector<float> light;
    for (int sample = 0; sample <= 65535; ++sample) {
      light.push_back(between(curves().light, codeOfSample(static_cast<std::uint16_t>(sample))));
    }
    return light;
  }();
  return made;
}

/// Makes tones of an image on white: transparent pixels count as paper. \param grey  code of a pixel from its samples
/// of red, green and blue; pictures without colours have their own grey.
template <class Grey>
Tones greysOf(const Image& image, Grey&& grey) {
  // Four pixels of the largest pictures become one tone: a tone for each would take as much memory as the picture.
  const bool large = static_cast<std::int64_t>(image.width) * image.height > kMaxImagePixels;
  const int halved = large ? 1 : 0;
  Tones tones{image.width >> halved, image.height >> halved, {}};
  tones.value.resize(cellCount(tones.width, tones.height));
  const std::size_t channels = image.channels;
  for (int y = 0; y < tones.height << halved; ++y) {
    const std::uint16_t* pixel = &image.samples[indexOf(0, y, image.width) * channels];
    float* const row = &tones.value[indexOf(0, y >> halved, tones.width)];
    for (int x = 0; x < tones.width << halved; ++x, pixel += channels) {
      const float solid = channels % 2 == 0 ? codeOfSample(pixel[channels - 1]) : 1;
      const float code = channels < 3 ? codeOfSample(pixel[0]) : grey(pixel);
      const float tone = code * solid + (1 - solid);
      row[x >> halved] += large ? tone / 4 : tone;
    }
  }
  return tones;
}

}  // namespace

float lightOfCode(float code) { return between(curves().light, code); }

float codeOfLight(float light) { return codeOf(curves(), light); }

// Luminance in linear light (Rec. 709), encoded again.
Tones tonesOf(const Image& image) {
  return greysOf(image, [&curve = curves(), &light = lightOfSamples()](const std::uint16_t* pixel) {
    return codeOf(curve, 0.2126f * light[pixel[0]] + 0.7152f * light[pixel[1]] + 0.0722f * light[pixel[2]]);
  });
}

// Luma of the codes themselves (Rec. 601), as video has it.
Tones lumaOf(const Image& image) {
  return greysOf(image, [](const std::uint16_t* pixel) {
    return 0.299f * codeOfSample(pixel[0]) + 0.587f * codeOfSample(pixel[1]) + 0.114f * codeOfSample(pixel[2]);
  });
}

// Means are taken in linear light: means of codes would darken fine patterns.
Tones resampled(const Tones& tones, int width, int height) {
  if (tones.width == width && tones.height == height) return tones;
  Tones out = tones;
  for (float& v : out.value) v = lightOfCode(v);
  out = means(out, width, height);
  for (float& v : out.value) v = codeOfLight(v);
  return out;
}

/// Half a step of 8 bits. Means of one grey differ in their last digits; stretched, these would become a picture.
constexpr float kRounding = 0.5f / 255;

// Stretches tones so that the 1st and 99th percentile within the shape become black and white.
Tones levelled(const Tones& tones, const std::vector<char>& inside) {
  Tones out = tones;
  if (out.value.empty()) return out;
  std::vector<float> sorted;
  for (std::size_t k = 0; k < out.value.size(); ++k) {
    if (inside.empty() || inside[k] != 0) sorted.push_back(out.value[k]);
  }
  // If the shape holds no cell, the whole picture counts.
  if (sorted.empty()) sorted = out.value;
  // Percentiles by selection, as sorting all tones would take longer.
  const auto percentile = [&](std::size_t percent) {
    const std::size_t k = (sorted.size() - 1) * percent / 100;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(k), sorted.end());
    return sorted[k];
  };
  const float low = percentile(1);
  const float high = percentile(99);
  if (!(high - low > kRounding)) {
    // Nearly all of one grey: stretch between the extremes, unless these are equal, too.
    const auto [least, most] = std::minmax_element(sorted.begin(), sorted.end());
    const float from = *least;
    const float to = *most;
    for (float& v : out.value) v = to - from > kRounding ? std::clamp((v - from) / (to - from), 0.0f, 1.0f) : 0.5f;
    return out;
  }
  for (float& v : out.value) v = std::clamp((v - low) / (high - low), 0.0f, 1.0f);
  return out;
}

}  // namespace sillon
