#include "runtime/localizer/recent_steps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/geometry/rotation.h"

namespace sphc {
namespace {

constexpr uint64_t kMs = 1000000;
constexpr double kTurnOfStep = 0.001, kShiftOfStep = 0.002;  // of a step, 1 sigma

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
    recent.push(
        {cameraAt(end_s - (i - 1) * step_s) * cameraAt(end_s - i * step_s).inverse(), kTurnOfStep, kShiftOfStep},
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
    Way from_ago;
    ASSERT_TRUE(recent.wayFromAgo(ago_ms * kMs, &from_ago)) << ago_ms;
    const Rigid expected = cameraAt(2) * cameraAt(2 - ago_ms * 1e-3).inverse();
    EXPECT_LT(offM(from_ago.now_from_then, expected), 1e-3) << ago_ms;
    EXPECT_LT(rotationAngle(from_ago.now_from_then.rotation * expected.rotation.transpose()), 2e-3) << ago_ms;
  }
}

TEST(RecentSteps, GoesOnSteadilyBesideWhatIsKnown) {
  const RecentSteps recent = walked(1, 20, 1);
  Way from_ago, from_ahead;
  ASSERT_TRUE(recent.wayFromAgo(50 * kMs, &from_ago));
  ASSERT_TRUE(recent.wayFromAhead(50 * kMs, &from_ahead));
  EXPECT_LT(offM(from_ago.now_from_then, cameraAt(1) * cameraAt(0.95).inverse()), 5e-3);
  EXPECT_LT(offM(from_ahead.now_from_then, cameraAt(1) * cameraAt(1.05).inverse()), 5e-3);
  EXPECT_FALSE(recent.wayFromAgo(101 * kMs, &from_ago)) << "too long before the frame";
  EXPECT_FALSE(recent.wayFromAhead(101 * kMs, &from_ahead));
}

TEST(RecentSteps, ErrorsOfStepsAddUp) {
  const RecentSteps recent = walked(20, 30, 2);
  const struct {
    uint64_t ago_ms;
    double steps;
  } cases[] = {{0, 0}, {15, 0.5}, {30, 1}, {120, 4}, {135, 4.5}, {450, 15}};
  for (const auto &one : cases) {
    Way way;
    ASSERT_TRUE(recent.wayFromAgo(one.ago_ms * kMs, &way)) << one.ago_ms;
    EXPECT_NEAR(way.turn_sigma_rad, std::sqrt(one.steps) * kTurnOfStep, 1e-9) << one.ago_ms;
    EXPECT_NEAR(way.shift_sigma_m, std::sqrt(one.steps) * kShiftOfStep, 1e-9) << one.ago_ms;
  }
  Way ahead, beyond;
  ASSERT_TRUE(recent.wayFromAhead(60 * kMs, &ahead));
  EXPECT_NEAR(ahead.shift_sigma_m, 2 * kShiftOfStep, 1e-9) << "what goes on so errs as much again";
  ASSERT_TRUE(walked(1, 30, 2).wayFromAgo(90 * kMs, &beyond));
  EXPECT_NEAR(beyond.shift_sigma_m, 3 * kShiftOfStep, 1e-9);
}

TEST(RecentSteps, ForgetsTheOldest) {
  Way from_ago;
  EXPECT_TRUE(walked(200, 11, 3).wayFromAgo(32 * 11 * kMs, &from_ago));
  EXPECT_FALSE(walked(200, 11, 3).wayFromAgo(32 * 11 * kMs + 1, &from_ago));
  EXPECT_FALSE(walked(200, 33, 3).wayFromAgo(501 * kMs, &from_ago)) << "odometry drifts";
}

TEST(RecentSteps, KnowsNothingBeforeAPause) {
  RecentSteps recent = walked(5, 33, 1);
  recent.push({}, 300 * kMs);
  Way from_ago;
  EXPECT_FALSE(recent.wayFromAgo(0, &from_ago));
  EXPECT_FALSE(recent.wayFromAhead(0, &from_ago));
  recent.push({}, 33 * kMs);
  EXPECT_TRUE(recent.wayFromAgo(100 * kMs, &from_ago));
  EXPECT_FALSE(recent.wayFromAgo(133 * kMs, &from_ago));
  recent.clear();
  EXPECT_FALSE(recent.wayFromAgo(0, &from_ago));
}

}  // namespace
}  // namespace sphc
