#include "calibrate/photo.hpp"

#include <Eigen/Cholesky>

namespace sillon {
namespace {

using Factors = Eigen::LDLT<Eigen::MatrixXd>;

/// Factors of the matrix, L D Lᵀ.
Factors factored(const NormalEquations& of) {
  const auto n = static_cast<Eigen::Index>(of.size);
  return Factors(Eigen::Map<const Eigen::MatrixXd>(of.matrix.data(), n, n));  // rows are columns: it is symmetric
}

}  // namespace

void NormalEquations::add(const double* row, double value, double weight) {
  for (std::size_t i = 0; i < size; ++i) {
    const double by = weight * row[i];
    for (std::size_t j = 0; j < size; ++j) matrix[i * size + j] += by * row[j];
    right[i] += by * value;
  }
}

std::vector<double> NormalEquations::solved() const {
  std::vector<double> x(size);
  const auto n = static_cast<Eigen::Index>(size);
  Eigen::Map<Eigen::VectorXd>(x.data(), n) = factored(*this).solve(Eigen::Map<const Eigen::VectorXd>(right.data(), n));
  return x;
}

std::vector<double> NormalEquations::variances(std::size_t count) const {
  const Factors factors = factored(*this);
  std::vector<double> out;
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(count); ++k) {
    out.push_back(factors.solve(Eigen::VectorXd::Unit(static_cast<Eigen::Index>(size), k))[k]);
  }
  return out;
}

}  // namespace sillon
