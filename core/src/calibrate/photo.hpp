// Steps of reading a photograph of a coupon: finding it, then fitting what it shows.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include "base/exact_math.hpp"
#include "calibrate/prints.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/base/types.hpp"
#include "sillon/calibrate/read_photo.hpp"
#include "sillon/look/inversion.hpp"

namespace sillon {

// Vectors and maps of space, no more than a photograph needs: headers that know all of algebra take compilers long.

struct Vec3 {
  double x = 0, y = 0, z = 0;

  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
  friend constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend double length(Vec3 a) { return std::sqrt(dot(a, a)); }
  friend Vec3 unit(Vec3 a) { return (1 / length(a)) * a; }
};

/// A linear map, by its columns.
struct Mat3 {
  Vec3 a{1, 0, 0}, b{0, 1, 0}, c{0, 0, 1};

  friend constexpr Vec3 operator*(const Mat3& m, Vec3 v) { return v.x * m.a + v.y * m.b + v.z * m.c; }
  friend constexpr Mat3 operator*(const Mat3& m, const Mat3& n) { return {m * n.a, m * n.b, m * n.c}; }

  [[nodiscard]] constexpr Mat3 transposed() const { return {{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}}; }
  /// Inverts a map that has an inverse.
  [[nodiscard]] constexpr Mat3 inverse() const {
    const Vec3 bc = cross(b, c);
    const double by = 1 / dot(a, bc);
    return Mat3{by * bc, by * cross(c, a), by * cross(a, b)}.transposed();
  }
};

/// Maps a point, in homogeneous coordinates.
constexpr Vec2 mapped(const Mat3& map, Vec2 p) {
  const Vec3 at = map * Vec3{p.x, p.y, 1};
  return {at.x / at.z, at.y / at.z};
}

// The map from one plane onto another as a camera sees it, through pairs of points.

struct PointPair {
  Vec2 plate, pixel;
  double weight = 1;
  Vec2 first{1, 0}, second{0, 1};  ///< what is measured of the pixel: its products with these
};

/// Direct linear transform, on coordinates of about 1. At least four pairs, of which no three are in line.
/// \param side  of the plate [mm], whose middle gets depth 1. \return plate to pixels, homogeneous.
Mat3 mapThrough(const std::vector<PointPair>& pairs, double side);

/// Residual that a map leaves of what is measured [pixels].
double leftOf(const PointPair& pair, const Mat3& map);

/// The same, where pairs count less the farther they are off, half at 0.1 mm: some are seen where they are not.
/// \param scale  [pixels/mm] \return weighted RMS of what is left, of what is measured [mm].
double fitMap(Mat3& map, const std::vector<PointPair>& pairs, double side, double scale);

// Finds the outline of a square plate in a photograph.

/// Corners of the one thing that lies on a plain ground [pixels from the upper left], as the picture's y goes down:
/// clockwise to the eye. \return InvalidFile: no plain ground, nothing on it, cut off, or not of four sides.
Result<std::vector<Vec2>> findOutline(const Image& photograph);

// Finds a coupon in a photograph.

/// A photograph and the map from the plate into it.
struct FoundCoupon {
  Mat3 map;            ///< plate [mm] to pixels from the picture's upper left, homogeneous
  double clarity = 0;  ///< 0..1, how clearly the turns of the spirals are seen

  [[nodiscard]] Vec2 pixelOf(Vec2 plate) const;
  /// Derivatives of the pixel by the place's x and y [pixels/mm].
  struct Steps {
    Vec2 x, y;
  };
  [[nodiscard]] Steps stepsAt(Vec2 plate) const;
  [[nodiscard]] double scaleAt(Vec2 plate) const;  ///< [pixels/mm]
};

/// First the plate's outline, on a plain ground; then, of four ways round, the one in which its spirals show.
/// \param tones  luminance of `photograph`. \param spirals  all of the coupon.
Result<FoundCoupon> findCoupon(const Image& photograph, const Tones& tones, const std::vector<CouponSpiral>& spirals,
                               const RunContext& run);

// Finds spirals in a photograph, by the pattern of their turns.

struct SeenSpiral {
  Vec2 off;            ///< of the spiral from where the map has it [mm]
  double clarity = 0;  ///< 1: nothing but a wave along its turns
};

/// For each spiral, where its turns answer most to those that it should have.
/// \param reach  how far off they may lie [mm]. \param stride  1: every place, and between them; 2: every other one.
std::vector<SeenSpiral> findSpirals(const std::vector<CouponSpiral>& spirals, const FoundCoupon& found,
                                    const Tones& tones, double reach, int stride);

double meanClarity(const std::vector<SeenSpiral>& seen);

// A photograph's pixels of the coupon's spirals, sorted by the direction of the bead and the place across it.

inline constexpr int kAngles = 36;  ///< around a spiral's middle
inline constexpr int kPhases = 10;  ///< from the middle of one turn to the next

struct FoldedSpiral {
  struct Bin {
    double light = 0;  ///< mean, as sRGB codes have it, 0..1
    int count = 0;     ///< of pixels; 0 where too many are burnt
    int burnt = 0;     ///< of these
  };
  std::array<std::array<Bin, kPhases>, kAngles> bins;
  double meanInverseRadius = 0;  ///< [1/mm], of the pixels
  int pixels = 0;
  int burnt = 0;  ///< with a channel at its upper end
};

/// Angle k is at (k + 0.5) / kAngles of a turn from +x, phase k at (k + 0.5) / kPhases of the pitch outward.
FoldedSpiral foldSpiral(const CouponSpiral& spiral, const FoundCoupon& found, const Image& photograph,
                        const Tones& tones);

// The appearance model, fitted to folded spirals.

enum class SpiralKind { Mark, Loose, Flow };

struct LitSpiral {
  CouponSpiral spiral;  ///< as it was asked for
  SpiralKind kind = SpiralKind::Mark;
  double flow = 1;    ///< asked for
  double width = 0;   ///< of a bead of flow 1 [mm]
  double height = 0;  ///< of a bead [mm]
  FoldedSpiral seen;
  Vec2 fromAxis;                  ///< from the picture's middle, in half widths and half heights
  Vec2 blurX{1, 0}, blurY{0, 1};  ///< steps of one pixel on the plate [mm]
};

struct SeenFrom {
  Vec3 place{0, 0, 1};         ///< of the camera, from the coupon's middle [mm]
  double distanceError = 0.5;  ///< of the log of its distance
  double directionError = 0;   ///< [radians]
  double strange = 0;          ///< how far the map is from any that a whole picture has, by the map's error
};

/// Prior of the lamp's elevation [degrees].
struct Elevation {
  double value = 47;
  double error = 9;
};

// Tilt x, tilt y, log of both variances, log blur, closing, lone, log of the camera's distance by the given one,
// inverse distance of the lamp [1/m], contrast of the camera's tone curve, sharpening, and how far all spirals seem to
// lie off, as they shine on their lamp's side [mm].
inline constexpr std::size_t kGlobals = 13;
using Globals = std::array<double, kGlobals>;

struct SpiralFit {
  Vec2 tilt;                 ///< slope that mirrors the lamp into the camera, in the coupon's middle
  double alongVariance = 0;  ///< of slopes, the lamp's included
  double acrossVariance = 0;
  double blur = 0;                    ///< standard deviation [pixels]
  double closing = 0;                 ///< width of beads in discs and marks, by what their flow asks for
  double lone = 0;                    ///< width of lone beads, likewise
  std::array<double, 7> variances{};  ///< of the first globals
  struct Surety {
    double xx = 0, xy = 0, yy = 0;
  };
  std::vector<Surety> surety;         ///< of the offsets: inverse variances, up to a factor
  std::vector<Vec2> offsets;          ///< of the spirals from where they were folded about [mm]
  double misfit = 0;                  ///< RMS of what is left, by the brightest direction's light
  double contrast = 0;                ///< brightest direction's light by the darkest's, of what was seen
  Globals globals{};                  ///< to begin with again
  double diffuse = 0;                 ///< mean light of what every direction sends [photograph's]
  double veil = 0;                    ///< light that lies evenly over the picture, by the brightest beads'
  std::array<double, 3> veilTerms{};  ///< [photograph's]: even, and by fromAxis
  double sharpening = 0;              ///< share that an unsharp mask adds of what a blur takes off
};

/// \param before  a fit of the same spirals, folded about nearby places, to begin with; nullptr: none.
SpiralFit fitSpirals(const std::vector<LitSpiral>& spirals, const SeenFrom& camera, const Elevation& elevation,
                     const SpiralFit* before, const RunContext& run);

// The map from the plate into a photograph, through where a fit has found the spirals.

/// Turns shine in few directions only. There a closed spiral looks nearly alike one turn farther along the lamp's
/// tilt, and may have been found there: it is put where the others say.
/// \param fit  of `spirals`, as they were seen through the map.
void refineMap(FoundCoupon& found, const std::vector<LitSpiral>& spirals, const SpiralFit& fit);

// Normal equations of least squares: gathered row by row, and solved.

/// A symmetric matrix that is positive definite, and the right side of its equations.
struct NormalEquations {
  std::size_t size;
  std::vector<double> matrix = std::vector<double>(size * size, 0);
  std::vector<double> right = std::vector<double>(size, 0);

  [[nodiscard]] double& at(std::size_t row, std::size_t column) { return matrix[row * size + column]; }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return matrix[row * size + column]; }

  /// One equation: row * x = value.
  void add(const double* row, double value, double weight);

  /// x of matrix * x = right.
  [[nodiscard]] std::vector<double> solved() const;

  /// Diagonal of the matrix' inverse, its first `count`.
  [[nodiscard]] std::vector<double> variances(std::size_t count) const;
};

// Errors that photographs of one spool have in common: large lamps look like rough surfaces, and the model is not
// exact.

inline constexpr double kModelShare = 0.03;  ///< of a slope, as rendered photographs have it

struct LampPart {
  double variance = 0;  ///< of slopes
  double error = 0;     ///< of `variance`
};

/// \param slope  of the lamp, known within a twentieth; unset: evenly spread up to kUnknownLampSlope.
inline LampPart lampPartOf(const std::optional<double>& slope) {
  if (slope) return {*slope * *slope, 0.1 * *slope * *slope};
  constexpr double kMost = kUnknownLampSlope * kUnknownLampSlope;
  return {kMost / 3, kMost * std::sqrt(4.0 / 45)};
}

/// Error of a slope, out of that of its variance [degrees].
inline double slopeErrorOf(double degrees, double varianceError) {
  const double slope = exact::tan(degrees * std::numbers::pi / 180);
  return varianceError / (2 * slope) / (1 + slope * slope) * 180 / std::numbers::pi;
}

// Model of folded spirals in the light of one lamp: the appearance model, and a camera's tone curve.

/// Slope that mirrors the lamp into a camera towards `eye`, and back.
Vec2 tiltAt(Vec3 lamp, Vec3 eye);
Vec3 lampOf(Vec2 tilt, Vec3 eye);

class SpiralModel {
 public:
  static constexpr std::size_t kRows = std::size_t{kAngles} * kPhases;
  using Rows = std::array<double, kRows>;
  using Basis = std::array<Vec3, kRows>;

  /// Keeps a reference to the spirals.
  SpiralModel(const std::vector<LitSpiral>& spirals, const SeenFrom& camera);

  struct Light {
    Rows weight, seen;
  };

  /// The light that a camera of this contrast has seen, weighted so that equal steps of codes count alike.
  [[nodiscard]] Light lightOf(std::size_t which, double contrast) const;
  /// Light of the brightest bin.
  [[nodiscard]] double brightest(double contrast) const;

  static constexpr std::size_t kHarmonics = 6;  ///< of the pattern across a pitch; lenses leave no more
  struct Wave {
    double re = 0, im = 0;
  };
  using Pattern = std::array<Wave, kHarmonics>;

  /// Light that a spiral sends, before lens and shift. The globals for blur, contrast, sharpening and offset do not
  /// matter to it.
  struct Shape {
    double light = 1;                                       ///< by the distance of the lamp
    Pattern body{};                                         ///< at every angle
    std::array<Pattern, std::size_t{2} * kAngles> shine{};  ///< at two points of each angle
    std::array<Pattern, std::size_t{2} * kAngles> floor{};  ///< of loose spirals
  };
  [[nodiscard]] Shape shapeOf(std::size_t which, const Globals& g) const;

  /// Tones of a spiral for a highlight of 1, for a body of 1, and for gaps of 1 between loose turns where
  /// no bead stands before the lamp or the camera.
  /// \param off  of the spiral from where it was folded about [mm].
  [[nodiscard]] Basis basisOf(std::size_t which, const Shape& shape, const Globals& g, Vec2 off) const;

  /// An unsharp mask over codes: it adds what a blur takes off them.
  struct Sharpened {
    Rows light;
    std::array<std::array<double, std::size_t{kPhases} * kPhases>, kAngles>
        by;  ///< derivatives, of each angle's phases
  };
  /// \param light  that falls onto the camera.
  [[nodiscard]] Sharpened sharpened(std::size_t which, const Rows& light, double contrast, double amount) const;

 private:
  const std::vector<LitSpiral>& spirals_;
  SeenFrom camera_;
  double profile_;
  std::vector<Rows> codes_;  // of the bins; below 0: none
  double brightest_ = 0;
};

}  // namespace sillon
