#include "host/import/fixed_in_image.h"

#include <gtest/gtest.h>

#include "tests/support/random_numbers.h"
#include "tests/support/scene.h"

namespace sphc::host {
namespace {

// Points that stand still, and such that are drawn over the lower right of each image of a camera that walks.
class FixedInImageTest : public testing::Test {
 protected:
  static constexpr int kStill = 300, kDrawn = 12, kFrames = 5;
  static constexpr double kDrawnFromPx = 200;

  FixedInImageTest() : random_(1), camera_(test::pinhole(320, 240, 250)) {
    for (int i = 0; i < kStill; ++i)
      still_.push_back({{test::uniformIn(&random_, -3, 3), test::uniformIn(&random_, -1.5, 1.5),
                         test::uniformIn(&random_, 2, 4)},
                        test::randomDescriptor(&random_)});
    for (int i = 0; i < kDrawn; ++i)
      drawn_.push_back({{kDrawnFromPx + 9 * i, kDrawnFromPx, 3}, test::randomDescriptor(&random_)});
  }

  // The point of each observation, as it would be if no other frame saw it.
  void walk(double step_m, int drawn, FixedInImage *fixed) {
    fixed->begin(camera_);
    for (int frame = 0; frame < kFrames; ++frame) {
      const Rigid world_from_camera = {Matrix3::Identity(), Vector3(step_m * frame, 0, 0)};
      std::vector<Observation> seen;
      for (const Thing &thing : still_)
        see(world_from_camera, world_from_camera.inverse() * thing.place, thing, &seen);
      for (int i = 0; i < drawn; ++i) {
        const Vector3 at = drawn_[i].place;
        Vector2 ray;
        ASSERT_TRUE(camera_.unproject(at.head<2>(), &ray));
        see(world_from_camera, at.z() * Vector3(ray.x(), ray.y(), 1), drawn_[i], &seen);
      }
      fixed->add(world_from_camera.inverse(), &seen);
      for (const Observation &o : seen) points_.push_back({{}, {o.camera_m}, {o.spot}, 0});
      drawn_seen_ += drawn;
    }
  }

  std::vector<TrackedPoint> points_;
  int drawn_seen_ = 0;

 private:
  struct Thing {
    Vector3 place;
    Descriptor descriptor;
  };
  void see(const Rigid &world_from_camera, const Vector3 &point_m, const Thing &thing,
           std::vector<Observation> *seen) const {
    Observation o = {};
    const bool is_seen = camera_.project(point_m, &o.pixel_px) && o.pixel_px.x() >= 0 && o.pixel_px.y() >= 0 &&
                         o.pixel_px.x() < camera_.width() && o.pixel_px.y() < camera_.height();
    if (!is_seen) return;
    o.image_px = o.pixel_px;
    o.position_m = world_from_camera * point_m;
    o.camera_m = world_from_camera.translation_m;
    o.depth_m = point_m.z();
    o.descriptor = thing.descriptor;
    seen->push_back(o);
  }

  Random random_;
  Camera camera_;
  std::vector<Thing> still_, drawn_;
};

TEST_F(FixedInImageTest, WhatStaysWhileTheCameraWalksIsDropped) {
  FixedInImage fixed;
  walk(0.2, kDrawn, &fixed);
  const auto all = static_cast<int>(points_.size());
  const auto dropped = static_cast<int>(fixed.dropFrom(&points_));
  EXPECT_EQ(static_cast<int>(points_.size()), all - dropped);
  EXPECT_GE(dropped, drawn_seen_);
  EXPECT_LT(dropped, drawn_seen_ + 0.1 * (all - drawn_seen_)) << "and little of what lies beside it";
}

TEST_F(FixedInImageTest, WhatStandsStillStays) {
  FixedInImage fixed;
  walk(0.2, 0, &fixed);
  EXPECT_EQ(fixed.dropFrom(&points_), 0u);
}

TEST_F(FixedInImageTest, OfACameraThatRestsNothingIsTold) {
  FixedInImage fixed;
  walk(0, kDrawn, &fixed);
  EXPECT_EQ(fixed.dropFrom(&points_), 0u);
}

TEST_F(FixedInImageTest, TheNextRecordingBeginsAnew) {
  FixedInImage fixed;
  for (int recording = 0; recording < 3; ++recording) walk(0, kDrawn, &fixed);
  EXPECT_EQ(fixed.dropFrom(&points_), 0u);
  walk(0.2, kDrawn, &fixed);
  const auto dropped = static_cast<int>(fixed.dropFrom(&points_));
  EXPECT_GE(dropped, kFrames * kDrawn);
  EXPECT_LT(dropped, 2 * kFrames * kDrawn) << "the others may have shown it once";
}

}  // namespace
}  // namespace sphc::host
