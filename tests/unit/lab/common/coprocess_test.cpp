#include "lab/common/coprocess.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sphc::host {
namespace {

TEST(Coprocess, WhatGoesInComesOut) {
  Coprocess cat({"cat"});
  std::vector<char> sent(100000, 'x'), got(sent.size());
  for (size_t at = 0; at < sent.size(); at += 1000) {
    ASSERT_TRUE(cat.write(sent.data() + at, 1000));
    ASSERT_TRUE(cat.read(got.data() + at, 1000));
  }
  EXPECT_EQ(sent, got);
}

TEST(Coprocess, ArgumentsArrive) {
  Coprocess echo({"echo", "two words"});
  char text[10];
  ASSERT_TRUE(echo.read(text, sizeof text));
  EXPECT_EQ(std::string(text, sizeof text), "two words\n");
  EXPECT_FALSE(echo.read(text, 1));
}

TEST(Coprocess, AProgramThatIsGoneNeitherReadsNorAnswers) {
  Coprocess gone({"true"});
  char byte = 0;
  EXPECT_FALSE(gone.read(&byte, 1));
  const std::vector<char> much(10000000);
  EXPECT_FALSE(gone.write(much.data(), much.size()));  // and no signal ends us
}

TEST(Coprocess, AProgramThatIsNotThereIsToldByName) {
  EXPECT_THROW(Coprocess({"/nowhere/program"}), std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
