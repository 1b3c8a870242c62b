#include "host/live/found.h"

#include <gtest/gtest.h>

#include "host/live/words.h"

namespace sphc::host {
namespace {

TEST(Found, SaysOfACameraWhatItTells) {
  const std::string spec = "v4l2:/dev/video0", problem = "open: Permission denied";
  EXPECT_EQ(nameAndOffers({spec, "OV5640", "colour: YUYV", ""}), "OV5640, colour: YUYV");
  EXPECT_EQ(nameAndOffers({spec, "", "colour", ""}), "colour") << "a camera without a model";
  EXPECT_EQ(nameAndOffers({spec, "OV5640", "", problem}), "OV5640");
  EXPECT_EQ(nameAndOffers({spec, "", "", problem}), "");
}

TEST(Found, NamesLayoutsAsLinuxDoes) {
  const auto fourcc = [](const char *letters) {
    uint32_t code = 0;
    for (int i = 3; i >= 0; --i) code = code << 8 | static_cast<uint8_t>(letters[i]);
    return code;
  };
  EXPECT_EQ(fourccText(fourcc("YUYV")), "YUYV");
  EXPECT_EQ(fourccText(fourcc("Y16 ") | 1u << 31), "Y16 -BE") << "not the layout that is read";
  EXPECT_EQ(fourccText(fourcc("\x1b[2J")), "?[2J") << "a device does not command the terminal";
  EXPECT_EQ(fourccText(0), "????");
}

}  // namespace
}  // namespace sphc::host
