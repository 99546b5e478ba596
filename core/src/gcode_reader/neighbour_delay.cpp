#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "gcode_reader/coverage.hpp"

namespace sillon {
namespace {

constexpr auto kNearest = static_cast<float>(kNearestNeighbour);
constexpr auto kFarthest = static_cast<float>(kFarthestNeighbour);
constexpr auto kAlong = static_cast<float>(kNeighbourAlong);
constexpr float kUnknown = std::numeric_limits<float>::infinity();

// A piece of a bead, about as long as the bead is wide.
struct BeadPiece {
  Vec2f at;
  Vec2f along;  // direction, of length 1
  float width;
  float length;
  float time;  // time at which its middle is laid [s]
};

// Wait of a piece for its neighbours [s], its length [mm], and whether both neighbours were laid before it.
struct Wait {
  float seconds;
  float length;
  bool squeezed;
};

// Cuts a bead into pieces.
void cutUp(const LaidBead& bead, std::vector<BeadPiece>& pieces) {
  const Vec2f d = bead.to - bead.from;
  const float size = length(d);
  if (!(size > 0) || !(bead.width > 0)) return;
  const int count = std::max(1, static_cast<int>(size / bead.width));
  for (int k = 0; k < count; ++k) {
    const float share = (static_cast<float>(k) + 0.5f) / static_cast<float>(count);
    pieces.push_back({bead.from + d * share, d * (1 / size), bead.width, size / static_cast<float>(count),
                      bead.begin + share * bead.seconds});
  }
}

// Pieces of a layer, sorted into square cells with a side of the greatest distance of neighbours.
class Neighbourhood {
 public:
  explicit Neighbourhood(const std::vector<BeadPiece>& pieces) {
    Bounds box;
    float widest = 0;
    for (const BeadPiece& piece : pieces) {
      box.add(Vec2{piece.at.x, piece.at.y});
      widest = std::max(widest, piece.width);
    }
    constexpr double kMostCells = 4e6;
    cell_ = std::max(static_cast<double>(kFarthest * widest), std::sqrt(box.size().x * box.size().y / kMostCells));
    min_ = box.min;
    columns_ = static_cast<int>(box.size().x / cell_) + 1;
    rows_ = static_cast<int>(box.size().y / cell_) + 1;
    first_.assign(cellCount(columns_, rows_) + 1, 0);
    for (const BeadPiece& piece : pieces) ++first_[cellOf(piece.at) + 1];
    for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
    std::vector<int> next(first_.begin(), first_.end() - 1);
    ordered_.resize(pieces.size());
    for (const BeadPiece& piece : pieces) ordered_[next[cellOf(piece.at)]++] = piece;
  }

  /// Waits for the neighbours on either side, of which the longer counts; infinite without any.
  [[nodiscard]] Wait wait(const BeadPiece& piece) const {
    float left = kUnknown;  // [s], negative: the neighbour was laid earlier
    float right = kUnknown;
    const int column = columnOf(piece.at);
    const int row = rowOf(piece.at);
    for (int y = std::max(row - 1, 0); y <= std::min(row + 1, rows_ - 1); ++y) {
      const int begin = y * columns_ + std::max(column - 1, 0);
      const int end = y * columns_ + std::min(column + 1, columns_ - 1) + 1;
      for (int k = first_[begin]; k < first_[end]; ++k) {
        const BeadPiece& other = ordered_[k];
        const Vec2f to = other.at - piece.at;
        const float mean = 0.5f * (piece.width + other.width);
        const float across = cross(piece.along, to);
        if (std::abs(dot(piece.along, to)) > kAlong * mean) continue;
        if (std::abs(across) < kNearest * mean || std::abs(across) > kFarthest * mean) continue;
        float& side = across > 0 ? left : right;
        const float after = other.time - piece.time;
        if (std::abs(after) < std::abs(side)) side = after;
      }
    }
    const auto [less, more] = std::minmax({std::abs(left), std::abs(right)});
    return {more == kUnknown ? less : more, piece.length, left < 0 && right < 0};
  }

 private:
  [[nodiscard]] int columnOf(Vec2f p) const { return static_cast<int>((static_cast<double>(p.x) - min_.x) / cell_); }
  [[nodiscard]] int rowOf(Vec2f p) const { return static_cast<int>((static_cast<double>(p.y) - min_.y) / cell_); }
  [[nodiscard]] std::size_t cellOf(Vec2f p) const { return indexOf(columnOf(p), rowOf(p), columns_); }

  Vec2 min_;
  double cell_ = 0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> first_;          // first index in ordered_ for each cell
  std::vector<BeadPiece> ordered_;  // cell by cell, since jumps in memory cost more than the comparisons
};

// Adds the waits in the oriented beads of one layer.
void addWaits(const LaidBead* begin, const LaidBead* end, std::vector<Wait>& waits) {
  std::vector<BeadPiece> pieces;
  for (const LaidBead* bead = begin; bead != end; ++bead) {
    if (!bead->base) cutUp(*bead, pieces);
  }
  if (pieces.empty()) return;
  const Neighbourhood neighbourhood(pieces);
  for (const BeadPiece& piece : pieces) {
    const Wait wait = neighbourhood.wait(piece);
    if (wait.seconds != kUnknown) waits.push_back(wait);
  }
}

}  // namespace

std::optional<NeighbourDelay> neighbourDelay(const std::vector<LaidBead>& beads) {
  std::vector<Wait> waits;
  const LaidBead* const end = beads.data() + beads.size();
  for (const LaidBead* begin = beads.data(); begin != end;) {
    const LaidBead* const last = stackEnd(begin, end);
    const auto inLayer = [](int layer) { return [layer](const LaidBead& bead) { return bead.layer == layer; }; };
    const LaidBead* const lowest = std::find_if_not(begin, last, inLayer(begin->layer));
    addWaits(begin, lowest, waits);
    if (lowest != last) addWaits(std::find_if(lowest, last, inLayer((last - 1)->layer)), last, waits);
    begin = last;
  }
  if (waits.empty()) return std::nullopt;
  // Equal waits are sorted by length, too: sums in another order may differ in the last digit.
  std::sort(waits.begin(), waits.end(), [](const Wait& a, const Wait& b) {
    return std::tie(a.seconds, a.length, a.squeezed) < std::tie(b.seconds, b.length, b.squeezed);
  });
  double all = 0;
  for (const Wait& wait : waits) all += static_cast<double>(wait.length);
  NeighbourDelay delay;
  double sum = 0;
  for (const Wait& wait : waits) {
    if (sum < 0.9 * all) delay.most = static_cast<double>(wait.seconds);
    const double share = static_cast<double>(wait.length) / all;
    sum += static_cast<double>(wait.length);
    if (wait.seconds > 30) delay.over30 += share;
    if (wait.seconds > 120) delay.over120 += share;
    if (wait.squeezed) delay.squeezed += share;
  }
  return delay;
}

}  // namespace sillon
