#include "runtime/localizer/recent_steps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/geometry/rotation.h"

namespace sphc {
namespace {

constexpr uint64_t kMs = 1000000;

// A camera that turns and speeds up, as odometry sees it.
Rigid cameraAt(double time_s) {
  const Vector3 center(0.4 * std::sin(3 * time_s), 0.2 * time_s * time_s, 0.5 * time_s);
  const Matrix3 turned = rotationFromVector(Vector3(0.2 * time_s, std::sin(2 * time_s), 0.1));
  return {turned, -(turned * center)};
}

// Steps of `step_ms` that end at `end_s`.
RecentSteps walked(int steps, double step_ms, double end_s) {
  RecentSteps recent;
  for (int i = steps; i > 0; --i) {
    const double step_s = step_ms * 1e-3;
    recent.push(cameraAt(end_s - (i - 1) * step_s) * cameraAt(end_s - i * step_s).inverse(),
                static_cast<uint64_t>(step_ms * kMs));
  }
  return recent;
}

double offM(const Rigid &a, const Rigid &b) {
  return (a.inverse().translation_m - b.inverse().translation_m).norm();
}

TEST(RecentSteps, TellsWhatIsBetweenStepsLongAgo) {
  const RecentSteps recent = walked(20, 33, 2);
  for (const uint32_t ago_ms : {0u, 10u, 33u, 66u, 133u, 250u, 500u}) {
    Rigid now_from_ago;
    ASSERT_TRUE(recent.nowFromAgo(ago_ms * kMs, &now_from_ago)) << ago_ms;
    const Rigid expected = cameraAt(2) * cameraAt(2 - ago_ms * 1e-3).inverse();
    EXPECT_LT(offM(now_from_ago, expected), 1e-3) << ago_ms;
    EXPECT_LT(rotationAngle(now_from_ago.rotation * expected.rotation.transpose()), 2e-3) << ago_ms;
  }
}

TEST(RecentSteps, GoesOnSteadilyBesideWhatIsKnown) {
  const RecentSteps recent = walked(1, 20, 1);
  Rigid now_from_ago, now_from_ahead;
  ASSERT_TRUE(recent.nowFromAgo(50 * kMs, &now_from_ago));
  ASSERT_TRUE(recent.nowFromAhead(50 * kMs, &now_from_ahead));
  EXPECT_LT(offM(now_from_ago, cameraAt(1) * cameraAt(0.95).inverse()), 5e-3);
  EXPECT_LT(offM(now_from_ahead, cameraAt(1) * cameraAt(1.05).inverse()), 5e-3);
  EXPECT_FALSE(recent.nowFromAgo(101 * kMs, &now_from_ago)) << "80 ms before all that is known";
  EXPECT_FALSE(recent.nowFromAhead(101 * kMs, &now_from_ahead));
}

TEST(RecentSteps, ForgetsTheOldest) {
  Rigid now_from_ago;
  EXPECT_TRUE(walked(200, 11, 3).nowFromAgo(32 * 11 * kMs, &now_from_ago));
  EXPECT_FALSE(walked(200, 11, 3).nowFromAgo(32 * 11 * kMs + 1, &now_from_ago));
  EXPECT_FALSE(walked(200, 33, 3).nowFromAgo(501 * kMs, &now_from_ago)) << "odometry drifts";
}

TEST(RecentSteps, KnowsNothingBeforeAPause) {
  RecentSteps recent = walked(5, 33, 1);
  recent.push({}, 300 * kMs);
  Rigid now_from_ago;
  EXPECT_FALSE(recent.nowFromAgo(0, &now_from_ago));
  EXPECT_FALSE(recent.nowFromAhead(0, &now_from_ago));
  recent.push({}, 33 * kMs);
  EXPECT_TRUE(recent.nowFromAgo(100 * kMs, &now_from_ago));
  EXPECT_FALSE(recent.nowFromAgo(133 * kMs, &now_from_ago));
  recent.clear();
  EXPECT_FALSE(recent.nowFromAgo(0, &now_from_ago));
}

}  // namespace
}  // namespace sphc
