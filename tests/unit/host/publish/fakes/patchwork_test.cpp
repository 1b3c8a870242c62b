#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "host/publish/fakes/strategy.h"
#include "runtime/stages/features/mirrored_descriptor.h"
#include "tests/support/random_numbers.h"
#include "tests/support/refusal.h"

namespace sphc::host {
namespace {

std::vector<SpherePoint> somePoints(size_t count, double spread, uint64_t seed = 3) {
  Random random(seed);
  std::vector<SpherePoint> points;
  for (size_t i = 0; i < count; ++i)
    points.push_back({(Vector3(1, 0.3, 0) + spread * test::normalVector(&random)).normalized(),
                      test::randomDescriptor(&random)});
  return points;
}

std::vector<Assignment> assignmentsOf(const std::vector<SpherePoint> &points, size_t real, uint8_t key = 1) {
  SecretRandom random({key});
  return patchworkFakes()->assignments(points, real, &random);
}

std::vector<Assignment> warpedAssignmentsOf(const std::vector<SpherePoint> &points, size_t real) {
  SecretRandom random({1});
  return warpedFakes()->assignments(points, real, &random);
}

bool same(const Descriptor &a, const Descriptor &b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(PatchworkFakes, RealPointsStayAndFakesAreMirrored) {
  const auto points = somePoints(3000, 1);
  const auto assignments = assignmentsOf(points, 1000);
  ASSERT_EQ(assignments.size(), points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(assignments[i].shown.direction.norm(), 1, 1e-12);
    if (assignments[i].real) {
      EXPECT_EQ(assignments[i].shown.direction, points[i].direction);
      EXPECT_TRUE(same(assignments[i].shown.descriptor, points[i].descriptor));
    } else {
      EXPECT_TRUE(same(assignments[i].shown.descriptor, mirrored(points[i].descriptor)));
    }
  }
}

TEST(PatchworkFakes, TheShareOfRealPointsIsEtaWithinAPatch) {
  for (double eta : {0.75, 0.5, 1.0 / 3, 0.25, 0.1}) {
    for (double spread : {0.05, 0.3, 2.0}) {
      const auto points = somePoints(6000, spread);
      double real = 0;
      for (const Assignment &assignment : assignmentsOf(points, static_cast<size_t>(eta * 6000)))
        real += assignment.real;
      EXPECT_NEAR(real / 6000, eta, 0.04) << spread;
    }
  }
}

// Points that lie together before lie together after, at the same distances: the company says nothing.
TEST(PatchworkFakes, FakesKeepTheirCompany) {
  const auto points = somePoints(3000, 1);
  const auto assignments = assignmentsOf(points, 1000);
  size_t pairs = 0, kept = 0, turned_over = 0, triples = 0;
  for (size_t i = 0; i < points.size(); i += 3) {
    if (assignments[i].real) continue;
    std::vector<size_t> near;
    for (size_t j = 0; j < points.size(); ++j) {
      if (j == i || (points[i].direction - points[j].direction).norm() > 0.03) continue;
      ++pairs;
      const double before = (points[i].direction - points[j].direction).norm();
      const bool stayed =
          std::abs((assignments[i].shown.direction - assignments[j].shown.direction).norm() - before) < 1e-9;
      kept += stayed;
      if (stayed) near.push_back(j);
    }
    if (near.size() < 2) continue;
    const auto side = [&](bool shown) {
      const auto at = [&](size_t k) { return shown ? assignments[k].shown.direction : points[k].direction; };
      return (at(near[0]) - at(i)).cross(at(near[1]) - at(i)).dot(at(i)) > 0;
    };
    ++triples;
    turned_over += side(false) != side(true);
  }
  ASSERT_GT(pairs, 200u);
  EXPECT_GT(static_cast<double>(kept) / static_cast<double>(pairs), 0.7);  // the others straddle an edge
  ASSERT_GT(triples, 50u);
  EXPECT_EQ(turned_over, triples);  // so that no camera, wherever it is, sees fakes where they are shown
}

TEST(PatchworkFakes, FakesLieOnRealPatches) {
  const auto points = somePoints(4000, 0.5);
  const auto assignments = assignmentsOf(points, 1333);
  size_t fakes = 0, covered = 0;
  for (const Assignment &assignment : assignments) {
    if (assignment.real) continue;
    ++fakes;
    for (size_t j = 0; j < points.size(); ++j) {
      if (!assignments[j].real || (points[j].direction - assignment.shown.direction).norm() > 0.1) continue;
      ++covered;
      break;
    }
  }
  EXPECT_GT(static_cast<double>(covered) / static_cast<double>(fakes), 0.95);
}

// Whoever lost a first release makes it again with its key: what is drawn under a key stays for ever.
TEST(PatchworkFakes, WhatAKeyDrawsNeverChanges) {
  const auto assignments = assignmentsOf(somePoints(300, 1), 100);
  std::vector<size_t> real;
  for (size_t i = 0; i < assignments.size() && real.size() < 8; ++i)
    if (assignments[i].real) real.push_back(i);
  EXPECT_EQ(real, (std::vector<size_t>{1, 7, 9, 10, 11, 14, 16, 17}));
  EXPECT_NEAR(assignments[0].shown.direction.x(), 0.359456062, 1e-6);  // a fake's
}

TEST(PatchworkFakes, SameKeySameAssignmentsOtherKeyOthers) {
  const auto points = somePoints(1000, 1);
  const auto a = assignmentsOf(points, 333), b = assignmentsOf(points, 333), c = assignmentsOf(points, 333, 2);
  size_t alike = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(a[i].real, b[i].real);
    EXPECT_EQ(a[i].shown.direction, b[i].shown.direction);
    alike += a[i].real && c[i].real;
  }
  EXPECT_NEAR(static_cast<double>(alike) / 1000, 1.0 / 9, 0.08);
}

TEST(PatchworkFakes, SmallCloudsHaveFakesToo) {
  for (size_t count : {16u, 50u, 200u}) {
    size_t real = 0;
    for (const Assignment &assignment : assignmentsOf(somePoints(count, 0.01), count / 2)) real += assignment.real;
    EXPECT_GT(real, 0u);
    EXPECT_LT(real, count);
  }
}

// Fakes need a patch to lie on.
TEST(PatchworkFakes, WhereEveryPatchIsTooLargeToStayIsExplained) {
  const auto points = somePoints(300, 1e-4);
  for (size_t real : {1u, 100u}) {
    EXPECT_THAT(test::refusal([&] { assignmentsOf(points, real); }), testing::HasSubstr("give a larger --eta"));
    EXPECT_THAT(test::refusal([&] { warpedAssignmentsOf(points, real); }), testing::HasSubstr("larger --eta"));
  }
}

TEST(PatchworkFakes, BadWidthsAreExplained) {
  for (double width : {0.0, -1.0, 1.9, 61.0, std::nan("")}) {
    EXPECT_THROW(patchworkFakes(width), std::runtime_error);
    EXPECT_THROW(warpedFakes(width), std::runtime_error);
  }
}

// Mean angle between where fakes are and where they are shown.
double meanWayOf(const std::vector<SpherePoint> &points, const std::vector<Assignment> &assignments) {
  double sum = 0, fakes = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    if (assignments[i].real) continue;
    sum += std::acos(std::min(1.0, points[i].direction.dot(assignments[i].shown.direction)));
    ++fakes;
  }
  return sum / fakes;
}

TEST(WarpedFakes, KeepTheRealPointsOfPatchworkAndMirrorTheOthers) {
  const auto points = somePoints(3000, 1);
  const auto assignments = warpedAssignmentsOf(points, 1000), patchwork = assignmentsOf(points, 1000);
  for (size_t i = 0; i < points.size(); ++i) {
    ASSERT_EQ(assignments[i].real, patchwork[i].real);
    EXPECT_NEAR(assignments[i].shown.direction.norm(), 1, 1e-12);
    if (assignments[i].real) {
      EXPECT_EQ(assignments[i].shown.direction, points[i].direction);
    }
    EXPECT_TRUE(same(assignments[i].shown.descriptor,
                     assignments[i].real ? points[i].descriptor : mirrored(points[i].descriptor)));
  }
}

TEST(WarpedFakes, ComeFromBeside) {
  const auto points = somePoints(4000, 3);
  EXPECT_GT(meanWayOf(points, assignmentsOf(points, 1333)), 1.2);
  EXPECT_LT(meanWayOf(points, warpedAssignmentsOf(points, 1333)), 0.4);
}

// Points that lie together lie together after, and no rigid copy of the patch is left.
TEST(WarpedFakes, AreBent) {
  const auto points = somePoints(6000, 0.5);
  const auto assignments = warpedAssignmentsOf(points, 2000);
  double near_pairs = 0, near_kept = 0, far_pairs = 0, far_kept = 0;
  for (size_t i = 0; i < points.size(); i += 3)
    for (size_t j = 0; j < points.size(); ++j) {
      if (assignments[i].real || assignments[j].real || i == j) continue;
      const double before = (points[i].direction - points[j].direction).norm();
      const double change =
          std::abs((assignments[i].shown.direction - assignments[j].shown.direction).norm() - before);
      if (before < 0.01) ++near_pairs, near_kept += change < 0.5 * before;
      if (before > 0.06 && before < 0.08 && change < 0.08) ++far_pairs, far_kept += change < 0.005;
    }
  ASSERT_GT(near_pairs, 100);
  EXPECT_GT(near_kept / near_pairs, 0.6);  // the others straddle an edge, or lie where the warp is steep
  ASSERT_GT(far_pairs, 1000);
  EXPECT_LT(far_kept / far_pairs, 0.45);
}

}  // namespace
}  // namespace sphc::host
