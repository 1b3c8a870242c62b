// The feature stage in pieces, for several threads: the same bytes.
#include <gtest/gtest.h>

#include "tests/support/backwards.h"
#include "tests/support/stepping_clock.h"
#include "tests/unit/runtime/stages/features/features_fixture.h"

namespace sphc {
namespace {

constexpr uint32_t kPieces[] = {2, 3, 5, 8};

FeatureConfig inPieces(FeatureConfig config, uint32_t pieces) {
  config.pieces = pieces;
  return config;
}

// How often pieces were run at the same time.
uint32_t expectSame(const TestImage &image, const FeatureConfig &config,
                    const FeatureKernels &kernels = simdFeatureKernels()) {
  TestExtractor whole(config, 0xA5, kernels);
  const Features expected = whole(image);
  EXPECT_GT(expected.keypoints.size(), 20u);
  uint32_t calls = 0;
  for (const uint32_t pieces : kPieces) {
    TestExtractor cut(inPieces(config, pieces), 0x3C, kernels, test::backwards(pieces, &calls));
    for (int i = 0; i < 2; ++i) {
      const Features found = cut(image);
      EXPECT_TRUE(found.keypoints.size() == expected.keypoints.size()) << pieces;
      EXPECT_TRUE(std::memcmp(found.keypoints.data(), expected.keypoints.data(),
                              found.keypoints.size() * sizeof(Keypoint)) == 0)
          << pieces;
      EXPECT_TRUE(std::memcmp(found.descriptors.data(), expected.descriptors.data(),
                              found.descriptors.size() * sizeof(Descriptor)) == 0)
          << pieces;
    }
    EXPECT_TRUE(cut.sound()) << pieces;
  }
  return calls;
}

TEST(Pieces, SameBytes) {
  const TestImage image = spots(320, 240, 7);
  EXPECT_EQ(expectSame(image, configFor(image, 300)), 8u * 3);  // two octaves are large enough, and the descriptors
  expectSame(image, configFor(image, 300), scalarFeatureKernels());
  const TestImage odd = spots(211, 333, 8);
  expectSame(odd, configFor(odd, 300));
  const TestImage low = spots(1200, 90, 9);  // one piece, whatever was asked for
  EXPECT_EQ(expectSame(low, configFor(low, 300)), 8u);
}

TEST(Pieces, SameBytesInDoubledImages) {
  const TestImage image = spots(161, 119, 7);
  FeatureConfig config = configFor(image, 300);
  config.first_octave = -1;
  expectSame(image, config);
}

TEST(Pieces, SameBytesOfTwoOrientations) {
  const TestImage image = spots(320, 240, 7);
  for (const uint32_t keypoints : {50u, 800u}) {
    FeatureConfig config = configFor(image, keypoints);
    config.max_orientations = 2;
    expectSame(image, config);
  }
}

// A piece's list is full before its rows end, and so is that of all.
TEST(Pieces, SameBytesOfMoreThanListsHold) {
  const TestImage image = noise(640, 480, 11);
  FeatureConfig config = configFor(image, 64);
  config.contrast_threshold = 0;
  expectSame(image, config);
  expectSame(image, configFor(image, 64));
}

// Each piece has the deadline for itself.
TEST(Pieces, EndInTime) {
  constexpr int64_t kLookNs = 1000;
  const TestImage image = spots(320, 240, 7);
  for (const uint32_t pieces : kPieces) {
    test::SteppingClock clock(kLookNs);
    TestExtractor extractor(inPieces(configFor(image, 300), pieces), 0xA5, simdFeatureKernels(),
                            test::backwards(pieces));
    for (const int64_t looks : {1, 5, 20, 50, 100, 1000000}) {
      for (int i = 0; i < 4; ++i) {
        const uint64_t before = clock.reads;
        const Features found = extractor(image, clock.deadline(clock.now_ns + looks * kLookNs));
        EXPECT_TRUE(extractor.sound());
        EXPECT_LE(clock.reads - before, static_cast<uint64_t>(looks) + 20 * pieces) << looks;
        EXPECT_TRUE(std::is_sorted(found.keypoints.begin(), found.keypoints.end(),
                                   [](const Keypoint &a, const Keypoint &b) { return a.response > b.response; }));
        if (looks > 1000) {
          EXPECT_GT(found.keypoints.size(), 200u);
        }
      }
    }
    EXPECT_FALSE(extractor.wasCut());
  }
}

}  // namespace
}  // namespace sphc
