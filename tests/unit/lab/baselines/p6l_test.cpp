#include "lab/baselines/p6l.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

using test::normalVector;
using test::randomDirection;
using test::randomRotation;
using test::uniformIn;

struct Problem {
  Vector3 bearing[kP6lLines];
  Line line[kP6lLines];
  Rigid camera_from_map;
};

// Six points before a camera, a line through each; `through` may set a line's direction in the map.
template <typename Direction>
Problem makeProblem(Random *random, Direction direction) {
  Problem p;
  p.camera_from_map = {randomRotation(random), 2 * normalVector(random)};
  for (int i = 0; i < kP6lLines; ++i) {
    const Vector3 point_camera(uniformIn(random, -2, 2), uniformIn(random, -2, 2), uniformIn(random, 1, 4));
    p.bearing[i] = point_camera.normalized();
    const Vector3 point_map = p.camera_from_map.inverse() * point_camera;
    p.line[i] = Line::through(point_map, direction(i, point_map));
  }
  return p;
}

Problem randomProblem(Random *random) {
  return makeProblem(random, [random](int, const Vector3 &) { return randomDirection(random); });
}

double difference(const Rigid &a, const Rigid &b) {
  return std::max((a.rotation - b.rotation).cwiseAbs().maxCoeff(), (a.translation_m - b.translation_m).norm());
}

double distanceToTruth(const Problem &p, const std::vector<Rigid> &poses) {
  double least = std::numeric_limits<double>::infinity();
  for (const Rigid &pose : poses) least = std::min(least, difference(pose, p.camera_from_map));
  return least;
}

// By how much a ray misses its line: their distance times the sine of the angle between them, relative to the size
// of the scene (the terms that cancel in it).
double worstMiss(const Problem &p, const Rigid &pose) {
  double worst = 0, size_m = 0;
  for (int i = 0; i < kP6lLines; ++i) {
    const Vector3 plane = (pose * p.line[i].point_m).cross(pose.rotation * p.line[i].direction);
    worst = std::max(worst, std::abs(p.bearing[i].dot(plane)));
    size_m = std::max(size_m, p.line[i].point_m.norm());
  }
  return worst / (size_m + pose.translation_m.norm());
}
// The solver ends when its equations, divided by the size of their terms, are below 1e-10 (kPolished2).  Its size
// is about the lines' middle, at most three times that of worstMiss.
constexpr double kMostMiss = 3e-10;

#ifdef NDEBUG
constexpr int kProblems = 200, kSpecialProblems = 20;
#else
constexpr int kProblems = 10, kSpecialProblems = 4;  // sanitizers are slow
#endif

TEST(P6l, FindsTheTruePoseAndNothingThatIsNone) {
  Random random(1);
  int found = 0;
  for (int k = 0; k < kProblems; ++k) {
    const Problem p = randomProblem(&random);
    const std::vector<Rigid> poses = solveP6l(p.bearing, p.line);
    found += distanceToTruth(p, poses) < 1e-6;
    ASSERT_LE(poses.size(), static_cast<size_t>(kP6lMaxSolutions));
    for (const Rigid &pose : poses) {
      EXPECT_LT(worstMiss(p, pose), kMostMiss);
      EXPECT_LT((pose.rotation * pose.rotation.transpose() - Matrix3::Identity()).norm(), 1e-9);
      EXPECT_GT(pose.rotation.determinant(), 0);
    }
  }
  EXPECT_GE(found, kProblems * 99 / 100);
}

TEST(P6l, HasSeveralDifferentSolutions) {
  Random random(2);
  const Problem p = randomProblem(&random);
  const std::vector<Rigid> poses = solveP6l(p.bearing, p.line);
  ASSERT_GE(poses.size(), 2u);
  for (size_t i = 0; i < poses.size(); ++i)
    for (size_t k = 0; k < i; ++k) EXPECT_GT(difference(poses[i], poses[k]), 1e-6);
}

TEST(P6l, DoesNotCareWhereTheOriginIsNorInWhichUnit) {
  Random random(3);
  for (const double unit : {1e-3, 1e3}) {
    Problem p = randomProblem(&random);
    const Vector3 offset = 1e4 * normalVector(&random);
    for (Line &line : p.line) line = Line::through(unit * (line.point_m + offset), line.direction);
    p.camera_from_map.translation_m =
        unit * (p.camera_from_map.translation_m - p.camera_from_map.rotation * offset);
    EXPECT_LT(distanceToTruth(p, solveP6l(p.bearing, p.line)), 1e-3 * unit);
  }
}

TEST(P6l, TwoMatchesOfOneLineWillDo) {  // as paired-point lifting has them
  Random random(4);
  int found = 0;
  for (int k = 0; k < kSpecialProblems; ++k) {
    Problem p = randomProblem(&random);
    const Vector3 other = p.line[0].point_m + 0.7 * p.line[0].direction;
    p.line[1] = p.line[0];
    p.bearing[1] = (p.camera_from_map * other).normalized();
    found += distanceToTruth(p, solveP6l(p.bearing, p.line)) < 1e-6;
  }
  EXPECT_EQ(found, kSpecialProblems);
}

TEST(P6l, ThreeLinesThroughEachOfTwoCentresWillDo) {  // as ray clouds have them
  Random random(5);
  int found = 0;
  for (int k = 0; k < kSpecialProblems; ++k) {
    const Vector3 centre[2] = {normalVector(&random), normalVector(&random)};
    const Problem p =
        makeProblem(&random, [&](int i, const Vector3 &point) -> Vector3 { return centre[i % 2] - point; });
    found += distanceToTruth(p, solveP6l(p.bearing, p.line)) < 1e-6;
  }
  EXPECT_GE(found, kSpecialProblems - 1);
}

TEST(P6l, LinesThroughOnePointGiveNoNonsense) {  // the scale is not known: no pose is isolated
  Random random(6);
  const Problem p = makeProblem(&random, [](int, const Vector3 &point) { return point; });
  for (const Rigid &pose : solveP6l(p.bearing, p.line)) {
    EXPECT_TRUE(pose.translation_m.allFinite());
    EXPECT_LT((pose.rotation * pose.rotation.transpose() - Matrix3::Identity()).norm(), 1e-9);
  }
}

TEST(P6l, NotANumberHasNoSolution) {
  Random random(7);
  Problem p = randomProblem(&random);
  p.line[2].point_m.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(solveP6l(p.bearing, p.line).empty());
}

}  // namespace
}  // namespace sphc::host
