#include "host/audit/attack/stack_features.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/audit/attack/mirror.h"
#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

constexpr Eigen::Index kBest = 0, kLogAngle = 2, kBestMirrored = 5, kBins = 10, kBinsMirrored = 20,
                       kDifference = 30, kRadius = 45, kLogCount = 47;
constexpr double kApartRad = 0.3;  // of two stacks: the ninth bin, up to 25 degrees

// Two stacks of 40 points; none alike but for those that a test makes so.
class StackFeatures : public testing::Test {
 protected:
  StackFeatures() {
    Random random(3);
    for (int i = 0; i < 80; ++i) {
      const double along = i < 40 ? 0 : kApartRad;
      const Vector3 middle(std::sin(along), 0, std::cos(along));
      map.directions.push_back(i % 40 == 0 ? middle : (middle + 0.01 * test::normalVector(&random)).normalized());
      map.descriptors.push_back(test::randomDescriptor(&random));
      stacks.push_back(i < 40 ? 0 : 1);
    }
  }

  Eigen::MatrixXf features() const { return stackFeatures(map.directions, neighboursIn(map), stacks); }

  Published map;
  std::vector<uint32_t> stacks;
};

TEST_F(StackFeatures, OfALookalikeInAnotherStack) {
  map.descriptors[40] = map.descriptors[0];
  const Eigen::MatrixXf values = features();
  EXPECT_EQ(values(0, kBest), 0);
  EXPECT_NEAR(values(0, kLogAngle), std::log(kApartRad + 0.02), 1e-3);
  EXPECT_EQ(values(0, kBins + 7), 0);  // 17 to 25 degrees
  EXPECT_GT(values(0, kBinsMirrored + 7), 100);
  EXPECT_GT(values(0, kBestMirrored), 100);
  EXPECT_EQ(values(0, kDifference), values(0, kBest) - values(0, kBestMirrored));
}

TEST_F(StackFeatures, OfAMirroredLookalikeInAnotherStack) {
  map.descriptors[40] = mirrorOf(map.descriptors[0]);
  const Eigen::MatrixXf values = features();
  EXPECT_EQ(values(0, kBestMirrored), 0);
  EXPECT_GT(values(0, kBest), 100);
}

TEST_F(StackFeatures, LookalikesInTheOwnStackSayNothingOfOthers) {
  map.descriptors[1] = map.descriptors[0];
  const Eigen::MatrixXf values = features();
  EXPECT_GT(values(0, kBest), 100);
  EXPECT_EQ(values.row(0).segment(kBins, 3).minCoeff(), 0);  // but that they are near
}

TEST_F(StackFeatures, OfPlacesInTheStack) {
  const Eigen::MatrixXf values = features();
  EXPECT_LT(values(0, kRadius), 0.1f);
  EXPECT_GT(values.col(kRadius).maxCoeff(), 0.2f);
  EXPECT_NEAR(values(0, kLogCount), std::log(40), 1e-5);
}

}  // namespace
}  // namespace sphc::host
