#include "runtime/geometry/rigid.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

Rigid randomRigid(Random *random) {
  const Matrix3 rotation = test::randomRotation(random);
  return {rotation, 3 * test::normalVector(random)};
}

TEST(Rigid, ComposeAppliesTheRightOneFirst) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Rigid c_from_b = randomRigid(&random), b_from_a = randomRigid(&random);
    const Vector3 x = test::normalVector(&random);
    EXPECT_LT(((c_from_b * b_from_a) * x - c_from_b * (b_from_a * x)).norm(), 1e-13);
    EXPECT_LT((b_from_a.inverse() * (b_from_a * x) - x).norm(), 1e-13);
  }
}

TEST(Rigid, ToTheInterfaceAndBack) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Rigid rigid = randomRigid(&random), back = rigidFromC(rigidToC(rigid));
    EXPECT_LT((back.rotation - rigid.rotation).norm(), 1e-13);
    EXPECT_EQ(back.translation_m, rigid.translation_m);
  }
}

TEST(Rigid, Validity) {
  const sphc_rigid good = {{1, 0, 0, 0}, {1, 2, 3}};
  EXPECT_TRUE(isValidRigid(good));
  sphc_rigid bad = good;
  bad.q_wxyz[0] = 0;
  EXPECT_FALSE(isValidRigid(bad));
  bad = good, bad.q_wxyz[0] = 1.01;
  EXPECT_FALSE(isValidRigid(bad));
  bad = good, bad.q_wxyz[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(isValidRigid(bad));
  bad = good, bad.t_m[1] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(isValidRigid(bad));
  bad = good, bad.q_wxyz[1] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(isValidRigid(bad));
}

}  // namespace
}  // namespace sphc
