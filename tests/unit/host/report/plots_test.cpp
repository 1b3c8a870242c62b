#include "host/report/plots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "frames.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;
using testing::Not;

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

host::Run pathOf(const std::vector<std::array<double, 2>> &places) {
  host::Run run;
  run.maps.resize(1);
  for (const auto &[x, y] : places) {
    run.frames.push_back(goodFrame(static_cast<uint32_t>(run.frames.size()), 0, 0));
    for (sphc_rigid *pose : {&run.frames.back().base_from_camera, &run.frames.back().truth_base_from_camera})
      *pose = {{0.5, -0.5, 0.5, -0.5}, {x, y, 1}};  // z is up
  }
  return run;
}

TEST(PathFromTop, HasThePlacesOfThePoses) {
  const std::string script = pathFromTop(pathOf({{1, 2}, {1.25, 5.5}})).script;
  EXPECT_THAT(script, HasSubstr("$truth << EOD\n1.000000 2.000000 0.000000\n1.250000 5.500000"));
  EXPECT_THAT(script, HasSubstr("set xlabel 'x, metres'\nset ylabel 'y, metres'"));
}

// Else the labels of the short axis lie on each other.
TEST(PathFromTop, HasOneTicStepForBothAxes) {
  EXPECT_THAT(pathFromTop(pathOf({{0, 2}, {4, 2.3}})).script,
              HasSubstr("set xtics 0.500000\nset ytics 0.500000\n"));
}

TEST(PathFromTop, SaysWhereItsAxesAreNotThoseOfThePoses) {
  host::Run run = pathOf({{0, 2}, {4, 2.3}});
  EXPECT_EQ(pathFromTop(run).caption.find("not the axes"), std::string::npos);
  const sphc_rigid tilt = {{std::cos(M_PI / 8), 0, std::sin(M_PI / 8), 0}, {0, 0, 0}};
  for (FrameRecord &frame : run.frames)
    sphc_rigid_compose(&tilt, &frame.truth_base_from_camera, &frame.truth_base_from_camera);
  EXPECT_THAT(pathFromTop(run).caption, HasSubstr("these are not the axes of the poses."));
  EXPECT_THAT(pathFromTop(run).script, HasSubstr("set xlabel 'metres'"));
}

TEST(PathFromTop, WithoutAnAnswerSpeaksOfNoDots) {
  host::Run run = runOff({});
  run.frames = {lostFrame(1), lostFrame(2)};
  const Drawing path = pathFromTop(run);
  EXPECT_THAT(path.caption, HasSubstr("The grey line is where the camera was; not one frame was localized."));
  EXPECT_THAT(path.script, Not(HasSubstr("$estimate using")));
  EXPECT_THAT(path.script, Not(HasSubstr("cm off")));
}

// A single point has no line, and gnuplot no range of it.
TEST(Timeline, OfOneFrameShowsIt) {
  const std::string script = timeline(runOff({0.01})).script;
  EXPECT_THAT(script, HasSubstr("$matches using 1:2 with linespoints"));
  EXPECT_THAT(script, HasSubstr("set xrange [-0.500000:0.500000]\nset xtics 1\n"));
}

TEST(Timeline, OfManyFramesLostOnesAreAStrip) {
  host::Run run = runOff({0.01, 0.01});
  run.frames.push_back(lostFrame(2));
  EXPECT_THAT(timeline(run).script, HasSubstr("$lost using 1:2 with points"));
  for (uint32_t i = 3; i < 400; ++i) run.frames.push_back(lostFrame(i));
  EXPECT_THAT(timeline(run).script, HasSubstr("$lost using 1:(0) with points"));
}

// The end of the whisker is the second number.
TEST(StageTimes, TellMedianAndWhisker) {
  EXPECT_THAT(stageTimes(summarize(runOff({0, 0}))).script,
              HasSubstr("using 3:2:(sprintf('%.1f (%.1f)', $1, $3)) with labels"));
}

}  // namespace
}  // namespace sphc::host
