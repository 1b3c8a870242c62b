#include "host/import/rolling_rows.h"

#include <gtest/gtest.h>

#include "tests/support/scene.h"

namespace sphc::host {
namespace {

constexpr uint32_t kWidth = 640, kHeight = 480;
constexpr int64_t kTimeNs = 1000000000, kRowNs = 40000;
const Vector3 kTurnRadS(0.2, -0.6, 0.1), kShiftMS(0.5, 0.1, -0.3);

// world_from_camera of a camera that turns and goes on, and rolls past where it is at kTimeNs.
Rigid poseAt(int64_t time_ns) {
  const double since_s = 1e-9 * static_cast<double>(time_ns - kTimeNs);
  return {rotationFromVector(since_s * kTurnRadS), since_s * kShiftMS};
}

class RollingRowsTest : public testing::Test {
 protected:
  // Where the image shows a point of the world: in the row that is exposed when the point lies there, in the frame
  // of the camera then.
  Vector2 seen(const Vector3 &point_in_world_m, Vector3 *point_m) const {
    Vector2 pixel_px(0, 0.5 * kHeight);
    for (int i = 0; i < 20; ++i) {
      const double rows = pixel_px.y() - 0.5 * kHeight;
      *point_m = poseAt(kTimeNs + static_cast<int64_t>(rows * kRowNs)).inverse() * point_in_world_m;
      EXPECT_TRUE(camera_.project(*point_m, &pixel_px));
    }
    return pixel_px;
  }
  // From where the image of the middle row's time would show it, before and after.
  struct Errors {
    double before_px, after_px;
  };
  Errors errorsOf(const Vector3 &point_in_world_m) const {
    Vector3 point_m;
    const Vector2 shown_px = seen(point_in_world_m, &point_m);
    Vector2 pixel_px = shown_px, middle_px;
    EXPECT_TRUE(rows_.toMiddle(point_m, &pixel_px));
    EXPECT_TRUE(camera_.project(point_in_world_m, &middle_px));
    return {(shown_px - middle_px).norm(), (pixel_px - middle_px).norm()};
  }

  Camera camera_ = Camera(test::pinhole(kWidth, kHeight, 500));
  RollingRows rows_ = RollingRows(camera_, kRowNs);
};

const Vector3 kTop(0.3, -0.8, 2), kBottom(-0.9, 0.85, 2.2);

TEST_F(RollingRowsTest, PixelsGoToWhereTheMiddleRowWouldShowThem) {
  ASSERT_TRUE(
      rows_.begin(kTimeNs, rigidToC(poseAt(kTimeNs)), [](int64_t time_ns) { return rigidToC(poseAt(time_ns)); }));
  for (const Vector3 &point_m : {kTop, kBottom}) {
    EXPECT_GT(errorsOf(point_m).before_px, 1);
    EXPECT_LT(errorsOf(point_m).after_px, 0.05);
  }
}

TEST_F(RollingRowsTest, PosesBeforeOrAfterTheFrameSuffice) {
  for (const bool before : {true, false}) {
    ASSERT_TRUE(
        rows_.begin(kTimeNs, rigidToC(poseAt(kTimeNs)), [before](int64_t time_ns) -> std::optional<sphc_rigid> {
          if ((time_ns < kTimeNs) != before) return std::nullopt;
          return rigidToC(poseAt(time_ns));
        }));
    EXPECT_LT(errorsOf(kTop).after_px, 0.05) << before;
    EXPECT_LT(errorsOf(kBottom).after_px, 0.05) << before;
  }
}

TEST_F(RollingRowsTest, WithoutPosesRowsStay) {
  EXPECT_FALSE(rows_.begin(kTimeNs, rigidToC(poseAt(kTimeNs)), [](int64_t) { return std::nullopt; }));
  EXPECT_EQ(errorsOf(kTop).after_px, errorsOf(kTop).before_px);
}

TEST_F(RollingRowsTest, APixelThatLeavesTheImageIsRefused) {
  constexpr double kToTheRightMS = 10;
  ASSERT_TRUE(rows_.begin(kTimeNs, rigidToC(poseAt(kTimeNs)), [](int64_t time_ns) {
    return rigidToC(
        {Matrix3::Identity(), Vector3(kToTheRightMS * 1e-9 * static_cast<double>(time_ns - kTimeNs), 0, 0)});
  }));
  const Vector2 right_px(638, 2), left_px(2, 2);  // the camera has yet to go to the right by a tenth of a metre
  Vector2 pixel_px = right_px, ray;
  ASSERT_TRUE(camera_.unproject(right_px, &ray));
  EXPECT_TRUE(rows_.toMiddle(2 * Vector3(ray.x(), ray.y(), 1), &pixel_px));
  EXPECT_LT(pixel_px.x(), 620);
  pixel_px = left_px;
  ASSERT_TRUE(camera_.unproject(left_px, &ray));
  EXPECT_FALSE(rows_.toMiddle(2 * Vector3(ray.x(), ray.y(), 1), &pixel_px));
  EXPECT_EQ(pixel_px, left_px);
}

}  // namespace
}  // namespace sphc::host
