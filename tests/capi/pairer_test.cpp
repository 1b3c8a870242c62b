#include <gtest/gtest.h>

#include "spherecloud/spherecloud_capture.h"
#include "tests/capi/bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::test::expectMentions;
using sphc::test::GuardedMemory;
using sphc::test::Output;

class CInterfacePairer : public testing::Test {
 protected:
  void SetUp() override {
    sphc_memory need = {};
    ASSERT_EQ(sphc_pairer_memory(&need), SPHC_OK);
    bytes_ = need.state_bytes;
    memory_ = GuardedMemory(bytes_, need.alignment);
    ASSERT_EQ(sphc_pairer_config_init(&config_, sizeof config_), SPHC_OK);
  }
  sphc_status init() { return sphc_pairer_init(memory_.data(), bytes_, &config_, &pairer_, &message_); }
  static sphc_capture capture(sphc_stream stream, int64_t time_ns) {
    sphc_capture c = {};
    c.struct_size = sizeof c;
    c.stream = stream;
    c.time_ns = time_ns;
    return c;
  }

  size_t bytes_ = 0;
  GuardedMemory memory_;
  sphc_pairer_config config_ = {};
  sphc_pairer *pairer_ = nullptr;
  sphc_message message_ = {};
};

TEST_F(CInterfacePairer, PairsThroughTheCInterface) {
  EXPECT_EQ(config_.slots, 4u);
  EXPECT_EQ(config_.tolerance_ns, 20000000);
  ASSERT_EQ(init(), SPHC_OK);
  const sphc_capture color = capture(SPHC_STREAM_COLOR, 100), depth = capture(SPHC_STREAM_DEPTH, 105);
  EXPECT_EQ(sphc_pairer_push(pairer_, &color), SPHC_OK);
  EXPECT_EQ(sphc_pairer_push(pairer_, &depth), SPHC_OK);
  sphc_capture first = {}, second = {}, dropped = {};
  EXPECT_EQ(sphc_pairer_pop(pairer_, &first, &second, &dropped), SPHC_OK);
  EXPECT_EQ(first.time_ns, 100);
  EXPECT_EQ(second.time_ns, 105);
  EXPECT_EQ(sphc_pairer_pop(pairer_, &first, &second, &dropped), SPHC_AGAIN);
  EXPECT_EQ(dropped.stream, SPHC_STREAM_NONE);
  EXPECT_TRUE(memory_.guardsIntact());
  sphc_pairer_fini(&pairer_);
  EXPECT_EQ(pairer_, nullptr);
}

TEST_F(CInterfacePairer, ForbiddenInits) {
  EXPECT_EQ(sphc_pairer_config_init(nullptr, sizeof config_), SPHC_E_ARGUMENT);
  Output<sphc_pairer_config> untouched;
  EXPECT_EQ(sphc_pairer_config_init(untouched.get(), sizeof config_ - 1), SPHC_E_STRUCT_SIZE);
  EXPECT_TRUE(untouched.untouched());
  EXPECT_EQ(sphc_pairer_memory(nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_pairer_init(nullptr, bytes_, &config_, &pairer_, &message_), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_pairer_init(memory_.data(), bytes_, nullptr, &pairer_, &message_), SPHC_E_ARGUMENT);
  expectMentions(message_.text, "config is null");
  EXPECT_EQ(sphc_pairer_init(memory_.data(), bytes_, &config_, nullptr, &message_), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_pairer_init(memory_.data(), bytes_ - 1, &config_, &pairer_, &message_), SPHC_E_MEMORY_SIZE);
  GuardedMemory larger(bytes_ + 64, 64);
  EXPECT_EQ(sphc_pairer_init(static_cast<uint8_t *>(larger.data()) + 1, bytes_, &config_, &pairer_, &message_),
            SPHC_E_MEMORY_ALIGNMENT);
  for (uint32_t slots : {0u, SPHC_PAIRER_SLOTS + 1, UINT32_MAX}) {
    config_.slots = slots;
    EXPECT_EQ(init(), SPHC_E_ARGUMENT);
    expectMentions(message_.text, "slots");
  }
  config_.slots = 4;
  config_.tolerance_ns = -1;
  EXPECT_EQ(init(), SPHC_E_ARGUMENT);
  config_.tolerance_ns = 0;
  config_.struct_size = 3;
  EXPECT_EQ(init(), SPHC_E_STRUCT_SIZE);
  expectMentions(message_.text, "struct_size is 3");
  EXPECT_EQ(pairer_, nullptr);
}

TEST_F(CInterfacePairer, ForbiddenCalls) {
  ASSERT_EQ(init(), SPHC_OK);
  sphc_capture color = capture(SPHC_STREAM_COLOR, 1);
  EXPECT_EQ(sphc_pairer_push(nullptr, &color), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_pairer_push(pairer_, nullptr), SPHC_E_ARGUMENT);
  color.struct_size = 0;
  EXPECT_EQ(sphc_pairer_push(pairer_, &color), SPHC_E_STRUCT_SIZE);
  Output<sphc_capture> first, second, dropped;
  EXPECT_EQ(sphc_pairer_pop(nullptr, first.get(), second.get(), dropped.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_pairer_pop(pairer_, nullptr, second.get(), dropped.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_pairer_pop(pairer_, first.get(), nullptr, dropped.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_pairer_pop(pairer_, first.get(), second.get(), nullptr), SPHC_E_ARGUMENT);
  EXPECT_TRUE(first.untouched() && second.untouched());
  EXPECT_TRUE(dropped.untouched());
  Output<sphc_pairer_counts> counts;
  EXPECT_EQ(sphc_pairer_get_counts(nullptr, counts.get()), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_pairer_get_counts(pairer_, nullptr), SPHC_E_ARGUMENT);
  for (const uint32_t struct_size : {0u, 3u, uint32_t{sizeof(sphc_pairer_counts)} - 8}) {
    Output<sphc_pairer_counts> sized;
    sized->struct_size = struct_size;
    EXPECT_EQ(sphc_pairer_get_counts(pairer_, sized.get()), SPHC_E_STRUCT_SIZE) << struct_size;
    sized->struct_size = counts->struct_size;
    EXPECT_TRUE(sized.untouched()) << struct_size;
  }
  sphc_pairer_flush(nullptr);
  sphc_pairer_fini(nullptr);
}

// Each of them another number, so that none stands in the place of another.
TEST_F(CInterfacePairer, CountsPairsDropsAndLosses) {
  ASSERT_EQ(init(), SPHC_OK);
  const auto push = [&](sphc_stream stream, int64_t time_ms, uint32_t sequence) {
    sphc_capture pushed = capture(stream, 1000000 * time_ms);
    pushed.sequence = sequence;
    EXPECT_EQ(sphc_pairer_push(pairer_, &pushed), SPHC_OK) << time_ms;
    sphc_capture color = {}, depth = {}, dropped = {};
    do {
      dropped.stream = SPHC_STREAM_NONE;
    } while (sphc_pairer_pop(pairer_, &color, &depth, &dropped) == SPHC_OK || dropped.stream != SPHC_STREAM_NONE);
  };
  uint32_t color = 0, depth = 0;
  for (const int64_t time_ms : {0, 30, 60, 90, 120}) {
    push(SPHC_STREAM_COLOR, time_ms, color++);
    push(SPHC_STREAM_DEPTH, time_ms, depth++);
  }
  push(SPHC_STREAM_DEPTH, 140, depth++);  // overtaken by the next two
  push(SPHC_STREAM_DEPTH, 145, depth++);
  push(SPHC_STREAM_COLOR, 150, color++);
  push(SPHC_STREAM_DEPTH, 150, depth++);
  push(SPHC_STREAM_COLOR, 250, color += 7);  // seven never came, nor did eight; too far from each other
  push(SPHC_STREAM_DEPTH, 350, depth += 8);
  for (int64_t time_ms = 380; time_ms < 380 + 7 * 30; time_ms += 30) push(SPHC_STREAM_DEPTH, time_ms, ++depth);
  struct {
    sphc_pairer_counts its;
    uint8_t behind[8];
  } told;
  std::memset(&told, 0x5A, sizeof told);
  told.its.struct_size = sizeof told.its;
  const auto expectTold = [&](sphc_pairer_drop last_drop, uint64_t full, uint64_t ended) {
    ASSERT_EQ(sphc_pairer_get_counts(pairer_, &told.its), SPHC_OK);
    EXPECT_EQ(told.its.struct_size, sizeof told.its);
    EXPECT_EQ(told.its.last_drop, last_drop);
    EXPECT_EQ(told.its.pairs, 6u);
    EXPECT_EQ(told.its.too_far, 1u);
    EXPECT_EQ(told.its.overtaken, 2u);
    EXPECT_EQ(told.its.full, full);
    EXPECT_EQ(told.its.ended, ended);
    EXPECT_EQ(told.its.color_lost, 7u);
    EXPECT_EQ(told.its.depth_lost, 8u);
    for (const uint8_t byte : told.behind) EXPECT_EQ(byte, 0x5A);
  };
  expectTold(SPHC_DROP_FULL, 5, 0);
  sphc_pairer_flush(pairer_);
  sphc_capture none = {}, dropped = {};
  while (sphc_pairer_pop(pairer_, &none, &none, &dropped), dropped.stream != SPHC_STREAM_NONE) continue;
  expectTold(SPHC_DROP_ENDED, 5, 3);
}

}  // namespace
