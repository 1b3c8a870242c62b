#include "host/publish/descriptor_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "runtime/map/sector.h"
#include "runtime/stages/match/distance.h"
#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

struct Points {
  std::vector<Descriptor> descriptors;
  std::vector<PackedDirection> directions;
};

// `count` points around `kinds` kinds of descriptors.
Points pointsOf(size_t count, size_t kinds) {
  Random random(8);
  Points points;
  std::vector<Descriptor> middles;
  for (size_t i = 0; i < kinds; ++i) middles.push_back(test::randomDescriptor(&random));
  for (size_t i = 0; i < count; ++i) {
    Descriptor descriptor = middles[random.below(static_cast<uint32_t>(kinds))];
    for (uint8_t &byte : descriptor.bytes) byte = static_cast<uint8_t>(byte ^ random.below(8));
    points.descriptors.push_back(descriptor);
    const auto coordinate = [&] { return static_cast<uint16_t>(1 + random.below(65535)); };
    const uint16_t u = coordinate(), v = coordinate();
    points.directions.push_back({u, v});
  }
  return points;
}

uint32_t nearestOf(const std::vector<Descriptor> &centroids, const Descriptor &descriptor) {
  uint32_t best = 0;
  for (uint32_t c = 1; c < centroids.size(); ++c)
    if (distance2Scalar(centroids[c], descriptor) < distance2Scalar(centroids[best], descriptor)) best = c;
  return best;
}

TEST(DescriptorIndex, EveryPointIsInItsNearestCellAndItsSectorOnce) {
  const Points points = pointsOf(3000, 40);
  const DescriptorIndex index = makeIndex(points.descriptors, points.directions);
  const uint32_t sectors = index.sector_side * index.sector_side;
  ASSERT_EQ(index.runs.size(), index.centroids.size() * sectors + 1);
  EXPECT_EQ(index.runs.front(), 0u);
  EXPECT_EQ(index.runs.back(), 3000u);
  std::vector<uint32_t> seen(3000);
  for (uint32_t run = 0; run + 1 < index.runs.size(); ++run) {
    for (uint32_t at = index.runs[run]; at < index.runs[run + 1]; ++at) {
      const uint32_t from = index.order[at];
      ++seen[from];
      EXPECT_EQ(nearestOf(index.centroids, points.descriptors[from]), run / sectors);
      EXPECT_EQ(sectorOf(points.directions[from], index.sector_side), run % sectors);
      EXPECT_TRUE(at == index.runs[run] || from > index.order[at - 1]);  // the input's order, which is shuffled
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1u), 3000);
}

TEST(DescriptorIndex, EveryCellIsInTheGroupOfItsNearestCentroid) {
  const Points points = pointsOf(3000, 40);
  const DescriptorIndex index = makeIndex(points.descriptors, points.directions);
  ASSERT_EQ(index.groups.size(), index.group_centroids.size() + 1);
  EXPECT_EQ(index.groups.back(), index.centroids.size());
  for (uint32_t g = 0; g + 1 < index.groups.size(); ++g)
    for (uint32_t c = index.groups[g]; c < index.groups[g + 1]; ++c)
      EXPECT_EQ(nearestOf(index.group_centroids, index.centroids[c]), g);
}

TEST(DescriptorIndex, TheSameInputGivesTheSameIndex) {
  const Points points = pointsOf(500, 10);
  const DescriptorIndex a = makeIndex(points.descriptors, points.directions),
                        b = makeIndex(points.descriptors, points.directions);
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(a.runs, b.runs);
  EXPECT_EQ(std::memcmp(a.centroids.data(), b.centroids.data(), a.centroids.size() * kDescriptorBytes), 0);
}

// Directions, which alone differ between real and fake points, have no part in the cells.
TEST(DescriptorIndex, CellsDependOnDescriptorsAlone) {
  Points points = pointsOf(500, 10);
  const DescriptorIndex before = makeIndex(points.descriptors, points.directions);
  std::reverse(points.directions.begin(), points.directions.end());
  const DescriptorIndex after = makeIndex(points.descriptors, points.directions);
  EXPECT_EQ(
      std::memcmp(before.centroids.data(), after.centroids.data(), before.centroids.size() * kDescriptorBytes), 0);
  const size_t sectors = size_t{before.sector_side} * before.sector_side;
  for (size_t run = 0; run < before.runs.size(); run += sectors) EXPECT_EQ(before.runs[run], after.runs[run]);
}

TEST(DescriptorIndex, FewPointsHaveNoMoreCells) {
  for (size_t count = 0; count <= 8; ++count) {
    const Points points = pointsOf(count, 3);
    const DescriptorIndex index = makeIndex(points.descriptors, points.directions);
    EXPECT_LE(index.centroids.size(), count);
    EXPECT_EQ(index.centroids.empty(), count == 0);
    EXPECT_EQ(index.order.size(), count);
    EXPECT_EQ(index.runs.back(), count);
  }
}

TEST(DescriptorIndex, PointsThatAreAllAlike) {
  Points points = pointsOf(100, 1);
  for (Descriptor &d : points.descriptors) d = points.descriptors[0];
  const DescriptorIndex index = makeIndex(points.descriptors, points.directions);
  EXPECT_EQ(index.order.size(), 100u);
  EXPECT_EQ(index.runs.back(), 100u);
}

}  // namespace
}  // namespace sphc::host
