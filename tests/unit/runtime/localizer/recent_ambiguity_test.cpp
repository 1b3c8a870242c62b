#include "runtime/localizer/recent_ambiguity.h"

#include <gtest/gtest.h>

#include <string>

namespace sphc {
namespace {

constexpr int64_t kAt30Hz = 33333333, kAt10Hz = 100000000, kAt4Hz = 250000000;

// Each letter a frame: "a" is ambiguous.  Is ambiguity seen before the next?
bool isSeenAfter(const std::string &frames, int64_t step_ns) {
  RecentAmbiguity recent;
  int64_t time_ns = -3 * step_ns;  // times may be any
  for (const char frame : frames) {
    recent.advance(time_ns += step_ns);
    recent.add(frame == 'a');
  }
  recent.advance(time_ns + step_ns);
  return recent.isSeen();
}

TEST(RecentAmbiguity, IsSeenAfterSeveralAmbiguousFrames) {
  EXPECT_FALSE(isSeenAfter("", kAt30Hz));
  EXPECT_FALSE(isSeenAfter("aa", kAt30Hz));
  EXPECT_TRUE(isSeenAfter("aaa", kAt30Hz));
  EXPECT_FALSE(isSeenAfter("aa", kAt10Hz));
  EXPECT_TRUE(isSeenAfter("aaaa", kAt10Hz));
  EXPECT_FALSE(isSeenAfter("aaaaaaaaaaaaaaaaaaaa", kAt4Hz)) << "frames too far apart to be of one moment";
}

TEST(RecentAmbiguity, NeedsAThirdOfTheFrames) {
  EXPECT_TRUE(isSeenAfter("ooooooooaooaoaoaoaoaoa", kAt30Hz));
  EXPECT_FALSE(isSeenAfter("aaaooooooooooooooooo", kAt30Hz));
}

TEST(RecentAmbiguity, IsForgottenWithTimeAndAtAPause) {
  RecentAmbiguity recent;
  const auto after = [&recent](int64_t time_ns) {
    recent.reset();
    for (int64_t i = 1; i <= 10; ++i) {
      recent.advance(i * kAt30Hz);
      recent.add(true);
    }
    recent.advance(time_ns);
    return recent.isSeen();
  };
  EXPECT_TRUE(after(11 * kAt30Hz));
  EXPECT_FALSE(after(10 * kAt30Hz + 1100000000));
  EXPECT_FALSE(after(10 * kAt30Hz)) << "a time that does not grow";
  EXPECT_FALSE(after(INT64_MAX));
  EXPECT_FALSE(after(INT64_MIN));
}

}  // namespace
}  // namespace sphc
