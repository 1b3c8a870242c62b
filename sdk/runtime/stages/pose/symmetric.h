// Symmetric positive definite matrices of the sizes that poses have.  Compiled once, since Eigen's decomposition is
// the larger part of the files that need it.
#pragma once

#include <Eigen/Core>

namespace sphc {

// The inverse; of 6 x 6 and 8 x 8.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> symmetricInverse(const Eigen::Matrix<double, kSize, kSize> &matrix);

// x of matrix * x = right; of 8 x 8.
template <int kSize>
Eigen::Matrix<double, kSize, 1> solveSymmetric(const Eigen::Matrix<double, kSize, kSize> &matrix,
                                               const Eigen::Matrix<double, kSize, 1> &right);

}  // namespace sphc
