// Points of closed curves, sorted into square buckets for queries about neighbouring beads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/parallel_for.hpp"
#include "base/simd.hpp"
#include "sillon/base/types.hpp"

namespace sillon {

/// Sorted points. Buckets are stored row by row, so that the buckets [x0, x1] of a row are one contiguous run of
/// points.
class PointGrid {
 public:
  PointGrid(const std::vector<Vec2f>& points, float bucket, const RunContext& run) : inverse_(1 / bucket) {
    Vec2f low{1e30f, 1e30f};
    Vec2f high{-1e30f, -1e30f};
    for (const Vec2f p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    if (points.empty()) low = high = {};
    low_ = low;
    nx_ = static_cast<int>((high.x - low.x) * inverse_) + 1;
    ny_ = static_cast<int>((high.y - low.y) * inverse_) + 1;
    const std::size_t buckets = cellCount(nx_, ny_);
    const int count = static_cast<int>(points.size());
    x.assign(points.size() + 4, 1e9f);  // four far points at the end allow vector loads beyond the last point
    y.assign(points.size() + 4, 1e9f);
    id.assign(points.size() + 4, -1);

    // Sorts by counting, in parallel shares; within a bucket points stay in order, whatever the number of shares.
    const int shares = std::clamp(std::min(run.threads(), count / (1 << 14)), 1, 8);
    const int grain = (count + shares - 1) / shares;
    std::vector<std::int32_t> bucketOf(points.size());
    std::vector<std::vector<std::int32_t>> next(shares, std::vector<std::int32_t>(buckets, 0));
    parallelFor(run, count, grain, [&](int begin, int end) {
      std::vector<std::int32_t>& share = next[begin / grain];
      for (int k = begin; k < end; ++k) {
        const Vec2f p = points[k];
        bucketOf[k] = row(p.y) * nx_ + column(p.x);
        ++share[bucketOf[k]];
      }
    });
    begin_.resize(buckets + 1);
    std::int32_t sum = 0;
    for (std::size_t b = 0; b < buckets; ++b) {
      begin_[b] = sum;
      for (std::vector<std::int32_t>& share : next) {
        const std::int32_t size = share[b];
        share[b] = sum;
        sum += size;
      }
    }
    begin_[buckets] = sum;
    parallelFor(run, count, grain, [&](int begin, int end) {
      std::vector<std::int32_t>& share = next[begin / grain];
      for (int k = begin; k < end; ++k) {
        const std::size_t b = bucketOf[k];
        const std::size_t at = share[b]++;
        x[at] = points[k].x;
        y[at] = points[k].y;
        id[at] = k;
      }
    });
  }

  [[nodiscard]] int count() const { return static_cast<int>(id.size()) - 4; }

  /// Calls visit(begin, end) for runs of sorted points that include all points within `reach` of p, lowest row first.
  template <class Visit>
  void around(Vec2f p, float reach, const Visit& visit) const {
    const int x0 = column(p.x - reach);
    const int x1 = column(p.x + reach);
    const int y1 = row(p.y + reach);
    for (int by = row(p.y - reach); by <= y1; ++by) {
      const std::size_t first = indexOf(0, by, nx_);
      const int begin = begin_[first + x0];
      const int end = begin_[first + x1 + 1];
      if (begin < end) visit(begin, end);
    }
  }

  std::vector<float> x;  ///< sorted, padded by four far points
  std::vector<float> y;
  std::vector<std::int32_t> id;  ///< index of each sorted point in the curves

 private:
  [[nodiscard]] int column(float v) const { return clampTo((v - low_.x) * inverse_, nx_); }
  [[nodiscard]] int row(float v) const { return clampTo((v - low_.y) * inverse_, ny_); }
  static int clampTo(float v, int count) {
    return v <= 0 ? 0 : (v >= static_cast<float>(count) ? count - 1 : static_cast<int>(v));
  }

  Vec2f low_;
  float inverse_;
  int nx_ = 1;
  int ny_ = 1;
  std::vector<std::int32_t> begin_;
};

/// Set of points on the same stretch of path as a given point: those of its curve fewer than `reach` points away along
/// it. They form one run of indices, or two if the stretch passes the curve's first point.
class OwnChain {
 public:
  OwnChain(int point, int first, int size, int reach) {
    const int end = first + size;
    int from = point - reach + 1;
    int to = point + reach;
    int from2 = 0;
    int to2 = 0;
    if (size < 2 * reach) {
      from = first;
      to = end;
    } else if (from < first) {
      from2 = from + size;
      to2 = end;
      from = first;
    } else if (to > end) {
      from2 = first;
      to2 = to - size;
      to = end;
    }
    before_ = splatInt(from - 1);
    end_ = splatInt(to);
    before2_ = splatInt(from2 - 1);
    end2_ = splatInt(to2);
  }

  /// Tests four indices at once. \return all bits set in each lane whose `id` belongs to the stretch.
  [[nodiscard]] I4 holds(I4 id) const { return ((id > before_) & (id < end_)) | ((id > before2_) & (id < end2_)); }

 private:
  I4 before_;
  I4 end_;
  I4 before2_;
  I4 end2_;
};

}  // namespace sillon
