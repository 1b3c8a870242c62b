// Every instruction set gives the scalar version's bits.
#include "runtime/stages/pose/kernels.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <set>

#include "tests/support/every_instruction_set.h"
#include "tests/support/pose_rows.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

constexpr uint32_t kCounts[] = {1, 15, 16, 63, 64, 65, 300};

::testing::AssertionResult sameBits(const float *a, const float *b, size_t count) {
  for (size_t i = 0; i < count; ++i)
    if (std::memcmp(a + i, b + i, sizeof(float)) != 0)
      return ::testing::AssertionFailure() << a[i] << " and " << b[i] << " at " << i;
  return ::testing::AssertionSuccess();
}

// Some agree with the pose and some do not; some have no depth; of a rig some are seen by another camera.
std::vector<Correspondence> randomCorrespondences(const Rigid &pose, uint32_t count, bool is_of_rig,
                                                  Random *random) {
  std::vector<Correspondence> out;
  for (uint32_t i = 0; i < count; ++i) {
    const Vector3 point = test::pointInView(random);
    const Vector3 noise = (i % 3 == 0 ? 1.0 : 0.02) * test::normalVector(random);
    Correspondence c = {{point, 0.002 + 0.01 * random->uniform(), 0.005 + 0.05 * random->uniform()},
                        (pose.inverse() * (point + noise)).normalized()};
    if (i % 4 == 1)
      c.lifted = {point.normalized(), 0.001 + 0.01 * random->uniform(), std::numeric_limits<double>::infinity()};
    if (is_of_rig && i % 3 == 0) c.lifted.centre_m = (0.1 * test::normalVector(random)).cast<float>();
    out.push_back(c);
  }
  return out;
}

struct RowsProblem {
  Rigid pose;
  std::vector<Correspondence> correspondences;
};
RowsProblem randomProblem(uint32_t count, bool is_of_rig, Random *random) {
  RowsProblem p;
  p.pose = {test::randomRotation(random), 2 * test::normalVector(random)};
  p.correspondences = randomCorrespondences(p.pose, count, is_of_rig, random);
  return p;
}

NormalTask taskAt(const Rigid &pose, bool with_bias) {
  NormalTask task = {};
  task.pose = poseF(pose);
  task.correction = {0.02f, -0.03f, 2.0f, 1.0f};
  task.inverse_scale2 = 1 / 8.0f;
  task.gate2 = 512;
  task.with_bias = with_bias;
  return task;
}

template <typename Check>
void onRandomProblems(const Check &check) {
  test::withEveryInstructionSet([&](const char *name) {
    SCOPED_TRACE(name);
    Random random(1);
    for (uint32_t count : kCounts)
      for (int trial = 0; trial < 6; ++trial) check(randomProblem(count, trial % 2 == 1, &random));
  });
}

TEST(Kernels, PrepareGivesTheScalarBits) {
  onRandomProblems([](const RowsProblem &problem) {
    test::OwnedRows ours(problem.correspondences), scalar(problem.correspondences);
    const DepthCorrection correction = {-0.01f, 0.02f, 2.0f, 1.3f};
    simdPoseKernels().prepare(&ours.rows, correction);
    scalarPoseKernels().prepare(&scalar.rows, correction);
    for (uint32_t f = 0; f < ours.rows.fieldCount(); ++f)
      EXPECT_TRUE(sameBits(ours.rows.field[f], scalar.rows.field[f], ours.rows.padded)) << "field " << f;
  });
}

TEST(Kernels, ScoreGivesTheScalarBits) {
  onRandomProblems([](const RowsProblem &problem) {
    const test::OwnedRows owned(problem.correspondences, scalarPoseKernels());
    const PoseF pose = poseF(problem.pose);
    const float count = static_cast<float>(problem.correspondences.size());
    // to the end; given up as it cannot be best; given up by Wald's test
    for (const ScoreLimits &limits : {ScoreLimits{1 / 12.0f, -1, 0, 0}, ScoreLimits{1 / 12.0f, 0.95f * count, 0, 0},
                                      ScoreLimits{1 / 12.0f, -1, 0.9f, 2}}) {
      const Score ours = simdPoseKernels().score(owned.rows, pose, limits);
      const Score scalar = scalarPoseKernels().score(owned.rows, pose, limits);
      EXPECT_TRUE(sameBits(&ours.gain, &scalar.gain, 1));
      EXPECT_TRUE(sameBits(&ours.seen, &scalar.seen, 1));
    }
  });
}

TEST(Kernels, ResidualsGiveTheScalarBits) {
  onRandomProblems([](const RowsProblem &problem) {
    const test::OwnedRows owned(problem.correspondences, scalarPoseKernels());
    const uint32_t padded = owned.rows.padded;
    std::vector<float> ours(padded), scalar(padded);
    for (const bool with_bias : {false, true}) {
      const NormalTask task = taskAt(problem.pose, with_bias);
      simdPoseKernels().residuals(owned.rows, task, ours.data());
      scalarPoseKernels().residuals(owned.rows, task, scalar.data());
      EXPECT_TRUE(sameBits(ours.data(), scalar.data(), padded));
      simdPoseKernels().plane_residuals(owned.rows, task, ours.data());
      scalarPoseKernels().plane_residuals(owned.rows, task, scalar.data());
      EXPECT_TRUE(sameBits(ours.data(), scalar.data(), padded));
    }
  });
}

void expectSameSums(const NormalSums &ours, const NormalSums &scalar) {
  EXPECT_TRUE(sameBits(ours.matrix, scalar.matrix, kNormalEntries));
  EXPECT_TRUE(sameBits(ours.gradient, scalar.gradient, kPoseUnknowns));
  EXPECT_TRUE(sameBits(&ours.cost, &scalar.cost, 1));
}

TEST(Kernels, EquationsGiveTheScalarBits) {
  onRandomProblems([](const RowsProblem &problem) {
    const test::OwnedRows owned(problem.correspondences, scalarPoseKernels());
    NormalSums ours, scalar;
    for (const bool with_bias : {false, true}) {
      const NormalTask task = taskAt(problem.pose, with_bias);
      simdPoseKernels().lifted_equations(owned.rows, task, &ours);
      scalarPoseKernels().lifted_equations(owned.rows, task, &scalar);
      expectSameSums(ours, scalar);
      simdPoseKernels().plane_equations(owned.rows, task, &ours);
      scalarPoseKernels().plane_equations(owned.rows, task, &scalar);
      expectSameSums(ours, scalar);
    }
  });
}

MinimalBatch batchOf(const RowsProblem &problem) {
  MinimalBatch batch;
  for (uint32_t lane = 0; lane < kMinimalBatch; ++lane)
    for (uint32_t k = 0; k < 3; ++k) {
      const Correspondence &c = problem.correspondences[3 * lane + k];
      for (int axis = 0; axis < 3; ++axis) {
        batch.point_m[k][axis][lane] = static_cast<float>(c.lifted.point_m[axis]);
        batch.direction[k][axis][lane] = static_cast<float>(c.direction[axis]);
      }
    }
  return batch;
}

void expectSamePoses(const PoseBatch &ours, const PoseBatch &scalar, uint32_t *valid) {
  EXPECT_TRUE(sameBits(&ours.valid[0][0], &scalar.valid[0][0], kMaxSolutions * kMinimalBatch));
  for (uint32_t solution = 0; solution < kMaxSolutions; ++solution)
    for (uint32_t sample = 0; sample < kMinimalBatch; ++sample) {
      if (ours.valid[solution][sample] == 0.0f) continue;
      ++*valid;
      const PoseF a = ours.pose(solution, sample), b = scalar.pose(solution, sample);
      EXPECT_TRUE(sameBits(a.r, b.r, 9));
      EXPECT_TRUE(sameBits(a.t, b.t, 3));
    }
}

TEST(Kernels, SolversGiveTheScalarBits) {
  test::withEveryInstructionSet([](const char *name) {
    SCOPED_TRACE(name);
    Random random(2);
    uint32_t valid = 0, valid_upright = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const MinimalBatch batch = batchOf(randomProblem(3 * kMinimalBatch, false, &random));
      PoseBatch ours, scalar;
      simdPoseKernels().solve_p3p(batch, &ours);
      scalarPoseKernels().solve_p3p(batch, &scalar);
      expectSamePoses(ours, scalar, &valid);
      UprightFrames frames;
      const Rigid from_map = {test::randomRotation(&random), {}}, from_camera = {test::randomRotation(&random), {}};
      std::memcpy(frames.upright_from_map, poseF(from_map).r, sizeof frames.upright_from_map);
      std::memcpy(frames.upright_from_camera, poseF(from_camera).r, sizeof frames.upright_from_camera);
      simdPoseKernels().solve_upright(batch, frames, &ours);
      scalarPoseKernels().solve_upright(batch, frames, &scalar);
      expectSamePoses(ours, scalar, &valid_upright);
    }
    EXPECT_GT(valid, 200 * kMinimalBatch / 2);
    EXPECT_GT(valid_upright, 200 * kMinimalBatch / 4);
  });
}

// The tests above would not notice one instruction set tried many times.
TEST(Kernels, EveryTargetIsAnother) {
  int targets = 0;
  std::set<const PoseKernels *> kernels;
  test::withEveryInstructionSet([&](const char *name) {
    SCOPED_TRACE(name);
    ++targets;
    kernels.insert(&simdPoseKernels());
  });
  RecordProperty("targets", targets);
  EXPECT_EQ(kernels.size(), static_cast<size_t>(targets));
  EXPECT_EQ(kernels.count(&scalarPoseKernels()), 0u);
}

}  // namespace
}  // namespace sphc
