// Batched perspective-three-point in single precision, against the truth and the solver in double precision.
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/stages/pose/kernels.h"
#include "runtime/stages/pose/p3p.h"
#include "tests/support/pose_world.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

struct Sample {
  Vector3 point[3], direction[3];
  Rigid camera_from_map;
};

bool isSpreadOut(const Sample &s) {
  const Vector3 side = s.point[1] - s.point[0], other = s.point[2] - s.point[0];
  for (int k = 0; k < 3; ++k) {
    if ((s.point[k] - s.point[(k + 1) % 3]).norm() < 0.5) return false;
    if ((s.point[k] - s.camera_from_map.translation_m).norm() < 0.3) return false;
  }
  return side.cross(other).norm() > 0.3;
}

Sample randomSample(Random *random) {
  for (;;) {
    Sample s;
    s.camera_from_map = {test::randomRotation(random), test::normalVector(random) + Vector3(0, 0, 2)};
    for (int k = 0; k < 3; ++k) {
      s.point[k] = test::pointInView(random);
      s.direction[k] = (s.camera_from_map.inverse() * s.point[k]).normalized();
    }
    if (isSpreadOut(s)) return s;
  }
}

void put(const Sample &s, uint32_t lane, MinimalBatch *batch) {
  for (int k = 0; k < 3; ++k)
    for (int axis = 0; axis < 3; ++axis) {
      batch->point_m[k][axis][lane] = static_cast<float>(s.point[k][axis]);
      batch->direction[k][axis][lane] = static_cast<float>(s.direction[k][axis]);
    }
}

double distance(const PoseF &a, const Rigid &b) {
  double sum = 0;
  const PoseF f = poseF(b);
  for (int i = 0; i < 9; ++i) sum += std::pow(static_cast<double>(a.r[i] - f.r[i]), 2);
  for (int i = 0; i < 3; ++i) sum += std::pow(static_cast<double>(a.t[i] - f.t[i]), 2);
  return std::sqrt(sum);
}

bool holds(const PoseBatch &poses, uint32_t lane, const Rigid &wanted) {
  for (uint32_t s = 0; s < kMaxSolutions; ++s)
    if (poses.valid[s][lane] != 0.0f && distance(poses.pose(s, lane), wanted) < 1e-3) return true;
  return false;
}

TEST(Minimal, TheTruthIsAmongTheSolutions) {
  Random random(1);
  int found = 0, tried = 0, of_double = 0, of_double_found = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    Sample samples[kMinimalBatch];
    MinimalBatch batch;
    PoseBatch poses;
    for (uint32_t lane = 0; lane < kMinimalBatch; ++lane) put(samples[lane] = randomSample(&random), lane, &batch);
    simdPoseKernels().solve_p3p(batch, &poses);
    for (uint32_t lane = 0; lane < kMinimalBatch; ++lane) {
      const Sample &s = samples[lane];
      ++tried;
      found += holds(poses, lane, s.camera_from_map);
      for (const Rigid &map_from_camera : solveP3p(s.direction, s.point)) {
        ++of_double;
        of_double_found += holds(poses, lane, map_from_camera.inverse());
      }
    }
  }
  RecordProperty("truth_missed_of_16000", tried - found);
  RecordProperty("double_missed", of_double - of_double_found);
  EXPECT_GT(found, 0.99 * tried);
  EXPECT_GT(of_double_found, 0.99 * of_double) << "of " << of_double;
}

TEST(Minimal, EverySolutionSolves) {
  Random random(2);
  int solutions = 0, wrong = 0;
  for (int trial = 0; trial < 500; ++trial) {
    Sample samples[kMinimalBatch];
    MinimalBatch batch;
    PoseBatch poses;
    for (uint32_t lane = 0; lane < kMinimalBatch; ++lane) {
      samples[lane] = randomSample(&random);
      for (Vector3 &direction : samples[lane].direction)
        if (trial % 2) direction = test::randomDirection(&random);  // fakes seldom fit anything
      put(samples[lane], lane, &batch);
    }
    simdPoseKernels().solve_p3p(batch, &poses);
    for (uint32_t lane = 0; lane < kMinimalBatch; ++lane)
      for (uint32_t s = 0; s < kMaxSolutions; ++s) {
        if (poses.valid[s][lane] == 0.0f) continue;
        ++solutions;
        const PoseF pose = poses.pose(s, lane);
        Rigid rigid;
        for (int i = 0; i < 9; ++i) rigid.rotation(i / 3, i % 3) = static_cast<double>(pose.r[i]);
        for (int i = 0; i < 3; ++i) rigid.translation_m[i] = static_cast<double>(pose.t[i]);
        EXPECT_LT((rigid.rotation * rigid.rotation.transpose() - Matrix3::Identity()).norm(), 1e-4);
        EXPECT_NEAR(rigid.rotation.determinant(), 1, 1e-4);
        double off = 0;
        for (int k = 0; k < 3; ++k)
          off = std::max(
              off, ((rigid.inverse() * samples[lane].point[k]).normalized() - samples[lane].direction[k]).norm());
        wrong += off > 5e-3;
      }
  }
  EXPECT_GT(solutions, 500 * 8);
  EXPECT_LT(wrong, 0.01 * solutions) << "of " << solutions;
}

// Whatever comes, a pose marked valid is made of numbers.
bool givesNumbers(const Sample &sample) {
  MinimalBatch batch;
  PoseBatch poses;
  for (uint32_t lane = 0; lane < kMinimalBatch; ++lane) put(sample, lane, &batch);
  bool numbers = true;
  for (const PoseKernels *kernels : {&simdPoseKernels(), &scalarPoseKernels()}) {
    kernels->solve_p3p(batch, &poses);
    for (uint32_t s = 0; s < kMaxSolutions; ++s) {
      if (poses.valid[s][0] == 0.0f) continue;
      const PoseF pose = poses.pose(s, 0);
      for (float x : pose.r) numbers = numbers && std::isfinite(x);
      for (float x : pose.t) numbers = numbers && std::isfinite(x);
    }
  }
  return numbers;
}

// Spoils many good samples.
template <typename Spoil>
void expectNumbersAfter(const Spoil &spoil) {
  Random random(3);
  int without = 0;
  for (int i = 0; i < 500; ++i) {
    Sample s = randomSample(&random);
    spoil(&s);
    without += !givesNumbers(s);
  }
  EXPECT_EQ(without, 0) << "of 500";
}

TEST(Minimal, OnePointTwice) {
  expectNumbersAfter([](Sample *s) { s->point[1] = s->point[0]; });
  expectNumbersAfter([](Sample *s) { s->point[2] = s->point[1]; });
  expectNumbersAfter([](Sample *s) { s->point[0] = s->point[2]; });
}
TEST(Minimal, OneDirectionTwice) {
  expectNumbersAfter([](Sample *s) { s->direction[1] = s->direction[0]; });
  expectNumbersAfter([](Sample *s) { s->direction[2] = s->direction[1]; });
  expectNumbersAfter([](Sample *s) { s->direction[2] = s->direction[1] = s->direction[0]; });
}
TEST(Minimal, OneCorrespondenceTwice) {
  for (int k = 0; k < 3; ++k)
    expectNumbersAfter([&](Sample *s) {
      s->point[k] = s->point[(k + 1) % 3];
      s->direction[k] = s->direction[(k + 1) % 3];
    });
  expectNumbersAfter([](Sample *s) {
    s->point[2] = s->point[1] = s->point[0];
    s->direction[2] = s->direction[1] = s->direction[0];
  });
}
TEST(Minimal, PointsOnALine) {
  expectNumbersAfter([](Sample *s) {
    s->point[2] = 0.3 * s->point[0] + 0.7 * s->point[1];
    s->direction[2] = (s->camera_from_map.inverse() * s->point[2]).normalized();
  });
}
TEST(Minimal, NothingAtAll) {
  expectNumbersAfter([](Sample *s) {
    for (Vector3 &point : s->point) point.setZero();
  });
  for (int k = 0; k < 3; ++k) expectNumbersAfter([&](Sample *s) { s->direction[k].setZero(); });
  expectNumbersAfter([](Sample *s) {
    for (Vector3 &direction : s->direction) direction.setZero();
  });
}
TEST(Minimal, OppositeDirections) {
  expectNumbersAfter([](Sample *s) { s->direction[1] = -s->direction[0]; });
}
TEST(Minimal, PointsOutOfAllReason) {
  for (double scale : {1e-30, 1e30})
    expectNumbersAfter([&](Sample *s) {
      for (Vector3 &point : s->point) point *= scale;
    });
}

}  // namespace
}  // namespace sphc
