#include "host/audit/score/image_scores.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/base/random.h"
#include "tests/unit/host/audit/score/truth_picture.h"

namespace sphc::host {
namespace {

cv::Mat noise(uint64_t seed) {
  Random random(seed);
  cv::Mat picture(128, 128, CV_32F);
  for (float &grey : cv::Mat_<float>(picture)) grey = static_cast<float>(random.uniform());
  return picture;
}

TEST(ImageScores, TheTruthInAnotherUnitIsPerfect) {
  const TruthView truth = truthPicture(1);
  const ImageScores scores = scoreImage(truth.grey * 0.01 - 3, truth);
  EXPECT_NEAR(scores.ncc, 1, 1e-4);
  EXPECT_NEAR(scores.ssim, 1, 1e-3);
  EXPECT_NEAR(scores.mae, 0, 1e-4);
  EXPECT_GT(scores.psnr_db, 60);
  EXPECT_EQ(scores.edge_recall, 1);
  EXPECT_GT(scores.sift_found, 0.8);
}

TEST(ImageScores, WhatIsUnknownDoesNotCount) {
  const TruthView truth = truthPicture(1);
  cv::Mat picture = truth.grey.clone();
  picture.setTo(5000, ~truth.seen);
  const ImageScores scores = scoreImage(picture, truth);
  EXPECT_NEAR(scores.ncc, 1, 1e-4);
  EXPECT_NEAR(scores.mae, 0, 1e-4);
  EXPECT_EQ(scores.edge_recall, 1);
}

TEST(ImageScores, TheNegativeIsTheOpposite) {
  const TruthView truth = truthPicture(2);
  const ImageScores scores = scoreImage(-truth.grey, truth);
  EXPECT_NEAR(scores.ncc, -1, 1e-4);
  EXPECT_LT(scores.ssim, 0.1);
  EXPECT_EQ(scores.edge_recall, 1);  // edges have no sign
}

TEST(ImageScores, NoiseShowsNothing) {
  const TruthView truth = truthPicture(3);
  const ImageScores scores = scoreImage(noise(5), truth);
  EXPECT_NEAR(scores.ncc, 0, 0.05);
  EXPECT_NEAR(scores.ssim, 0, 0.06);
  EXPECT_NEAR(scores.edge_recall, scores.edge_chance, 0.1);
  EXPECT_LT(scores.sift_found, 0.05);
}

// E |a - b|^2 = 2 (1 - ncc) 0.2^2 of standardised pictures.
TEST(ImageScores, PsnrFollowsFromCorrelation) {
  const TruthView truth = truthPicture(4);
  const ImageScores scores = scoreImage(truth.grey / 50 + 2 * noise(6), truth);
  EXPECT_GT(scores.ncc, 0.2);
  EXPECT_LT(scores.ncc, 0.99);
  EXPECT_NEAR(scores.psnr_db, -10 * std::log10(2 * (1 - scores.ncc) * 0.04), 0.01);
}

TEST(ImageScores, AGreyPictureIsNoFault) {
  const ImageScores scores = scoreImage(cv::Mat(128, 128, CV_32F, cv::Scalar(0)), truthPicture(1));
  EXPECT_NEAR(scores.ncc, 0, 1e-6);
  EXPECT_EQ(scores.edge_recall, 0);
  EXPECT_EQ(scores.sift_found, 0);
}

}  // namespace
}  // namespace sphc::host
