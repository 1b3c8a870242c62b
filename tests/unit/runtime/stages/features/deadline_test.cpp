// The feature stage against the clock: time is the number of times it is read.
#include <gtest/gtest.h>

#include <memory>

#include "tests/support/stepping_clock.h"
#include "tests/unit/runtime/stages/features/features_fixture.h"

namespace sphc {
namespace {

constexpr int64_t kStepNs = 1000;

std::vector<Keypoint> finerThan(float scale_px, const Features &features) {
  std::vector<Keypoint> finer;
  for (const Keypoint &k : features.keypoints)
    if (k.scale_px < scale_px) finer.push_back(k);
  return finer;
}

bool hasAlike(const Features &features, const Keypoint &k) {
  return std::any_of(features.keypoints.begin(), features.keypoints.end(), [&](const Keypoint &other) {
    return std::hypot(k.x_px - other.x_px, k.y_px - other.y_px) < 0.25f * k.scale_px &&
           std::abs(k.scale_px - other.scale_px) < 0.1f * k.scale_px;
  });
}

double finestScale(const Features &features) {
  double finest = 1e9;
  for (const Keypoint &k : features.keypoints) finest = std::min(finest, static_cast<double>(k.scale_px));
  return finest;
}

class FeatureDeadline : public testing::Test {
 protected:
  // After some images with so much time each, when the pace is known.
  Features within(int64_t looks) {
    for (int i = 0; i < 6; ++i) found_ = (*extractor_)(image_, clock_.deadline(clock_.now_ns + looks * kStepNs));
    return found_;
  }
  uint64_t looksOfAll() {
    within(1000000);
    const uint64_t before = clock_.reads;
    (*extractor_)(image_, clock_.deadline(clock_.now_ns + 1000000 * kStepNs));
    return clock_.reads - before;
  }

  void useImage(const TestImage &image) {
    image_ = image;
    extractor_ = std::make_unique<TestExtractor>(configFor(image_, 300));
  }

  TestImage image_ = spots(320, 240, 7);
  std::unique_ptr<TestExtractor> extractor_ = std::make_unique<TestExtractor>(configFor(image_, 300));
  test::SteppingClock clock_{kStepNs};
  Features found_;
};

TEST_F(FeatureDeadline, ADistantOneChangesNothing) {
  const Features plain = (*extractor_)(image_);
  EXPECT_TRUE(same(plain, within(1000000)));
  EXPECT_FALSE(extractor_->wasCut());
  EXPECT_EQ(plain.keypoints.size(), 300u);
}

TEST_F(FeatureDeadline, WithoutOneNoClockIsReadAndNothingIsKept) {
  const Features plain = (*extractor_)(image_);
  within(60);
  const uint64_t before = clock_.reads;
  EXPECT_TRUE(same(plain, (*extractor_)(image_)));
  EXPECT_EQ(clock_.reads, before);
  EXPECT_FALSE(extractor_->wasCut());
}

TEST_F(FeatureDeadline, ThePassedOneGivesNothing) {
  const uint64_t before = clock_.reads;
  EXPECT_EQ((*extractor_)(image_, clock_.deadline(clock_.now_ns)).keypoints.size(), 0u);
  EXPECT_TRUE(extractor_->wasCut());
  EXPECT_LT(clock_.reads - before, 30u);
}

// Whatever the time, the stage goes on for a few looks after it, and says that it was cut.
TEST_F(FeatureDeadline, EndsSoonAfterEveryOne) {
  const auto all = static_cast<int64_t>(looksOfAll());
  for (int64_t looks = 1; looks < all; looks += 3) {
    const int64_t end_ns = clock_.now_ns + looks * kStepNs;
    (*extractor_)(image_, clock_.deadline(end_ns));
    EXPECT_LE(clock_.now_ns, end_ns + 25 * kStepNs) << looks;
    EXPECT_TRUE(extractor_->sound());
  }
}

TEST_F(FeatureDeadline, TheFinestScalesAreLeftOutFirst) {
  const auto all = static_cast<int64_t>(looksOfAll());
  const Features plain = (*extractor_)(image_), most = within(all * 3 / 4);
  EXPECT_TRUE(extractor_->wasCut());
  EXPECT_LT(finestScale(plain), 1.6);
  EXPECT_GT(finestScale(most), 1.9);
  EXPECT_GT(most.keypoints.size(), 100u);
}

// Where the second octave does not fit as a whole, a band of its rows in the middle of the image shows some of it:
// the keypoints that the whole octave has there.
TEST_F(FeatureDeadline, ABandOfTheOctaveThatDoesNotFitIsSwept) {
  const auto all = static_cast<int64_t>(looksOfAll());
  const Features plain = TestExtractor(configFor(image_, 6000))(image_);
  uint32_t bands = 0, fine = 0, found_again = 0;
  for (int64_t looks = 1; looks < all; ++looks) {
    const Features found = within(looks);
    const std::vector<Keypoint> band = finerThan(4.2f, found);
    if (band.size() < 5) continue;
    const auto [top, bottom] = std::minmax_element(
        band.begin(), band.end(), [](const Keypoint &a, const Keypoint &b) { return a.y_px < b.y_px; });
    if (bottom->y_px - top->y_px > 190) continue;
    EXPECT_TRUE(extractor_->wasCut()) << looks;
    EXPECT_LT(top->y_px, 140) << looks;
    EXPECT_GT(bottom->y_px, 100) << looks;
    EXPECT_TRUE(extractor_->sound());
    ++bands;
    fine += static_cast<uint32_t>(band.size());
    for (const Keypoint &k : band) found_again += hasAlike(plain, k);
  }
  EXPECT_GT(bands, 5u);
  EXPECT_GT(found_again, 0.9 * fine);
}

// Without the octave before them, the others are made from an image that was blurred at once: nearly the same one.
TEST_F(FeatureDeadline, CoarseKeypointsAreWhereTheyWere) {
  const auto all = static_cast<int64_t>(looksOfAll());
  const Features plain = TestExtractor(configFor(image_, 3000))(image_), half = within(all / 2);
  uint32_t found_again = 0;
  for (const Keypoint &k : half.keypoints) found_again += hasAlike(plain, k);
  EXPECT_GT(found_again, 0.8 * static_cast<double>(half.keypoints.size()));
}

// Where most of the time is gone while octaves are skimmed, the band below them would be made of the image before.
TEST_F(FeatureDeadline, NothingIsFoundOfTheImageBefore) {
  constexpr int64_t kTimeNs = 900000, kLateNs = 730000;  // of an extractor whose pace is not known yet
  const TestImage blank = draw(640, 480, [](double, double) { return 128; });
  for (uint64_t late_read = 1; late_read < 40; ++late_read) {
    useImage(spots(640, 480, 7));
    (*extractor_)(image_);
    test::SteppingClock clock(kStepNs / 10);
    clock.late_read = late_read;
    clock.late_by_ns = kLateNs;
    EXPECT_EQ((*extractor_)(blank, clock.deadline(kTimeNs)).keypoints.size(), 0u) << "late at " << late_read;
  }
}

TEST_F(FeatureDeadline, NoiseEverywhereIsCutToo) {
  useImage(noise(640, 480, 3));
  const auto all = static_cast<int64_t>(looksOfAll());
  for (const int64_t looks : {all / 8, all / 4, all / 3, all / 2, 2 * all / 3, 5 * all / 6}) {
    const int64_t end_ns = clock_.now_ns + looks * kStepNs;
    (*extractor_)(image_, clock_.deadline(end_ns));
    EXPECT_TRUE(extractor_->wasCut());
    EXPECT_LE(clock_.now_ns, end_ns + 25 * kStepNs);
  }
}

}  // namespace
}  // namespace sphc
