#include "host/mapping/vertical.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "runtime/geometry/rigid.h"

namespace sphc::host {
namespace {

constexpr int64_t kPeriodNs = 5000000;  // 200 accelerations a second, and 20 poses
const Vector3 kUp = Vector3(0.3, -0.9, 0.2).normalized();

// Ten seconds of a camera that looks around, nods, and is shaken; `sensor` is how the sensor is turned against what
// is believed of it.
FeltPath walk(double shake_mps2, const Matrix3 &sensor = Matrix3::Identity(), double gravity_mps2 = 9.81) {
  FeltPath path;
  for (int64_t i = 0; i < 2000; ++i) {
    const double t_s = static_cast<double>(i * kPeriodNs) * 1e-9;
    Rigid pose;
    pose.rotation =
        (Eigen::AngleAxisd(0.6 * t_s, kUp) * Eigen::AngleAxisd(0.5 * std::sin(t_s), kUp.unitOrthogonal()))
            .toRotationMatrix();
    if (i % 10 == 0) path.world_from_camera.add(i * kPeriodNs, rigidToC(pose));
    const Vector3 shaken = shake_mps2 * Vector3(std::sin(11 * t_s), std::sin(13 * t_s), std::sin(17 * t_s));
    const Vector3 felt = sensor * (pose.rotation.transpose() * (gravity_mps2 * kUp + shaken));
    path.felt.push_back({i * kPeriodNs, {felt.x(), felt.y(), felt.z()}});
  }
  return path;
}

double offRad(const MeasuredVertical &vertical) {
  return std::atan2(vertical.up_world.cross(kUp).norm(), vertical.up_world.dot(kUp));
}

TEST(Vertical, ACameraThatIsCarriedAroundTellsUp) {
  const MeasuredVertical still = measureVertical({walk(0)}), shaken = measureVertical({walk(2)});
  EXPECT_TRUE(still.isKnown());
  EXPECT_LT(offRad(still), 1e-3);  // poses between recorded ones are interpolated
  EXPECT_EQ(still.accelerations, 1991u) << "up to the last pose";
  EXPECT_EQ(still.seconds, 10);
  EXPECT_TRUE(shaken.isKnown());
  EXPECT_LT(offRad(shaken), 3 * shaken.sigma_rad);
  EXPECT_LT(shaken.sigma_rad, 0.02);
  EXPECT_GT(shaken.sigma_rad, still.sigma_rad);
}

TEST(Vertical, SeveralPathsOfOneWorldAreOneMeasurement) {
  const MeasuredVertical both = measureVertical({walk(2), walk(1)});
  EXPECT_TRUE(both.isKnown());
  EXPECT_EQ(both.seconds, 20);
}

// A wrong transform of the sensor turns with the camera, so it is seen.
TEST(Vertical, ASensorThatIsElsewhereThanToldIsNotBelieved) {
  const Matrix3 quarter = Eigen::AngleAxisd(kPi / 2, kUp.unitOrthogonal()).toRotationMatrix();
  const MeasuredVertical vertical = measureVertical({walk(0, quarter)});
  EXPECT_FALSE(vertical.isKnown());
  EXPECT_THAT(vertical.doubt, testing::HasSubstr("the sensor's place on the camera"));
  const Matrix3 tilted = Eigen::AngleAxisd(0.4, kUp.unitOrthogonal()).toRotationMatrix();
  EXPECT_THAT(measureVertical({walk(0, tilted)}).doubt, testing::HasSubstr("deg in where up is"));
}

TEST(Vertical, UnitsThatAreNoneOfOursAreNotBelieved) {
  EXPECT_THAT(measureVertical({walk(0, Matrix3::Identity(), 1)}).doubt,
              testing::HasSubstr("their mean is 1.0 m/s^2, and gravity is 9.8; check the units"));
}

// One acceleration a second is none throughout, and may be of a jolt.
TEST(Vertical, SecondsWithAFewAccelerationsTellNothing) {
  const FeltPath whole = walk(0);
  FeltPath path = whole;
  path.felt.clear();
  for (size_t i = 0; i < whole.felt.size(); i += 200) path.felt.push_back(whole.felt[i]);
  EXPECT_FALSE(measureVertical({path}).isKnown());
  path.felt = whole.felt;
  path.felt.erase(path.felt.begin() + 420, path.felt.begin() + 580);  // 0.8 s of the third second
  const MeasuredVertical vertical = measureVertical({path});
  EXPECT_TRUE(vertical.isKnown());
  EXPECT_EQ(vertical.seconds, 9);
}

TEST(Vertical, TwoSecondsTellNothing) {
  FeltPath path = walk(0);
  path.felt.resize(390);
  const MeasuredVertical vertical = measureVertical({path, {}});
  EXPECT_FALSE(vertical.isKnown());
  EXPECT_EQ(vertical.doubt, "");
  EXPECT_EQ(measureVertical({}).accelerations, 0u);
}

}  // namespace
}  // namespace sphc::host
