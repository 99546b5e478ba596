#include "toolpath/path.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/fast_math.hpp"
#include "base/parallel_for.hpp"
#include "base/refused.hpp"

namespace sillon {
namespace {

// Root on an edge between two values, as a share of it. Waves are sines, so that their phase (arc sine) is linear along
// the edge: its root is exact where that of the values is not. Nearer to the border than half a spacing, values are no
// waves, and are interpolated themselves.
float rootBetween(float a, float b, bool onPhase) {
  if (onPhase) {
    a = asinApprox(a);
    b = asinApprox(b);
  }
  if (std::abs(b - a) < 1e-4f) return 0.5f;
  return std::clamp(a / (a - b), kMinRoot, 1 - kMinRoot);
}

// The lattice with the field's values, and the place of a vertex on each of its edges.
struct Lattice {
  const Grid& grid;
  const float* values;
  const float* distance;
  float inner;  ///< distances below this carry waves

  [[nodiscard]] bool positive(int x, int y) const { return values[grid.index(x, y)] >= 0; }

  [[nodiscard]] Vec2f vertex(int x0, int y0, int x1, int y1) const {
    const std::size_t i = grid.index(x0, y0);
    const std::size_t j = grid.index(x1, y1);
    const double u = rootBetween(values[i], values[j], distance[i] < inner && distance[j] < inner);
    const Vec2 a = grid.centre(x0, y0);
    const Vec2 b = grid.centre(x1, y1);
    return {static_cast<float>(a.x + u * (b.x - a.x)), static_cast<float>(a.y + u * (b.y - a.y))};
  }
};

// Signs of all nodes, one bit each, so that 64 edges without a vertex are passed at once. Looking at each edge takes
// 1.7 times the instructions where curves are dense, and seven times where they are few.
class Signs {
 public:
  using Word = std::uint64_t;

  explicit Signs(const Lattice& lattice)
      : lattice_(lattice), words_((lattice.grid.nx + 63) / 64), bits_(words_ * lattice.grid.ny) {}

  [[nodiscard]] std::size_t words() const { return words_; }  ///< words in a row

  // Packs one row of signs into words; zero counts as positive.
  void read(int y) {
    const std::size_t nx = lattice_.grid.nx;
    const float* values = &lattice_.values[lattice_.grid.index(0, y)];
    for (std::size_t w = 0; w < words_; ++w) {
      const std::size_t count = std::min<std::size_t>(64, nx - 64 * w);
      Word bits = 0;
      for (std::size_t k = 0; k < count; ++k) bits |= static_cast<Word>(values[64 * w + k] >= 0 ? 1 : 0) << k;
      bits_[words_ * y + w] = bits;
    }
  }

  /// Bit x: a vertex lies on (x, y)-(x + 1, y).
  [[nodiscard]] Word along(int y, std::size_t w) const {
    const Word* row = &bits_[words_ * y];
    const Word next = w + 1 < words_ ? row[w + 1] << 63 : 0;
    return (row[w] ^ (row[w] >> 1 | next)) & within(w, lattice_.grid.nx - 1);
  }

  /// Bit x: a vertex lies on (x, y)-(x, y + 1).
  [[nodiscard]] Word up(int y, std::size_t w) const {
    if (y + 1 >= lattice_.grid.ny) return 0;
    const std::size_t at = words_ * y + w;
    return bits_[at] ^ bits_[at + words_];
  }

 private:
  // Mask of the bits of a word whose columns are less than `end`.
  static Word within(std::size_t w, int end) {
    const int count = end - 64 * static_cast<int>(w);
    return count >= 64 ? ~Word{0} : count <= 0 ? 0 : (Word{1} << count) - 1;
  }

  const Lattice& lattice_;
  std::size_t words_;
  std::vector<Word> bits_;
};

// The vertices on the edges of one square of marching squares; -1 where there is none.
struct SquareVertices {
  int bottom;
  int right;
  int top;
  int left;
};

// Links the vertices of one square so that positive corners lie on the left. Going round counter-clockwise, a curve
// enters where the sign falls and leaves where it rises.
void linkSquare(const Lattice& lattice, int x, int y, const SquareVertices& vertices, std::vector<int>& next) {
  const auto [bottom, right, top, left] = vertices;
  const auto link = [&](int from, int to) { next[from] = to; };
  const bool bl = lattice.positive(x, y);
  if (bottom >= 0 && right >= 0 && top >= 0 && left >= 0) {
    // The ambiguous case, a saddle: all four edges have a vertex. The mean of the corners decides which two corners are
    // connected.
    const Grid& g = lattice.grid;
    const float mean = lattice.values[g.index(x, y)] + lattice.values[g.index(x + 1, y)] +
                       lattice.values[g.index(x, y + 1)] + lattice.values[g.index(x + 1, y + 1)];
    const bool joinsLowerLeft = (mean >= 0) == bl;
    if (bl) {
      link(bottom, joinsLowerLeft ? right : left);
      link(top, joinsLowerLeft ? left : right);
    } else {
      link(right, joinsLowerLeft ? bottom : top);
      link(left, joinsLowerLeft ? top : bottom);
    }
    return;
  }
  // All other squares hold one curve at most: the signs at the corners tell which vertex it enters by.
  int from = -1;
  int to = -1;
  const bool br = lattice.positive(x + 1, y);
  const bool tl = lattice.positive(x, y + 1);
  if (bottom >= 0) (bl ? from : to) = bottom;
  if (right >= 0) (br ? from : to) = right;
  if (top >= 0) (tl ? to : from) = top;
  if (left >= 0) (bl ? to : from) = left;
  if (from >= 0) link(from, to);
}

}  // namespace

Result<ClosedCurves> contourCycles(const Grid& grid, const std::vector<float>& values,
                                   const std::vector<float>& distance, double spacing, const RunContext& run) {
  const Lattice lattice{grid, values.data(), distance.data(), static_cast<float>(-0.5 * spacing)};

  // 1. Read all signs.
  Signs signs(lattice);
  const int grain = rowGrain(run, grid.ny, 2.0 * grid.nx);
  parallelForEach(run, grid.ny, grain, [&](int y) { signs.read(y); });
  // 2. Number the vertices row by row: first the edges along the row, then those up to the next row. The bits of each
  // row are counted, and sums of the counts tell where each row begins, so that rows can be worked on at the same time.
  std::vector<std::int64_t> first(grid.ny + 1, 0);
  std::vector<int> firstUp(grid.ny, 0);  // offset within its row
  parallelForEach(run, grid.ny, grain, [&](int y) {
    int along = 0;
    int up = 0;
    for (std::size_t w = 0; w < signs.words(); ++w) {
      along += std::popcount(signs.along(y, w));
      up += std::popcount(signs.up(y, w));
    }
    first[y + 1] = along + up;
    firstUp[y] = along;
  });
  for (std::size_t y = 1; y < first.size(); ++y) first[y] += first[y - 1];
  const std::int64_t total = first.back();
  if (total > INT32_MAX / 2) {
    return refused(ErrorCode::TooLarge, "PathTooLong");
  }

  // 3. Place the vertices and link them, square by square. Each row numbers its vertices anew from its own begin.
  std::vector<Vec2f> vertices(toSize(total));
  std::vector<int> next(toSize(total), -1);
  parallelForEach(run, grid.ny - 1, grain, [&](int y) {
    const std::size_t row = y;
    int along = static_cast<int>(first[row]);  // the next vertex of each kind
    int above = static_cast<int>(first[row + 1]);
    int up = along + firstUp[row];
    for (std::size_t w = 0; w < signs.words(); ++w) {
      const Signs::Word alongs = signs.along(y, w);
      const Signs::Word ups = signs.up(y, w);
      const Signs::Word aboves = signs.along(y + 1, w);
      const Signs::Word nextUps = ups >> 1 | (w + 1 < signs.words() ? signs.up(y, w + 1) << 63 : 0);
      // Visit only squares of which an edge holds a vertex.
      for (Signs::Word rest = alongs | ups | aboves; rest != 0; rest &= rest - 1) {
        const int bit = std::countr_zero(rest);
        const int x = 64 * static_cast<int>(w) + bit;
        const auto number = [&](Signs::Word word, int& free) { return (word >> bit & 1) != 0 ? free++ : -1; };
        const int left = number(ups, up);
        if (left >= 0) vertices[left] = lattice.vertex(x, y, x, y + 1);
        if (x + 1 == grid.nx) continue;
        const int bottom = number(alongs, along);
        const int top = number(aboves, above);
        // The right edge belongs to the next square, which numbers it: it is the next free one here.
        const int right = (nextUps >> bit & 1) != 0 ? up : -1;
        if (bottom >= 0) vertices[bottom] = lattice.vertex(x, y, x + 1, y);
        linkSquare(lattice, x, y, {bottom, right, top, left}, next);
      }
    }
  });
  if (run.cancelled()) return cancelledRun();

  // 4. Follow the links round. Cycles begin at their lowest edge, in order.
  ClosedCurves cycles;
  cycles.points.reserve(vertices.size());
  for (std::size_t start = 0; start < next.size(); ++start) {
    if (next[start] < 0) continue;
    if (run.cancelled()) return cancelledRun();
    cycles.begin.push_back(static_cast<int>(cycles.points.size()));
    for (std::size_t i = start; next[i] >= 0;) {
      cycles.points.push_back(vertices[i]);
      const int to = next[i];
      next[i] = -1;
      i = to;
    }
  }
  cycles.begin.push_back(static_cast<int>(cycles.points.size()));
  return cycles;
}

}  // namespace sillon
