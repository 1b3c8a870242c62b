#include "host/mapping/calibration_change.h"

#include <gtest/gtest.h>

#include "runtime/geometry/camera.h"
#include "runtime/geometry/rigid.h"
#include "spotted_images.h"

namespace sphc::host {
namespace {

CalibrationChange someChange() {
  CalibrationChange change;
  change.lens << 0.01, -0.004, 0.006;
  change.mount << 0.003, -0.002, 0.004, 0.005, -0.006;
  return change;
}

sphc_rig apart() {
  sphc_rig rig = spottedRig();
  rig.color_from_depth.t_m[0] = 0.03;
  return rig;
}

TEST(CalibrationChangeTest, PixelsOfTheChangedCameraAreTheAssumedRaysOfTheOther) {
  const Camera before(apart().color_camera), after(changedBy(someChange(), apart()).color_camera);
  for (const Vector2 &ray : {Vector2(0.2, -0.1), Vector2(-0.15, 0.12), Vector2(0, 0)}) {
    Vector2 pixel_px, assumed;
    ASSERT_TRUE(after.project(Vector3(ray.x(), ray.y(), 1), &pixel_px));
    ASSERT_TRUE(before.unproject(pixel_px, &assumed));
    EXPECT_LT((assumed - assumedRay(ray, someChange().lens.data())).norm(), 1e-9);
  }
}

// As of a telephone: depth of a quarter of the size.
TEST(CalibrationChangeTest, SmallerDepthKeepsLyingOnTheImage) {
  sphc_rig rig = spottedRig();
  rig.depth_camera.width /= 4;
  rig.depth_camera.height /= 4;
  for (int i = 0; i < 4; ++i) rig.depth_camera.params[i] /= 4;
  EXPECT_TRUE(haveSameRays(rig));
  const sphc_rig changed = changedBy(someChange(), rig);
  EXPECT_TRUE(haveSameRays(changed));
  EXPECT_NEAR(changed.depth_camera.params[0], 1.01 * rig.depth_camera.params[0], 1e-9);
  rig.depth_camera.params[2] += 0.5;
  EXPECT_FALSE(haveSameRays(rig));
}

TEST(CalibrationChangeTest, RegisteredDepthKeepsLyingOnTheImage) {
  EXPECT_TRUE(haveSameRays(spottedRig()));
  EXPECT_TRUE(haveSameRays(changedBy(someChange(), spottedRig())));
  EXPECT_FALSE(haveSameRays(apart()));
}

// A plane that moves with the depth sensor meets the ray where the derivatives say.
TEST(CalibrationChangeTest, DepthsFollowTheSensorAsTheirDerivativesSay) {
  const Vector3 normal = Vector3(0.4, -0.2, -1).normalized();
  const Vector3 on_plane_m(0.1, 0.2, 2);
  SeenPoint seen;
  seen.ray = {0.15, -0.1};
  const Vector3 along(seen.ray.x(), seen.ray.y(), 1);
  seen.depth_m = normal.dot(on_plane_m) / normal.dot(along);
  seen.depth_by_move = normal / normal.dot(along);
  const sphc_rig changed = changedBy(someChange(), apart());
  const Rigid move = rigidFromC(changed.color_from_depth) * rigidFromC(apart().color_from_depth).inverse();
  const Vector3 moved_normal = move.rotation * normal;
  const double moved_m = moved_normal.dot(move * on_plane_m) / moved_normal.dot(along);
  EXPECT_NEAR(depthByMount(seen).dot(someChange().mount), moved_m - seen.depth_m, 2e-4);
  EXPECT_GT(std::abs(moved_m - seen.depth_m), 2e-3);
}

}  // namespace
}  // namespace sphc::host
