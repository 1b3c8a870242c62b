#include "host/cli/common/option_names.h"

#include <gtest/gtest.h>

namespace sphc::host {
namespace {

class OptionNames : public testing::Test {
 protected:
  OptionNames() {
    for (const char *name : {"--band", "--depth-min", "--map", "--max-keypoints", "--probes"}) app_.add_flag(name);
  }
  std::string said(const std::string &text) const { return withOptionNames(text, app_); }
  CLI::App app_;
};

TEST_F(OptionNames, FieldsThatAnOptionSets) {
  EXPECT_EQ(said("config.depth_min_m is 0; it must lie in 0.01 to 100"),
            "--depth-min is 0; it must lie in 0.01 to 100");
  EXPECT_EQ(said("config.max_keypoints is 1"), "--max-keypoints is 1");
  EXPECT_EQ(said("SPHC_PARAMETER_PROBES is 99"), "--probes is 99");
}

TEST_F(OptionNames, AFieldThatIsNamedAgain) {
  app_.add_option("--row-time-ns");
  EXPECT_EQ(said("config.color_row_time_ns is 5"), "--row-time-ns is 5");
  EXPECT_EQ(said("config.color_band is SPHC_BAND_VISIBLE; give that map, or set color_band to what it is"),
            "--band is visible; give that map, or set --band to what it is");
}

// `live` has --color and --depth, which are cameras.
TEST_F(OptionNames, AnOptionOfTheFirstWordAloneIsAnother) {
  for (const char *name : {"--color", "--depth"}) app_.add_flag(name);
  EXPECT_EQ(said("config.color_band is 3"), "--band is 3");
  EXPECT_EQ(said("config.depth_format is 3"), "config.depth_format is 3");
  EXPECT_EQ(said("config.depth_min_m is 0"), "--depth-min is 0");
}

TEST_F(OptionNames, WhatNoOptionSetsKeepsItsName) {
  for (const char *text : {"config.camera_count is 5", "map_id is 3", "depth_min_m of another", ""})
    EXPECT_EQ(said(text), text);
}

}  // namespace
}  // namespace sphc::host
