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
#include "sillon/calibrate/calibrate.hpp"
#include "sillon/look/inversion.hpp"

namespace sillon {

// Vectors and linear maps of space, with no more than a photograph needs: headers of whole algebra libraries compile
// slowly.

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

/// A linear map, given by its columns.
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

/// Maps a point of a plane by a homogeneous map.
constexpr Vec2 mapped(const Mat3& map, Vec2 p) {
  const Vec3 at = map * Vec3{p.x, p.y, 1};
  return {at.x / at.z, at.y / at.z};
}

// The map from one plane onto another as a camera sees it (a homography), through pairs of points.

/// A point of the plate [mm], and the pixel that shows it.
struct PointPair {
  Vec2 plate, pixel;
  double weight = 1;
  Vec2 first{1, 0}, second{0, 1};  ///< vectors whose products with the pixel are measured
};

/// Fits a homography by the direct linear transform, on coordinates of about 1.
/// \param pairs  at least four, of which no three are in line. \param side  length of the plate's side [mm]; the
/// plate's middle gets depth 1. \return the map from plate to pixels, homogeneous.
Mat3 mapThrough(const std::vector<PointPair>& pairs, double side);

/// Residual of a pair under a map, along the vectors that are measured [pixels].
double leftOf(const PointPair& pair, const Mat3& map);

/// Fits a homography by reweighted least squares. A pair counts less the farther it is off, and half at 0.1 mm,
/// because some spirals are seen in a wrong place.
/// \param scale  size of the plate in the picture [pixels/mm]. \return weighted RMS residual [mm].
double fitMap(Mat3& map, const std::vector<PointPair>& pairs, double side, double scale);

// Finds the outline of a square plate in a photograph.

/// Finds the corners of the only thing that lies on a plain ground. \return corners [pixels from the upper left],
/// clockwise to the eye; InvalidFile if there is no plain ground, or the thing on it is missing, cut off or not
/// four-sided.
Result<std::vector<Vec2>> findOutline(const Image& photograph);

// Finds a coupon in a photograph.

/// A photograph and the map from the plate into it.
struct FoundCoupon {
  Mat3 map;            ///< homogeneous map from the plate [mm] to pixels from the picture's upper left
  double clarity = 0;  ///< mean clarity of the spirals, 0..1: see SeenSpiral

  /// Pixel that shows a place of the plate [mm].
  [[nodiscard]] Vec2 pixelOf(Vec2 plate) const;
  /// Derivatives of the pixel with respect to the place's x and y [pixels/mm].
  struct Steps {
    Vec2 x, y;
  };
  [[nodiscard]] Steps stepsAt(Vec2 plate) const;
  [[nodiscard]] double scaleAt(Vec2 plate) const;  ///< scale at a place of the plate [pixels/mm]
};

/// Finds the plate's outline on a plain ground, then the one of its four orientations in which the spirals show.
/// \param tones  luminance of `photograph`. \param spirals  all spirals of the coupon.
Result<FoundCoupon> findCoupon(const Image& photograph, const Tones& tones, const std::vector<CouponSpiral>& spirals,
                               const RunContext& run);

// Finds spirals in a photograph, by the pattern of their turns.

/// A spiral as the picture shows it.
struct SeenSpiral {
  Vec2 off;            ///< offset of the spiral from its place in the map [mm]
  double clarity = 0;  ///< correlation of the pixels with the ideal wave of the turns; 1: they follow it exactly
};

/// Finds for each spiral the place where its turns correlate most with those that it should have.
/// \param reach  largest offset that is tried [mm]. \param stride  1: tries every place, and interpolates between
/// them; 2: tries every other one.
std::vector<SeenSpiral> findSpirals(const std::vector<CouponSpiral>& spirals, const FoundCoupon& found,
                                    const Tones& tones, double reach, int stride);

double meanClarity(const std::vector<SeenSpiral>& seen);

// A photograph's pixels of the coupon's spirals, sorted by the direction of the bead and the place across it.

/// Bins around a spiral's middle. Twice as many did not read rendered photographs better.
inline constexpr int kAngles = 36;
/// Bins from the middle of one turn to the next: two for each harmonic of the pattern, see kHarmonics.
inline constexpr int kPhases = 10;

/// Pixels of one spiral in bins.
struct FoldedSpiral {
  struct Bin {
    double light = 0;  ///< mean light of the pixels, 0..1, from their sRGB codes
    int count = 0;     ///< number of pixels; 0 where too many are burnt
    int burnt = 0;     ///< burnt pixels among them
  };
  std::array<std::array<Bin, kPhases>, kAngles> bins;
  double meanInverseRadius = 0;  ///< mean of 1 / radius over the pixels [1/mm]
  int pixels = 0;
  int burnt = 0;  ///< pixels with a channel at its upper end
};

/// Sorts a spiral's pixels into bins. Angle k is at (k + 0.5) / kAngles of a turn from +x, phase k at
/// (k + 0.5) / kPhases of the pitch outward.
FoldedSpiral foldSpiral(const CouponSpiral& spiral, const FoundCoupon& found, const Image& photograph,
                        const Tones& tones);

// The appearance model, fitted to folded spirals.

/// Marks locate the coupon, loose spirals leave gaps between their turns, and flow discs are each printed with another
/// flow.
enum class SpiralKind { Mark, Loose, Flow };

/// A spiral as it was printed, and as the photograph shows it.
struct LitSpiral {
  CouponSpiral spiral;  ///< geometry that was asked for
  SpiralKind kind = SpiralKind::Mark;
  double flow = 1;    ///< flow that was asked for
  double width = 0;   ///< width of a bead of flow 1 [mm]
  double height = 0;  ///< height of a bead [mm]
  FoldedSpiral seen;
  Vec2 fromAxis;                  ///< place from the picture's middle, y down, in half widths of the picture
  Vec2 blurX{1, 0}, blurY{0, 1};  ///< steps on the plate for one pixel to the right and for one down [mm]
};

/// The camera, as far as it follows from the map.
struct SeenFrom {
  Vec3 place{0, 0, 1};         ///< place of the camera, from the coupon's middle [mm]
  double distanceError = 0.5;  ///< standard deviation of its distance's logarithm
  double directionError = 0;   ///< error of its direction [radians]
  /// Misfit to an uncropped, undistorted picture at the best focal length [standard errors]; unusual focal lengths add
  /// to it.
  double strange = 0;
};

/// Prior of the lamp's elevation [degrees]. It is needed because all slopes and the lamp's tilt scale together in a
/// photograph. These values hold for a lamp whose elevation nobody has measured.
struct Elevation {
  double value = 47;
  double error = 9;
};

/// Unknowns that all spirals share: tilt x, tilt y, log of both variances, log blur, closing, lone, log of the
/// camera's distance over the given one, inverse distance of the lamp [1/m], contrast of the camera's tone curve,
/// sharpening, and the offset x and y by which all spirals seem to lie off because they shine on the lamp's side [mm].
inline constexpr std::size_t kGlobals = 13;
using Globals = std::array<double, kGlobals>;

/// Result of fitSpirals.
struct SpiralFit {
  Vec2 tilt;                          ///< slope that mirrors the lamp into the camera, in the coupon's middle
  double alongVariance = 0;           ///< variance of slopes along the beads, the lamp's included
  double acrossVariance = 0;          ///< variance of slopes across the beads, the lamp's included
  double blur = 0;                    ///< standard deviation of the lens' blur [pixels]
  double closing = 0;                 ///< width of beads in discs and marks over the width that their flow asks for
  double lone = 0;                    ///< width of lone beads over the width that their flow asks for
  std::array<double, 7> variances{};  ///< variances of the first seven globals
  /// Information matrix of an offset.
  struct Surety {
    double xx = 0, xy = 0, yy = 0;
  };
  std::vector<Surety> surety;         ///< inverse variances of the offsets, up to a factor
  std::vector<Vec2> offsets;          ///< offsets of the spirals from the places about which they were folded [mm]
  double misfit = 0;                  ///< RMS residual of a bin, relative to the brightest bin's light
  double contrast = 0;                ///< ratio of the brightest direction's light to the darkest one's, as seen
  Globals globals{};                  ///< values from which another fit may start
  double diffuse = 0;                 ///< light that beads send in all directions, in the photograph's unit
  double veil = 0;                    ///< stray light over the whole picture, relative to the brightest beads' light
  std::array<double, 3> veilTerms{};  ///< even term of the veil and those by fromAxis, in the photograph's unit
  /// Amount of the camera's unsharp mask, which adds this multiple of the difference between the picture and a blurred
  /// copy.
  double sharpening = 0;
};

/// Fits the appearance model to folded spirals.
/// \param before  a fit of the same spirals, folded about nearby places, to start from; nullptr: none.
SpiralFit fitSpirals(const std::vector<LitSpiral>& spirals, const SeenFrom& camera, const Elevation& elevation,
                     const SpiralFit* before, const RunContext& run);

// The map from the plate into a photograph, through the places at which a fit has found the spirals.

/// Fits the map again, through the places at which the spirals were found. Turns shine in few directions only, so
/// that a closed spiral looks nearly alike one turn farther along the lamp's tilt. If it was found there, it is put
/// back where the others say that it lies.
/// \param fit  fit of `spirals`, as they were seen through the map.
void refineMap(FoundCoupon& found, const std::vector<LitSpiral>& spirals, const SpiralFit& fit);

// Normal equations of least squares: they are gathered row by row, and solved.

/// A symmetric, positive definite matrix, and the right side of its equations.
struct NormalEquations {
  std::size_t size;
  std::vector<double> matrix = std::vector<double>(size * size, 0);
  std::vector<double> right = std::vector<double>(size, 0);

  [[nodiscard]] double& at(std::size_t row, std::size_t column) { return matrix[row * size + column]; }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return matrix[row * size + column]; }

  /// Adds one equation: row * x = value.
  void add(const double* row, double value, double weight);

  /// Solves matrix * x = right for x.
  [[nodiscard]] std::vector<double> solved() const;

  /// First `count` elements of the inverse matrix's diagonal.
  [[nodiscard]] std::vector<double> variances(std::size_t count) const;
};

// Errors that all photographs of one spool share: a large lamp looks like a rougher surface, and the model is not
// exact.

inline constexpr double kModelShare = 0.03;  ///< relative error of a slope due to the model, from rendered photographs

/// Variance that the size of the lamp adds to that of the surface's slopes.
struct LampPart {
  double variance = 0;  ///< square of the lamp's slope
  double error = 0;     ///< standard deviation of `variance`
};

/// Variance and its error for a lamp of known or unknown size.
/// \param slope  slope of the lamp, known to 5 %; unset: evenly spread from 0 to kUnknownLampSlope.
inline LampPart lampPartOf(const std::optional<double>& slope) {
  if (slope) return {*slope * *slope, 0.1 * *slope * *slope};
  constexpr double kMost = kUnknownLampSlope * kUnknownLampSlope;
  return {kMost / 3, kMost * std::sqrt(4.0 / 45)};
}

/// Error of a slope [degrees] that follows from the error of its variance.
inline double slopeErrorOf(double degrees, double varianceError) {
  const double slope = exact::tan(degrees * std::numbers::pi / 180);
  return varianceError / (2 * slope) / (1 + slope * slope) * 180 / std::numbers::pi;
}

// Model of folded spirals in the light of one lamp: the appearance model and a camera's tone curve.

/// Slope that mirrors a lamp into a camera; both are given by unit vectors towards them.
Vec2 tiltAt(Vec3 lamp, Vec3 eye);
/// Inverse of tiltAt: the direction of the lamp that this slope mirrors into the camera.
Vec3 lampOf(Vec2 tilt, Vec3 eye);

/// Light of all bins of the spirals, as a function of the unknowns.
class SpiralModel {
 public:
  static constexpr std::size_t kRows = std::size_t{kAngles} * kPhases;
  using Rows = std::array<double, kRows>;
  using Basis = std::array<Vec3, kRows>;

  /// \param spirals  must outlive the model.
  SpiralModel(const std::vector<LitSpiral>& spirals, const SeenFrom& camera);

  /// Weights of the bins, and the light of each times its weight.
  struct Light {
    Rows weight, seen;
  };

  /// Light that a camera of this contrast has seen, weighted so that equal steps of codes count alike.
  [[nodiscard]] Light lightOf(std::size_t which, double contrast) const;
  /// Light of the brightest bin.
  [[nodiscard]] double brightest(double contrast) const;

  /// The pattern across a pitch is kept as its mean and five harmonics, because the lens blurs away all higher ones.
  static constexpr std::size_t kHarmonics = 6;
  /// A complex amplitude.
  struct Amplitude {
    double re = 0, im = 0;
  };
  using Pattern = std::array<Amplitude, kHarmonics>;

  /// Light that a spiral sends, before lens and shift. It does not depend on the globals for blur, contrast, sharpening
  /// and offset.
  struct Unblurred {
    double light = 1;                                       ///< factor that follows from the lamp's distance
    Pattern body{};                                         ///< pattern of the bead itself, the same at every angle
    std::array<Pattern, std::size_t{2} * kAngles> shine{};  ///< pattern of the highlight, at two points of each angle
    std::array<Pattern, std::size_t{2} * kAngles> floor{};  ///< pattern of the base that is lit and seen, likewise
  };
  [[nodiscard]] Unblurred shapeOf(std::size_t which, const Globals& g) const;

  /// Light of a spiral's bins for a highlight of 1, for a body of 1, and for a base of 1 that shows between turns where
  /// no bead stands before the lamp or the camera.
  /// \param off  offset of the spiral from the place about which it was folded [mm].
  [[nodiscard]] Basis basisOf(std::size_t which, const Unblurred& shape, const Globals& g, Vec2 off) const;

  /// Light after an unsharp mask, which works on the codes of the picture.
  struct Sharpened {
    Rows light;
    /// Derivatives of the light after the mask with respect to the light before it, among the phases of each angle.
    std::array<std::array<double, std::size_t{kPhases} * kPhases>, kAngles> by;
  };
  /// Applies an unsharp mask to the light that falls onto the camera.
  [[nodiscard]] Sharpened sharpened(std::size_t which, const Rows& light, double contrast, double amount) const;

 private:
  const std::vector<LitSpiral>& spirals_;
  SeenFrom camera_;
  double profile_;           // slope of a bead's top at its edge
  std::vector<Rows> codes_;  // codes of the bins; below 0: the bin is not used
  double brightest_ = 0;     // highest code
};

}  // namespace sillon
