#include "host/audit/attack/density.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/audit/score/point_errors.h"
#include "lab/baselines/line_clouds.h"
#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

// Points on the walls and the floor of a room, about its middle.
std::vector<Vector3> roomPoints(size_t count) {
  Random random(1);
  std::vector<Vector3> points_m;
  for (size_t i = 0; i < count; ++i) {
    Vector3 point(4 * random.uniform() - 2, 4 * random.uniform() - 2, 4 * random.uniform() - 2);
    point[static_cast<int>(i % 3)] = i % 2 ? 2 : -2;
    points_m.push_back(point);
  }
  return points_m;
}

double medianError(const LineCloud &cloud, const std::vector<Vector3> &points_m) {
  auto errors_m = pointErrors(points_m, cloud.line_of_point, attackByDensity(cloud.lines, {}, {}));
  std::nth_element(errors_m.begin(), errors_m.begin() + static_cast<ptrdiff_t>(errors_m.size() / 2),
                   errors_m.end());
  return errors_m[errors_m.size() / 2];
}

TEST(DensityAttack, HasThePapersOrder) {
  const std::vector<Vector3> points_m = roomPoints(2000);
  std::vector<Vector3> directions;
  for (const Vector3 &point : points_m) directions.push_back(point.normalized());
  const double uniform = medianError(uniformLineCloud(points_m, 2), points_m);
  const double pairs = medianError(pairedLineCloud(points_m, 2), points_m);
  const double sphere = medianError(centralLineCloud(directions), points_m);
  EXPECT_LT(uniform, 0.8);  // of a room of 4 m, with few points
  EXPECT_GT(pairs, 1.5 * uniform);
  EXPECT_GT(sphere, 2);  // the distance of the walls
  EXPECT_GT(sphere, 1.2 * pairs);
}

TEST(DensityAttack, LinesThatMeetGiveTheirCentreAway) {
  std::vector<Vector3> directions;
  for (const Vector3 &point : roomPoints(500)) directions.push_back(point.normalized());
  const std::vector<Vector3> recovered = attackByDensity(centralLineCloud(directions).lines, {}, {});
  EXPECT_GE(shareWithin(recovered, Vector3::Zero(), 1e-6), 0.99);
}

TEST(DensityAttack, ClosestAlongIsThePointNearestToTheOther) {
  const Line x_axis = Line::through({0, 0, 0}, {1, 0, 0}), across = Line::through({3, 5, 1}, {0, 1, 0});
  EXPECT_NEAR(closestAlong(x_axis, across), 3, 1e-12);
  EXPECT_NEAR(closestAlong(x_axis, Line::through({2, 0, 1}, {1, 1, 0})), 2, 1e-12);
  EXPECT_TRUE(std::isnan(closestAlong(x_axis, Line::through({0, 1, 0}, {1, 0, 0}))));
}

TEST(DensityAttack, DensestIsWhereMostVotesAre) {
  EXPECT_NEAR(densestOf({-9, 4, 1.0, 1.1, 1.05, 7, 1.02, -3, 12, 20}, 0.4), 1.05, 1e-12);
  EXPECT_NEAR(densestOf({5}, 0.2), 5, 0);
  EXPECT_TRUE(std::isnan(densestOf({}, 0.2)));
}

TEST(DensityAttack, ParallelLinesAndTooFewLines) {
  std::vector<Line> parallel;
  for (int i = 0; i < 5; ++i) parallel.push_back(Line::through(Vector3(i, 0, 0), {0, 0, 1}));
  for (const Vector3 &point : attackByDensity(parallel, {}, {})) EXPECT_TRUE(point.allFinite());
  EXPECT_THROW(attackByDensity({parallel[0]}, {}, {}), std::runtime_error);
}

TEST(DensityAttack, TellsHowFarItIs) {
  DensityAttackOptions options;
  options.rounds = 1;
  uint64_t last = 0, all = 0;
  attackByDensity(uniformLineCloud(roomPoints(30), 3).lines, options, [&](uint64_t done, uint64_t total) {
    EXPECT_EQ(done, last + 1);
    last = done, all = total;
  });
  EXPECT_EQ(last, 60u);
  EXPECT_EQ(all, 60u);
}

}  // namespace
}  // namespace sphc::host
