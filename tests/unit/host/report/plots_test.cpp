#include "host/report/plots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "frames.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

host::Run runOff(const std::vector<double> &errors_m) {
  host::Run run;
  run.maps.resize(1);
  for (const double error_m : errors_m)
    run.frames.push_back(goodFrame(static_cast<uint32_t>(run.frames.size()), error_m, 0.1));
  return run;
}

// Between 0.6 and 0.7 m there is no power of ten of centimetres.
TEST(ErrorCurve, FarOffHasNumbersOnItsAxisAndTheMark) {
  const std::string script = translationCdf(runOff({0.6, 0.65, 0.7})).script;
  EXPECT_THAT(script, HasSubstr("set logscale x"));
  EXPECT_THAT(script, HasSubstr("set xtics (2, 5, 10, 20, 50)"));
  EXPECT_THAT(script, HasSubstr("set xrange [1.666667:77.000000]"));
  EXPECT_THAT(script, HasSubstr("set label '5 cm' at first 5.000"));
}

TEST(ErrorCurve, OfManyDecadesNumbersEachOnce) {
  EXPECT_THAT(translationCdf(runOff({0.0002, 9})).script, HasSubstr("set xtics (0.1, 1, 10, 100)"));
}

// The axis is of all frames.
TEST(ErrorCurve, WithLostFramesSaysThatItIsOfTheOthers) {
  host::Run run = runOff({0.001, 0.002});
  EXPECT_THAT(translationCdf(run).script, HasSubstr("set label 'all far within 5 cm'"));
  run.frames.push_back(lostFrame(2));
  EXPECT_THAT(translationCdf(run).script, HasSubstr("set label 'those localized: all far within 5 cm'"));
}

// The end of the whisker is the second number.
TEST(StageTimes, TellMedianAndWhisker) {
  EXPECT_THAT(stageTimes(summarize(runOff({0, 0}))).script,
              HasSubstr("using 3:2:(sprintf('%.1f (%.1f)', $1, $3)) with labels"));
}

}  // namespace
}  // namespace sphc::host
