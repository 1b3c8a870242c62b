// The same bytes again: from call to call, from memory to memory, from one instruction set to another.
#include <gtest/gtest.h>

#include "tests/support/every_instruction_set.h"
#include "tests/unit/runtime/stages/features/features_fixture.h"

namespace sphc {
namespace {

uint64_t fingerprint(const Features &features) {
  uint64_t hash = 0xCBF29CE484222325ull;  // FNV-1a
  const auto add = [&](const void *data, size_t bytes) {
    for (size_t i = 0; i < bytes; ++i) hash = (hash ^ static_cast<const uint8_t *>(data)[i]) * 0x100000001B3ull;
  };
  add(features.keypoints.data(), features.keypoints.size() * sizeof(Keypoint));
  add(features.descriptors.data(), features.descriptors.size() * sizeof(Descriptor));
  return hash;
}

TEST(Repeatability, ScratchKeepsNothing) {
  const TestImage a = spots(200, 150, 1), b = noise(200, 150, 2);
  TestExtractor extractor(configFor(a)), other(configFor(a), 0xFF);
  const Features first = extractor(a);
  extractor(b);
  EXPECT_TRUE(same(first, extractor(a)));
  EXPECT_TRUE(same(first, other(a)));
  EXPECT_TRUE(extractor.sound());
}

TEST(Repeatability, InstructionSetsAgree) {
  const TestImage a = spots(333, 211, 1), b = noise(160, 121, 2);
  const Features first = extractFrom(a), second = extractFrom(b);
  int tried = 0;
  test::withEveryInstructionSet([&](const char *name) {
    EXPECT_TRUE(same(first, extractFrom(a))) << name;
    EXPECT_TRUE(same(second, extractFrom(b))) << name;
    ++tried;
  });
  EXPECT_GE(tried, 1);
}

TEST(Repeatability, ScalarVersionAgrees) {
  for (const TestImage &image : {spots(333, 211, 1), noise(160, 121, 2), noise(37, 300, 3)}) {
    for (const int32_t first_octave : {0, -1}) {
      FeatureConfig config = configFor(image);
      config.first_octave = first_octave;
      TestExtractor fast(config), plain(config, 0xA5, scalarFeatureKernels());
      const Features found = fast(image);
      EXPECT_GT(found.keypoints.size(), 10u);
      EXPECT_TRUE(same(found, plain(image))) << image.width << ", octave " << first_octave;
    }
  }
}

// Pinned: when this changes, maps built before no longer fit, so kExtractorId rises with it.
TEST(Repeatability, BytesArePinned) {
  EXPECT_EQ(fingerprint(extractFrom(noise(256, 200, 42))), 13275549569735278974ull);
  EXPECT_EQ(kExtractorId, 2u);
}

}  // namespace
}  // namespace sphc
