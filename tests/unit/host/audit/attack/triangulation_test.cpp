#include "host/audit/attack/triangulation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/audit/attack/five_point.h"
#include "host/audit/score/release_scores.h"
#include "tests/unit/host/audit/made_up_releases.h"

namespace sphc::host {
namespace {

constexpr double kHalfReal = 0.5;

TriangulationOptions quick() {
  TriangulationOptions options;
  options.samples = 1500;
  options.angles_rad = {2e-3};
  return options;
}

TEST(FivePoint, TheTrueMatrixIsAmongTheSolutions) {
  Random random(3);
  int found = 0;
  for (int round = 0; round < 200; ++round) {
    const Rigid b_from_a = {test::randomRotation(&random), test::randomDirection(&random)};
    std::array<Vector3, 5> a, b;
    for (size_t k = 0; k < 5; ++k) {
      const Vector3 point = 3 * test::normalVector(&random);
      a[k] = point.normalized();
      b[k] = (b_from_a * point).normalized();
    }
    Matrix3 truth = crossMatrix(b_from_a.translation_m) * b_from_a.rotation;
    truth /= truth.norm();
    double nearest = 1;
    for (const Matrix3 &e : fivePoint(a, b)) {
      nearest = std::min({nearest, (e - truth).norm(), (e + truth).norm()});
      for (size_t k = 0; k < 5; ++k) EXPECT_LT(std::abs(b[k].dot(e * a[k])), 1e-9);
    }
    found += nearest < 1e-6;
  }
  EXPECT_GE(found, 196);
}

// The same points about another centre, in another frame: eta^2 of them come back to millimetres.
TEST(Triangulation, AnotherCentreGivesThePointsAway) {
  const PointModel room = test::madeUpRoom(2000, 1);
  const test::MadeUpRelease a = test::released(room, 1, kHalfReal),
                            b = test::released(test::part(room, 0, 1700), 2, kHalfReal);
  const double centres_m = (a.place.centre_m - b.place.centre_m).norm();
  ASSERT_GT(centres_m, 0.005);
  const Triangulation attack = triangulateReleases(a.map, b.map, quick());
  ASSERT_TRUE(attack.found);
  EXPECT_LT(rotationAngle(attack.b_from_a), 0.002);  // one world
  const TriangulationScore score = scoreTriangulation(attack, a.truth, b.truth, centres_m);
  EXPECT_GT(score.both_real.precision(), 0.9);
}

// The sample that wins decides how exact the pose is, and rounding decides which one wins: hence a spread over
// keys.
TEST(Triangulation, ALargeShiftGivesThemToMillimetres) {
  const PointModel room = test::madeUpRoom(2000, 1);
  PointModel half = room;
  std::sort(half.points.begin(), half.points.end(),
            [](const ModelPoint &p, const ModelPoint &q) { return p.position_m.x() < q.position_m.x(); });
  half.points.resize(1400);
  std::vector<double> errors_m;
  for (uint8_t key = 1; key <= 23; key += 2) {
    const test::MadeUpRelease a = test::released(room, key, kHalfReal),
                              b = test::released(test::seenAgain(half, 1, test::otherWorld(), 0, 0), key + 1,
                                                 kHalfReal);
    const Vector3 centre_b = test::otherWorld().inverse() * b.place.centre_m;
    const double centres_m = (a.place.centre_m - centre_b).norm();
    ASSERT_GT(centres_m, 0.2);
    const Triangulation attack = triangulateReleases(a.map, b.map, quick());
    ASSERT_TRUE(attack.found) << int{key};
    EXPECT_LT(rotationAngle(attack.b_from_a * test::otherWorld().rotation.transpose()), 3e-3) << int{key};
    const TriangulationScore score = scoreTriangulation(attack, a.truth, b.truth, centres_m);
    EXPECT_GT(score.both_real.precision(), 0.97) << int{key};
    EXPECT_NEAR(static_cast<double>(score.both_real.real) / 1400, kHalfReal * kHalfReal, 0.05) << int{key};
    errors_m.push_back(score.median_error_m);
  }
  std::sort(errors_m.begin(), errors_m.end());
  EXPECT_LT(errors_m[errors_m.size() / 2], 0.003);
  EXPECT_LT(errors_m.back(), 0.01);
}

TEST(Triangulation, UpdatesHaveNoParallax) {
  const PointModel room = test::madeUpRoom(2000, 1);
  const test::MadeUpRelease a = test::released(room, 1, kHalfReal);
  const PointModel more = test::seenLater(room, 2000, test::madeUpRoom(200, 2));
  const test::MadeUpRelease b = test::released(more, 1, kHalfReal, {a.place});
  EXPECT_FALSE(triangulateReleases(a.map, b.map, quick()).found);
}

TEST(Triangulation, MapsOfRoomsThatOverlapHaveNoPointInCommon) {
  const PointModel room = test::madeUpRoom(1500, 1);
  const test::MadeUpRelease a = test::released(room, 1, kHalfReal);
  const PointModel next = test::seenLater(room, 400, test::madeUpRoom(1100, 5, {14, -4, 2}));
  const test::MadeUpRelease b = test::released(next, 1, kHalfReal, {a.place});
  ASSERT_EQ(b.place.number, 2u);
  EXPECT_FALSE(triangulateReleases(a.map, b.map, quick()).found);
}

}  // namespace
}  // namespace sphc::host
