#include "runtime/stages/pose/symmetric.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace sphc {
namespace {

// Products of fixed size would be unrolled, which takes long to compile.
template <int kSize>
void expectInverse() {
  Eigen::MatrixXd root(kSize, kSize);
  for (int i = 0; i < kSize * kSize; ++i) root(i) = (7 * i * i + 3 * i) % 23 - 11;
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(kSize, kSize),
                        matrix = root * root.transpose() + identity;
  const Eigen::MatrixXd inverse = symmetricInverse<kSize>(matrix);
  EXPECT_LT((inverse - matrix.inverse()).norm(), 1e-9 * inverse.norm()) << "against LU";
  EXPECT_LT((inverse * matrix - identity).norm(), 1e-9);
}

Eigen::Matrix<double, 8, 8> anyMatrix() {
  Eigen::Matrix<double, 8, 8> matrix;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) matrix(y, x) = (x == y ? 60 : 0) + (x * y + 3 * (x + y)) % 7;
  return matrix;
}

TEST(Symmetric, InvertsEverySizeThatPosesHave) {
  expectInverse<6>();
  expectInverse<8>();
}

TEST(Symmetric, SolvesASystem) {
  const Eigen::Matrix<double, 8, 8> matrix = anyMatrix();
  const Eigen::Matrix<double, 8, 1> truth{1, -2, 3, 0.5, 0, 7, -4, 2}, right = matrix.lazyProduct(truth);
  EXPECT_LT((solveSymmetric(matrix, right) - truth).norm(), 1e-12);
}

}  // namespace
}  // namespace sphc
