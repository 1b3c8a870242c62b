// Symmetric positive definite matrices of the sizes that poses have.
#pragma once

#include <Eigen/Core>

namespace sphc {

// L D L^T of a matrix whose rows and columns were exchanged so that the largest remaining element of the diagonal
// comes next (Golub and Van Loan, Matrix Computations, 4.2.9).  One function for all sizes: a template for each was
// the slowest of all files to compile.
class SymmetricFactors {
 public:
  static constexpr int kMostRows = 8;

  // Column-major; the lower triangle is read.
  SymmetricFactors(const double *matrix, int rows);
  // x of matrix * x = right; in place.
  void solve(double *x) const;

 private:
  double &at(int row, int column) { return factors_[column * rows_ + row]; }
  double at(int row, int column) const { return factors_[column * rows_ + row]; }
  void exchange(int k, int with);
  void eliminate(int k);

  double factors_[kMostRows * kMostRows];  // L below the diagonal, which is 1, and D on it
  int exchanged_[kMostRows];               // row k with which, in this order
  int rows_;
};

template <int kRows>
Eigen::Matrix<double, kRows, 1> solveSymmetric(const Eigen::Matrix<double, kRows, kRows> &matrix,
                                               const Eigen::Matrix<double, kRows, 1> &right) {
  static_assert(kRows <= SymmetricFactors::kMostRows);
  Eigen::Matrix<double, kRows, 1> x = right;
  SymmetricFactors(matrix.data(), kRows).solve(x.data());
  return x;
}

template <int kRows>
Eigen::Matrix<double, kRows, kRows> symmetricInverse(const Eigen::Matrix<double, kRows, kRows> &matrix) {
  static_assert(kRows <= SymmetricFactors::kMostRows);
  const SymmetricFactors factors(matrix.data(), kRows);
  Eigen::Matrix<double, kRows, kRows> inverse = Eigen::Matrix<double, kRows, kRows>::Identity();
  for (int column = 0; column < kRows; ++column) factors.solve(inverse.data() + column * kRows);
  return inverse;
}

}  // namespace sphc
