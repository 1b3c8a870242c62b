#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "handle.h"

namespace sphc::simulated::test {
namespace {

// One room serves every step: it takes a while to paint.
TEST(SimulatedSource, KeepsTheContract) {
  sphc_simulated_config config = defaults();
  config.frame_count = 6;
  config.color_noise = 0;
  config.ideal_depth = 1;
  const Handle handle(config);
  sphc_source source{};
  EXPECT_EQ(sphc_simulated_source(handle.get(), &source), SPHC_E_STRUCT_SIZE);
  source.struct_size = sizeof source;
  ASSERT_EQ(sphc_simulated_source(handle.get(), &source), SPHC_OK);
  ASSERT_EQ(source.loan_limit, SPHC_SIMULATED_LOAN_LIMIT);
  EXPECT_STREQ(source.message(source.self), "");

  sphc_capture capture{};
  capture.struct_size = sizeof capture;
  source.stop(source.self);  // does nothing when stopped
  EXPECT_EQ(source.acquire(source.self, 0, &capture), SPHC_E_STATE) << "stopped";
  EXPECT_THAT(std::string(source.message(source.self)), testing::HasSubstr("start first"));
  ASSERT_EQ(source.start(source.self), SPHC_OK);
  EXPECT_EQ(source.start(source.self), SPHC_E_STATE) << "running already";
  EXPECT_EQ(source.acquire(source.self, 0, nullptr), SPHC_E_ARGUMENT);
  capture.struct_size = 3;
  EXPECT_EQ(source.acquire(source.self, 0, &capture), SPHC_E_STRUCT_SIZE);

  // Loans up to the limit, in order of time, colour and depth by turns.
  std::vector<sphc_capture> loans;
  int64_t last_ns = -1;
  for (uint32_t i = 0; i < source.loan_limit; ++i) {
    sphc_capture loan{};
    loan.struct_size = sizeof loan;
    ASSERT_EQ(source.acquire(source.self, 0, &loan), SPHC_OK);
    EXPECT_EQ(loan.stream, i % 2 == 0 ? SPHC_STREAM_COLOR : SPHC_STREAM_DEPTH);
    EXPECT_EQ(loan.sequence, i / 2);
    EXPECT_GT(loan.time_ns, last_ns);
    last_ns = loan.time_ns;
    loans.push_back(loan);
  }
  capture.struct_size = sizeof capture;
  EXPECT_EQ(source.acquire(source.self, 0, &capture), SPHC_E_STATE) << "limit";

  // The images are those rendered by index, and stay so while others come.
  std::vector<uint8_t> rgb(3 * kColorPixels);
  std::vector<uint16_t> depth(kDepthPixels);
  ASSERT_EQ(sphc_simulated_render_color(handle.get(), 0, rgb.data()), SPHC_OK);
  ASSERT_EQ(sphc_simulated_render_depth(handle.get(), 3, depth.data()), SPHC_OK);
  EXPECT_EQ(std::memcmp(loans[0].image.data, rgb.data(), rgb.size()), 0);
  EXPECT_EQ(std::memcmp(loans[7].image.data, depth.data(), 2 * depth.size()), 0);
  EXPECT_EQ(loans[0].image.format, SPHC_FORMAT_RGB8);
  EXPECT_EQ(loans[7].image.format, SPHC_FORMAT_DEPTH16);

  // Released twice counts once.
  source.release(source.self, &loans[2]);
  source.release(source.self, &loans[2]);
  EXPECT_EQ(source.acquire(source.self, 0, &capture), SPHC_OK);
  source.release(source.self, &loans[2]);  // its slot is another's now
  sphc_capture beyond = capture;
  EXPECT_EQ(source.acquire(source.self, 0, &beyond), SPHC_E_STATE);
  source.release(source.self, &capture);

  // To the end, again and again.
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(source.acquire(source.self, 0, &capture), SPHC_OK);
    source.release(source.self, &capture);
  }
  EXPECT_EQ(source.acquire(source.self, 0, &capture), SPHC_END);
  EXPECT_EQ(source.acquire(source.self, 0, &capture), SPHC_END);

  // A restart begins at frame 0, with every slot free.
  source.stop(source.self);
  ASSERT_EQ(source.start(source.self), SPHC_OK);
  ASSERT_EQ(source.acquire(source.self, 0, &capture), SPHC_OK);
  EXPECT_EQ(capture.sequence, 0u);
  EXPECT_EQ(capture.time_ns, config.start_time_ns);
  EXPECT_EQ(std::memcmp(capture.image.data, rgb.data(), rgb.size()), 0);
  source.release(source.self, &capture);
  source.stop(source.self);

  // Ideal depth is the truth, rounded.
  std::vector<float> truth(kDepthPixels);
  ASSERT_EQ(sphc_simulated_oracle_tof_depth(handle.get(), loans[7].time_ns, truth.data()), SPHC_OK);
  for (size_t i = 0; i < kDepthPixels; ++i) {
    ASSERT_NEAR(depth[i] * SPHC_SIMULATED_DEPTH_UNIT_M, static_cast<double>(truth[i]), 0.00051);
  }

  EXPECT_EQ(sphc_simulated_frame_count(handle.get()), 6u);
  EXPECT_EQ(sphc_simulated_render_color(handle.get(), 6, rgb.data()), SPHC_E_ARGUMENT);
}

}  // namespace
}  // namespace sphc::simulated::test
