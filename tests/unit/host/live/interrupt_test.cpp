#include "host/live/interrupt.h"

#include <gtest/gtest.h>

namespace sphc::host {
namespace {

TEST(Interrupt, EveryPoliteSignalEndsTheLoopAndNotTheProgram) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const Interrupt interrupt;
    EXPECT_FALSE(interrupt.came());
    std::raise(number);
    EXPECT_TRUE(interrupt.came()) << number;
  }
}

TEST(Interrupt, WhatWasThereBeforeComesBack) {
  std::signal(SIGTERM, SIG_IGN);
  { const Interrupt interrupt; }
  EXPECT_EQ(std::signal(SIGTERM, SIG_DFL), SIG_IGN);
}

TEST(Interrupt, NohupIsRespected) {
  std::signal(SIGHUP, SIG_IGN);
  {
    const Interrupt interrupt;
    std::raise(SIGHUP);
    EXPECT_FALSE(interrupt.came());
  }
  EXPECT_EQ(std::signal(SIGHUP, SIG_DFL), SIG_IGN);
}

}  // namespace
}  // namespace sphc::host
