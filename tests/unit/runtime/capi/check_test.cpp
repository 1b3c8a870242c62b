#include "runtime/capi/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sphc {
namespace {

using testing::HasSubstr;

TEST(CheckApart, BytesOfTwoThingsMayTouchAndNotOverlap) {
  const char memory[100] = {};
  sphc_message message = {};
  const MemoryRange middle = {"scratch", memory + 40, 20};
  const auto apart = [&](int begin, size_t bytes) {
    return checkApart(middle, {"state", memory + begin, bytes}, &message) == SPHC_OK;
  };
  EXPECT_TRUE(apart(20, 20));
  EXPECT_TRUE(apart(60, 20));
  EXPECT_FALSE(apart(20, 21));
  EXPECT_FALSE(apart(59, 20));
  EXPECT_FALSE(apart(45, 2));   // inside
  EXPECT_FALSE(apart(0, 100));  // around
  EXPECT_FALSE(apart(40, 20));  // the same
  EXPECT_THAT(message.text, HasSubstr("scratch memory overlaps state"));
}

TEST(CheckMemory, NamesWhatIsWrong) {
  alignas(64) char memory[128] = {};
  sphc_message message = {};
  EXPECT_EQ(checkMemory(memory, 128, 128, 64, "state", &message), SPHC_OK);
  EXPECT_EQ(checkMemory(nullptr, 128, 128, 64, "state", &message), SPHC_E_ARGUMENT);
  EXPECT_THAT(message.text, HasSubstr("state memory is null"));
  EXPECT_EQ(checkMemory(memory + 32, 96, 64, 64, "state", &message), SPHC_E_MEMORY_ALIGNMENT);
  EXPECT_THAT(message.text, HasSubstr("64 bytes"));
  EXPECT_EQ(checkMemory(memory, 127, 128, 64, "state", &message), SPHC_E_MEMORY_SIZE);
  EXPECT_THAT(message.text, HasSubstr("127 bytes, 128 are needed"));
}

class CheckImageTest : public testing::Test {
 protected:
  sphc_status check(const sphc_image &image, sphc_format depth_format = 0) {
    sphc_camera camera = {};
    camera.width = width_px_;
    camera.height = 4;
    return checkImage("color", image, camera, {depth_format, "config.depth_format"}, &message_);
  }
  uint32_t width_px_ = 8;
  alignas(2) uint8_t pixels_[8 * 4 * 3 + 1] = {};
  sphc_message message_ = {};
};

TEST_F(CheckImageTest, ItsFormatIsOfItsKind) {
  EXPECT_EQ(check({pixels_, 8, 4, 8, SPHC_FORMAT_GRAY8}), SPHC_OK);
  EXPECT_EQ(check({pixels_, 8, 4, 24, SPHC_FORMAT_RGB8}), SPHC_OK);
  EXPECT_EQ(check({pixels_, 8, 4, 16, SPHC_FORMAT_DEPTH16}, SPHC_FORMAT_DEPTH16), SPHC_OK);
  EXPECT_EQ(check({pixels_, 8, 4, 8, SPHC_FORMAT_GRAY8}, SPHC_FORMAT_DEPTH16), SPHC_E_IMAGE);
  EXPECT_EQ(check({pixels_, 8, 4, 16, SPHC_FORMAT_DEPTH16}), SPHC_E_IMAGE);
}

TEST_F(CheckImageTest, ItsRowsAreWhole) {
  EXPECT_EQ(check({pixels_, 8, 4, 23, SPHC_FORMAT_BGR8}), SPHC_E_IMAGE);
  EXPECT_THAT(message_.text, HasSubstr("stride of 23 bytes; a row has 24"));
  EXPECT_EQ(check({pixels_, 8, 4, 17, SPHC_FORMAT_DEPTH16}, SPHC_FORMAT_DEPTH16), SPHC_E_IMAGE);
  EXPECT_EQ(check({pixels_, 7, 4, 8, SPHC_FORMAT_GRAY8}), SPHC_E_IMAGE);
  EXPECT_EQ(check({pixels_, 8, 5, 8, SPHC_FORMAT_GRAY8}), SPHC_E_IMAGE);
}

TEST_F(CheckImageTest, PixelsThatShareBytesAreWhole) {
  EXPECT_EQ(check({pixels_, 8, 4, 12, SPHC_FORMAT_GRAY12P}), SPHC_OK);
  width_px_ = 7;
  EXPECT_EQ(check({pixels_, 7, 4, 12, SPHC_FORMAT_GRAY12P}), SPHC_E_IMAGE);
  EXPECT_THAT(message_.text, HasSubstr("7 wide, and 2 pixels"));
}

TEST_F(CheckImageTest, ItsPixelsAreThereAndAligned) {
  EXPECT_EQ(check({nullptr, 8, 4, 8, SPHC_FORMAT_GRAY8}), SPHC_E_IMAGE);
  EXPECT_EQ(check({pixels_ + 1, 8, 4, 16, SPHC_FORMAT_DEPTH16}, SPHC_FORMAT_DEPTH16), SPHC_E_IMAGE);
  EXPECT_THAT(message_.text, HasSubstr("not aligned to 2 bytes"));
}

}  // namespace
}  // namespace sphc
