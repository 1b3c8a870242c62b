#include "runtime/stages/pose/symmetric_inverse.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace sphc {
namespace {

template <int kSize>
void expectInverse() {
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  Matrix root;
  for (int i = 0; i < kSize * kSize; ++i) root(i) = (7 * i * i + 3 * i) % 23 - 11;
  const Matrix matrix = root * root.transpose() + Matrix::Identity();
  const Matrix inverse = symmetricInverse(matrix);
  EXPECT_LT((inverse - matrix.inverse()).norm(), 1e-9 * inverse.norm()) << "against LU";
  EXPECT_LT((inverse * matrix - Matrix::Identity()).norm(), 1e-9);
}

TEST(SymmetricInverse, InvertsEverySizeThatPosesHave) {
  expectInverse<2>();
  expectInverse<6>();
  expectInverse<8>();
}

}  // namespace
}  // namespace sphc
