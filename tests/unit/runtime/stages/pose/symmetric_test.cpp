#include "runtime/stages/pose/symmetric.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cstring>

#include "runtime/base/random.h"
#include "runtime/types/estimate.h"
#include "tests/support/dense_matrix.h"

namespace sphc {
namespace {

// Products of fixed size would be unrolled, and those of any size need much code: lazy ones compile in a moment.
template <int kSize>
void expectInverse() {
  Eigen::MatrixXd root(kSize, kSize);
  for (int i = 0; i < kSize * kSize; ++i) root(i) = (7 * i * i + 3 * i) % 23 - 11;
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(kSize, kSize),
                        matrix = root.lazyProduct(root.transpose()) + identity;
  const Eigen::MatrixXd inverse = symmetricInverse<kSize>(matrix);
  EXPECT_LT((inverse - test::inverseByLu(matrix)).norm(), 1e-9 * inverse.norm()) << "against LU";
  EXPECT_LT((inverse.lazyProduct(matrix) - identity).norm(), 1e-9);
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

// Sums in the order of Eigen's decomposition, so that poses have the bytes that they had with it.
TEST(Symmetric, GivesTheBitsOfEigen) {
  using Matrix = Eigen::Matrix<double, 6, 6>;
  Random random(11);
  for (int round = 0; round < 2000; ++round) {
    Matrix matrix = Matrix::Zero();
    const int rank = round % 3 ? 9 : round % 6;  // some are singular
    for (int i = 0; i < rank; ++i) {
      Vector6 v;
      for (double &element : v) element = (2 * random.uniform() - 1) * (random.below(4) ? 1 : 1e3);
      matrix += v * v.transpose();
    }
    const Vector6 right = matrix.col(round % 6) + Vector6::Unit(round % 5);
    const Vector6 expected = Eigen::LDLT<Matrix>(matrix).solve(right), found = solveSymmetric<6>(matrix, right);
    ASSERT_EQ(std::memcmp(expected.data(), found.data(), sizeof expected), 0) << matrix;
  }
}

TEST(Symmetric, WhatNothingPinsDownIsZero) {
  Eigen::Matrix2d matrix;
  matrix << 4, 0, 0, 0;
  const Eigen::Vector2d x = solveSymmetric<2>(matrix, Eigen::Vector2d(8, 3));
  EXPECT_EQ(x[0], 2);
  EXPECT_EQ(x[1], 0);
}

}  // namespace
}  // namespace sphc
