#include "host/report/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "frames.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

TEST(Table, HoldsTheFiguresAPersonAsksFor) {
  host::Run run;
  run.frames = {goodFrame(1, 0.01, 0.5), goodFrame(2, 0.03, 0.5), lostFrame(3), lostFrame(4)};
  run.state_bytes = 1000;
  run.scratch_bytes = 2500000;
  run.maps.resize(1);
  run.maps[0].file_bytes = 500000;
  const std::string text = tableText(tableRows(run, summarize(run)));
  EXPECT_THAT(text, HasSubstr("50.0 %   2 of 4"));
  EXPECT_THAT(text, HasSubstr("2.00 cm"));
  EXPECT_THAT(text, HasSubstr("0.50 deg"));
  EXPECT_THAT(text, HasSubstr("3.00 MB"));
}

TEST(Table, OfSeveralMapsSaysHowManyAnswersAreInEach) {
  host::Run run;
  run.maps.resize(1);
  run.maps[0].path = "kitchen.sphc";
  run.frames = {goodFrame(1, 0.01, 0.5), goodFrame(2, 0.01, 0.5), lostFrame(3)};
  EXPECT_THAT(tableText(tableRows(run, summarize(run))), testing::Not(HasSubstr("kitchen.sphc")));
  run.maps.resize(2);
  run.maps[1].path = "hall.sphc";
  for (FrameRecord &frame : run.frames) frame.map = 1;
  const std::string text = tableText(tableRows(run, summarize(run)));
  EXPECT_THAT(text, testing::ContainsRegex("in kitchen.sphc +0   of 2 localized"));
  EXPECT_THAT(text, testing::ContainsRegex("in hall.sphc +2   of 2 localized"));
}

TEST(Table, TellsWhyFramesHaveNoPoseAndTheCure) {
  host::Run run;
  run.maps.resize(1);
  run.frames = {goodFrame(1, 0.01, 0.5), lostFrame(2)};
  EXPECT_THAT(tableText(tableRows(run, summarize(run))), testing::Not(HasSubstr("no pose")));
  run.frames[1].hints = SPHC_HINT_TOO_DARK | SPHC_HINT_AMBIGUOUS;
  const std::string text = tableText(tableRows(run, summarize(run)));
  EXPECT_THAT(text, testing::ContainsRegex("no pose, too dark +50.0 %   more light"));
  EXPECT_THAT(text, testing::ContainsRegex("no pose, ambiguous +50.0 %"));
}

TEST(Table, WarnsOfWrongPosesAlone) {
  host::Run run;
  run.maps.resize(1);
  run.frames = {goodFrame(1, 0.01, 0.5)};
  EXPECT_THAT(tableText(tableRows(run, summarize(run))), testing::Not(HasSubstr("WRONG")));
  run.frames.push_back(goodFrame(2, 0.30, 0.5));
  EXPECT_THAT(tableText(tableRows(run, summarize(run))), HasSubstr("WRONG POSES GIVEN OUT"));
}

TEST(Table, SaysHowToGetErrorsWhenThereAreNone) {
  host::Run run;
  run.frames = {goodFrame(1, 0.01, 0.5)};
  run.frames[0].has_truth = false;
  EXPECT_THAT(tableText(tableRows(run, summarize(run))), HasSubstr("--owner-note"));
}

TEST(Table, DoesNotSpeakOfPosesThatAreNotThere) {
  host::Run run;
  run.base = "world";
  run.frames = {goodFrame(1, 0.01, 0.5)};
  run.frames[0].has_truth = false;
  EXPECT_THAT(tableText(tableRows(run, summarize(run))), HasSubstr("no pose of the recording can be compared"));
  run.has_poses = false;
  EXPECT_THAT(tableText(tableRows(run, summarize(run))),
              testing::AllOf(HasSubstr("not known   the recording holds no poses"),
                             testing::Not(HasSubstr("pose of the recording"))));
}

TEST(Table, AlignsItsColumns) {
  const std::string text = tableText({{"a", "1", "x"}, {"long name", "1000", ""}});
  EXPECT_EQ(text, "  a             1   x\n  long name  1000\n");
  EXPECT_EQ(tableText({{"Küche", "1", "x"}, {"Flur", "1000", ""}}), "  Küche     1   x\n  Flur   1000\n");
}

TEST(HumanBytes, PicksAUnit) {
  EXPECT_EQ(humanBytes(999), "999 B");
  EXPECT_EQ(humanBytes(26400), "26.4 kB");
  EXPECT_EQ(humanBytes(2760000), "2.76 MB");
  EXPECT_EQ(humanBytes(123456789), "123 MB");
}

}  // namespace
}  // namespace sphc::host
