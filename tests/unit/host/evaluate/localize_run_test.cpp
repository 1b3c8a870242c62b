#include "host/evaluate/localize_run.h"

#include <gtest/gtest.h>

#include "runtime/localizer/tuning.h"

namespace sphc::host {
namespace {

std::string settingOf(const sphc_localizer_config &config, const std::string &name) {
  for (const Setting &setting : describeConfig(config, {}))
    if (setting.name == name) return setting.value;
  return "none";
}

TEST(DescribeConfig, SaysWhatTheLocalizerWasGiven) {
  sphc_localizer_config config = spherecloud::defaultConfig();
  EXPECT_EQ(settingOf(config, "depth_max_m"), "6");
  EXPECT_EQ(settingOf(config, "depth_sigma_m"), "0.004");
  config.depth_mid_m = 1.25;
  EXPECT_EQ(settingOf(config, "depth_mid_m"), "1.25");
}

TEST(DescribeConfig, ASmallNumberIsNotZero) {
  sphc_localizer_config config = spherecloud::defaultConfig();
  config.depth_offset_sigma_m = 1e-5;  // 0 would be a sensor without bias
  EXPECT_EQ(settingOf(config, "depth_offset_sigma_m"), "1e-05");
}

TEST(LongestStep, IsThatOfTheLocalizer) { EXPECT_EQ(kLongestStepS, tuning::kSteadySeconds); }

}  // namespace
}  // namespace sphc::host
