#include "lab/baselines/pose_problems.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lab/baselines/line_clouds.h"
#include "tests/support/pose_world.h"
#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

using test::normal;
using test::normalVector;

constexpr double kFocalPx = 500;

// Points before a camera and the keypoints that see them, with pixel noise.
struct World {
  Rigid camera_from_map;
  std::vector<Vector3> points_m;
  std::vector<Vector2> keypoints;
};

World makeWorld(size_t count, double sigma_px, uint64_t seed) {
  Random random(seed);
  World world;
  world.camera_from_map = {test::randomRotation(&random), normalVector(&random)};
  for (const Vector3 &point : test::pointsInView(count, &random).points_m) {
    world.points_m.push_back(world.camera_from_map.inverse() * point);
    const Vector2 noise(normal(&random), normal(&random));
    world.keypoints.emplace_back(point.hnormalized() + sigma_px / kFocalPx * noise);
  }
  return world;
}

// Every `wrong`-th keypoint is matched with its neighbour's point or line.
PointPoseProblem pointProblem(const World &world, size_t wrong = 0) {
  std::vector<PointPoseMatch> matches;
  for (size_t i = 0; i < world.points_m.size(); ++i) {
    const size_t point = wrong && i % wrong == 0 ? (i + 1) % world.points_m.size() : i;
    matches.push_back({world.keypoints[i], world.points_m[point]});
  }
  return {matches, kFocalPx};
}

LinePoseProblem lineProblem(const World &world, const LineCloud &cloud, size_t wrong = 0) {
  std::vector<LineMatch> matches;
  for (size_t i = 0; i < world.points_m.size(); ++i) {
    const size_t point = wrong && i % wrong == 0 ? (i + 1) % world.points_m.size() : i;
    const uint32_t line = cloud.line_of_point[point];
    matches.push_back(
        {world.keypoints[i], cloud.lines[line], cloud.group_of_line.empty() ? 0 : cloud.group_of_line[line]});
  }
  return {matches, kFocalPx};
}

void expectPose(const RobustPose &found, const Rigid &truth, double angle_rad, double distance_m) {
  EXPECT_GT(found.inliers, 0u);
  EXPECT_LT(test::rotationErrorRad(found.camera_from_map, truth), angle_rad);
  EXPECT_LT(test::translationErrorM(found.camera_from_map, truth), distance_m);
}

TEST(PoseProblems, EverySystemFindsExactPosesExactly) {
  const World world = makeWorld(40, 0, 1);
  expectPose(findPose(pointProblem(world), {}, 1), world.camera_from_map, 1e-7, 1e-7);
  for (const auto make : {uniformLineCloud, pairedLineCloud, pairedLineCloudPlus, rayCloud}) {
    const LineCloud cloud = make(world.points_m, 2);
    SCOPED_TRACE(cloud.name);
    expectPose(findPose(lineProblem(world, cloud), {}, 1), world.camera_from_map, 1e-6, 1e-6);
  }
}

TEST(PoseProblems, EverySystemStandsNoiseAndWrongMatches) {
  const World world = makeWorld(120, 0.4, 3);
  expectPose(findPose(pointProblem(world, 5), {}, 1), world.camera_from_map, 0.003, 0.01);
  for (const auto make : {uniformLineCloud, pairedLineCloud}) {
    const LineCloud cloud = make(world.points_m, 4);
    SCOPED_TRACE(cloud.name);
    expectPose(findPose(lineProblem(world, cloud, 10), {}, 1), world.camera_from_map, 0.005, 0.02);
  }
  // Here the camera looks along the axis of both centres, and rays say little of where on it the camera is.
  expectPose(findPose(lineProblem(world, rayCloud(world.points_m, 4), 10), {}, 1), world.camera_from_map, 0.005,
             0.15);
}

TEST(PoseProblems, ErrorsArePixels) {
  const std::vector<PointPoseMatch> points = {{Vector2(0, 0), Vector3(0.02, 0, 2)}};
  EXPECT_NEAR(PointPoseProblem(points, kFocalPx).squaredError(0, {}), 25, 1e-9);
  const std::vector<LineMatch> lines = {{Vector2(0, 0), Line::through({0.02, 0, 2}, {0, 1, 0.3})}};
  const double aside_px =
      kFocalPx * 0.01 / std::hypot(1, 0.003);  // the image line leans a little: x = 0.01 - 0.003 y
  EXPECT_NEAR(LinePoseProblem(lines, kFocalPx).squaredError(0, {}), aside_px * aside_px, 1e-6);
  EXPECT_TRUE(std::isinf(PointPoseProblem({{Vector2(0, 0), Vector3(0, 0, -1)}}, kFocalPx).squaredError(0, {})));
}

// The gradient of half the squared error, against differences.
void expectGradients(const PoseProblem &problem, const Rigid &pose) {
  constexpr double kStep = 1e-6;
  for (uint32_t i = 0; i < problem.count(); ++i) {
    PoseEquations equations;
    problem.addEquations(i, pose, &equations);
    for (int k = 0; k < 6; ++k) {
      Eigen::Matrix<double, 6, 1> step = Eigen::Matrix<double, 6, 1>::Zero();
      step[k] = kStep;
      const auto at = [&](double sign) {
        const Rigid moved = {rotationFromVector(sign * step.head<3>()) * pose.rotation,
                             pose.translation_m + sign * step.tail<3>()};
        return 0.5 * problem.squaredError(i, moved);
      };
      const double numeric = (at(1) - at(-1)) / (2 * kStep);
      EXPECT_NEAR(-equations.right[k], numeric, 1e-3 * (1 + std::abs(numeric))) << "match " << i << ", part " << k;
    }
  }
}

TEST(PoseProblems, GradientsAreThoseOfTheErrors) {
  const World world = makeWorld(10, 3, 5);
  Rigid pose = world.camera_from_map;
  pose.translation_m += Vector3(0.01, -0.02, 0.01);
  expectGradients(pointProblem(world), pose);
  expectGradients(lineProblem(world, uniformLineCloud(world.points_m, 6)), pose);
}

TEST(PoseProblems, SamplesOfRaysHaveThreeOfEachCentre) {
  const World world = makeWorld(30, 0, 7);
  const LineCloud cloud = rayCloud(world.points_m, 8);
  const LinePoseProblem problem = lineProblem(world, cloud);
  Random random(9);
  for (int k = 0; k < 20; ++k) {
    std::vector<uint32_t> sample;
    ASSERT_TRUE(problem.drawSample(&random, &sample));
    ASSERT_EQ(sample.size(), 6u);
    int second = 0;
    for (const uint32_t match : sample) second += cloud.group_of_line[cloud.line_of_point[match]] == 1;
    EXPECT_EQ(second, 3);
  }
}

TEST(PoseProblems, TooFewMatchesHaveNoPose) {
  const World world = makeWorld(5, 0, 10);
  EXPECT_EQ(findPose(lineProblem(world, uniformLineCloud(world.points_m, 11)), {}, 1).inliers, 0u);
  EXPECT_EQ(findPose(PointPoseProblem({}, kFocalPx), {}, 1).inliers, 0u);
}

TEST(PoseProblems, TheSameSeedGivesTheSameAnswer) {
  const World world = makeWorld(60, 0.5, 12);
  const LineCloud cloud = uniformLineCloud(world.points_m, 13);
  const RobustPose a = findPose(lineProblem(world, cloud), {}, 14), b = findPose(lineProblem(world, cloud), {}, 14);
  EXPECT_EQ(a.camera_from_map.rotation, b.camera_from_map.rotation);
  EXPECT_EQ(a.camera_from_map.translation_m, b.camera_from_map.translation_m);
  EXPECT_EQ(a.iterations, b.iterations);
}

}  // namespace
}  // namespace sphc::host
