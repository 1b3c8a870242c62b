#include "host/base/on_threads.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <stdexcept>

#include "tests/support/is_sanitized.h"

namespace sphc::host {
namespace {

TEST(OnThreads, EachNumberIsGivenOnce) {
  std::atomic<int> sum{0};
  onThreads(4, [&](size_t i) { sum += 1 << (4 * i); });
  EXPECT_EQ(sum, 0x1111);
}

TEST(OnThreads, WhatOneThrowsComesOutWhenAllAreOver) {
  std::atomic<int> over{0};
  const auto work = [&](size_t i) {
    if (i == 2) throw std::runtime_error("two");
    ++over;
  };
  EXPECT_THROW(onThreads(4, work), std::runtime_error);
  EXPECT_EQ(over, 3);
}

TEST(OnThreads, FewerWhereTheSystemHasNoMore) {
  if (kIsSanitized) GTEST_SKIP() << "a sanitizer needs address space of its own";
  rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  const rlimit no_more = {1 << 20, before.rlim_max};  // of what is taken nothing is lost
  ASSERT_EQ(setrlimit(RLIMIT_AS, &no_more), 0);
  std::atomic<int> calls{0};
  onThreads(64, [&](size_t) { ++calls; });
  ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_GE(calls, 1);
  EXPECT_LT(calls, 64);  // stacks of threads that are over are used again
}

}  // namespace
}  // namespace sphc::host
