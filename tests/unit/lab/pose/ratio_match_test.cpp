#include "lab/pose/ratio_match.h"

#include <gtest/gtest.h>

#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

std::vector<Descriptor> randomDescriptors(size_t count) {
  Random random(1);
  std::vector<Descriptor> descriptors;
  for (size_t i = 0; i < count; ++i) descriptors.push_back(sphc::test::randomDescriptor(&random));
  return descriptors;
}

Descriptor near(Descriptor descriptor, uint8_t by) {
  descriptor.bytes[0] = static_cast<uint8_t>(descriptor.bytes[0] ^ by);
  return descriptor;
}

TEST(RatioMatch, FindsTheNearest) {
  const std::vector<Descriptor> points = randomDescriptors(50);
  const auto matches = matchByRatio({near(points[7], 1), near(points[31], 2)}, points, 0.8);
  ASSERT_EQ(matches.size(), 2u);
  EXPECT_EQ(matches[0].point, 7u);
  EXPECT_EQ(matches[1].query, 1u);
  EXPECT_EQ(matches[1].point, 31u);
}

TEST(RatioMatch, NearDuplicatesAreRefused) {
  std::vector<Descriptor> points = randomDescriptors(10);
  points.push_back(points[3]);
  EXPECT_TRUE(matchByRatio({near(points[3], 1)}, points, 0.8).empty());
}

TEST(RatioMatch, OfTwoQueriesWithOnePointTheNearerStays) {
  const std::vector<Descriptor> points = randomDescriptors(10);
  const auto matches = matchByRatio({near(points[3], 4), near(points[3], 1)}, points, 0.8);
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].query, 1u);
}

TEST(RatioMatch, NothingInNothing) { EXPECT_TRUE(matchByRatio(randomDescriptors(2), {}, 0.8).empty()); }

}  // namespace
}  // namespace sphc::host
