#include "input/svg/svg_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <Eigen/LU>

namespace sillon::svg {
namespace {

constexpr double kShortest = 1e-4;  // length from which on a piece has a direction [mm]; points lie on a grid of 1 nm
constexpr double kTightTurn = 0.1;  // turn per point in a bend tighter than the stroke is wide [radians]; see thinned()
constexpr double kSmoothTurn = 0.95;  // cosine of the largest turn between chords of a curve; larger turns are cusps

Vec2 by(const Matrix& m, Vec2 p) {
  const Eigen::Vector2d out = m * Eigen::Vector2d(p.x, p.y);
  return {out.x(), out.y()};
}

Vec2 leftOf(Vec2 direction) { return {-direction.y, direction.x}; }

// A line in the element's units: there the pen is round, whatever the transform makes of it.
struct Track {
  std::vector<Vec2> points;
  std::vector<char> smooth;
  bool closed = false;
};

double cosineOfTurn(Vec2 before, Vec2 at, Vec2 after) {
  const Vec2 from = at - before, to = after - at;
  return dot(from, to) / (length(from) * length(to));
}

// Closes a line that ends where it began, in the same direction: many circles are drawn so, and it looks closed. Square
// caps are excepted, because they stick out visibly.
void closeWhereItMeetsItself(Track& track, StrokeCap cap) {
  const std::vector<Vec2>& p = track.points;
  const std::size_t n = p.size();
  if (track.closed || cap == StrokeCap::Square || n < 5 || p.front() != p.back()) return;
  const double atSeam = cosineOfTurn(p[n - 2], p[0], p[1]);
  const bool curved = track.smooth[1] != 0 && track.smooth[n - 2] != 0;
  const double beside = std::min(cosineOfTurn(p[0], p[1], p[2]), cosineOfTurn(p[n - 3], p[n - 2], p[n - 1]));
  if (atSeam < kSmoothTurn && !(curved && atSeam > beside - 0.01)) return;
  track.closed = true;
  track.points.pop_back();
  track.smooth.pop_back();
  track.smooth.front() = 1;
}

// Converts a line to the element's units and drops pieces that are too short to have a direction.
Track trackOf(const PathLine& line, const Matrix& toUser, StrokeCap cap) {
  Track track;
  track.closed = line.closed;
  Vec2 last;
  for (std::size_t k = 0; k < line.points.size(); ++k) {
    const Vec2 p = line.points[k];
    if (k > 0 && length(p - last) < kShortest) {
      if (line.smooth[k] == 0) track.smooth.back() = 0;
      continue;
    }
    track.points.push_back(by(toUser, p));
    track.smooth.push_back(line.smooth[k]);
    last = p;
  }
  if (track.closed && track.points.size() > 1 && length(last - line.points.front()) < kShortest) {
    track.points.pop_back();
    track.smooth.pop_back();
  }
  closeWhereItMeetsItself(track, cap);
  return track;
}

Track reversed(Track track) {
  std::reverse(track.points.begin(), track.points.end());
  std::reverse(track.smooth.begin(), track.smooth.end());
  return track;
}

// Cuts a track into the pieces that its dashes cover.
class Dashes {
 public:
  /// \param period  sum of the stroke's dashes; there must be at least one.
  Dashes(const LineStroke& stroke, double period, std::int64_t& pointsLeft)
      : dashes_(*stroke.dashes), pointsLeft_(pointsLeft) {
    start_ = std::fmod(stroke.dashOffset, period);
    if (start_ < 0) start_ += period;
  }

  // Returns the dashes of a track.
  std::vector<Track> cut(const Track& track) {
    startPattern();
    pieces_.clear();
    piece_ = {};
    const std::size_t n = track.points.size();
    if (on()) add(track.points[0], 0);
    for (std::size_t k = 1; k < n + (track.closed ? 1 : 0); ++k) {
      const Vec2 from = track.points[k - 1], to = track.points[k % n];
      const double size = length(to - from);
      double at = 0;
      while (left_ < size - at) {  // a dash that would begin at the very end is left out
        at += left_;
        const Vec2 p = from + (to - from) * (size > 0 ? at / size : 0);
        if (on()) {
          add(p, 0);
          finish();
        }
        index_ = (index_ + 1) % dashes_.size();
        left_ = dashes_[index_];
        if (on()) add(p, 0);
        if (--pointsLeft_ < 0) refusePoints();
      }
      left_ -= size - at;
      if (on()) add(to, track.smooth[k % n]);
    }
    finish();
    return std::move(pieces_);
  }

 private:
  [[nodiscard]] bool on() const { return index_ % 2 == 0; }

  void startPattern() {
    double offset = start_;
    index_ = 0;
    while (offset > 0 && offset >= dashes_[index_] && index_ + 1 < dashes_.size()) {
      offset -= dashes_[index_++];
    }
    left_ = std::max(0.0, dashes_[index_] - offset);
  }

  void add(Vec2 p, char smooth) {
    if (!piece_.points.empty() && piece_.points.back() == p) return;
    piece_.points.push_back(p);
    piece_.smooth.push_back(smooth);
  }

  void finish() {
    if (!piece_.points.empty()) pieces_.push_back(std::move(piece_));
    piece_ = {};
  }

  const std::vector<double>& dashes_;
  double start_ = 0;  // distance into the pattern at which a line begins
  std::int64_t& pointsLeft_;
  std::vector<Track> pieces_;
  Track piece_;
  std::size_t index_ = 0;
  double left_ = 0;  // remaining length of the current dash or gap
};

// Walks along tracks and leaves a ring on their left. A ring is the sum of half rectangles beside the pieces, of wedges
// on the outer side of turns, and of caps, all with the same sense: on the inner side of a turn, the half rectangles
// either end where they meet, or return to the turn itself.
class Walker {
 public:
  Walker(const LineStroke& stroke, const Matrix& toWorld, double tolerance, std::int64_t& pointsLeft)
      : stroke_(stroke), toWorld_(toWorld), pointsLeft_(pointsLeft), half_(stroke.width / 2) {
    const Eigen::Matrix2d m = toWorld.linear();
    const double pp = m.col(0).squaredNorm(), qq = m.col(1).squaredNorm(), pq = m.col(0).dot(m.col(1));
    const double radius = half_ * std::sqrt((pp + qq + std::sqrt((pp - qq) * (pp - qq) + 4 * pq * pq)) / 2);
    step_ = std::min(std::numbers::pi / 4, std::sqrt(8 * tolerance / std::max(radius, 1e-12)));
  }

  // Adds the rings of a track's stroke.
  void walk(const Track& track, std::vector<Ring>& rings) {
    if (track.points.size() < 2) {
      if (!track.points.empty()) spot(track.points[0]);
    } else if (track.closed) {
      // A stroke wide enough to fill the area that it encloses has no inner side.
      const int turning = coversInside(track);
      if (turning <= 0) side(thinned(track));
      take(rings);
      if (turning >= 0) side(thinned(reversed(track)));
    } else {
      side(thinned(track));
      side(thinned(reversed(track)));
    }
    take(rings);
  }

 private:
  // Returns 1 for a convex track turning left whose stroke leaves no hole, -1 for one turning right, and 0 otherwise.
  [[nodiscard]] int coversInside(const Track& track) const {
    const std::size_t n = track.points.size();
    Bounds box;
    bool left = false, right = false;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 p = track.points[k];
      box.add(p);
      const double turn = cross(p - track.points[(k + n - 1) % n], track.points[(k + 1) % n] - p);
      left = left || turn > 0;
      right = right || turn < 0;
    }
    if (left == right || 2 * half_ < std::min(box.size().x, box.size().y)) return 0;
    return left ? 1 : -1;
  }

  // Removes points where a curve bends to the left more tightly than the stroke is wide: there, half rectangles fan out
  // beyond the centre of the bend and all cross each other. A few of them suffice; the error is below a thousandth of
  // the width.
  [[nodiscard]] Track thinned(const Track& track) const {
    const std::size_t n = track.points.size();
    Track thin;
    thin.closed = track.closed;
    double turned = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 p = track.points[k];
      const bool inner = k > 0 && k + 1 < n && track.smooth[k] != 0;
      if (inner) {
        const Vec2 from = p - track.points[k - 1], to = track.points[k + 1] - p;
        const double angle = std::atan2(cross(from, to), dot(from, to));
        const bool tight = angle > 0 && half_ * std::tan(angle / 2) > 0.5 * std::min(length(from), length(to));
        turned += angle;
        if (tight && turned < kTightTurn) continue;
      }
      turned = 0;
      thin.points.push_back(p);
      thin.smooth.push_back(track.smooth[k]);
    }
    return thin;
  }

  // Adds the left side, and for an open track the cap at its end.
  void side(const Track& track) {
    const std::size_t n = track.points.size();
    const auto point = [&](std::size_t k) { return track.points[k % n]; };
    const auto direction = [&](std::size_t k) {
      const Vec2 along = point(k + 1) - point(k);
      return along * (1 / length(along));
    };
    if (!track.closed) put(point(0) + half_ * leftOf(direction(0)));
    for (std::size_t k = track.closed ? 0 : 1; k + (track.closed ? 0 : 1) < n; ++k) {
      const std::size_t before = k + n - 1;
      const double room = 0.5 * std::min(length(point(k) - point(before)), length(point(k + 1) - point(k)));
      turn(point(k), direction(before % n), direction(k), track.smooth[k] != 0, room);
    }
    if (!track.closed) cap(point(n - 1), direction(n - 2));
  }

  // Adds the left side of a turn: the inner side of a left turn, or the join of a right one.
  void turn(Vec2 p, Vec2 from, Vec2 to, bool smooth, double room) {
    const double sine = cross(from, to), cosine = dot(from, to);
    const Vec2 n0 = half_ * leftOf(from), n1 = half_ * leftOf(to);
    const bool straight = 1 + cosine > 1e-9;
    const Vec2 meeting = straight ? (n0 + n1) * (1 / (1 + cosine)) : n0;
    if (sine > 0) {  // a turn to the left: the ring is on the inner side
      if (straight && half_ * sine <= room * (1 + cosine)) return put(p + meeting);
      put(p + n0);
      put(p);
      return put(p + n1);
    }
    StrokeJoin join = stroke_.join;
    if (smooth) join = cosine > kSmoothTurn ? StrokeJoin::Miter : StrokeJoin::Round;
    // The miter is 1 / cos(turn / 2) half widths long.
    const double limit = smooth ? 4 : stroke_.miterLimit;
    if (join == StrokeJoin::Miter && straight && 2 <= limit * limit * (1 + cosine)) return put(p + meeting);
    put(p + n0);
    if (join == StrokeJoin::Round) arc(p, n0, std::atan2(std::abs(sine), cosine));
    put(p + n1);
  }

  // Adds the cap at the end of an open track.
  void cap(Vec2 p, Vec2 direction) {
    const Vec2 n = half_ * leftOf(direction);
    const Vec2 ahead = stroke_.cap == StrokeCap::Square ? half_ * direction : Vec2{};
    put(p + n + ahead);
    if (stroke_.cap == StrokeCap::Round) arc(p, n, std::numbers::pi);
    put(p - n + ahead);
  }

  // Draws a line without length, which shows its caps alone.
  void spot(Vec2 p) {
    const Vec2 u{half_, 0}, v{0, half_};
    if (stroke_.cap == StrokeCap::Square) {
      for (const Vec2 corner : {u + v, u - v, -u - v, v - u}) put(p + corner);
    }
    if (stroke_.cap != StrokeCap::Round) return;
    put(p + u);
    arc(p, u, 2 * std::numbers::pi);
  }

  // Adds an arc clockwise from p + n, without its ends.
  void arc(Vec2 p, Vec2 n, double angle) {
    const int pieces = static_cast<int>(std::ceil(angle / step_));
    for (int k = 1; k < pieces; ++k) {
      const double at = angle * k / pieces;
      put(p + std::cos(at) * n - std::sin(at) * leftOf(n));
    }
  }

  void put(Vec2 p) {
    p = onGrid(by(toWorld_, p));
    if (!ring_.empty() && ring_.back() == p) return;
    if (--pointsLeft_ < 0) refusePoints();
    ring_.push_back(p);
  }

  void take(std::vector<Ring>& rings) {
    while (ring_.size() > 1 && ring_.back() == ring_.front()) ring_.pop_back();
    if (ring_.size() >= 3) rings.push_back(std::move(ring_));
    ring_.clear();
  }

  const LineStroke& stroke_;
  const Matrix& toWorld_;
  std::int64_t& pointsLeft_;
  double half_;
  double step_ = 0;  // largest step of arcs [radians]
  Ring ring_;
};

}  // namespace

std::vector<Ring> strokeRings(const std::vector<PathLine>& lines, const LineStroke& stroke, const Matrix& toWorld,
                              double tolerance, std::int64_t& pointsLeft) {
  std::vector<Ring> rings;
  const double scale = std::sqrt(std::abs(toWorld.linear().determinant()));
  if (!(scale * stroke.width > 1e-6) || !(scale < 1e9)) return rings;
  const Matrix toUser = toWorld.inverse();
  double period = 0;
  for (const double dash : stroke.dashes ? *stroke.dashes : std::vector<double>{}) period += dash;
  std::optional<Dashes> dashes;  // dashes finer than kShortest look solid
  if (period * scale > kShortest) dashes.emplace(stroke, period, pointsLeft);
  Walker walker(stroke, toWorld, tolerance, pointsLeft);
  for (const PathLine& line : lines) {
    const Track track = trackOf(line, toUser, stroke.cap);
    if (!dashes) {
      walker.walk(track, rings);
      continue;
    }
    for (const Track& piece : dashes->cut(track)) walker.walk(piece, rings);
  }
  return rings;
}

}  // namespace sillon::svg
