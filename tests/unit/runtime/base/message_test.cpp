#include "runtime/base/message.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>

namespace sphc {
namespace {

template <typename T>
std::string written(T value) {
  sphc_message message;
  MessageWriter(&message) << value;
  return message.text;
}

TEST(Message, Text) { EXPECT_EQ(written("stride 3"), "stride 3"); }

TEST(Message, Integers) {
  EXPECT_EQ(written(uint32_t{0}), "0");
  EXPECT_EQ(written(std::numeric_limits<uint64_t>::max()), "18446744073709551615");
  EXPECT_EQ(written(std::numeric_limits<int64_t>::min()), "-9223372036854775808");
  EXPECT_EQ(written(int32_t{-7}), "-7");
}

TEST(Message, Doubles) {
  EXPECT_EQ(written(0.0), "0");
  EXPECT_EQ(written(1.5), "1.5");
  EXPECT_EQ(written(-0.25), "-0.25");
  EXPECT_EQ(written(0.1), "0.1");
  EXPECT_EQ(written(123456.789), "123457");
  EXPECT_EQ(written(1e6), "1000000");
  EXPECT_EQ(written(1e-4), "0.0001");
  EXPECT_EQ(written(1e-6), "1e-6");
  EXPECT_EQ(written(-2.5e-9), "-2.5e-9");
  EXPECT_EQ(written(std::numeric_limits<double>::denorm_min()), "4.94066e-324");
  EXPECT_EQ(written(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(written(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(written(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(written(1e300), "1e18+");
}

TEST(Message, DoublesComeBackWithinSixDigits) {
  for (double value : {3.14159265, 99.9999, 0.000123, 0.0000123, 99999.95, 0.9999999, 12.000001, 7e17}) {
    const double back = std::atof(written(value).c_str());
    EXPECT_NEAR(back, value, 1e-5 * value + 1e-6) << written(value);
  }
}

TEST(Message, TooLongIsCutAndTerminated) {
  struct {
    sphc_message message;
    char guard[8];
  } memory;
  std::memset(&memory, 'g', sizeof memory);
  MessageWriter writer(&memory.message);
  for (int i = 0; i < 100; ++i) writer << "0123456789" << uint32_t{42};
  EXPECT_EQ(std::strlen(memory.message.text), SPHC_MESSAGE_BYTES - 1);
  for (char c : memory.guard) EXPECT_EQ(c, 'g');
}

TEST(Message, NullSwallowsEverything) { MessageWriter(nullptr) << "text" << 1.0 << uint32_t{3} << int64_t{-1}; }

TEST(Message, BeginsEmpty) {
  sphc_message message;
  std::memset(&message, 'x', sizeof message);
  MessageWriter writer(&message);
  EXPECT_STREQ(message.text, "");
}

}  // namespace
}  // namespace sphc
