// The inverse of a symmetric positive definite matrix of fixed size, at most 8 x 8.
#pragma once

#include <Eigen/Cholesky>

namespace sphc {

// Column by column: for all columns at once Eigen has kernels that on arm64 fuse multiply and add, and so give
// other bits there than on x86.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> symmetricInverse(const Eigen::Matrix<double, kSize, kSize> &matrix) {
  static_assert(kSize <= 8, "Eigen unrolls no more");
  const Eigen::LDLT<Eigen::Matrix<double, kSize, kSize>> factors(matrix);
  Eigen::Matrix<double, kSize, kSize> inverse;
  for (int i = 0; i < kSize; ++i) inverse.col(i) = factors.solve(Eigen::Matrix<double, kSize, 1>::Unit(i));
  return inverse;
}

}  // namespace sphc
