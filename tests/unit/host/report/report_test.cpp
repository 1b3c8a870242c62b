#include "host/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "frames.h"
#include "host/report/file.h"
#include "host/report/page.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ReportTest : public testing::Test {
 protected:
  void SetUp() override {
    run_.recording = "walk <one>";
    run_.maps.resize(1);
    run_.maps[0].directions = {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
    for (uint32_t i = 0; i < 8; ++i) run_.frames.push_back(goodFrame(i, 0.004 * i, 0.1 * i));
    run_.frames.push_back(lostFrame(8));
  }

  std::string write() {
    const ImageOfFrame gray = [](const FrameRecord &) { return cv::Mat(48, 64, CV_8UC3, cv::Scalar(90, 90, 90)); };
    problem_ = writeReport(folder_.path(), run_, gray).problem;
    const auto bytes = readBytes(folder_ / "report.html");
    return {bytes.begin(), bytes.end()};
  }

  const test::TempFolder folder_;
  std::string problem_;
  host::Run run_;
};

// Of a data block in a gnuplot script.
std::ptrdiff_t linesOf(const std::string &script, const std::string &block) {
  const std::string head = "$" + block + " << EOD\n";
  const size_t begin = script.find(head) + head.size(), end = script.find("EOD\n", begin);
  return std::count(script.begin() + static_cast<std::ptrdiff_t>(begin),
                    script.begin() + static_cast<std::ptrdiff_t>(end), '\n');
}

TEST_F(ReportTest, IsOnePageThatNeedsNothingElse) {
  const std::string page = write();
  EXPECT_THAT(page, HasSubstr("data:image/jpeg;base64,"));
  EXPECT_THAT(page, HasSubstr("walk &lt;one&gt;"));
  EXPECT_THAT(page, HasSubstr("name of this release, by what it holds")) << "the id of a map";
  EXPECT_THAT(page, Not(HasSubstr("src='http")));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  for (const char *file : {"overlay_best.jpg", "overlay_not_localized_1.jpg", "map_directions.png", "frames.jsonl",
                           "summary.json", "trajectory.tum", "plots/path.gp"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / file)) << file;
  }
}

TEST_F(ReportTest, WarnsOfWrongPosesAndListsTheWorst) {
  std::string page = write();
  EXPECT_THAT(page, Not(HasSubstr("<p class='wrong'>")));
  EXPECT_THAT(page, HasSubstr("<h2>Worst poses</h2>"));
  run_.frames.push_back(goodFrame(123, 0.5, 3));
  page = write();
  EXPECT_THAT(page, HasSubstr("<p class='wrong'><b>1 wrong pose was given out</b>"));
  EXPECT_THAT(page, HasSubstr("<tr class='wrong'><td>123</td><td class='value'>50.0 cm</td>"));
}

TEST_F(ReportTest, ListsTheWrongPosesThatItAnnounces) {
  const auto rows = [](const std::string &page) {
    size_t count = 0;
    for (size_t at = 0; (at = page.find("<tr class='wrong'>", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  for (uint32_t i = 0; i < 20; ++i) run_.frames.push_back(goodFrame(100 + i, 0.5, 3));
  std::string page = write();
  EXPECT_THAT(page, HasSubstr("<b>20 wrong poses were given out</b>"));
  EXPECT_THAT(page, HasSubstr("below has them."));
  EXPECT_EQ(rows(page), 20u);
  for (uint32_t i = 0; i < 40; ++i) run_.frames.push_back(goodFrame(200 + i, 0.5, 3));
  page = write();
  EXPECT_THAT(page, HasSubstr("below has the worst 50; frames.jsonl has all."));
  EXPECT_EQ(rows(page), 50u);
}

TEST_F(ReportTest, SaysWhereTheTruthMayLieElsewhere) {
  run_.frames.clear();
  for (uint32_t i = 0; i < 8; ++i) {
    run_.frames.push_back(goodFrame(i, 2.6, 3));
    run_.frames.back().confidence = 0.99;
  }
  std::string page = write();
  EXPECT_THAT(page, HasSubstr("it has a world of its own (--align compares after an alignment)"));
  EXPECT_THAT(page, Not(HasSubstr("Truth aligned")));
  run_.aligned_frames = 8;
  page = write();
  EXPECT_THAT(page, HasSubstr("<b>Truth aligned</b> by 8 poses: the errors are what a rigid alignment"));
  EXPECT_THAT(page, HasSubstr("the true place (grey line, aligned)."));
}

TEST_F(ReportTest, SaysSoWithoutGnuplot) {
  const char *path = getenv("PATH");
  const std::string saved = path ? path : "";
  setenv("PATH", "/nonexistent", 1);
  const std::string page = write();
  setenv("PATH", saved.c_str(), 1);
  EXPECT_THAT(problem_, HasSubstr("apt-get install gnuplot-nox"));
  EXPECT_THAT(page, HasSubstr("gnuplot is not installed"));
  EXPECT_THAT(page, Not(HasSubstr("<svg")));
  for (const char *name : {"path", "stage_times", "translation_error", "rotation_error", "timeline"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / (std::string("plots/") + name + ".gp"))) << name;
}

TEST_F(ReportTest, DrawsReliabilityWhereThereIsAConfidence) {
  EXPECT_THAT(write(), Not(HasSubstr("Is it as sure as it may be?")));
  for (FrameRecord &frame : run_.frames) frame.confidence = 0.9;
  EXPECT_THAT(write(), HasSubstr("Is it as sure as it may be?"));
  EXPECT_EQ(problem_, "");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "plots/reliability.png"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "plots/gnuplot.log")) << "there was nothing to say";
}

TEST_F(ReportTest, WorksWithoutTruth) {
  for (FrameRecord &frame : run_.frames) frame.has_truth = false;
  std::string page = write();
  EXPECT_THAT(page, HasSubstr("The truth was not given"));
  EXPECT_THAT(page, Not(HasSubstr("How far off")));
  EXPECT_THAT(page, HasSubstr("in the map&#39;s own frame"));
  run_.base = "world";  // with the owner's note
  EXPECT_THAT(write(), HasSubstr("No pose of the recording can be compared"));
  run_.has_poses = false;
  page = write();
  EXPECT_THAT(page, HasSubstr("The recording holds no poses, so this report"));
  EXPECT_THAT(page, Not(HasSubstr("pose of the recording")));
  EXPECT_THAT(page, HasSubstr("in the world that the map was made in"));
  EXPECT_THAT(page, Not(HasSubstr("Run again with")));
  EXPECT_THAT(page, HasSubstr("It needs a recording with poses"));
}

// Errors colour the dots, and where there is no truth there is no error: such a dot must not look exact.
TEST_F(ReportTest, DrawsAnswersWithoutTruthApart) {
  const auto script = [this] {
    write();
    const auto bytes = readBytes(folder_ / "plots/path.gp");
    return std::string(bytes.begin(), bytes.end());
  };
  EXPECT_THAT(script(), Not(HasSubstr("$unjudged using")));
  run_.frames[3].has_truth = false;
  const std::string some = script();
  EXPECT_THAT(some, HasSubstr("$estimate using 1:2:3"));
  EXPECT_THAT(some, HasSubstr("'truth not known'"));
  EXPECT_THAT(write(), HasSubstr("Of the blue ones the true place is not known."));
  for (FrameRecord &frame : run_.frames) frame.has_truth = false;
  const std::string none = script();
  EXPECT_THAT(none, Not(HasSubstr("$estimate using")));
  EXPECT_THAT(none, HasSubstr("title 'estimate'"));
}

TEST_F(ReportTest, OfSeveralMapsAllCentresAreDrawn) {
  run_.base = "world";
  run_.maps[0].path = "room.sphc";
  run_.maps.resize(2, run_.maps.front());
  run_.centres_m = {{0.1, 0.2, 1}, {0.5, 0.1, 1}, {90, 0, 1}};  // the last is too far off
  const std::string page = write();
  EXPECT_THAT(page, HasSubstr("The stars are the sphere centres"));
  EXPECT_THAT(page, HasSubstr("All directions in room.sphc, seen from its centre"));
  const auto bytes = readBytes(folder_ / "plots/path.gp");
  EXPECT_EQ(linesOf({bytes.begin(), bytes.end()}, "centre"), 2);
}

// Without the owner's notes each map has a frame of its own.
TEST_F(ReportTest, AnswersInFramesOfSeveralMapsAreNotDrawnAsOnePath) {
  run_.maps.resize(2, run_.maps.front());
  run_.maps[1].path = "hall.sphc";
  for (FrameRecord &frame : run_.frames) {
    frame.has_truth = false;
    frame.map = frame.sequence < 3 ? 0 : 1;
  }
  EXPECT_THAT(write(), HasSubstr("Every dot is one answer in hall.sphc, in that map&#39;s own frame."));
  const auto bytes = readBytes(folder_ / "plots/path.gp");
  EXPECT_EQ(linesOf({bytes.begin(), bytes.end()}, "unjudged"), 5) << "frames 3 to 7";
  for (FrameRecord &frame : run_.frames) frame.map = 1;
  const std::string page = write();
  EXPECT_THAT(page, HasSubstr("Every dot is one answer in hall.sphc, in that map&#39;s own frame."));
  EXPECT_THAT(page, HasSubstr("All that hall.sphc shows of its room"));
  EXPECT_THAT(page, HasSubstr("<td class='value'>hall.sphc</td><td class='soft'>8 frames localized in it</td>"));
}

// After an alignment each map has a world of its own too.
TEST_F(ReportTest, OfAlignedMapsOneIsDrawn) {
  run_.base = "world";
  run_.maps.resize(2, run_.maps.front());
  run_.maps[1].path = "hall.sphc";
  run_.centres_m = {{0.1, 0.2, 1}, {0.5, 0.1, 1}};
  run_.aligned_frames = 8;
  for (FrameRecord &frame : run_.frames) frame.map = frame.sequence < 3 ? 0 : 1;
  const std::string page = write();
  EXPECT_THAT(page, HasSubstr("Every dot is one answer in hall.sphc, coloured by"));
  EXPECT_THAT(page, HasSubstr("The star is the sphere centre"));
  const auto bytes = readBytes(folder_ / "plots/path.gp");
  EXPECT_EQ(linesOf({bytes.begin(), bytes.end()}, "truth"), 5) << "frames 3 to 7";
}

TEST_F(ReportTest, LargeNumbersOfFramesKeepTheirDigits) {
  for (FrameRecord &frame : run_.frames) frame.sequence += 1999999998;
  write();
  const std::string drawn = folder_ / "plots/timeline.svg";
  if (!std::filesystem::exists(drawn)) GTEST_SKIP() << "gnuplot is not installed";
  const auto bytes = readBytes(drawn);
  EXPECT_THAT(std::string(bytes.begin(), bytes.end()), HasSubstr("2000000002"));
}

TEST_F(ReportTest, WorksWhenNothingWasLocalized) {
  run_.frames = {lostFrame(1)};
  EXPECT_THAT(write(), HasSubstr("no consensus"));
}

TEST_F(ReportTest, SaysWhatUpIsInThePictureOfDirections) {
  EXPECT_THAT(write(), HasSubstr("longitude to the left, up is up."));
  for (FrameRecord &frame : run_.frames) frame.base_from_camera.q_wxyz[1] = 0.15;  // looks down
  EXPECT_THAT(write(), HasSubstr("up is as the cameras were held on average."));
}

TEST_F(ReportTest, LeavesNoPictureOfAnEarlierRun) {
  write();
  run_.frames.pop_back();
  write();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "overlay_not_localized_1.jpg"));
}

TEST_F(ReportTest, KeepsPicturesThatAreNotItsOwn) {
  for (const char *name : {"overlay_of_mine.jpg", "overlay_best.png", "overlay_wrong_7.jpg"})
    std::ofstream(folder_ / name) << "a picture";
  write();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "overlay_of_mine.jpg"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "overlay_best.png"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "overlay_wrong_7.jpg")) << "of a run before";
}

// With the truth there were curves of errors.
TEST_F(ReportTest, LeavesNoPlotOfAnEarlierRun) {
  const std::string curve = folder_ / "plots/translation_error";
  write();
  ASSERT_TRUE(std::filesystem::exists(curve + ".gp"));
  for (FrameRecord &frame : run_.frames) frame.has_truth = false;
  write();
  for (const char *ending : {".gp", ".svg", ".png"})
    EXPECT_FALSE(std::filesystem::exists(curve + ending)) << ending;
}

TEST_F(ReportTest, NamesSeveralMapsAsTheyAreCalled) {
  run_.maps[0].path = "room.sphc";
  EXPECT_THAT(write(), HasSubstr("<p>walk &lt;one&gt; in the sphere cloud room.sphc</p>"));
  run_.maps.push_back(run_.maps[0]);
  run_.maps[1].path = "kitchen & <hall>.sphc";
  const std::string page = write();
  EXPECT_THAT(page, HasSubstr("<td class='value'>kitchen &amp; &lt;hall&gt;.sphc</td>"));
  EXPECT_THAT(page, HasSubstr(" in the sphere clouds room.sphc, kitchen &amp; &lt;hall&gt;.sphc</p>"));
}

// Killed then, it would leave pictures, and no page to know them by.
TEST_F(ReportTest, APageMarksTheFolderBeforeThePictures) {
  const std::string page = folder_ / "report.html";
  const ImageOfFrame image = [&page](const FrameRecord &) {
    const auto bytes = readBytes(page);
    EXPECT_THAT(std::string(bytes.begin(), bytes.end()), AllOf(HasSubstr(kReportHead), HasSubstr("not finished")));
    return cv::Mat(48, 64, CV_8UC3, cv::Scalar(90, 90, 90));
  };
  writeReport(folder_.path(), run_, image);
  const auto bytes = readBytes(page);
  EXPECT_THAT(std::string(bytes.begin(), bytes.end()), Not(HasSubstr("not finished")));
}

TEST_F(ReportTest, APageOfAnEarlierRunDoesNotStayOverNewFigures) {
  write();
  const ImageOfFrame broken = [](const FrameRecord &) -> cv::Mat { throw std::runtime_error("no space left"); };
  EXPECT_THROW(writeReport(folder_.path(), run_, broken), std::runtime_error);
  const auto bytes = readBytes(folder_ / "report.html");
  EXPECT_THAT(std::string(bytes.begin(), bytes.end()), HasSubstr("not finished"));
}

TEST_F(ReportTest, NamesTheFolderThatCannotBeWritten) {
  EXPECT_THAT(test::refusal([&] { writeReport("/dev/null/report", run_, nullptr); }),
              HasSubstr("/dev/null/report"));
}

}  // namespace
}  // namespace sphc::host
