#include "host/report/overlay.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "frames.h"

namespace sphc::host {
namespace {

std::vector<std::string> names(const Run &run) {
  std::vector<std::string> names;
  for (const Highlight &highlight : chooseHighlights(run)) {
    names.push_back(highlight.name + ":" + std::to_string(run.frames[highlight.frame].sequence));
  }
  return names;
}

TEST(Highlights, AreBestMedianWorstAndLost) {
  host::Run run;
  run.frames = {goodFrame(1, 0.03, 0), lostFrame(2), goodFrame(3, 0.01, 0), goodFrame(4, 0.02, 0), lostFrame(5)};
  EXPECT_EQ(names(run),
            (std::vector<std::string>{"best:3", "median:4", "worst:1", "not_localized_1:2", "not_localized_2:5"}));
}

TEST(Highlights, ShowTheWrongPoses) {
  host::Run run;
  run.frames = {goodFrame(1, 0.30, 0), goodFrame(2, 0.01, 0), goodFrame(3, 0.40, 0), goodFrame(4, 0.02, 11)};
  EXPECT_EQ(names(run), (std::vector<std::string>{"best:2", "median:1", "worst:3", "wrong_4:4"}));
}

TEST(Highlights, ShowAWrongPoseOnce) {
  host::Run run;
  run.frames = {goodFrame(1, 0.30, 0)};
  EXPECT_EQ(names(run), (std::vector<std::string>{"best:1"}));
  run.frames.push_back(goodFrame(2, 0.40, 0));
  EXPECT_EQ(names(run), (std::vector<std::string>{"best:1", "worst:2"}));
}

TEST(Highlights, GoByInliersWithoutTruth) {
  host::Run run;
  run.frames = {goodFrame(1, 0, 0), goodFrame(2, 0, 0)};
  for (FrameRecord &frame : run.frames) frame.has_truth = false;
  run.frames[1].inliers = 90;
  EXPECT_EQ(names(run), (std::vector<std::string>{"best:2", "worst:1"}));
  EXPECT_EQ(chooseHighlights(run)[0].title, "Most matches agree");
  EXPECT_EQ(chooseHighlights(run)[1].title, "Fewest matches agree");
}

TEST(Highlights, OfASingleFrameShowItOnce) {
  host::Run run;
  run.frames = {lostFrame(1)};
  EXPECT_EQ(names(run), (std::vector<std::string>{"not_localized_1:1"}));
  EXPECT_TRUE(chooseHighlights(host::Run()).empty());
}

TEST(Overlay, MarksAnInlierInGreen) {
  const cv::Mat gray(60, 80, CV_8UC3, cv::Scalar(100, 100, 100));
  FrameRecord frame = goodFrame(1, 0.01, 0);
  frame.observations = {{30.5f, 30.5f, 2, 1, 0, SPHC_OBSERVATION_MATCHED | SPHC_OBSERVATION_INLIER, 0}};
  const cv::Mat picture = drawOverlay(gray, frame);
  ASSERT_EQ(picture.cols, 160);
  EXPECT_GT(picture.rows, 120);
  int green = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const auto &pixel = picture.at<cv::Vec3b>(y, x);
      green += pixel[1] > 180 && pixel[2] < 140;
    }
  }
  EXPECT_GT(green, 20);
}

// Gaps between things that are drawn in the legend below an image of `rows`, wider than those between words.
int wideGaps(const cv::Mat &picture, int rows) {
  cv::Mat legend, ink;
  cv::cvtColor(picture.rowRange(rows, picture.rows), legend, cv::COLOR_BGR2GRAY);
  cv::reduce(legend, ink, 0, cv::REDUCE_MAX);
  const double between_words = 16 * picture.cols / 1280.0;
  int gaps = 0, gap = 0;
  bool is_begun = false;
  for (int x = 0; x < ink.cols; ++x) {
    if (ink.at<uint8_t>(0, x) < 60) {
      ++gap;
      continue;
    }
    gaps += is_begun && gap >= between_words;
    is_begun = true;
    gap = 0;
  }
  return gaps;
}

TEST(Overlay, WordsOfTheLegendDoNotOverlap) {
  FrameRecord frame = goodFrame(3, 0.0135, 0.13);
  frame.keypoints = 1000;
  frame.matches = 186;
  frame.inliers = 179;
  for (const int width : {480, 640, 1440}) {
    const cv::Mat image(40, width, CV_8UC3, cv::Scalar(100, 100, 100));
    EXPECT_EQ(wideGaps(drawOverlay(image, frame), 80), 3) << width;
  }
}

TEST(Overlay, LettersGrowWithTheImage) {
  const auto legend = [](int width) {
    return drawOverlay(cv::Mat(40, width, CV_8UC3, cv::Scalar(100, 100, 100)), goodFrame(1, 0, 0)).rows - 80;
  };
  EXPECT_EQ(legend(640), 56);
  EXPECT_EQ(legend(1440), 126);
}

TEST(Overlay, ReadsEveryColourFormat) {
  const uint8_t rgb[3] = {200, 100, 50};
  const sphc_image image = {rgb, 1, 1, 3, SPHC_FORMAT_RGB8};
  EXPECT_EQ(bgrFromImage(image).at<cv::Vec3b>(0, 0), cv::Vec3b(50, 100, 200));
  EXPECT_THROW(bgrFromImage({rgb, 1, 1, 2, SPHC_FORMAT_DEPTH16}), std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
