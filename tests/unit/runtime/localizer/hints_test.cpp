#include "runtime/localizer/hints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "runtime/base/random.h"
#include "runtime/localizer/tuning.h"

namespace sphc {
namespace {

using namespace tuning;

constexpr int32_t kWidth = 320, kHeight = 240;
constexpr double kFocalPx = 300;

// Squares of random greys, mixed along a line of some pixels, with noise.
class Picture {
 public:
  Picture() : pixels_(size_t{kWidth} * kHeight) {
    Random random(1);
    std::vector<double> greys(size_t{kWidth} * kHeight / 100 + 64);
    for (double &grey : greys) grey = 40 + 160 * random.uniform();
    for (int32_t y = 0; y < kHeight; ++y)
      for (int32_t x = 0; x < kWidth; ++x) at(x, y) = greys[static_cast<size_t>(y / 10 * (kWidth / 10) + x / 10)];
  }
  Picture &darken(double factor) {
    for (double &pixel : pixels_) pixel *= factor;
    return *this;
  }
  Picture &blur(int32_t reach, int32_t dx, int32_t dy) {
    const std::vector<double> before = pixels_;
    for (int32_t y = 0; y < kHeight; ++y)
      for (int32_t x = 0; x < kWidth; ++x) {
        double sum = 0;
        for (int32_t i = -reach; i <= reach; ++i) {
          const int32_t u = std::min(std::max(x + i * dx, 0), kWidth - 1),
                        v = std::min(std::max(y + i * dy, 0), kHeight - 1);
          sum += before[static_cast<size_t>(v * kWidth + u)];
        }
        at(x, y) = sum / (2 * reach + 1);
      }
    return *this;
  }
  Picture &addNoise(double sigma) {
    Random random(2);
    for (double &pixel : pixels_) {
      double sum = -6;  // of twelve even numbers: nearly normal
      for (int i = 0; i < 12; ++i) sum += random.uniform();
      pixel += sigma * sum;
    }
    return *this;
  }
  ImageQuality quality() {
    bytes_.clear();
    for (const double pixel : pixels_)
      bytes_.push_back(static_cast<uint8_t>(std::min(std::max(pixel + 0.5, 0.0), 255.0)));
    return qualityOf({bytes_.data(), kWidth, kHeight, kWidth}, kFocalPx);
  }

 private:
  double &at(int32_t x, int32_t y) { return pixels_[static_cast<size_t>(y * kWidth + x)]; }

  std::vector<double> pixels_;
  std::vector<uint8_t> bytes_;
};

TEST(ImageQuality, AGoodImageIsNeitherDarkNorBlurred) {
  const ImageQuality quality = Picture().addNoise(2).quality();
  EXPECT_NEAR(quality.level, 120, 15);
  EXPECT_NEAR(quality.noise, 2, 0.5);
  EXPECT_FALSE(quality.isDark());
  EXPECT_FALSE(quality.isBlurredAlongALine());
}

TEST(ImageQuality, LittleLightIsDarkWithOrWithoutAmplification) {
  EXPECT_TRUE(Picture().darken(0.04).addNoise(0.5).quality().isDark());
  const ImageQuality amplified = Picture().darken(0.5).addNoise(12).quality();
  EXPECT_NEAR(amplified.noise, 12, 2);
  EXPECT_TRUE(amplified.isDark());
  EXPECT_FALSE(Picture().darken(0.5).addNoise(2).quality().isDark()) << "half the brightness";
  EXPECT_TRUE(Picture().darken(0).quality().isDark()) << "black";
}

TEST(ImageQuality, ALampIsNotOverexposureAndTwiceTheLightIs) {
  EXPECT_FALSE(Picture().addNoise(2).quality().isOverexposed());
  EXPECT_FALSE(Picture().darken(1.3).quality().isOverexposed()) << "a few squares are white";
  EXPECT_TRUE(Picture().darken(2).quality().isOverexposed());
}

TEST(ImageQuality, BlurAlongALineIsToldFromBlurAllAround) {
  for (const double noise : {0.0, 3.0}) {
    EXPECT_TRUE(Picture().blur(12, 1, 0).addNoise(noise).quality().isBlurredAlongALine()) << noise;
    EXPECT_TRUE(Picture().blur(12, 0, 1).addNoise(noise).quality().isBlurredAlongALine()) << noise;
    EXPECT_TRUE(Picture().blur(9, 1, 1).addNoise(noise).quality().isBlurredAlongALine()) << noise;
    EXPECT_FALSE(Picture().blur(12, 1, 0).blur(12, 0, 1).addNoise(noise).quality().isBlurredAlongALine()) << noise;
  }
}

TEST(ImageQuality, AnImageOfOneColourIsPlain) {
  const std::vector<uint8_t> gray(size_t{kWidth} * kHeight, 120);
  const ImageQuality quality = qualityOf({gray.data(), kWidth, kHeight, kWidth}, kFocalPx);
  EXPECT_TRUE(quality.isPlain());
  EXPECT_FALSE(quality.isBlurredAlongALine());
  EXPECT_FALSE(Picture().addNoise(2).quality().isPlain());
  const std::vector<uint8_t> tiny(16 * 16, 120);
  EXPECT_FALSE(qualityOf({tiny.data(), 16, 16, 16}, kFocalPx).isBlurredAlongALine());
}

TEST(Hints, SalientKeypointsAreThoseBeyondNoise) {
  const Keypoint weak = {0, 0, 2, 0, 0.0005f}, strong = {0, 0, 2, 0, 0.01f};
  const std::vector<Keypoint> keypoints = {strong, weak, strong};
  EXPECT_EQ(countSalient({keypoints.data(), keypoints.size()}, 2), 2u);
  EXPECT_EQ(countSalient({keypoints.data(), keypoints.size()}, 30), 0u);
}

TEST(Hints, ClearMatchesBeatTheirRunnerUpByFar) {
  const std::vector<Match> matches = {{0, 0, 100, 1000}, {1, 1, 700, 1000}, {2, 2, 0, 0}};
  EXPECT_EQ(countClear({matches.data(), matches.size()}), 1u);
}

FrameEvidence goodFrame() {
  FrameEvidence frame;
  frame.image = {120, 2, 30, 0.1, 0.12};
  frame.keypoints = frame.salient = 800;
  frame.lifted = 700;
  frame.was_asked = true;
  frame.clear = 100;
  return frame;
}

Hypothesis without(Outcome outcome) {
  Hypothesis best;
  best.tried = true;
  best.outcome = outcome;
  return best;
}

TEST(Hints, OfAGoodFrameNothingIsKnown) { EXPECT_EQ(hintsOf(goodFrame(), without(Outcome::kNoConsensus)), 0u); }

TEST(Hints, TheImageAndTheDepthTellWhy) {
  const Hypothesis none = without(Outcome::kNoConsensus);
  FrameEvidence frame = goodFrame();
  frame.image.level = 10;
  EXPECT_EQ(hintsOf(frame, none), kTooDark);
  frame.image.least_sharp = 0.01;
  frame.salient = 5;
  EXPECT_EQ(hintsOf(frame, none), kTooDark) << "blurred and plain it may only seem";
  frame.image.level = 120;
  frame.salient = 800;
  EXPECT_EQ(hintsOf(frame, none), kTooFast);
  frame = goodFrame();
  frame.salient = 5;
  EXPECT_EQ(hintsOf(frame, none), kTooPlain);
  frame = goodFrame();
  frame.image.contrast = 2;
  EXPECT_EQ(hintsOf(frame, none), kTooPlain);
  frame = goodFrame();
  frame.lifted = 20;
  EXPECT_EQ(hintsOf(frame, none), kNoDepthInRange);
  frame.keypoints = frame.salient = frame.lifted = 5;
  frame.was_cut = true;
  EXPECT_EQ(hintsOf(frame, none), 0u) << "what a deadline left out may be there";
  frame.keypoints = 400;
  EXPECT_EQ(hintsOf(frame, none), kNoDepthInRange) << "of so many some have depth";
  frame = goodFrame();
  frame.clear = 2;
  EXPECT_EQ(hintsOf(frame, none), kNotInMap);
  frame.was_cut = true;
  EXPECT_EQ(hintsOf(frame, none), 0u) << "not all of it was compared";
  frame.image.contrast = 2;
  EXPECT_EQ(hintsOf(frame, none), kTooPlain) << "of the image alone";
}

TEST(Hints, WhatIsSeenWellAndMatchesNothingIsNotInTheMap) {
  FrameEvidence frame = goodFrame();
  frame.clear = 2;
  EXPECT_EQ(hintsOf(frame, without(Outcome::kNoConsensus)), kNotInMap);
  EXPECT_EQ(hintsOf(frame, without(Outcome::kFewMatches)), kNotInMap);
  EXPECT_EQ(hintsOf(frame, without(Outcome::kUncertain)), 0u) << "a pose was found";
  Hypothesis nearly = without(Outcome::kNoConsensus);
  nearly.evidence.log_chance_first = -10;
  EXPECT_EQ(hintsOf(frame, nearly), 0u) << "chance hardly explains the agreement";
  frame.image.level = 10;
  EXPECT_EQ(hintsOf(frame, without(Outcome::kNoConsensus)), kTooDark) << "in the dark nothing is like the map";
  frame = goodFrame();
  frame.clear = 2;
  frame.was_asked = false;
  EXPECT_EQ(hintsOf(frame, without(Outcome::kNoConsensus)), 0u) << "not all was compared";
}

TEST(Hints, ARivalMakesThePoseAmbiguous) {
  Hypothesis best = without(Outcome::kUncertain);
  EXPECT_EQ(hintsOf(goodFrame(), best), 0u) << "too weak, but alone";
  best.doubtForRival();
  EXPECT_EQ(hintsOf(goodFrame(), best), kAmbiguous);
  best.outcome = Outcome::kDeadline;
  EXPECT_EQ(hintsOf(goodFrame(), best), 0u) << "with more time it might have been told apart";
}

TEST(ImageQuality, EdgesAreHiddenInTheDarkAndInTheLight) {
  for (const int level : {0, 128, 255}) {
    const std::vector<uint8_t> gray(size_t{kWidth} * kHeight, static_cast<uint8_t>(level));
    EXPECT_EQ(hidesEdges({gray.data(), kWidth, kHeight, kWidth}), level != 128) << level;
  }
}

// The same response is more where the blur has left less noise.
TEST(Hints, ACoarserKeypointIsMoreSalient) {
  Keypoint fine = {};
  fine.response = 0.001f;
  fine.scale_px = 1;
  Keypoint coarse = fine;
  coarse.scale_px = 4;
  const Keypoint both[] = {fine, coarse};
  EXPECT_EQ(countSalient({both, 2}, 1), 1u);
}

}  // namespace
}  // namespace sphc
