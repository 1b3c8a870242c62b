#include "runtime/stages/pose/sampler.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/arena_memory.h"
#include "tests/support/pose_rows.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

struct OwnedSampler {
  explicit OwnedSampler(uint32_t capacity)
      : memory([&](Arena &arena, bool real) { Sampler::layout(capacity, arena, real ? &sampler : nullptr); }) {}
  Sampler sampler;
  test::ArenaMemory memory;
};

struct Rows {
  explicit Rows(size_t count) : world(makeWorld(count)), owned(world.correspondences, simdPoseKernels()) {}
  static test::PoseWorld makeWorld(size_t count) {
    test::PoseWorldOptions options;
    options.count = count;
    return test::makePoseWorld(options);
  }
  // Row of a sample's point.
  uint32_t rowOf(const MinimalBatch &batch, uint32_t k, uint32_t lane) const {
    for (uint32_t i = 0; i < owned.rows.count; ++i)
      if (owned.rows.field[kPointX][i] == batch.point_m[k][0][lane]) return i;
    return owned.rows.count;
  }
  test::PoseWorld world;
  test::OwnedRows owned;
};

TEST(Sampler, DrawsRowsWithTheirDirections) {
  const Rows rows(100);
  const std::vector<float> quality(100, 0.0f);
  OwnedSampler s(100);
  s.sampler.start(rows.owned.rows, {quality.data(), 100}, 3, 5);
  std::vector<int> drawn(100);
  for (int trial = 0; trial < 100; ++trial) {
    MinimalBatch batch;
    s.sampler.draw(&batch);
    for (uint32_t lane = 0; lane < kMinimalBatch; ++lane)
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t row = rows.rowOf(batch, k, lane);
        ASSERT_LT(row, 100u);
        ++drawn[row];
        EXPECT_EQ(batch.direction[k][1][lane], rows.owned.rows.field[kDirectionY][row]);
      }
  }
  for (int times : drawn) {  // 48 on average
    EXPECT_GT(times, 10);
    EXPECT_LT(times, 120);
  }
}

TEST(Sampler, SamplesAreSpreadOut) {
  const Rows rows(100);
  const std::vector<float> quality(100, 0.0f);
  OwnedSampler s(100);
  for (uint32_t size : {2u, 3u}) {
    s.sampler.start(rows.owned.rows, {quality.data(), 100}, size, 5);
    int twice = 0;
    for (int trial = 0; trial < 100; ++trial) {
      MinimalBatch batch;
      s.sampler.draw(&batch);
      for (uint32_t lane = 0; lane < kMinimalBatch; ++lane)
        for (uint32_t k = 0; k < size; ++k)
          twice += batch.point_m[k][0][lane] == batch.point_m[(k + 1) % size][0][lane];
    }
    EXPECT_LE(twice, 4) << "of 1600 samples";
  }
}

TEST(Sampler, OneSeedOneSequence) {
  const Rows rows(100);
  const std::vector<float> quality(100, 0.0f);
  OwnedSampler s(100);
  MinimalBatch first, again, other;
  s.sampler.start(rows.owned.rows, {quality.data(), 100}, 3, 5);
  s.sampler.draw(&first);
  s.sampler.start(rows.owned.rows, {quality.data(), 100}, 3, 5);
  s.sampler.draw(&again);
  s.sampler.start(rows.owned.rows, {quality.data(), 100}, 3, 6);
  s.sampler.draw(&other);
  EXPECT_EQ(std::memcmp(&first, &again, sizeof first), 0);
  EXPECT_NE(std::memcmp(&first, &other, sizeof first), 0);
}

TEST(Sampler, TheBestComeFirstAndAllComeInTheEnd) {
  const Rows rows(100);
  std::vector<float> quality(100);
  for (uint32_t i = 0; i < 100; ++i) quality[i] = static_cast<float>(i * 37 % 100) / 100.0f;
  OwnedSampler s(100);
  s.sampler.start(rows.owned.rows, {quality.data(), 100}, 3, 5);
  float lowest_first = 1, lowest_last = 1;
  for (int trial = 0; trial < 40; ++trial) {
    MinimalBatch batch;
    s.sampler.draw(&batch);
    for (uint32_t lane = 0; lane < kMinimalBatch; ++lane)
      for (uint32_t k = 0; k < 3; ++k) {
        float &lowest = trial == 0 ? lowest_first : lowest_last;
        lowest = std::min(lowest, quality[rows.rowOf(batch, k, lane)]);
      }
  }
  EXPECT_GT(lowest_first, 0.65f);
  EXPECT_LT(lowest_last, 0.1f);
}

TEST(Sampler, FewRowsAndRowsAtOnePlaceDoNotHang) {
  for (size_t count : {1u, 3u, 7u}) {
    const Rows rows(count);
    const std::vector<float> quality = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f};
    OwnedSampler s(static_cast<uint32_t>(count));
    s.sampler.start(rows.owned.rows, {quality.data(), count}, 3, 5);
    MinimalBatch batch;
    for (int trial = 0; trial < 20; ++trial) s.sampler.draw(&batch);
    EXPECT_LT(rows.rowOf(batch, 2, 3), count);
  }
}

}  // namespace
}  // namespace sphc
