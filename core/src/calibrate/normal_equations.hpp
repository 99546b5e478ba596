// Normal equations of least squares: gathered row by row, and solved.
#pragma once

#include <cstddef>
#include <vector>

namespace sillon {

/// A symmetric matrix that is positive definite, and the right side of its equations.
struct NormalEquations {
  std::size_t size;
  std::vector<double> matrix = std::vector<double>(size * size, 0);
  std::vector<double> right = std::vector<double>(size, 0);

  [[nodiscard]] double& at(std::size_t row, std::size_t column) { return matrix[row * size + column]; }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return matrix[row * size + column]; }

  /// One equation: row * x = value.
  void add(const double* row, double value, double weight);

  /// x of matrix * x = right.
  [[nodiscard]] std::vector<double> solved() const;

  /// Diagonal of the matrix' inverse, its first `count`.
  [[nodiscard]] std::vector<double> variances(std::size_t count) const;
};

}  // namespace sillon
