#include "runtime/stages/align/sparse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/support/arena_memory.h"
#include "tests/support/random_numbers.h"
#include "tests/support/scene.h"
#include "tests/unit/runtime/stages/align/plane.h"

namespace sphc {
namespace {

const DepthSensor kSparseSensor = {0.001, 0.2, 6, 0.002, 0.001};

struct SparseRig {
  Camera color{test::pinhole(640, 480, 500)};
  Camera depth{test::pinhole(320, 288, 220)};
  Rigid color_from_depth{rotationFromVector(Vector3(0.01, -0.03, 0.005)), Vector3(0.06, -0.01, 0.004)};
  std::vector<uint16_t> mm = std::vector<uint16_t>(320 * 288);

  // `surface`: depth along a ray (x, y, 1) of the depth camera.
  void measure(const std::function<double(const Vector2 &ray)> &surface) {
    for (int y = 0; y < 288; ++y)
      for (int x = 0; x < 320; ++x) {
        Vector2 ray;
        depth.unproject({x + 0.5, y + 0.5}, &ray);
        mm[static_cast<size_t>(y * 320 + x)] = static_cast<uint16_t>(std::lround(1000 * surface(ray)));
      }
  }
  bool lift(const Vector2 &pixel, Vector3 *point, double *sigma) const {
    const SparseAligner aligner(color, depth, color_from_depth, kSparseSensor);
    return aligner.lift({mm.data(), 320, 288, 320}, pixel, point, sigma);
  }
};

TEST(Sparse, PlaneSeenByTwoCameras) {
  const Vector3 normals[] = {{0, 0, 1}, {0.3, -0.1, 1}, {-0.2, 0.4, 1}};
  for (const Vector3 &n : normals) {
    SparseRig rig;
    rig.measure(test::plane(n, 2.0));
    int lifted = 0, asked = 0;
    for (double y = 20; y < 470; y += 37)
      for (double x = 20; x < 630; x += 41) {
        ++asked;
        Vector3 point;
        double sigma = 0;
        if (!rig.lift({x, y}, &point, &sigma)) continue;
        ++lifted;
        // it is on the plane and on the pixel's ray
        EXPECT_NEAR(n.dot(rig.color_from_depth.inverse() * point), 2, 0.006) << x << " " << y;
        Vector2 back;
        ASSERT_TRUE(rig.color.project(point, &back));
        EXPECT_LT((back - Vector2(x, y)).norm(), 1e-6);
        EXPECT_GT(sigma, 0.002);
        EXPECT_LT(sigma, 0.05);
      }
    EXPECT_GT(lifted, 0.9 * asked);
  }
}

TEST(Sparse, HolesAreRefused) {
  SparseRig rig;
  rig.measure([](const Vector2 &) { return 0.0; });
  Vector3 point(7, 7, 7);
  double sigma = 7;
  EXPECT_FALSE(rig.lift({320, 240}, &point, &sigma));
  EXPECT_EQ(point, Vector3(7, 7, 7));
  EXPECT_EQ(sigma, 7);
}

TEST(Sparse, OutsideTheDepthCamerasViewIsRefused) {
  SparseRig rig;
  rig.color_from_depth = {rotationFromVector(Vector3(0, 1.2, 0)), Vector3(0.05, 0, 0)};
  rig.measure(test::plane({0, 0, 1}, 2));
  Vector3 point;
  double sigma;
  int lifted = 0;
  for (double x = 400; x < 640; x += 10) lifted += rig.lift({640 - x, 240}, &point, &sigma);
  EXPECT_EQ(lifted, 0);
}

// A near bar before a wall.  What colour sees of the wall close to the bar's edge, the depth camera may not see:
// such a keypoint gets no depth or a right one, never one in between.
TEST(Sparse, OcclusionEdgeGivesNothingInBetween) {
  SparseRig rig;
  rig.color_from_depth = {Matrix3::Identity(), Vector3(0.1, 0, 0)};
  const double bar_m = 1, wall_m = 3, low = -0.15, high = 0.15;  // x of the bar in the depth frame
  rig.measure([&](const Vector2 &ray) { return ray.x() * bar_m > low && ray.x() * bar_m < high ? bar_m : wall_m; });
  int refused = 0, between = 0, on_bar = 0, on_wall = 0;
  for (double x = 60; x < 600; x += 1.5) {
    Vector2 ray;
    ASSERT_TRUE(rig.color.unproject({x, 240}, &ray));
    const double at_bar = ray.x() * bar_m - 0.1;  // x in the depth frame
    const double true_z = at_bar > low && at_bar < high ? bar_m : wall_m;
    Vector3 point;
    double sigma;
    if (!rig.lift({x, 240}, &point, &sigma)) {
      ++refused;
      continue;
    }
    (true_z < 2 ? on_bar : on_wall) += 1;
    const bool near_edge = std::min(std::abs(at_bar - low), std::abs(at_bar - high)) < 0.015;
    if (std::abs(point.z() - true_z) > 0.03 * true_z && !near_edge) ++between;
  }
  EXPECT_EQ(between, 0);
  EXPECT_GT(refused, 5);  // the shadow of the bar
  EXPECT_GT(on_bar, 50);
  EXPECT_GT(on_wall, 100);
}

TEST(Sparse, RegisteredImagesAreReadAtThePixel) {
  SparseRig rig;
  rig.color = rig.depth;
  rig.color_from_depth = Rigid();
  rig.measure(test::plane({0.2, 0.1, 1}, 1.5));
  for (double x = 10; x < 310; x += 13.7) {
    Vector3 point;
    double sigma;
    ASSERT_TRUE(rig.lift({x, 100.2}, &point, &sigma));
    EXPECT_NEAR(Vector3(0.2, 0.1, 1).dot(point), 1.5, 0.004);
  }
}

// Two cameras are one only with the same lens, at the same place, looking the same way.
TEST(Sparse, CamerasThatDifferInOneThingAreTwo) {
  const auto expectOnPlane = [](const SparseRig &rig) {
    const Vector3 n(0.2, 0.1, 1);
    for (double x = 60; x < 260; x += 13.7) {
      Vector3 point;
      double sigma;
      ASSERT_TRUE(rig.lift({x, 100.2}, &point, &sigma)) << x;
      EXPECT_NEAR(n.dot(rig.color_from_depth.inverse() * point), 1.5, 0.004) << x;
    }
  };
  SparseRig lens, turned, moved;
  for (SparseRig *rig : {&lens, &turned, &moved}) {
    rig->color = rig->depth;
    rig->color_from_depth = Rigid();
    rig->measure(test::plane({0.2, 0.1, 1}, 1.5));
  }
  lens.color = Camera(test::pinhole(320, 288, 300));
  turned.color_from_depth.rotation = rotationFromVector(Vector3(0, 0.08, 0));
  moved.color_from_depth.translation_m = Vector3(0.15, 0, 0);
  expectOnPlane(lens);
  expectOnPlane(turned);
  expectOnPlane(moved);
}

// Images may lie in larger ones: what is beside them is none of theirs, wherever a ray comes from.
TEST(Sparse, WhatLiesBesideTheImageIsNotLookedAt) {
  constexpr int kMargin = 80, kStride = 320 + 2 * kMargin;
  SparseRig rig;
  rig.measure(test::plane({0.2, 0.1, 1}, 2));
  std::vector<uint16_t> near(size_t{kStride} * (288 + 2 * kMargin), 700), empty(near.size(), 0);
  const auto viewIn = [&](std::vector<uint16_t> *larger) {
    uint16_t *first = larger->data() + kMargin * kStride + kMargin;
    for (int y = 0; y < 288; ++y) std::copy_n(rig.mm.begin() + y * 320, 320, first + y * kStride);
    return ImageView<uint16_t>{first, 320, 288, kStride};
  };
  const ImageView<uint16_t> beside_near = viewIn(&near), beside_nothing = viewIn(&empty);
  const Camera wide(test::pinhole(640, 480, 280));
  for (const Vector3 &shift_m :
       {Vector3(0.06, 0, 0), Vector3(-0.06, 0, 0), Vector3(0, 0.06, 0), Vector3(0, -0.06, 0)}) {
    const SparseAligner aligner(wide, rig.depth, {Matrix3::Identity(), shift_m}, kSparseSensor);
    int lifted = 0;
    for (int y = 0; y < 480; y += 5)
      for (int x = 0; x < 640; x += 5) {
        Vector3 a = Vector3::Zero(), b = Vector3::Zero();
        double sigma_a = 0, sigma_b = 0;
        lifted += aligner.lift(beside_nothing, {x + 0.5, y + 0.5}, &a, &sigma_a);
        aligner.lift(beside_near, {x + 0.5, y + 0.5}, &b, &sigma_b);
        EXPECT_EQ(a, b) << shift_m.transpose() << ": " << x << " " << y;
      }
    EXPECT_GT(lifted, 4000);
  }
}

// Along the colour ray an error of depth is longer where the depth camera looks another way.
TEST(Sparse, SigmaIsOfTheColourCamerasDepth) {
  SparseRig rig;
  rig.color_from_depth = {rotationFromVector(Vector3(0, 0.4, 0)), Vector3(0, 0, 0)};
  rig.measure(test::plane({0, 0, 1}, 2));
  for (const double x : {400.0, 480.0, 560.0}) {
    Vector3 point;
    double sigma;
    ASSERT_TRUE(rig.lift({x, 240}, &point, &sigma)) << x;
    const double depth_of_1m = (rig.color_from_depth.inverse() * Vector3(point / point.z())).z();
    EXPECT_NEAR(sigma, kSparseSensor.sigmaAt(2) / depth_of_1m, 1e-6) << x;
  }
}

// Strides over what is known to be far do not change an answer.
TEST(Sparse, MemoryDoesNotChangeAnswers) {
  SparseRig rig;
  Random random(3);
  rig.measure([&](const Vector2 &ray) {
    const double wall = 3 + 0.4 * ray.x() + 0.1 * std::sin(20 * ray.y());
    const bool bar = std::abs(std::fmod(ray.x() + 5, 0.35)) < 0.08, hole = random.below(9) == 0;
    return hole ? 0.0 : bar ? 0.9 + 0.3 * ray.y() : wall;
  });
  const ImageView<uint16_t> view = {rig.mm.data(), 320, 288, 320};
  const SparseAligner plain(rig.color, rig.depth, rig.color_from_depth, kSparseSensor);
  SparseAligner prepared;
  const test::ArenaMemory memory([&](Arena &arena, bool has_memory) {
    SparseAligner::layout(320, 288, arena, has_memory ? &prepared : nullptr);
  });
  prepared.init(kSparseSensor);
  prepared.setCameras(rig.color, rig.depth, rig.color_from_depth);
  prepared.prepare(view);
  int lifted = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector2 pixel(0.01 * random.below(64000), 0.01 * random.below(48000));
    Vector3 a(0, 0, 0), b(0, 0, 0);
    double sigma_a = 0, sigma_b = 0;
    lifted += plain.lift(view, pixel, &a, &sigma_a);
    prepared.lift(view, pixel, &b, &sigma_b);
    EXPECT_EQ(a, b) << pixel.transpose();
    EXPECT_EQ(sigma_a, sigma_b);
  }
  EXPECT_GT(lifted, 1000);
}

TEST(Sparse, NonsensePixels) {
  SparseRig rig;
  rig.measure(test::plane({0, 0, 1}, 2));
  Vector3 point;
  double sigma;
  for (const Vector2 &pixel : {Vector2(-1e9, 0), Vector2(NAN, 3), Vector2(1e300, 1e300), Vector2(-300, 240)})
    EXPECT_FALSE(rig.lift(pixel, &point, &sigma));
}

}  // namespace
}  // namespace sphc
