#include "runtime/stages/pose/symmetric_inverse.h"

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

TEST(SymmetricInverse, InvertsEverySizeThatPosesHave) {
  expectInverse<2>();
  expectInverse<6>();
  expectInverse<8>();
}

}  // namespace
}  // namespace sphc
