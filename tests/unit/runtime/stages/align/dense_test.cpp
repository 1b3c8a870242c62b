#include "runtime/stages/align/dense.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "tests/support/arena_memory.h"
#include "tests/support/random_numbers.h"
#include "tests/support/scene.h"
#include "tests/unit/runtime/stages/align/plane.h"

namespace sphc {
namespace {

sphc_camera distorted(sphc_camera camera, sphc_camera_model model, const std::vector<double> &k) {
  camera.model = model;
  camera.param_count = static_cast<uint32_t>(4 + k.size());
  std::copy(k.begin(), k.end(), camera.params + 4);
  return camera;
}

// A colour camera beside a depth camera, and what the depth camera sees.
struct DenseRig {
  DenseConfig config;
  std::vector<uint16_t> raw;
  std::unique_ptr<test::ArenaMemory> memory;
  DenseAligner aligner;
  std::vector<uint16_t> depth;
  std::vector<uint8_t> mask, confidence;

  DenseRig(const sphc_camera &color, const sphc_camera &depth_camera, const Rigid &color_from_depth) {
    config.color = Camera(color);
    config.depth = Camera(depth_camera);
    config.color_from_depth = color_from_depth;
    config.sensor = {0.001, 0.2, 6, 0.002, 0.001};
    raw.resize(static_cast<size_t>(config.depth.width() * config.depth.height()));
  }

  // `surface`: depth along a ray (x, y, 1) of the depth camera, m; 0: none.
  void measure(const std::function<double(const Vector2 &ray)> &surface) {
    for (int y = 0; y < config.depth.height(); ++y)
      for (int x = 0; x < config.depth.width(); ++x) {
        Vector2 ray;
        const bool seen = config.depth.unproject({x + 0.5, y + 0.5}, &ray);
        raw[static_cast<size_t>(y * config.depth.width() + x)] =
            seen ? static_cast<uint16_t>(std::lround(1000 * surface(ray))) : uint16_t{0};
      }
  }
  void align(const AlignKernels &kernels = simdAlignKernels()) {
    memory = std::make_unique<test::ArenaMemory>([&](Arena &arena, bool has_memory) {
      DenseAligner::layout(config, arena, has_memory ? &aligner : nullptr);
    });
    aligner.init(config, kernels);
    const size_t pixels = static_cast<size_t>(config.color.width() * config.color.height());
    depth.assign(pixels, 7);
    mask.assign(pixels, 7);
    confidence.assign(pixels, 7);
    process();
  }
  // One image more, by the same aligner.
  void process() {
    const int32_t width = config.depth.width();
    aligner.process({raw.data(), width, config.depth.height(), width},
                    {depth.data(), mask.data(), confidence.data(), config.color.width(), config.color.width(),
                     config.color.width()});
  }
  size_t at(int x, int y) const { return static_cast<size_t>(y * config.color.width() + x); }
  int count(int kind) const { return static_cast<int>(std::count(mask.begin(), mask.end(), kind)); }
};

const Rigid kBeside{rotationFromVector(Vector3(0.01, -0.03, 0.005)), Vector3(0.06, -0.01, 0.004)};

struct Pair {
  const char *name;
  sphc_camera color, depth;
};
std::vector<Pair> cameraPairs() {
  const sphc_camera color = test::pinhole(160, 120, 125), fine = test::pinhole(160, 120, 120);
  const sphc_camera coarse = test::pinhole(80, 72, 55);
  return {{"pinhole, as dense", color, fine},
          {"pinhole, coarser", color, coarse},
          {"Brown 5", distorted(color, SPHC_CAMERA_BROWN5, {0.08, -0.05, 0.001, -0.002, 0.01}),
           distorted(coarse, SPHC_CAMERA_BROWN5, {-0.1, 0.04, 0.002, 0.001, 0})},
          {"Brown 8", distorted(color, SPHC_CAMERA_BROWN8, {0.3, 0.1, 0.001, -0.002, 0.01, 0.25, 0.1, 0.01}),
           distorted(fine, SPHC_CAMERA_BROWN8, {0.2, 0.1, 0, 0, 0.01, 0.3, 0.05, 0})},
          {"Kannala-Brandt 4", distorted(color, SPHC_CAMERA_KANNALA_BRANDT4, {-0.02, 0.01, -0.005, 0.001}),
           distorted(coarse, SPHC_CAMERA_KANNALA_BRANDT4, {0.03, -0.02, 0.01, -0.002})}};
}

TEST(Dense, APlaneStaysOneUnderEveryCameraModel) {
  const Vector3 n(0.3, -0.15, 1);
  for (const Pair &pair : cameraPairs()) {
    SCOPED_TRACE(pair.name);
    DenseRig rig(pair.color, pair.depth, kBeside);
    rig.measure(test::plane(n, 2));
    rig.align();
    int covered = 0, checked = 0;
    for (int y = 20; y < 100; ++y) {
      for (int x = 30; x < 130; ++x) {
        ++checked;
        const uint8_t kind = rig.mask[rig.at(x, y)];
        if (kind != SPHC_ALIGNED_MEASURED && kind != SPHC_ALIGNED_FILLED) continue;
        ++covered;
        Vector2 ray;
        ASSERT_TRUE(rig.config.color.unproject({x + 0.5, y + 0.5}, &ray));
        const double z = 0.001 * rig.depth[rig.at(x, y)];
        const Vector3 in_depth = kBeside.inverse() * Vector3(z * ray.x(), z * ray.y(), z);
        EXPECT_NEAR(n.dot(in_depth), 2, 0.02) << x << " " << y;  // half a depth pixel of slope
      }
    }
    EXPECT_GT(covered, 0.995 * checked);  // no cracks
    EXPECT_EQ(rig.count(SPHC_ALIGNED_OCCLUDED), 0);
  }
}

TEST(Dense, TheScalarVersionGivesTheSameBytes) {
  Random random(5);
  for (const Pair &pair : cameraPairs()) {
    SCOPED_TRACE(pair.name);
    DenseRig rig(pair.color, pair.depth, kBeside);
    for (uint16_t &mm : rig.raw)  // two surfaces, holes, and rubbish
      mm = static_cast<uint16_t>(random.below(20) == 0  ? random.below(65536)
                                 : random.below(8) == 0 ? 0
                                 : random.below(3) == 0 ? 900 + random.below(9)
                                                        : 2500 + random.below(90));
    rig.align(simdAlignKernels());
    const auto depth = rig.depth;
    const auto mask = rig.mask, confidence = rig.confidence;
    EXPECT_GT(rig.count(SPHC_ALIGNED_MEASURED), 1000);
    rig.align(scalarAlignKernels());
    EXPECT_EQ(rig.depth, depth);
    EXPECT_EQ(rig.mask, mask);
    EXPECT_EQ(rig.confidence, confidence);
  }
}

// A near bar before a wall, the colour camera to the right: to the right of the bar it sees wall that the depth
// camera cannot see.
TEST(Dense, WhatSomethingNearHidesIsOccluded) {
  for (const Pair &pair : {cameraPairs()[0], cameraPairs()[1]}) {
    SCOPED_TRACE(pair.name);
    const double bar_m = 1, wall_m = 3, half_m = 0.15;
    DenseRig rig(pair.color, pair.depth, Rigid{Matrix3::Identity(), Vector3(-0.1, 0, 0)});
    rig.measure([&](const Vector2 &ray) { return std::abs(ray.x() * bar_m) < half_m ? bar_m : wall_m; });
    rig.align();
    // Edges of the bar, and where the wall that grazes its right edge is seen.
    const double f = pair.color.params[0], c = pair.color.params[2];
    const double bar_right = c + f * (half_m - 0.1) / bar_m,
                 wall_from = c + f * (half_m * wall_m / bar_m - 0.1) / wall_m;
    const double bar_left = c + f * (-half_m - 0.1) / bar_m;
    ASSERT_GT(wall_from - bar_right, 6);
    for (int y = 20; y < 100; ++y) {
      for (int x = static_cast<int>(bar_left) + 3; x < 130; ++x) {
        const double centre = x + 0.5;
        if (std::abs(centre - bar_right) < 2 || std::abs(centre - wall_from) < 2.5)
          continue;  // within a depth pixel
        const uint8_t kind = rig.mask[rig.at(x, y)];
        const int depth_mm = rig.depth[rig.at(x, y)];
        if (centre < bar_right) {
          EXPECT_NEAR(depth_mm, 1000, 1) << x << " " << y;
        } else if (centre < wall_from) {
          EXPECT_EQ(kind, SPHC_ALIGNED_OCCLUDED) << x << " " << y;
          EXPECT_EQ(depth_mm, 0);
          EXPECT_EQ(rig.confidence[rig.at(x, y)], 0);
        } else {
          EXPECT_NEAR(depth_mm, 3000, 1) << x << " " << y;
        }
      }
    }
  }
}

TEST(Dense, NoMeasurementNoDepth) {
  DenseRig rig(test::pinhole(64, 48, 50), test::pinhole(64, 48, 50), kBeside);
  rig.measure([](const Vector2 &) { return 0.0; });
  rig.align();
  EXPECT_EQ(rig.count(SPHC_ALIGNED_HOLE), 64 * 48);
  EXPECT_EQ(*std::max_element(rig.depth.begin(), rig.depth.end()), 0);
  EXPECT_EQ(*std::max_element(rig.confidence.begin(), rig.confidence.end()), 0);
  rig.measure([](const Vector2 &) { return 6.5; });  // out of range
  rig.align();
  EXPECT_EQ(rig.count(SPHC_ALIGNED_HOLE), 64 * 48);
}

TEST(Dense, RegisteredImagesComeBackAsTheyWere) {
  const sphc_camera camera = test::pinhole(64, 48, 50);
  DenseRig rig(camera, camera, Rigid());
  rig.measure(test::plane({0.1, 0.2, 1}, 1.5));
  rig.align();
  EXPECT_EQ(rig.depth, rig.raw);
  EXPECT_EQ(rig.count(SPHC_ALIGNED_MEASURED), 64 * 48);
}

TEST(Dense, WidthsThatAreNoWholeVectors) {
  const sphc_camera camera = test::pinhole(75, 48, 50);
  DenseRig rig(camera, camera, Rigid());
  rig.measure(test::plane({0.1, 0.2, 1}, 1.5));
  rig.align();
  EXPECT_EQ(rig.depth, rig.raw);
  EXPECT_EQ(rig.count(SPHC_ALIGNED_MEASURED), 75 * 48);
  for (int y = 0; y < 48; ++y)
    for (int x = 64; x < 75; ++x) EXPECT_NE(rig.confidence[rig.at(x, y)], 7) << x << " " << y;
}

// Nothing is left of the image before.
TEST(Dense, EachImageStandsAlone) {
  for (const Pair &pair : cameraPairs()) {
    SCOPED_TRACE(pair.name);
    DenseRig rig(pair.color, pair.depth, kBeside), fresh(pair.color, pair.depth, kBeside);
    rig.measure([](const Vector2 &ray) { return ray.norm() < 0.3 ? 0.8 : 1.5; });
    rig.align();
    for (DenseRig *of : {&rig, &fresh}) of->measure([](const Vector2 &ray) { return ray.y() < 0.1 ? 3.0 : 0.0; });
    fresh.align();
    rig.process();
    EXPECT_EQ(rig.depth, fresh.depth);
    EXPECT_EQ(rig.mask, fresh.mask);
    EXPECT_EQ(rig.confidence, fresh.confidence);
  }
}

// A square of 30 cm, 1 m away, 2 m before a wall; the colour camera 10 cm beside the depth camera.
TEST(Dense, OnTheColourCamerasSideTheWallIsOccluded) {
  const Pair pair = cameraPairs()[0];
  const double f = pair.color.params[0];
  for (const Vector2 &side : {Vector2(1, 0), Vector2(-1, 0), Vector2(0, 1), Vector2(0, -1)}) {
    DenseRig rig(pair.color, pair.depth, Rigid{Matrix3::Identity(), Vector3(-0.1 * side.x(), -0.1 * side.y(), 0)});
    rig.measure([](const Vector2 &ray) { return ray.cwiseAbs().maxCoeff() < 0.15 ? 1.0 : 3.0; });
    rig.align();
    const auto at = [&](double along) {  // in the colour image, towards the camera's side
      return rig.at(static_cast<int>(80 + along * f * side.x()), static_cast<int>(60 + along * f * side.y()));
    };
    EXPECT_NEAR(rig.depth[at(0)], 1000, 1) << side.transpose();
    EXPECT_EQ(rig.mask[at((0.05 + 0.15 - 0.1 / 3) / 2)], SPHC_ALIGNED_OCCLUDED) << side.transpose();
    EXPECT_NEAR(rig.depth[at(0.15)], 3000, 1) << side.transpose();
    EXPECT_NEAR(rig.depth[at(-0.29)], 3000, 1) << side.transpose();
  }
}

TEST(Dense, TheChosenUnit) {
  const sphc_camera camera = test::pinhole(64, 48, 50);
  DenseRig rig(camera, camera, Rigid());
  rig.config.out_unit_m = 0.0005;
  rig.measure(test::plane({0, 0, 1}, 1.5));
  rig.align();
  EXPECT_EQ(rig.depth[rig.at(30, 20)], 3000);
}

// 255 / (1 + (e / 0.01)^2) with e the relative error of the sensor, on a frontal plane.
TEST(Dense, ConfidenceIsTheDocumentedFunctionOfTheError) {
  const sphc_camera camera = test::pinhole(64, 48, 50);
  DenseRig rig(camera, camera, Rigid());
  for (double z : {0.5, 1.0, 2.0, 4.0}) {
    rig.measure(test::plane({0, 0, 1}, z));
    rig.align();
    const double e = rig.config.sensor.sigmaAt(z) / z;
    EXPECT_NEAR(rig.confidence[rig.at(30, 20)], 255 / (1 + e * e / 1e-4), 1) << z;
  }
}

TEST(Dense, ConfidenceFallsAtEdgesAndOnSlopes) {
  const sphc_camera camera = test::pinhole(64, 48, 50);
  DenseRig rig(camera, camera, Rigid());
  rig.measure([](const Vector2 &ray) { return ray.x() < 0 ? 1.0 : 2.0; });
  rig.align();
  EXPECT_LT(rig.confidence[rig.at(31, 20)], rig.confidence[rig.at(20, 20)] / 2);
  rig.measure(test::plane({0, 0, 1}, 1));
  rig.align();
  const int frontal = rig.confidence[rig.at(32, 24)];
  rig.measure(test::plane({0.9, 0, 1}, 1));
  rig.align();
  EXPECT_LT(rig.confidence[rig.at(32, 24)], frontal - 20);
}

TEST(Dense, TheNearerOfTwoWins) {  // a camera turned by a right angle about its axis, so that order does not matter
  const sphc_camera camera = test::pinhole(64, 64, 40);
  const Rigid turned{rotationFromVector(Vector3(0, 0, kPi / 2)), Vector3(0.05, 0.02, 0)};
  DenseRig rig(camera, camera, turned);
  rig.measure([](const Vector2 &ray) { return ray.norm() < 0.3 ? 0.8 : 3.0; });
  rig.align();
  Vector2 middle;
  ASSERT_TRUE(rig.config.color.project(turned * Vector3(0, 0, 0.8), &middle));
  for (int y = -6; y <= 6; ++y)
    for (int x = -6; x <= 6; ++x)
      EXPECT_EQ(rig.depth[rig.at(static_cast<int>(middle.x()) + x, static_cast<int>(middle.y()) + y)], 800);
}

}  // namespace
}  // namespace sphc
