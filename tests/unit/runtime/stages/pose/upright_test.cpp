// The solver for a known vertical, against constructed poses.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "runtime/stages/pose/kernels.h"
#include "tests/support/pose_world.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

// Some rotation that takes `up` to z.
Matrix3 uprightFrom(const Vector3 &up) {
  const Vector3 across = up.unitOrthogonal();
  Matrix3 rotation;
  rotation << across.transpose(), up.cross(across).transpose(), up.transpose();
  return rotation;
}

struct UprightProblem {
  Rigid camera_from_map;
  UprightFrames frames;
  Vector3 point[2], direction[2];
};

UprightProblem randomUpright(Random *random) {
  UprightProblem p;
  p.camera_from_map = {test::randomRotation(random), test::normalVector(random) + Vector3(0, 0, 2)};
  const Vector3 up = test::randomDirection(random);
  const Rigid from_map = {uprightFrom(up), {}}, from_camera = {uprightFrom(p.camera_from_map.rotation * up), {}};
  std::memcpy(p.frames.upright_from_map, poseF(from_map).r, sizeof p.frames.upright_from_map);
  std::memcpy(p.frames.upright_from_camera, poseF(from_camera).r, sizeof p.frames.upright_from_camera);
  do {
    for (int k = 0; k < 2; ++k) {
      p.point[k] = test::pointInView(random);
      p.direction[k] = (p.camera_from_map.inverse() * p.point[k]).normalized();
    }
  } while ((p.point[0] - p.point[1]).norm() < 0.5);
  return p;
}

PoseBatch solve(const UprightProblem &p, const PoseKernels &kernels = simdPoseKernels()) {
  MinimalBatch batch = {};
  for (uint32_t lane = 0; lane < kMinimalBatch; ++lane)
    for (int k = 0; k < 2; ++k)
      for (int axis = 0; axis < 3; ++axis) {
        batch.point_m[k][axis][lane] = static_cast<float>(p.point[k][axis]);
        batch.direction[k][axis][lane] = static_cast<float>(p.direction[k][axis]);
      }
  PoseBatch poses;
  kernels.solve_upright(batch, p.frames, &poses);
  return poses;
}

double distance(const PoseF &a, const PoseF &b) {
  float sum = 0;
  for (int i = 0; i < 9; ++i) sum += std::abs(a.r[i] - b.r[i]);
  for (int i = 0; i < 3; ++i) sum += std::abs(a.t[i] - b.t[i]);
  return static_cast<double>(sum);
}

TEST(Upright, TheTruthIsAmongTheSolutions) {
  Random random(1);
  constexpr int kTrials = 3000;
  int found = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const UprightProblem p = randomUpright(&random);
    const PoseBatch poses = solve(p);
    double best = 1e9;
    for (uint32_t s = 0; s < kMaxSolutions; ++s)
      if (poses.valid[s][0] != 0.0f) best = std::min(best, distance(poses.pose(s, 0), poseF(p.camera_from_map)));
    found += best < 5e-3;
  }
  RecordProperty("missed_of_3000", kTrials - found);
  EXPECT_GT(found, 0.99 * kTrials);
}

TEST(Upright, EverySolutionKeepsTheVertical) {
  Random random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    UprightProblem p = randomUpright(&random);
    if (trial % 2) p.direction[1] = test::randomDirection(&random);
    const PoseBatch poses = solve(p);
    for (uint32_t s = 0; s < kMaxSolutions; ++s) {
      if (poses.valid[s][0] == 0.0f) continue;
      const PoseF pose = poses.pose(s, 0);
      const float *up_map = p.frames.upright_from_map + 6, *up_camera = p.frames.upright_from_camera + 6;
      for (int i = 0; i < 3; ++i) {
        const float turned =
            pose.r[3 * i] * up_map[0] + pose.r[3 * i + 1] * up_map[1] + pose.r[3 * i + 2] * up_map[2];
        EXPECT_NEAR(turned, up_camera[i], 1e-5);
      }
    }
  }
}

void expectNumbers(const UprightProblem &p) {
  for (const PoseKernels *kernels : {&simdPoseKernels(), &scalarPoseKernels()}) {
    const PoseBatch poses = solve(p, *kernels);
    for (uint32_t s = 0; s < kMaxSolutions; ++s) {
      if (poses.valid[s][0] == 0.0f) continue;
      const PoseF pose = poses.pose(s, 0);
      for (float x : pose.r) ASSERT_TRUE(std::isfinite(x));
      for (float x : pose.t) ASSERT_TRUE(std::isfinite(x));
    }
  }
}

TEST(Upright, DegenerateSamplesGiveNoPoseWithoutNumbers) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const UprightProblem good = randomUpright(&random);
    UprightProblem p = good;
    p.point[1] = p.point[0];  // one point twice
    expectNumbers(p);
    p.direction[1] = p.direction[0];  // one correspondence twice
    expectNumbers(p);
    p = good, p.direction[1] = p.direction[0];
    expectNumbers(p);
    p = good, p.direction[0] = p.direction[1] = Vector3::Zero();
    expectNumbers(p);
    p = good, p.point[0] = p.point[1] = Vector3::Zero();
    expectNumbers(p);
    p = good;  // both directions are level
    for (Vector3 &d : p.direction)
      d = test::randomDirection(&random)
              .cross(Vector3(static_cast<double>(p.frames.upright_from_map[6]),
                             static_cast<double>(p.frames.upright_from_map[7]),
                             static_cast<double>(p.frames.upright_from_map[8])))
              .normalized();
    expectNumbers(p);
    p = good, p.direction[1] = -p.direction[0];
    expectNumbers(p);
    std::memset(&p.frames, 0, sizeof p.frames);
    expectNumbers(p);
  }
}

}  // namespace
}  // namespace sphc
