#include "geometry/closed_curves.hpp"

#include <algorithm>

#include "base/parallel_for.hpp"

namespace sillon {
namespace {

// Resamples like resampled(), but keeps the points marked in `keep` and the segments between them.
ClosedCurves resampledBetween(const ClosedCurves& curves, const std::vector<char>& keep, double step) {
  ClosedCurves out;
  for (int c = 0; c < curves.count(); ++c) {
    out.begin.push_back(static_cast<int>(out.points.size()));
    const int first = curves.begin[c];
    const int n = curves.size(c);
    double since = step;  // arc length since the last point in `out`
    for (int k = 0; k < n; ++k) {
      const std::size_t i = first + k;
      const std::size_t j = first + (k + 1) % n;
      if (keep[i] || since >= 0.99 * step) {
        out.points.push_back(curves.points[i]);
        since = 0;
      }
      const Vec2f along = curves.points[j] - curves.points[i];
      const double size = static_cast<double>(length(along));
      if (keep[i] || keep[j]) {
        since += size;
        continue;
      }
      // Between free points only, take equal steps along the segment.
      double at = step - since;
      for (; at < size - 0.1 * step; at += step) {
        out.points.push_back(curves.points[i] + along * static_cast<float>(at / size));
      }
      since = size - (at - step);
    }
    if (static_cast<int>(out.points.size()) - out.begin.back() < kMinPoints) {
      out.points.resize(out.begin.back());
      for (int k = 0; k < n; ++k) out.points.push_back(curves.points[first + k]);
    }
  }
  out.begin.push_back(static_cast<int>(out.points.size()));
  return out;
}

}  // namespace

ClosedCurves resampled(const ClosedCurves& curves, float step, const RunContext& run) {
  // Arc length at each point and at the end of its curve, summed in blocks of fixed size, so that the result is the
  // same for any number of threads.
  constexpr int kBlock = 4096;
  ClosedCurves out;
  std::vector<double> along;
  for (int c = 0; c < curves.count(); ++c) {
    const Vec2f* p = curves.points.data() + curves.begin[c];
    const int n = curves.size(c);
    along.resize(n + 1);
    along[0] = 0;
    parallelFor(run, n, kBlock, [&](int begin, int end) {
      double sum = 0;
      for (int k = begin; k < end; ++k) {
        sum += static_cast<double>(length(p[k + 1 < n ? k + 1 : 0] - p[k]));
        along[k + 1] = sum;
      }
    });
    for (int begin = kBlock; begin < n; begin += kBlock) {
      const double before = along[begin];
      const int end = std::min(begin + kBlock, n);
      for (int k = begin; k < end; ++k) along[k + 1] += before;
    }
    const double total = along.back();
    const int count = std::max(kMinPoints, static_cast<int>(total / static_cast<double>(step) + 0.5));
    const std::size_t first = out.points.size();
    out.begin.push_back(static_cast<int>(first));
    out.points.resize(first + count);
    parallelFor(run, count, kBlock, [&](int begin, int end) {
      const auto found = std::upper_bound(along.begin() + 1, along.end(), total * begin / count);
      int k = std::min(n - 1, static_cast<int>(found - along.begin()) - 1);
      for (int s = begin; s < end; ++s) {
        const double at = total * s / count;
        while (k + 1 < n && along[k + 1] <= at) ++k;
        const double size = along[k + 1] - along[k];
        const float t = size > 0 ? static_cast<float>((at - along[k]) / size) : 0.0f;
        out.points[first + s] = p[k] + (p[k + 1 < n ? k + 1 : 0] - p[k]) * t;
      }
    });
  }
  out.begin.push_back(static_cast<int>(out.points.size()));
  return out;
}

ClosedCurves resampledSimply(const ClosedCurves& curves, float step, const RunContext& run) {
  ClosedCurves out = resampled(curves, step, run);
  auto crossings = findCrossings(out, run);
  if (crossings.empty()) return out;

  std::vector<char> keep(curves.points.size(), 0);  // marks original points that stay
  constexpr int kAttempts = 6;
  for (int attempt = 0; attempt < kAttempts && !crossings.empty(); ++attempt) {
    const std::vector<std::int32_t> curveOf = curveOfPoints(out);
    const double reach = static_cast<double>(step) * (2 << attempt);
    for (const auto& [a, b] : crossings) {
      for (const int segment : {a, b}) {
        // Keeps the original points near the crossing. Searching the whole curve is affordable, because crossings are
        // rare.
        const std::size_t c = curveOf[segment];
        const Vec2f p = out.points[segment];
        for (int k = curves.begin[c]; k < curves.begin[c + 1]; ++k) {
          if (static_cast<double>(length(curves.points[k] - p)) < reach) keep[k] = 1;
        }
      }
    }
    out = resampledBetween(curves, keep, static_cast<double>(step));
    crossings = findCrossings(out, run);
  }
  return crossings.empty() ? out : curves;
}

std::vector<std::int32_t> curveOfPoints(const ClosedCurves& curves) {
  std::vector<std::int32_t> curve(curves.points.size());
  for (int c = 0; c < curves.count(); ++c) {
    std::fill(curve.begin() + curves.begin[c], curve.begin() + curves.begin[c + 1], c);
  }
  return curve;
}

}  // namespace sillon
