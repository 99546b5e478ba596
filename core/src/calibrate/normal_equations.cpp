#include "calibrate/normal_equations.hpp"

#include <algorithm>

namespace sillon {
namespace {

/// L and D of L D L^T = matrix, below and on the diagonal.
std::vector<double> factored(const NormalEquations& of) {
  const std::size_t n = of.size;
  std::vector<double> m = of.matrix;
  for (std::size_t j = 0; j < n; ++j) {
    const double by = 1 / std::max(1e-300, m[j * n + j]);
    for (std::size_t i = j + 1; i < n; ++i) {
      const double share = m[i * n + j] * by;
      for (std::size_t k = j + 1; k <= i; ++k) m[i * n + k] -= share * m[k * n + j];
    }
    for (std::size_t i = j + 1; i < n; ++i) m[i * n + j] *= by;
  }
  return m;
}

void solve(const std::vector<double>& factors, std::vector<double>& x) {
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) x[i] -= factors[i * n + k] * x[k];
  }
  for (std::size_t i = 0; i < n; ++i) x[i] /= std::max(1e-300, factors[i * n + i]);
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) x[i] -= factors[k * n + i] * x[k];
  }
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
  std::vector<double> x = right;
  solve(factored(*this), x);
  return x;
}

std::vector<double> NormalEquations::variances(std::size_t count) const {
  const std::vector<double> factors = factored(*this);
  std::vector<double> out;
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<double> x(size, 0);
    x[k] = 1;
    solve(factors, x);
    out.push_back(x[k]);
  }
  return out;
}

}  // namespace sillon
