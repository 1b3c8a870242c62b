#include "host/audit/score/retrieval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tests/unit/host/audit/score/truth_picture.h"

namespace sphc::host {
namespace {

struct Pairs {
  std::vector<cv::Mat> pictures;
  std::vector<TruthView> truths;
};

// Each picture is its truth, blurred and in another unit.
Pairs tenPairs() {
  Pairs pairs;
  for (uint64_t i = 0; i < 10; ++i) {
    pairs.truths.push_back(truthPicture(i));
    cv::Mat picture;
    cv::GaussianBlur(pairs.truths.back().grey * 0.02 - 1, picture, {}, 3);
    pairs.pictures.push_back(picture);
  }
  return pairs;
}

class EitherCells : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Retrieval, EitherCells, testing::Values(kFineCells, kCoarseCells));

TEST_P(EitherCells, FindsWhatIsShown) {
  const Pairs pairs = tenPairs();
  const Retrieval retrieval = retrieve(pairs.pictures, pairs.truths, GetParam());
  EXPECT_EQ(retrieval.top1, 1);
  EXPECT_EQ(retrieval.standard_error, 0);
}

TEST_P(EitherCells, AnotherPlaceIsAMiss) {
  Pairs pairs = tenPairs();
  std::swap(pairs.pictures[2], pairs.pictures[7]);
  const Retrieval retrieval = retrieve(pairs.pictures, pairs.truths, GetParam());
  EXPECT_NEAR(retrieval.top1, 0.8, 1e-12);
  EXPECT_NEAR(retrieval.standard_error, std::sqrt(0.8 * 0.2 / 10), 1e-12);
  EXPECT_FALSE(retrieval.hits[2]);
  EXPECT_FALSE(retrieval.hits[7]);
  EXPECT_TRUE(retrieval.hits[0]);
}

TEST_P(EitherCells, EdgesAloneFindAPlaceWhoseBrightnessIsWrong) {
  Pairs pairs = tenPairs();
  for (cv::Mat &picture : pairs.pictures) {  // locally flat
    cv::Mat mean;
    cv::GaussianBlur(picture, mean, {}, 6);
    picture = picture - mean;
  }
  EXPECT_GE(retrieve(pairs.pictures, pairs.truths, GetParam()).top1, 0.9);
}

// Turned by 3 degrees: what coarse cells forgive.
TEST(Retrieval, CoarseCellsForgiveAPoseThatIsNearlyRight) {
  Pairs pairs = tenPairs();
  for (cv::Mat &picture : pairs.pictures) {
    const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, 7, 0, 1, 0);
    cv::warpAffine(picture, picture, shift, picture.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  }
  EXPECT_GE(retrieve(pairs.pictures, pairs.truths, kCoarseCells).top1, 0.9);
}

TEST(Retrieval, NothingToFindIsNoFault) {
  const Retrieval retrieval = retrieve({}, {}, kFineCells);
  EXPECT_EQ(retrieval.top1, 0);
  EXPECT_TRUE(retrieval.hits.empty());
}

}  // namespace
}  // namespace sphc::host
