#include "host/cli/common/number_checks.h"

#include <gtest/gtest.h>

namespace sphc::host {
namespace {

bool takes(const CLI::Validator &check, std::string text) { return check(text).empty(); }

TEST(NumberChecks, ADecimalNumberInItsBounds) {
  for (const char *text : {"0.5", "2", "1e0", "0.50"}) EXPECT_TRUE(takes(between(0.5, 2), text)) << text;
  for (const char *text : {"nan", "-nan", "inf", "0.49", "2.01", "", "x", "1x"})
    EXPECT_FALSE(takes(between(0.5, 2), text)) << text;
  EXPECT_TRUE(takes(notNegative(), "1e9"));
  for (const char *text : {"-1", "nan", "inf", "1e999"}) EXPECT_FALSE(takes(notNegative(), text)) << text;
}

TEST(NumberChecks, AWholeNumberHasNoSign) {
  for (const char *text : {"0", "18446744073709551615"}) EXPECT_TRUE(takes(wholeFrom(0), text)) << text;
  for (const char *text : {"-1", "+1", " 1", "1.5", "", "nan", "18446744073709551616"})
    EXPECT_FALSE(takes(wholeFrom(0), text)) << text;
  EXPECT_TRUE(takes(wholeFrom(1), "1"));
  EXPECT_TRUE(takes(wholeFrom(0, UINT32_MAX), "4294967295"));
  std::string beyond = "4294967296";
  EXPECT_EQ(wholeFrom(0, UINT32_MAX)(beyond), "4294967296 is not a whole number from 0 to 4294967295");
  for (const char *text : {"0", "-1"}) EXPECT_FALSE(takes(wholeFrom(1), text)) << text;
}

TEST(NumberChecks, AWholeNumberOfEitherSign) {
  for (const char *text : {"-5", "0", "-0", "7", "-005"}) EXPECT_TRUE(takes(wholeBetween(-5, 7), text)) << text;
  for (const char *text : {"-6", "8", "--5", "-", "+1", "1.5", "", "nan", "-99999999999999999999"})
    EXPECT_FALSE(takes(wholeBetween(-5, 7), text)) << text;
  std::string zeros = "-005", beyond = "8";
  EXPECT_EQ(wholeBetween(-5, 7)(zeros), "");
  EXPECT_EQ(zeros, "-5");
  EXPECT_EQ(wholeBetween(-5, 7)(beyond), "8 is not a whole number from -5 to 7");
}

// Names of files have zeros in front, and nobody counts in octal.
TEST(NumberChecks, ZerosInFrontSayNothing) {
  uint32_t number = 0;
  CLI::App app;
  app.add_option("--first", number)->transform(wholeFrom(0, 1000));
  for (const auto &[text, value] : {std::pair("000620", 620u), {"0089", 89u}, {"000", 0u}, {"07", 7u}}) {
    app.parse(std::string("--first ") + text);
    EXPECT_EQ(number, value) << text;
  }
}

}  // namespace
}  // namespace sphc::host
