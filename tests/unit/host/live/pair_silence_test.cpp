#include "host/live/pair_silence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/contract/tiny_recording.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;
using Got = Rig::Got;

TEST(PairSilence, IsSaidOnceAndItsEndToo) {
  const test::TempFolder folder;
  contract::writeTinyRecording(folder / "walk", 6);
  RigOptions options;
  options.both = "replay:" + (folder / "walk");
  options.tolerance_ms = 0.5;  // depth lags by a millisecond
  Rig rig(options, [](const std::string &) {});
  CapturePair pair;
  ASSERT_EQ(rig.next(std::chrono::seconds(10), &pair), Got::kEnd);

  const PairSilence::Clock::time_point start;
  const auto at = [&](int seconds) { return start + std::chrono::seconds(seconds); };
  PairSilence silence(start);
  EXPECT_EQ(silence.hear(Got::kNothing, rig, at(4)), "");
  EXPECT_THAT(silence.hear(Got::kNothing, rig, at(5)),
              testing::AllOf(HasSubstr("No pair of images has come for 5 s"), HasSubstr("Without a partner: 12")));
  EXPECT_EQ(silence.hear(Got::kNothing, rig, at(20)), "") << "once is enough";
  EXPECT_EQ(silence.hear(Got::kPair, rig, at(21)), "Pairs of images come again.");
  EXPECT_EQ(silence.hear(Got::kPair, rig, at(22)), "");
  EXPECT_EQ(silence.hear(Got::kNothing, rig, at(26)), "");
  EXPECT_THAT(silence.hear(Got::kNothing, rig, at(27)), HasSubstr("No pair of images"));
}

}  // namespace
}  // namespace sphc::host
