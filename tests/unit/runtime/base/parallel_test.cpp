#include "runtime/base/parallel.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/backwards.h"

namespace sphc {
namespace {

TEST(Parallel, PartsAreAllAndAboutAsLarge) {
  for (const size_t size : {0u, 1u, 7u, 480u})
    for (uint32_t pieces = 1; pieces <= Parallel::kMostPieces; ++pieces) {
      size_t end = 0;
      for (uint32_t i = 0; i < pieces; ++i) {
        const Part part = partOf(size, pieces, i);
        EXPECT_EQ(part.first, end);
        EXPECT_LE(part.size(), size / pieces + 1);
        end = part.end;
      }
      EXPECT_EQ(end, size);
    }
}

TEST(Parallel, OnePieceNeedsNoFunction) {
  const Parallel alone;
  std::vector<uint32_t> order;
  alone.forEach(0, [&](uint32_t i) { order.push_back(i); });
  alone.forEach(1, [&](uint32_t i) { order.push_back(i); });
  alone.both([&] { order.push_back(1); }, [&] { order.push_back(2); });
  EXPECT_EQ(order, (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_TRUE(alone.allOf(1, [](uint32_t) { return true; }));
  EXPECT_FALSE(alone.allOf(1, [](uint32_t) { return false; }));
}

TEST(Parallel, TheFunctionRunsSeveral) {
  uint32_t calls = 0;
  const Parallel parallel = test::backwards(3, &calls);
  std::vector<uint32_t> order;
  parallel.forEach(3, [&](uint32_t i) { order.push_back(i); });
  parallel.both([&] { order.push_back(10); }, [&] { order.push_back(11); });
  EXPECT_EQ(order, (std::vector<uint32_t>{2, 1, 0, 11, 10}));
  EXPECT_TRUE(parallel.allOf(3, [](uint32_t) { return true; }));
  EXPECT_FALSE(parallel.allOf(3, [](uint32_t i) { return i != 2; }));
  EXPECT_EQ(calls, 4u);
}

// What a caller's pool must not do, and does: the pieces are done once all the same.
TEST(Parallel, EachPieceIsDoneOnceByAnyFunction) {
  using Pool = void (*)(void *, uint32_t, Parallel::Task, void *);
  const Pool skips = [](void *, uint32_t count, Parallel::Task task, void *data) {
    for (uint32_t i = 0; i < count; i += 2) task(data, i);
  };
  const Pool does_nothing = [](void *, uint32_t, Parallel::Task, void *) {};
  const Pool repeats = [](void *, uint32_t count, Parallel::Task task, void *data) {
    for (uint32_t i = 0; i < 2 * count; ++i) task(data, i / 2);
  };
  const Pool goes_beyond = [](void *, uint32_t count, Parallel::Task task, void *data) {
    for (const uint32_t i : {UINT32_MAX, count + 32, count, 0u}) task(data, i);
  };
  for (const Pool run : {skips, does_nothing, repeats, goes_beyond}) {
    const Parallel parallel = {run, nullptr, 3};
    std::vector<uint32_t> done(3, 0);
    parallel.forEach(3, [&](uint32_t i) { ++done.at(i); });
    EXPECT_EQ(done, std::vector<uint32_t>(3, 1));
    EXPECT_TRUE(parallel.allOf(3, [](uint32_t) { return true; }));
  }
}

}  // namespace
}  // namespace sphc
