#include "runtime/stages/pose/symmetric.h"

#include <Eigen/Cholesky>

namespace sphc {

// Column by column: for all columns at once Eigen has kernels that on arm64 fuse multiply and add, and so give
// other bits there than on x86.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> symmetricInverse(const Eigen::Matrix<double, kSize, kSize> &matrix) {
  static_assert(kSize <= 8, "Eigen unrolls no more");
  using Vector = Eigen::Matrix<double, kSize, 1>;
  const Eigen::LDLT<Eigen::Matrix<double, kSize, kSize>> factors(matrix);
  Eigen::Matrix<double, kSize, kSize> inverse;
  for (int i = 0; i < kSize; ++i) {
    const Vector unit = Vector::Unit(i);
    inverse.col(i) = Vector(factors.solve(unit));
  }
  return inverse;
}

template <int kSize>
Eigen::Matrix<double, kSize, 1> solveSymmetric(const Eigen::Matrix<double, kSize, kSize> &matrix,
                                               const Eigen::Matrix<double, kSize, 1> &right) {
  return Eigen::LDLT<Eigen::Matrix<double, kSize, kSize>>(matrix).solve(right);
}

template Eigen::Matrix<double, 6, 6> symmetricInverse(const Eigen::Matrix<double, 6, 6> &);
template Eigen::Matrix<double, 8, 8> symmetricInverse(const Eigen::Matrix<double, 8, 8> &);
template Eigen::Matrix<double, 8, 1> solveSymmetric(const Eigen::Matrix<double, 8, 8> &,
                                                    const Eigen::Matrix<double, 8, 1> &);

}  // namespace sphc
