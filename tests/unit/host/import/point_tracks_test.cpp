#include "host/import/point_tracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/random_numbers.h"
#include "tests/support/scene.h"

namespace sphc::host {
namespace {

const Camera &camera() {
  static const Camera instance(test::pinhole(640, 480, 500));
  return instance;
}

// Points of a world, seen from a row of cameras with noise.
struct World {
  explicit World(uint64_t seed = 1, size_t count = 200) : random(seed) {
    for (size_t i = 0; i < count; ++i) {
      points.emplace_back(test::uniformIn(&random, -1.2, 1.2), test::uniformIn(&random, -0.9, 0.9),
                          test::uniformIn(&random, 2, 4));
      descriptors.push_back(test::randomDescriptor(&random));
    }
  }
  static Rigid cameraFromWorld(int frame) {
    return {rotationFromVector(Vector3(0, 0.01 * frame, 0)), Vector3(-0.03 * frame, 0.01 * frame, 0)};
  }
  std::vector<Observation> observe(int frame, double sigma_m) {
    const Rigid camera_from_world = cameraFromWorld(frame);
    std::vector<Observation> seen;
    for (size_t i = 0; i < points.size(); ++i) {
      Observation o;
      const Vector3 noisy = points[i] + sigma_m * test::normalVector(&random);
      const Vector3 in_camera = camera_from_world * noisy;
      if (!camera().project(in_camera, &o.pixel_px)) continue;
      if (o.pixel_px.x() < 0 || o.pixel_px.y() < 0 || o.pixel_px.x() >= 640 || o.pixel_px.y() >= 480) continue;
      o.position_m = noisy;
      o.camera_m = camera_from_world.inverse().translation_m;
      o.information = Matrix3::Identity() / (sigma_m * sigma_m + 1e-6);
      o.depth_m = in_camera.z();
      o.sigma_m = sigma_m + 1e-3;
      o.metric_scale_m = 0.01;
      o.descriptor = descriptors[i];
      for (int k = 0; k < 20; ++k) o.descriptor.bytes[random.below(128)] ^= 3;
      seen.push_back(o);
    }
    return seen;
  }

  Random random;
  std::vector<Vector3> points;
  std::vector<Descriptor> descriptors;
};

double distanceToNearest(const Vector3 &p, const std::vector<Vector3> &points) {
  double nearest = 1e9;
  for (const Vector3 &q : points) nearest = std::min(nearest, (p - q).norm());
  return nearest;
}

TEST(PointTracks, MergesAFramesPointsWithThoseKnown) {
  World world;
  PointTracks tracks({});
  const auto first = world.observe(0, 0.002), second = world.observe(1, 0.002);
  EXPECT_EQ(tracks.add(camera(), World::cameraFromWorld(0), first), 0u);
  EXPECT_GT(tracks.add(camera(), World::cameraFromWorld(1), second), second.size() * 9 / 10);
}

TEST(PointTracks, ManyFramesMakeOnePointEachAndAverageTheNoise) {
  World world;
  PointTracks tracks({});
  constexpr double kSigma = 0.004;
  for (int frame = 0; frame < 10; ++frame)
    tracks.add(camera(), World::cameraFromWorld(frame), world.observe(frame, kSigma));
  const PointModel model = modelOf(tracks.points());
  EXPECT_GE(model.points.size(), world.points.size() * 95 / 100);
  EXPECT_LE(model.points.size(), world.points.size() * 105 / 100);
  double squares = 0;
  for (const ModelPoint &point : model.points) {
    const double error = distanceToNearest(point.position_m, world.points);
    squares += error * error / 3;
    if (point.observations > 1) {
      EXPECT_LT(point.sigma_m, kSigma);
    }
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(model.points.size())), 0.6 * kSigma);
}

TEST(PointTracks, WhatOneFrameAloneSawIsKeptOnlyWhereWanted) {
  World world;
  for (uint32_t least : {1u, 2u}) {
    RgbdImportOptions options;
    options.min_observations = least;
    PointTracks tracks(options);
    tracks.add(camera(), World::cameraFromWorld(0), world.observe(0, 0.002));
    EXPECT_GT(tracks.count(), 150u);
    const size_t kept = tracks.points().size();
    EXPECT_EQ(kept > 150, least == 1);
    EXPECT_EQ(kept == 0, least == 2);
  }
}

// At a depth edge a patch scatters; such an observation needs another one's word.
TEST(PointTracks, ALoneObservationAtADepthEdgeIsDropped) {
  World world;
  RgbdImportOptions options;
  options.min_observations = 1;
  PointTracks tracks(options);
  auto seen = world.observe(0, 0.002);
  for (Observation &o : seen) o.sigma_m = 3 * kMappingNoise.sigmaAt(o.depth_m);
  tracks.add(camera(), World::cameraFromWorld(0), seen);
  EXPECT_EQ(tracks.points().size(), 0u);
}

// Of two that disagree the surer one is where the point is.  The other one's depth patch says nothing of it.
TEST(PointTracks, TheOneObservationThatAgreesIsAskedWhetherItIsClean) {
  const auto kept = [](bool sure_is_clean, bool other_is_clean, bool sure_is_first) {
    World world(6, 40);
    auto sure = world.observe(0, 0.001), other = sure;
    for (size_t i = 0; i < sure.size(); ++i) {
      const double noise_m = kMappingNoise.sigmaAt(sure[i].depth_m);
      sure[i].sigma_m = (sure_is_clean ? 0.5 : 3) * noise_m;
      other[i].sigma_m = (other_is_clean ? 0.5 : 3) * noise_m;
      other[i].position_m *= 1.025;
      other[i].depth_m *= 1.025;
      other[i].information = Matrix3::Identity() / (0.01 * 0.01);
    }
    PointTracks tracks({});
    tracks.add(camera(), World::cameraFromWorld(0), sure_is_first ? sure : other);
    EXPECT_EQ(tracks.add(camera(), World::cameraFromWorld(0), sure_is_first ? other : sure), sure.size());
    for (const TrackedPoint &tracked : tracks.points()) EXPECT_EQ(tracked.point.observations, 1u);
    return static_cast<double>(tracks.points().size()) / static_cast<double>(sure.size());
  };
  for (bool sure_is_first : {false, true}) {
    EXPECT_EQ(kept(true, false, sure_is_first), 1) << sure_is_first;
    EXPECT_EQ(kept(false, true, sure_is_first), 0) << sure_is_first;
  }
}

TEST(PointTracks, OutliersDoNotMoveAPoint) {
  World world(3, 60);
  PointTracks tracks({});
  for (int frame = 0; frame < 9; ++frame) {
    auto seen = world.observe(frame, 0.008);
    if (frame % 3 == 2)
      for (Observation &o : seen) {  // depth wrong by 2.5 %: the view still agrees
        const Vector3 eye = World::cameraFromWorld(frame).inverse().translation_m;
        o.position_m = eye + 1.025 * (o.position_m - eye);
        o.depth_m *= 1.025;
      }
    tracks.add(camera(), World::cameraFromWorld(frame), seen);
  }
  const PointModel model = modelOf(tracks.points());
  std::vector<double> errors;
  for (const ModelPoint &point : model.points) errors.push_back(distanceToNearest(point.position_m, world.points));
  ASSERT_GT(errors.size(), 50u);
  std::nth_element(errors.begin(), errors.begin() + static_cast<ptrdiff_t>(errors.size() / 2), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.03);
}

TEST(PointTracks, OtherDescriptorsOrOtherDepthsStayApart) {
  World world(4, 40);
  const auto first = world.observe(0, 0.002);
  auto other_descriptors = first, other_depth = first;
  for (Observation &o : other_descriptors) o.descriptor = test::randomDescriptor(&world.random);
  for (Observation &o : other_depth) o.depth_m *= 1.5, o.position_m *= 1.5;
  PointTracks tracks({});
  tracks.add(camera(), World::cameraFromWorld(0), first);
  EXPECT_EQ(tracks.add(camera(), World::cameraFromWorld(0), other_descriptors), 0u);
  EXPECT_EQ(tracks.add(camera(), World::cameraFromWorld(0), other_depth), 0u);
}

TEST(PointTracks, SameInputSameModel) {
  const auto run = [] {
    World world(5);
    PointTracks tracks({});
    for (int frame = 0; frame < 4; ++frame)
      tracks.add(camera(), World::cameraFromWorld(frame), world.observe(frame, 0.003));
    return modelOf(tracks.points());
  };
  const PointModel a = run(), b = run();
  ASSERT_EQ(a.points.size(), b.points.size());
  for (size_t i = 0; i < a.points.size(); ++i) EXPECT_EQ(a.points[i].position_m, b.points[i].position_m);
}

}  // namespace
}  // namespace sphc::host
