#include "base/exact_math.hpp"
#include "calibrate/photo.hpp"

namespace sillon {
namespace {

constexpr double kUsualOff = 0.1;  // [mm] residual at which a pair counts half
constexpr int kRounds = 5;         // rounds of fitting and reweighting

}  // namespace

Mat3 mapThrough(const std::vector<PointPair>& pairs, double side) {
  Vec2 middle;
  double total = 0;
  for (const PointPair& p : pairs) middle = middle + p.weight * p.pixel, total += p.weight;
  middle = (1 / total) * middle;
  double size = 0;
  for (const PointPair& p : pairs) size += p.weight * length(p.pixel - middle) / total;
  const double half = side / 2;
  NormalEquations normal{8};
  for (const PointPair& p : pairs) {
    const double x = p.plate.x / half - 1, y = p.plate.y / half - 1;
    const double u = (p.pixel.x - middle.x) / size, v = (p.pixel.y - middle.y) / size;
    for (const Vec2 n : {p.first, p.second}) {
      const double value = n.x * u + n.y * v;
      const double row[] = {n.x * x, n.x * y, n.x, n.y * x, n.y * y, n.y, -value * x, -value * y};
      normal.add(row, value, p.weight);
    }
  }
  const std::vector<double> h = normal.solved();
  const Mat3 inner{{h[0], h[3], h[6]}, {h[1], h[4], h[7]}, {h[2], h[5], 1}};
  const Mat3 plate{{1 / half, 0, 0}, {0, 1 / half, 0}, {-1, -1, 1}};
  const Mat3 pixel{{size, 0, 0}, {0, size, 0}, {middle.x, middle.y, 1}};
  return pixel * inner * plate;
}

double leftOf(const PointPair& pair, const Mat3& map) {
  const Vec2 off = mapped(map, pair.plate) - pair.pixel;
  return exact::hypot(dot(pair.first, off), dot(pair.second, off));
}

double fitMap(Mat3& map, const std::vector<PointPair>& pairs, double side, double scale) {
  std::vector<PointPair> weighted = pairs;
  double residual = 0;
  for (int round = 0; round < kRounds; ++round) {
    map = mapThrough(weighted, side);
    double sum = 0, weights = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const double off = leftOf(pairs[k], map) / scale;
      weighted[k].weight = pairs[k].weight / (1 + exact::square(off / kUsualOff));
      sum += weighted[k].weight * off * off, weights += weighted[k].weight;
    }
    residual = std::sqrt(sum / weights);
  }
  return residual;
}

}  // namespace sillon
