#include "host/guide/time_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sphc::host {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(TimeWordsTest, OfSoundClocksNothingIsSaid) {
  WalkTimes times;
  times.apart_s = 0.004;
  times.drift_s_per_s = times.drifted_s = 1e-5;
  times.unpaired = 0.02;
  EXPECT_TRUE(complaintsOf(times).empty());
}

TEST(TimeWordsTest, EachFaultIsSaidWithItsCure) {
  WalkTimes times;
  times.backward = 4;
  times.pauses = {{1.8, 100}};
  times.unpaired = 0.5;
  times.drift_s_per_s = -0.0004;
  times.drifted_s = -0.04;
  times.apart_s = 0.014;
  EXPECT_THAT(complaintsOf(times),
              ElementsAre(HasSubstr("times of 4 images go backwards"), HasSubstr("from 1.8 to 100.0 s"),
                          HasSubstr("50 % of the images have no partner"), HasSubstr("by 24 ms a minute"),
                          HasSubstr("14 ms apart (median)")));
}

}  // namespace
}  // namespace sphc::host
