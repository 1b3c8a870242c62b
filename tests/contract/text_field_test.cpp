#include "host/recording/text_field.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sphc::recording {

namespace {

int64_t seconds(const char *text) {
  int64_t time_ns = -1;
  return parseSeconds(text, time_ns) ? time_ns : -1;
}

TEST(TextField, ReadsSecondsWithoutFloatLoss) {
  EXPECT_EQ(seconds("1305031102.175304"), 1305031102175304000);
  EXPECT_EQ(seconds("1305031102.175304123"), 1305031102175304123);
  EXPECT_EQ(seconds("9000000000.000000001"), 9000000000000000001);
  EXPECT_EQ(seconds("9223372035.999999999"), 9223372035999999999);
  EXPECT_EQ(seconds("9223372036.9"), -1) << "beyond 64 bits";
  EXPECT_EQ(seconds("0"), 0);
  EXPECT_EQ(seconds("7."), 7000000000);
  EXPECT_EQ(seconds("0.300000"), 300000000);
  EXPECT_EQ(seconds("000.1"), 100000000);
}

TEST(TextField, ReadsSecondsWithAnExponent) {
  EXPECT_EQ(seconds("1.305031102175304123e+09"), 1305031102175304123);
  EXPECT_EQ(seconds("1.700000000299999952e+09"), 1700000000299999952);
  EXPECT_EQ(seconds("0.000000000000000000e+00"), 0);
  EXPECT_EQ(seconds("2.999999999999999889e-01"), 300000000);
  EXPECT_EQ(seconds("1.25E-3"), 1250000);
  EXPECT_EQ(seconds("12e3"), 12000000000000);
  EXPECT_EQ(seconds("1e-300"), 0);
}

TEST(TextField, RoundsDigitsBehindTheNinth) {
  EXPECT_EQ(seconds("1.0000000014"), 1000000001);
  EXPECT_EQ(seconds("1.0000000015"), 1000000002);
  EXPECT_EQ(seconds("0.9999999999"), 1000000000);
}

TEST(TextField, RefusesWhatIsNoTime) {
  for (const char *text : {"", ".", ".5", "-1", "+1", "1e", "1e3.5", "e3", ".e3", "-1e3", "1.2.3e1", "1e11",
                           "1e99999999999", "1.5x", "x", "nan", "1.2.3", "99999999999", " 1"})
    EXPECT_EQ(seconds(text), -1) << text;
}

TEST(TextField, WritesSecondsThatReadBackTheSame) {
  for (const int64_t time_ns : {int64_t{0}, int64_t{1}, int64_t{999999999}, int64_t{1305031102175304123}})
    EXPECT_EQ(seconds(formatSeconds(time_ns).c_str()), time_ns);
}

TEST(TextField, TakesWordsFromTheFront) {
  std::string_view text = "  a\tbc \r\n";
  EXPECT_EQ(takeWord(text), "a");
  EXPECT_EQ(takeWord(text), "bc");
  EXPECT_EQ(takeWord(text), "");
  EXPECT_EQ(takeWord(text), "");
}

TEST(TextField, ReadsNumbersOfEveryStyle) {
  double value = 0;
  EXPECT_TRUE(parseDouble("-1.5e+001", value));
  EXPECT_EQ(value, -15);
  EXPECT_TRUE(parseDouble("+2", value));
  EXPECT_TRUE(parseDouble("nan", value));
  EXPECT_TRUE(std::isnan(value));
  EXPECT_FALSE(parseDouble("-1.#IND", value));
  EXPECT_FALSE(parseDouble("", value));
}

}  // namespace

}  // namespace sphc::recording
