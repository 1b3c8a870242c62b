#include <gtest/gtest.h>

#include <cmath>

#include "drivers/simulated/bvh.h"
#include "drivers/simulated/headset.h"
#include "drivers/simulated/lens.h"
#include "drivers/simulated/random.h"
#include "drivers/simulated/shape.h"

namespace sphc::simulated {
namespace {

TEST(SimulatedLens, UnprojectInvertsProject) {
  for (uint32_t kind = 0; kind < 8; ++kind) {
    const sphc_rig rig = camerasOf(kind / 2).rig;
    const sphc_camera &camera = kind % 2 == 0 ? rig.color_camera : rig.depth_camera;
    for (double y = 0.5; y < camera.height; y += 20) {
      for (double x = 0.5; x < camera.width; x += 20) {
        const double pixel_px[2] = {x, y};
        double xy[2], back_px[2];
        unproject(camera, pixel_px, xy);
        project(camera, xy[0], xy[1], back_px);
        EXPECT_NEAR(back_px[0], x, 1e-7);
        EXPECT_NEAR(back_px[1], y, 1e-7);
      }
    }
  }
}

TEST(SimulatedLens, TheTofCameraCoversTheColorImage) {
  const sphc_rig rig = camerasOf(SPHC_SIMULATED_CAMERAS_HEADSET).rig;
  const sphc_camera &color = rig.color_camera, &depth = rig.depth_camera;
  const Pose color_from_depth = poseOf(rig.color_from_depth);
  for (const double x : {0.5, 639.5}) {
    for (const double y : {0.5, 479.5}) {
      const double pixel_px[2] = {x, y};
      double xy[2], seen_px[2];
      unproject(color, pixel_px, xy);
      const Vec3d in_color = Vec3d{xy[0], xy[1], 1} * 1.0;
      const Vec3d p = transposed(color_from_depth.rotation) * (in_color - color_from_depth.center);
      project(depth, p.x / p.z, p.y / p.z, seen_px);
      EXPECT_GT(seen_px[0], 0);
      EXPECT_LT(seen_px[0], depth.width);
      EXPECT_GT(seen_px[1], 0);
      EXPECT_LT(seen_px[1], depth.height);
    }
  }
}

TEST(SimulatedPose, QuaternionAndMatrixAgree) {
  Rng rng(3);
  for (int i = 0; i < 100; ++i) {
    double q[4], length = 0;
    for (double &c : q) {
      c = rng.real(-1, 1);
      length += c * c;
    }
    for (double &c : q) c /= std::sqrt(length);
    const Pose pose{matrixOf(q), {1, 2, 3}};
    const sphc_rigid rigid = rigidOf(pose);
    const double sign = q[0] < 0 ? -1 : 1;
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(rigid.q_wxyz[k], sign * q[k], 1e-12);
  }
}

// A point of a face, looked at from outside, is found again: same face, same place.
TEST(SimulatedShape, ContactInvertsFacePoint) {
  Rng rng(5);
  for (const Kind kind : {Kind::kRoom, Kind::kBox, Kind::kCylinder, Kind::kEllipsoid}) {
    Shape shape;
    shape.kind = kind;
    shape.local_from_world = toFloat(transposed(yawRotation(0.7)));
    shape.center = {0.3f, -0.2f, 1.0f};
    shape.half = {1.5f, 1.0f, 0.6f};
    for (int i = 0; i < 200; ++i) {
      const int face = rng.index(faceCount(kind));
      float u = rng.uniform(0.25f, 0.75f);
      const float v = rng.uniform(0.25f, 0.75f);
      Vec3f unit, normal;
      facePoint(shape, face, u, v, &unit, &normal);
      const Vec3f target = worldPoint(shape, unit);
      const Vec3f eye = target + normal * 0.2f;
      const LocalRay ray = localRay(shape, eye, target - eye);
      const float t = intersect(kind, ray, 0.01f, kFar);
      ASSERT_NEAR(t, 1.0f, 1e-3f);
      const Contact seen = contact(kind, ray, t);
      EXPECT_EQ(seen.face, face);
      EXPECT_NEAR(seen.u, u, 1e-3f);
      EXPECT_NEAR(seen.v, v, 1e-3f);
      EXPECT_GT(dot(worldNormal(shape, seen.normal), normal), 0.999f);
    }
  }
}

TEST(SimulatedBvh, AgreesWithEveryShapeAsked) {
  Rng rng(8);
  std::vector<Shape> shapes;
  for (int i = 0; i < 60; ++i) {
    Shape shape;
    shape.kind = static_cast<Kind>(1 + rng.index(3));
    shape.local_from_world = toFloat(transposed(yawRotation(rng.real(0, 6))));
    shape.center = {rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-2, 2)};
    shape.half = {rng.uniform(0.05f, 0.3f), rng.uniform(0.05f, 0.3f), rng.uniform(0.05f, 0.3f)};
    shapes.push_back(shape);
  }
  const Bvh bvh(shapes);
  int blocked = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3f origin{rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-3, 3)};
    const Vec3f way{rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-3, 3)};
    bool any = false;
    for (const Shape &shape : shapes) any |= intersect(shape.kind, localRay(shape, origin, way), 0, 1) < kFar;
    EXPECT_EQ(bvh.blocked(origin, way, 1), any);
    blocked += any ? 1 : 0;
  }
  EXPECT_GT(blocked, 100);
  EXPECT_LT(blocked, 1900);
}

}  // namespace
}  // namespace sphc::simulated
