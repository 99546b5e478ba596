#include "geometry/signed_distance.hpp"

#include <array>
#include <atomic>
#include <cmath>
#include <span>

#include "base/parallel_for.hpp"
#include "base/refused.hpp"
#include "geometry/outline.hpp"

namespace sillon {
namespace {

constexpr int kBlockCells = 4;  ///< side of a leaf block [cells]
constexpr std::int64_t kMaxRowCrossings = 100'000'000;
constexpr double kMaxCandidates = 400e6;
constexpr double kBytesPerCandidate = 12;  ///< in its block, which has room to grow, and in the index

constexpr int kTile = 4;  ///< side of the tile that bandDistance() measures together [samples]

// Returns the offset from the nearest point of a segment to p. Ends are used as given, so that two segments that share
// one yield bit-equal distances.
Vec2 offsetFrom(const BorderSegment& s, Vec2 p) {
  const Vec2 along = s.b - s.a;
  const double size2 = dot(along, along);
  const double t = dot(p - s.a, along);
  return t <= 0 ? p - s.a : (t >= size2 ? p - s.b : p - (s.a + along * (t / size2)));
}

double squaredDistance(const BorderSegment& s, Vec2 p) {
  const Vec2 offset = offsetFrom(s, p);
  return dot(offset, offset);
}

// Returns the squared component of the offset across the segment; breaks ties at shared ends.
double squaredAcross(const BorderSegment& s, Vec2 p) {
  const Vec2 along = s.b - s.a;
  const double across = cross(along, offsetFrom(s, p));
  return across * across / dot(along, along);
}

struct CellBlock {
  int x;  ///< in leaf blocks
  int y;
  int side;  ///< in leaf blocks, a power of two
  std::vector<int> candidates;
};

// Returns the segments of `list` that can be nearest to some point of the square with this centre and half diagonal.
// \param[out] lowest  lower bound of the distance over the square.
// \param squared  scratch memory.
std::vector<int> nearestCandidates(const std::vector<BorderSegment>& segments, const std::vector<int>& list,
                                   Vec2 centre, double halfDiagonal, double& lowest, std::vector<double>& squared) {
  squared.resize(list.size());
  double least = 1e300;
  for (std::size_t k = 0; k < list.size(); ++k) {
    squared[k] = squaredDistance(segments[list[k]], centre);
    least = std::min(least, squared[k]);
  }
  const double best = std::sqrt(least);
  std::vector<int> kept;
  const double limit = best + 2 * halfDiagonal * (1 + 1e-9);
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (squared[k] <= limit * limit) kept.push_back(list[k]);
  }
  lowest = std::max(0.0, best - halfDiagonal);
  return kept;
}

class Subdivision {
 public:
  Subdivision(const std::vector<BorderSegment>& segments, const Grid& blocks) : segments_(segments), blocks_(blocks) {}

  // Calls visit(block, lowest distance) for every block of side `leaf` under `block`, until visit returns false.
  template <class Visit>
  bool descend(const CellBlock& block, int leaf, const Visit& visit) const {
    std::vector<double> scratch;
    return descend(Square{block.x, block.y, block.side}, block.candidates, leaf, visit, scratch);
  }

 private:
  struct Square {  // in leaf blocks
    int x;
    int y;
    int side;
  };

  template <class Visit>
  bool descend(const Square& square, const std::vector<int>& list, int leaf, const Visit& visit,
               std::vector<double>& scratch) const {
    const auto [x, y, size] = square;
    if (x >= blocks_.nx || y >= blocks_.ny) return true;
    const double side = size * blocks_.cell;
    const Vec2 centre{blocks_.origin.x + x * blocks_.cell + 0.5 * side,
                      blocks_.origin.y + y * blocks_.cell + 0.5 * side};
    double lowest = 0;
    std::vector<int> candidates =
        nearestCandidates(segments_, list, centre, side * 0.70710678118654757, lowest, scratch);
    if (size <= leaf) return visit(CellBlock{x, y, size, std::move(candidates)}, lowest);
    const int half = size / 2;
    for (int k = 0; k < 4; ++k) {
      const Square quarter{x + (k & 1) * half, y + (k >> 1) * half, half};
      if (!descend(quarter, candidates, leaf, visit, scratch)) return false;
    }
    return true;
  }

  const std::vector<BorderSegment>& segments_;
  const Grid& blocks_;
};

// Distances of the samples of one tile. It measures only those candidates of a block that can be nearest to one of the
// samples: with a detailed border this takes half the instructions of measuring all candidates for each sample.
class TileDistances {
 public:
  static constexpr std::size_t kSamples = kTile * kTile;

  std::array<double, kSamples> x{};  ///< places of the samples, row by row, kTile to a row
  std::array<double, kSamples> y{};
  std::array<double, kSamples> squared{};

  explicit TileDistances(const std::vector<BorderSegment>& segments) : segments_(segments) {}

  /// Sets `squared`: exact, or one lower bound if all distances are above `band`.
  /// \param candidates  at least one.
  void measure(std::span<const int> candidates, double band) {
    const Vec2 centre{0.5 * (x.front() + x.back()), 0.5 * (y.front() + y.back())};
    const double halfDiagonal = 0.5 * length(Vec2{x.back() - x.front(), y.back() - y.front()});
    toCentre_.resize(candidates.size());
    double least = 1e300;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      toCentre_[k] = squaredDistance(segments_[candidates[k]], centre);
      least = std::min(least, toCentre_[k]);
    }
    const double lowest = std::sqrt(least) - halfDiagonal;
    if (lowest > band * (1 + 1e-6)) {
      squared.fill(lowest * lowest);
      return;
    }
    const double limit = (std::sqrt(least) + 2 * halfDiagonal) * (1 + 1e-9) + 1e-9;
    squared.fill(1e300);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (toCentre_[k] <= limit * limit) add(segments_[candidates[k]]);
    }
  }

 private:
  // Computes squaredDistance() for all samples without branches, so that compilers can vectorise it.
  void add(const BorderSegment& s) {
    const Vec2 along = s.b - s.a;
    const double size2 = dot(along, along);
    for (std::size_t k = 0; k < kSamples; ++k) {
      const double fromAx = x[k] - s.a.x;
      const double fromAy = y[k] - s.a.y;
      const double t = fromAx * along.x + fromAy * along.y;
      const double share = t / size2;
      const double insideX = x[k] - (s.a.x + along.x * share);
      const double insideY = y[k] - (s.a.y + along.y * share);
      const double beyondX = t >= size2 ? x[k] - s.b.x : insideX;
      const double beyondY = t >= size2 ? y[k] - s.b.y : insideY;
      const double offsetX = t <= 0 ? fromAx : beyondX;
      const double offsetY = t <= 0 ? fromAy : beyondY;
      const double distance = offsetX * offsetX + offsetY * offsetY;
      squared[k] = distance < squared[k] ? distance : squared[k];
    }
  }

  const std::vector<BorderSegment>& segments_;
  std::vector<double> toCentre_;  ///< squared distance of each candidate to the centre
};

// Splits columns or rows of samples into runs of at most `most` that lie in the same column or row of blocks.
std::vector<int> runsOf(const std::vector<std::size_t>& blocks, int most) {
  std::vector<int> bounds;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const bool same = k > 0 && blocks[k] == blocks[k - 1] && static_cast<int>(k) - bounds.back() < most;
    if (!same) bounds.push_back(static_cast<int>(k));
  }
  bounds.push_back(static_cast<int>(blocks.size()));
  return bounds;
}

// Checks the work of insideIntervals() before it is done.
Result<int> checkRows(const Shape& shape, const Grid& lattice) {
  double crossings = 0;
  for (const FilledPath& path : shape.paths) {
    for (const Ring& ring : path.rings) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        crossings += std::abs(ring[k].y - ring[k + 1 < ring.size() ? k + 1 : 0].y) / lattice.cell;
      }
    }
  }
  if (crossings > static_cast<double>(kMaxRowCrossings)) {
    return refused(ErrorCode::TooLarge, "OutlineTooDetailed");
  }
  return 0;
}

// Calls visit(first, end) for the runs of samples of a row that lie inside, each sample once.
template <class Visit>
void forInside(const std::vector<Interval>& intervals, const Grid& lattice, const Visit& visit) {
  int done = 0;
  for (const Interval& interval : intervals) {
    const double low = std::ceil((interval.begin - lattice.origin.x) / lattice.cell - 0.5);
    const double high = std::floor((interval.end - lattice.origin.x) / lattice.cell - 0.5);
    const int first = std::max(done, static_cast<int>(std::clamp(low, 0.0, static_cast<double>(lattice.nx))));
    const int end = static_cast<int>(std::clamp(high, -1.0, static_cast<double>(lattice.nx - 1))) + 1;
    if (first >= end) continue;
    visit(first, end);
    done = end;
  }
}

}  // namespace

Grid makeGrid(const Bounds& box, double spacing) {
  Grid grid;
  grid.cell = 0.5 * spacing;
  grid.origin = {box.min.x - 1.5 * spacing, box.min.y - 1.5 * spacing};
  const Vec2 size = box.size();
  // Subtracts a little, so that an exact multiple does not gain a cell by rounding.
  grid.nx = static_cast<int>(std::ceil((size.x + 3 * spacing) / grid.cell - 1e-6));
  grid.ny = static_cast<int>(std::ceil((size.y + 3 * spacing) / grid.cell - 1e-6));
  return grid;
}

Grid nodeLattice(const Grid& grid) {
  const double cell = 0.5 * grid.cell;
  return {{grid.origin.x - 0.5 * cell, grid.origin.y - 0.5 * cell}, cell, 2 * grid.nx + 1, 2 * grid.ny + 1};
}

Result<BorderIndex> buildBorderIndex(const Outline& outline, const Grid& grid, const RunContext& run) {
  if (outline.segments.empty()) return refused(ErrorCode::EmptyShape, "NoOutline");
  BorderIndex index;
  index.segments_ = outline.segments;
  index.blocks_ = {grid.origin, kBlockCells * grid.cell, (grid.nx - 1) / kBlockCells + 1,
                   (grid.ny - 1) / kBlockCells + 1};
  const Grid& blocks = index.blocks_;

  CellBlock root{0, 0, 1, {}};
  while (root.side < std::max(blocks.nx, blocks.ny)) root.side *= 2;
  root.candidates.resize(outline.segments.size());
  for (std::size_t k = 0; k < root.candidates.size(); ++k) root.candidates[k] = static_cast<int>(k);

  const bool byMemory = run.memory() < kMaxCandidates * kBytesPerCandidate;
  const std::size_t most = toSize(byMemory ? run.memory() / kBytesPerCandidate : kMaxCandidates);
  std::atomic<std::size_t> kept{0};
  const auto hasRoom = [&](const CellBlock& block) { return (kept += block.candidates.size()) <= most; };

  // Splits into a few large blocks on this thread, then divides each of them on any thread.
  const Subdivision subdivision(index.segments_, blocks);
  std::vector<CellBlock> tasks;
  if (subdivision.descend(root, std::max(1, root.side / 16), [&](CellBlock block, double) {
        tasks.push_back(std::move(block));
        return hasRoom(tasks.back());
      })) {
    kept = 0;
  }
  struct Leaf {
    std::size_t block;
    float lowest;
    std::vector<int> candidates;
  };
  std::vector<std::vector<Leaf>> leaves(tasks.size());
  parallelForEach(run, static_cast<int>(tasks.size()), 1, [&](int k) {
    subdivision.descend(tasks[k], 1, [&](CellBlock block, double lowest) {
      if (!hasRoom(block)) return false;
      leaves[k].push_back(
          {blocks.index(block.x, block.y), static_cast<float>(lowest * (1 - 1e-6)), std::move(block.candidates)});
      return true;
    });
  });
  if (run.cancelled()) return cancelledRun();
  if (kept > most) {
    return refused(byMemory ? ErrorCode::OutOfMemory : ErrorCode::TooLarge, "OutlineTooDetailed");
  }

  index.lowest_.assign(blocks.size(), 0);
  index.begin_.assign(blocks.size() + 1, 0);
  for (const std::vector<Leaf>& task : leaves) {
    for (const Leaf& leaf : task) {
      index.begin_[leaf.block + 1] = static_cast<int>(leaf.candidates.size());
      index.lowest_[leaf.block] = leaf.lowest;
    }
  }
  for (std::size_t k = 0; k < blocks.size(); ++k) index.begin_[k + 1] += index.begin_[k];
  index.candidates_.resize(kept);
  for (const std::vector<Leaf>& task : leaves) {
    for (const Leaf& leaf : task) {
      std::copy(leaf.candidates.begin(), leaf.candidates.end(), index.candidates_.begin() + index.begin_[leaf.block]);
    }
  }
  index.outside_.assign(blocks.size(), 0);
  parallelForEach(run, blocks.ny, 16, [&](int y) {
    for (int x = 0; x < blocks.nx; ++x) {
      index.outside_[blocks.index(x, y)] = index.nearest(blocks.centre(x, y)).distance > 0 ? 1 : 0;
    }
  });
  return index;
}

std::size_t BorderIndex::blockOf(Vec2 p) const {
  const double x = std::clamp((p.x - blocks_.origin.x) / blocks_.cell, 0.0, static_cast<double>(blocks_.nx - 1));
  const double y = std::clamp((p.y - blocks_.origin.y) / blocks_.cell, 0.0, static_cast<double>(blocks_.ny - 1));
  return blocks_.index(static_cast<int>(x), static_cast<int>(y));
}

float BorderIndex::blockDistance(Vec2 p) const { return lowest_[blockOf(p)]; }

float BorderIndex::blockDepth(Vec2 p) const {
  const std::size_t block = blockOf(p);
  return outside_[block] != 0 ? 0 : lowest_[block];
}

bool BorderIndex::outside(Vec2 p) const {
  const std::size_t block = blockOf(p);
  return lowest_[block] > 0 ? outside_[block] != 0 : nearest(p).distance > 0;
}

NearestBorder BorderIndex::nearest(Vec2 p) const {
  const std::size_t block = blockOf(p);
  const BorderSegment* best = nullptr;
  double least = 1e300;
  for (int k = begin_[block]; k < begin_[block + 1]; ++k) {
    const BorderSegment& s = segments_[candidates_[k]];
    const double squared = squaredDistance(s, p);
    // Two segments that share the nearest corner are equally far; the one that the point lies more across tells the
    // side.
    if (squared < least || (squared == least && squaredAcross(s, p) > squaredAcross(*best, p))) {
      least = squared;
      best = &s;
    }
  }
  const Vec2 along = best->b - best->a;
  const double size2 = dot(along, along);
  const double t = std::clamp(dot(p - best->a, along) / size2, 0.0, 1.0);
  const Vec2 offset = t <= 0 ? p - best->a : (t >= 1 ? p - best->b : p - (best->a + along * t));
  const double distance = std::sqrt(least);
  const bool inside = cross(along, p - best->a) >= 0;
  Vec2 normal = Vec2{along.y, -along.x} * (1 / std::sqrt(size2));  // the inside is on the left
  if (distance > 1e-6) normal = offset * ((inside ? -1 : 1) / distance);
  return {static_cast<float>(inside ? -distance : distance),
          {static_cast<float>(normal.x), static_cast<float>(normal.y)}};
}

Result<SignedDistanceField> signedDistanceField(const Shape& shape, const BorderIndex& index, const Grid& grid,
                                                const RunContext& run) {
  if (const Result<int> rows = checkRows(shape, grid); !rows) return rows.error();
  SignedDistanceField field{grid, std::vector<float>(grid.size()), std::vector<Vec2f>(grid.size())};
  const auto intervals = insideIntervals(shape, grid.centre(0, 0).y, grid.cell, grid.ny);
  parallelFor(run, grid.ny, rowGrain(run, grid.ny, 30.0 * grid.nx), [&](int begin, int end) {
    std::vector<char> inside(grid.nx);
    for (int y = begin; y < end; ++y) {
      std::fill(inside.begin(), inside.end(), char{0});
      forInside(intervals[y], grid,
                [&](int first, int last) { std::fill(inside.begin() + first, inside.begin() + last, char{1}); });
      for (int x = 0; x < grid.nx; ++x) {
        const NearestBorder nearest = index.nearest(grid.centre(x, y));
        const bool in = inside[x] != 0;
        const std::size_t i = grid.index(x, y);
        field.distance[i] = in ? -std::abs(nearest.distance) : std::abs(nearest.distance);
        // On the border itself the normal is that of the segment; elsewhere it follows the sign of the distance.
        const bool flip = in != (nearest.distance < 0) && std::abs(nearest.distance) > 1e-6f;
        field.normal[i] = flip ? -nearest.normal : nearest.normal;
      }
    }
  });
  if (run.cancelled()) return cancelledRun();
  return field;
}

Result<std::vector<float>> bandDistance(const Shape& shape, const BorderIndex& index, const Grid& lattice, float band,
                                        const RunContext& run) {
  if (const Result<int> rows = checkRows(shape, lattice); !rows) return rows.error();
  std::vector<float> distance(lattice.size());
  const auto intervals = insideIntervals(shape, lattice.centre(0, 0).y, lattice.cell, lattice.ny);
  std::vector<std::size_t> column;  // column of the block that holds a sample
  std::vector<std::size_t> row;
  for (int x = 0; x < lattice.nx; ++x)
    column.push_back(index.blockOf({lattice.centre(x, 0).x, index.blocks_.origin.y}));
  for (int y = 0; y < lattice.ny; ++y) row.push_back(index.blockOf({index.blocks_.origin.x, lattice.centre(0, y).y}));
  const std::vector<int> columns = runsOf(column, lattice.nx);
  const std::vector<int> rows = runsOf(row, kTile);
  const int tileRows = static_cast<int>(rows.size()) - 1;
  parallelFor(run, tileRows, rowGrain(run, tileRows, 5.0 * kTile * lattice.nx), [&](int begin, int end) {
    TileDistances tile(index.segments_);
    for (int r = begin; r < end; ++r) {
      const int top = rows[r];
      const int bottom = rows[r + 1];
      for (std::size_t c = 0; c + 1 < columns.size(); ++c) {
        const int first = columns[c];
        const int last = columns[c + 1];
        const std::size_t block = row[top] + column[first];
        const float lowest = index.lowest_[block];
        if (lowest > band) {
          for (int y = top; y < bottom; ++y) std::fill_n(&distance[lattice.index(first, y)], last - first, lowest);
          continue;
        }
        const int* const candidates = index.candidates_.data();
        for (int left = first; left < last; left += kTile) {
          for (std::size_t k = 0; k < TileDistances::kSamples; ++k) {
            const Vec2 p = lattice.centre(left + static_cast<int>(k % kTile), top + static_cast<int>(k / kTile));
            tile.x[k] = p.x;
            tile.y[k] = p.y;
          }
          tile.measure({candidates + index.begin_[block], candidates + index.begin_[block + 1]},
                       static_cast<double>(band));
          for (int y = top; y < bottom; ++y) {
            for (int x = left; x < std::min(left + kTile, last); ++x) {
              distance[lattice.index(x, y)] = static_cast<float>(std::sqrt(tile.squared[(y - top) * kTile + x - left]));
            }
          }
        }
      }
      for (int y = top; y < bottom; ++y) {
        float* const line = &distance[lattice.index(0, y)];
        forInside(intervals[y], lattice, [&](int first, int last) {
          for (int x = first; x < last; ++x) line[x] = -line[x];
        });
      }
    }
  });
  if (run.cancelled()) return cancelledRun();
  return distance;
}

}  // namespace sillon
