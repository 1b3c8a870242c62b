#include "runtime/base/deadline.h"

#include <gtest/gtest.h>

#include "runtime/base/pace.h"
#include "tests/support/stepping_clock.h"

namespace sphc {
namespace {

TEST(Deadline, NoneNeverPassesAndReadsNoClock) {
  const Deadline none;
  EXPECT_FALSE(none.isSet());
  EXPECT_FALSE(none.passed());
  EXPECT_FALSE(none.afterShare(0.5).isSet());
  Watch watch(none, 1);
  EXPECT_FALSE(watch.passed(1000));
}

TEST(Deadline, AShareIsOfWhatIsLeft) {
  test::SteppingClock clock(0);
  clock.now_ns = 1000;
  const Deadline deadline = Deadline::after(clock.clock(), 1000, 800);
  EXPECT_EQ(deadline.afterShare(0.25).time_ns, 1200);
  clock.now_ns = 1400;
  EXPECT_EQ(deadline.afterShare(0.25).time_ns, 1500);
  clock.now_ns = 5000;
  EXPECT_TRUE(deadline.passed());
  EXPECT_TRUE(deadline.afterShare(0.5).passed());
}

TEST(Deadline, TheClocksWholeRangeMayBeLeft) {
  test::SteppingClock clock(0);
  clock.now_ns = INT64_MIN;
  const Deadline far = {clock.clock(), INT64_MAX};
  EXPECT_FALSE(far.passed());
  EXPECT_NEAR(static_cast<double>(far.afterShare(0.5).time_ns), 0, 1e4);
}

TEST(Watch, ReadsTheClockOnceInSoMuchWork) {
  test::SteppingClock clock(1);
  Watch watch(clock.deadline(1000), 100);
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(watch.passed(10));
  EXPECT_EQ(clock.reads, 100u);
}

TEST(Watch, LooksBeforeAnythingIsDoneAndKeepsItsAnswer) {
  test::SteppingClock clock(1);
  Watch watch(clock.deadline(0), 100);
  EXPECT_FALSE(watch.hasPassed());
  EXPECT_TRUE(watch.passed(1));
  clock.now_ns = -1000;
  EXPECT_TRUE(watch.passed(1));
  EXPECT_TRUE(watch.hasPassed());
  EXPECT_EQ(clock.reads, 1u);
}

TEST(Pace, TellsWhatFits) {
  test::SteppingClock clock(0);
  Pace pace(10);
  EXPECT_EQ(pace.fitting({}, 77), 77);
  EXPECT_EQ(pace.fitting(clock.deadline(500), 77), 50);
  EXPECT_EQ(pace.fitting(clock.deadline(5000), 77), 77);
  EXPECT_EQ(pace.fitting(clock.deadline(-5), 77), 0);
}

TEST(Pace, OneInterruptionIsNoNewPace) {
  Pace pace(10);
  pace.learn(100, 2000);
  EXPECT_NEAR(pace.unitNs(), 20, 0.01);
  pace.learn(100, 200000);
  EXPECT_NEAR(pace.unitNs(), 30, 0.01);
  for (int i = 0; i < 30; ++i) pace.learn(100, 2000);
  EXPECT_NEAR(pace.unitNs(), 20, 0.01);
}

TEST(Pace, NothingDoneTeachesNothing) {
  Pace pace(10);
  pace.learn(0, 5000);
  EXPECT_EQ(pace.unitNs(), 10);
  pace.learn(10, 0);  // a clock that stands
  EXPECT_GT(pace.unitNs(), 0);
}

}  // namespace
}  // namespace sphc
