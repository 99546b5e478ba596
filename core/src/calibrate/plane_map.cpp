#include "calibrate/plane_map.hpp"

#include <Eigen/Eigenvalues>

namespace sillon {

Eigen::Matrix3d mapThrough(const std::vector<PointPair>& pairs, double side) {
  Vec2 middle;
  double total = 0;
  for (const PointPair& p : pairs) middle = middle + p.weight * p.pixel, total += p.weight;
  middle = (1 / total) * middle;
  double size = 0;
  for (const PointPair& p : pairs) size += p.weight * length(p.pixel - middle) / total;
  const double half = side / 2;
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (const PointPair& p : pairs) {
    const double x = p.plate.x / half - 1, y = p.plate.y / half - 1;
    const double u = (p.pixel.x - middle.x) / size, v = (p.pixel.y - middle.y) / size;
    Eigen::Matrix<double, 9, 1> a, b;
    a << x, y, 1, 0, 0, 0, -u * x, -u * y, -u;
    b << 0, 0, 0, x, y, 1, -v * x, -v * y, -v;
    normal += p.weight * (a * a.transpose() + b * b.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
  const Eigen::Matrix<double, 9, 1> h = solver.eigenvectors().col(0);
  Eigen::Matrix3d inner, plate, pixel;
  inner << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], h[8];
  plate << 1 / half, 0, -1, 0, 1 / half, -1, 0, 0, 1;
  pixel << size, 0, middle.x, 0, size, middle.y, 0, 0, 1;
  Eigen::Matrix3d map = pixel * inner * plate;
  const double depth = (map * Eigen::Vector3d(half, half, 1))[2];
  return map / depth;
}

}  // namespace sillon
