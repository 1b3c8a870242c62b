#include "runtime/localizer/between_images.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sphc {
namespace {

TEST(BetweenImages, NothingIsUnknownOfImagesOfOneTime) {
  BetweenImages between;
  between.add(Way());
  between.addUnknown(0);
  EXPECT_EQ(between.turn_sigma_rad, 0);
  EXPECT_EQ(between.shift_sigma_m, 0);
  EXPECT_FALSE(between.areApart());
}

TEST(BetweenImages, TheImageOfWhichLeastIsKnownCounts) {
  BetweenImages between;
  between.addUnknown(0.033);
  EXPECT_FALSE(between.areApart());
  EXPECT_NEAR(between.shift_sigma_m, 0.0116, 1e-4);
  between.add({Rigid(), 0.001, 0.002});
  EXPECT_NEAR(between.shift_sigma_m, 0.0116, 1e-4);
  between.addUnknown(0.1);
  EXPECT_TRUE(between.areApart());
  EXPECT_NEAR(between.shift_sigma_m, 0.035, 1e-9);
  EXPECT_NEAR(between.turn_sigma_rad, 0.008, 1e-9);
  between.add({Rigid(), 0.03, 0.04});
  EXPECT_NEAR(between.turn_sigma_rad, 0.03, 1e-9);
  EXPECT_NEAR(between.shift_sigma_m, 0.05, 1e-9) << "a turn moves what is a metre away";
}

TEST(BetweenImages, OdometryThatSaysLittleIsAsGoodAsNone) {
  BetweenImages good, poor;
  good.add({Rigid(), 0.003, 0.01});
  poor.add({Rigid(), 0.01, 0.02});
  EXPECT_FALSE(good.areApart());
  EXPECT_TRUE(poor.areApart());
}

TEST(BetweenImages, TimesOfTwoClocksCountForOneSecond) {
  BetweenImages between;
  between.addUnknown(1e9);
  EXPECT_EQ(between.apart_s, 1);
  EXPECT_NEAR(between.shift_sigma_m, 0.35, 1e-9);
}

}  // namespace
}  // namespace sphc
