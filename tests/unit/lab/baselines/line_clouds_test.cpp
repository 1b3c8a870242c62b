#include "lab/baselines/line_clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

double distanceTo(const Line &line, const Vector3 &point_m) {
  return (point_m - line.point_m).cross(line.direction).norm();
}

std::vector<Vector3> scatteredPoints(size_t count) {
  Random random(1);
  std::vector<Vector3> points_m;
  for (size_t i = 0; i < count; ++i) points_m.push_back(test::normalVector(&random));
  return points_m;
}

// Floor and wall of a room.
std::vector<Vector3> twoPlanes(size_t count) {
  Random random(2);
  std::vector<Vector3> points_m;
  for (size_t i = 0; i < count; ++i) {
    const double a = 4 * random.uniform(), b = 4 * random.uniform();
    points_m.emplace_back(i % 2 ? Vector3(a, b, 0) : Vector3(0, a, b));
  }
  return points_m;
}

void expectLinesThroughPoints(const LineCloud &cloud, const std::vector<Vector3> &points_m) {
  ASSERT_EQ(cloud.line_of_point.size(), points_m.size());
  for (size_t i = 0; i < points_m.size(); ++i) {
    ASSERT_LT(cloud.line_of_point[i], cloud.lines.size());
    EXPECT_LT(distanceTo(cloud.lines[cloud.line_of_point[i]], points_m[i]), 1e-9);
  }
}

std::map<uint32_t, int> pointsPerLine(const LineCloud &cloud) {
  std::map<uint32_t, int> counts;
  for (const uint32_t line : cloud.line_of_point) ++counts[line];
  return counts;
}

TEST(Line, SaysNothingOfThePointNorOfTheSenseItWasMadeFrom) {
  const Vector3 point(1, 2, 3), along(-1, 0.5, 2);
  const Line line = Line::through(point, along), same = Line::through(point - 7 * along, -3 * along);
  EXPECT_LT((line.point_m - same.point_m).norm(), 1e-12);
  EXPECT_LT((line.direction - same.direction).norm(), 1e-12);
  EXPECT_NEAR(line.point_m.dot(line.direction), 0, 1e-12);
  EXPECT_LT(distanceTo(line, point), 1e-12);
  EXPECT_GT(Line::through(point, Vector3(0, -1, 4)).direction.y(), 0);
  EXPECT_GT(Line::through(point, Vector3(0, 0, -4)).direction.z(), 0);
}

TEST(LineClouds, UniformLinesPointEverywhere) {
  const std::vector<Vector3> points_m = scatteredPoints(4000);
  const LineCloud cloud = uniformLineCloud(points_m, 3);
  expectLinesThroughPoints(cloud, points_m);
  EXPECT_EQ(cloud.lines.size(), points_m.size());
  Matrix3 scatter = Matrix3::Zero();
  for (const Line &line : cloud.lines) scatter += line.direction * line.direction.transpose();
  EXPECT_LT((scatter / 4000 - Matrix3::Identity() / 3).cwiseAbs().maxCoeff(), 0.02);
}

TEST(LineClouds, PairsShareALine) {
  const std::vector<Vector3> points_m = scatteredPoints(200);
  for (const LineCloud &cloud : {pairedLineCloud(points_m, 4), pairedLineCloudPlus(points_m, 4)}) {
    expectLinesThroughPoints(cloud, points_m);
    EXPECT_EQ(cloud.lines.size(), points_m.size() / 2);
    for (const auto &[line, count] : pointsPerLine(cloud)) EXPECT_EQ(count, 2) << line;
  }
}

TEST(LineClouds, OfAnOddNumberTheLastHasALineToo) {
  const std::vector<Vector3> points_m = scatteredPoints(7);
  for (const LineCloud &cloud : {pairedLineCloud(points_m, 4), pairedLineCloudPlus(points_m, 4)}) {
    expectLinesThroughPoints(cloud, points_m);
    EXPECT_EQ(cloud.lines.size(), 4u);
  }
}

TEST(LineClouds, PlusLeavesThePlanes) {
  const std::vector<Vector3> points_m = twoPlanes(1000);
  const auto inPlane = [](const LineCloud &cloud) {
    return std::count_if(cloud.lines.begin(), cloud.lines.end(), [](const Line &line) {
      return std::min(std::abs(line.direction.x()), std::abs(line.direction.z())) < 1e-6;
    });
  };
  EXPECT_GT(inPlane(pairedLineCloud(points_m, 5)), 200);  // half of 500
  EXPECT_LT(inPlane(pairedLineCloudPlus(points_m, 5)), 25);
}

TEST(LineClouds, RaysMeetInTwoCentres) {
  const std::vector<Vector3> points_m = scatteredPoints(300);
  const LineCloud cloud = rayCloud(points_m, 6);
  expectLinesThroughPoints(cloud, points_m);
  ASSERT_EQ(cloud.centres_m.size(), 2u);
  EXPECT_GT((cloud.centres_m[0] - cloud.centres_m[1]).norm(), 1);
  ASSERT_EQ(cloud.group_of_line.size(), cloud.lines.size());
  for (size_t i = 0; i < cloud.lines.size(); ++i)
    EXPECT_LT(distanceTo(cloud.lines[i], cloud.centres_m.at(cloud.group_of_line[i])), 1e-9);
  const auto second = std::count(cloud.group_of_line.begin(), cloud.group_of_line.end(), 1u);
  EXPECT_GT(second, 100);
  EXPECT_LT(second, 200);
}

TEST(LineClouds, CentralLinesMeetInTheOrigin) {
  const std::vector<Vector3> directions = {{1, 2, 3}, {-1, 0, 0}, {0, 0.5, -1}};
  const LineCloud cloud = centralLineCloud(directions);
  expectLinesThroughPoints(cloud, directions);
  for (const Line &line : cloud.lines) EXPECT_LT(line.point_m.norm(), 1e-12);
}

TEST(LineClouds, TheSameSeedGivesTheSameLines) {
  const std::vector<Vector3> points_m = scatteredPoints(50);
  for (const auto make : {uniformLineCloud, pairedLineCloud, pairedLineCloudPlus, rayCloud}) {
    const LineCloud a = make(points_m, 7), b = make(points_m, 7), other = make(points_m, 8);
    ASSERT_EQ(a.lines.size(), b.lines.size());
    bool differs = false;
    for (size_t i = 0; i < a.lines.size(); ++i) {
      EXPECT_EQ(a.lines[i].direction, b.lines[i].direction);
      differs |= a.lines[i].direction != other.lines[i].direction;
    }
    EXPECT_TRUE(differs);
  }
}

TEST(LineClouds, PointsThatAreOneAndTooFewPoints) {
  const std::vector<Vector3> same(2, Vector3(1, 1, 1));
  for (const auto make : {uniformLineCloud, pairedLineCloud, pairedLineCloudPlus, rayCloud}) {
    for (const Line &line : make(same, 9).lines) EXPECT_NEAR(line.direction.norm(), 1, 1e-12);
    EXPECT_THROW(make({Vector3(1, 2, 3)}, 9), std::runtime_error);
  }
}

}  // namespace
}  // namespace sphc::host
