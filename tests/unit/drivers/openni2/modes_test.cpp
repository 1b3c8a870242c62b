#include "drivers/openni2/modes.h"

#include <gtest/gtest.h>

#include <vector>

#include "drivers/openni2/streams.h"

namespace sphc::openni2 {

namespace {

OniVideoMode modes[] = {{ONI_PIXEL_FORMAT_YUV422, 640, 480, 30}, {ONI_PIXEL_FORMAT_GRAY8, 640, 480, 30},
                        {ONI_PIXEL_FORMAT_RGB888, 640, 480, 30}, {ONI_PIXEL_FORMAT_RGB888, 320, 240, 60},
                        {ONI_PIXEL_FORMAT_RGB888, 0, -1, 30},    {ONI_PIXEL_FORMAT_RGB888, 8, 8, 30},
                        {ONI_PIXEL_FORMAT_RGB888, 64, 64, 0}};
const OniSensorInfo kOffered = {ONI_SENSOR_COLOR, 7, modes};

TEST(Modes, PrefersThePresentOneThenColour) {
  EXPECT_EQ(chooseMode(kOffered, kColor, {}, modes[3]), &modes[3]);
  EXPECT_EQ(chooseMode(kOffered, kColor, {}, modes[1]), &modes[1]);
  EXPECT_EQ(chooseMode(kOffered, kColor, {}, modes[0]), &modes[2]) << "YUV422 is not passed on";
  EXPECT_EQ(chooseMode(kOffered, kColor, {320, 0, 0}, modes[2]), &modes[3]);
}

TEST(Modes, RefusesWhatNoImageCanBe) {
  EXPECT_EQ(chooseMode(kOffered, kColor, {8, 0, 0}, {}), nullptr);
  EXPECT_EQ(chooseMode(kOffered, kColor, {64, 0, 0}, {}), nullptr);
  EXPECT_EQ(chooseMode(kOffered, kDepth, {}, {}), nullptr) << "colour is no depth";
  EXPECT_EQ(chooseMode({ONI_SENSOR_COLOR, 0, nullptr}, kColor, {}, {}), nullptr);
}

TEST(Modes, ListsAsManyAsFit) {
  EXPECT_STREQ(ModeList(modes, 2).text, "640x480@30 YUV422, 640x480@30 GRAY8");
  EXPECT_STREQ(ModeList(modes, 0).text, "");
  const std::vector<OniVideoMode> many(50, {ONI_PIXEL_FORMAT_DEPTH_100_UM, INT32_MIN, INT32_MIN, INT32_MIN});
  const ModeList list(many.data(), 50);
  EXPECT_LT(strnlen(list.text, sizeof list.text), sizeof list.text);
  EXPECT_NE(std::string(list.text).find(" ..."), std::string::npos);
}

}  // namespace

}  // namespace sphc::openni2
