#include <gtest/gtest.h>

#include "spherecloud/spherecloud_capture.h"
#include "tests/capi/bytes.h"
#include "tests/support/session.h"

namespace {

using sphc::test::expectMentions;
using sphc::test::GuardedMemory;
using sphc::test::Output;

class CInterfaceClockMapper : public testing::Test {
 protected:
  void SetUp() override {
    sphc_memory need = {};
    ASSERT_EQ(sphc_clock_mapper_memory(&need), SPHC_OK);
    bytes_ = need.state_bytes;
    memory_ = GuardedMemory(bytes_, need.alignment);
    ASSERT_EQ(sphc_clock_mapper_config_init(&config_, sizeof config_), SPHC_OK);
  }
  sphc_status init() { return sphc_clock_mapper_init(memory_.data(), bytes_, &config_, &mapper_, &message_); }

  size_t bytes_ = 0;
  GuardedMemory memory_;
  sphc_clock_mapper_config config_ = {};
  sphc_clock_mapper *mapper_ = nullptr;
  sphc_message message_ = {};
};

TEST_F(CInterfaceClockMapper, MapsThroughTheCInterface) {
  ASSERT_EQ(init(), SPHC_OK);
  int64_t host_ns = 0;
  sphc_clock_mapping mapping = {};
  mapping.struct_size = sizeof mapping;
  EXPECT_EQ(sphc_clock_mapper_map(mapper_, 0, &host_ns), SPHC_AGAIN);
  EXPECT_EQ(sphc_clock_mapper_get(mapper_, &mapping), SPHC_AGAIN);
  EXPECT_EQ(sphc_clock_mapper_add(mapper_, 1000, 5000), SPHC_OK);
  EXPECT_EQ(sphc_clock_mapper_add(mapper_, 900, 5100), SPHC_AGAIN);  // ran backwards
  EXPECT_EQ(sphc_clock_mapper_map(mapper_, 1000, &host_ns), SPHC_OK);
  EXPECT_EQ(host_ns, 5200);
  ASSERT_EQ(sphc_clock_mapper_get(mapper_, &mapping), SPHC_OK);
  EXPECT_EQ(mapping.struct_size, sizeof mapping);
  EXPECT_EQ(mapping.restarts, 1u);
  EXPECT_EQ(mapping.samples, 1u);
  EXPECT_TRUE(memory_.guardsIntact());
  sphc_clock_mapper_fini(&mapper_);
  EXPECT_EQ(mapper_, nullptr);
}

TEST_F(CInterfaceClockMapper, RefusesWhatItCannotUse) {
  EXPECT_EQ(sphc_clock_mapper_config_init(nullptr, sizeof config_), SPHC_E_ARGUMENT);
  Output<sphc_clock_mapper_config> untouched;
  EXPECT_EQ(sphc_clock_mapper_config_init(untouched.get(), sizeof config_ - 1), SPHC_E_STRUCT_SIZE);
  EXPECT_TRUE(untouched.untouched());
  EXPECT_EQ(sphc_clock_mapper_memory(nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_clock_mapper_init(memory_.data(), bytes_, nullptr, &mapper_, &message_), SPHC_E_ARGUMENT);
  expectMentions(message_.text, "config is null");
  EXPECT_EQ(sphc_clock_mapper_init(memory_.data(), bytes_ - 1, &config_, &mapper_, &message_), SPHC_E_MEMORY_SIZE);
  config_.max_drift_ppm = 0;
  EXPECT_EQ(init(), SPHC_E_ARGUMENT);
  expectMentions(message_.text, "max_drift_ppm 0 must be 1 to 10000");
  SetUp();
  config_.window_ns = 5;
  EXPECT_EQ(init(), SPHC_E_ARGUMENT);
  SetUp();
  config_.struct_size = 3;
  EXPECT_EQ(init(), SPHC_E_STRUCT_SIZE);
  EXPECT_EQ(mapper_, nullptr);
}

TEST_F(CInterfaceClockMapper, NullsAndSizes) {
  ASSERT_EQ(init(), SPHC_OK);
  int64_t host_ns = 0;
  Output<sphc_clock_mapping> mapping;
  EXPECT_EQ(sphc_clock_mapper_add(nullptr, 0, 0), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_clock_mapper_map(nullptr, 0, &host_ns), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_clock_mapper_map(mapper_, 0, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_clock_mapper_get(mapper_, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_clock_mapper_get(mapper_, mapping.get()), SPHC_E_STRUCT_SIZE);
  EXPECT_TRUE(mapping.untouched());
  sphc_clock_mapper_fini(nullptr);
}

}  // namespace
