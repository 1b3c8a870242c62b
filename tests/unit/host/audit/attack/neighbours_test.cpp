#include "host/audit/attack/neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "host/audit/attack/mirror.h"
#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

constexpr int kPoints = 90, kCount = 7;

// The others of point `i`, nearest first, one by one.
template <typename Distance>
std::vector<int> ranked(int i, Distance distance) {
  std::vector<int> others;
  for (int j = 0; j < kPoints; ++j)
    if (j != i) others.push_back(j);
  std::stable_sort(others.begin(), others.end(), [&](int a, int b) { return distance(i, a) < distance(i, b); });
  others.resize(kCount);
  return others;
}

template <typename Distance>
void expectNearest(const Neighbours &neighbours, Distance distance) {
  ASSERT_EQ(neighbours.indices.rows(), kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const std::vector<int> others = ranked(i, distance);
    for (int k = 0; k < kCount; ++k) {
      EXPECT_EQ(neighbours.indices(i, k), others[k]);
      EXPECT_NEAR(neighbours.distances(i, k), distance(i, others[k]), 1e-4);
    }
  }
}

double apart(const Descriptor &a, const Descriptor &b) {
  double sum = 0;
  for (size_t k = 0; k < kDescriptorBytes; ++k) sum += (a.bytes[k] - b.bytes[k]) * (a.bytes[k] - b.bytes[k]);
  return std::sqrt(sum);
}

TEST(Neighbours, AreTheNearestWithoutThePointItself) {
  Random random(3);
  std::vector<Vector3> directions;
  std::vector<Descriptor> descriptors;
  for (int i = 0; i < kPoints; ++i) {
    directions.push_back(test::randomDirection(&random));
    descriptors.push_back(test::randomDescriptor(&random));
  }
  expectNearest(directionNeighbours(directions, kCount),
                [&](int i, int j) { return (directions[i] - directions[j]).norm(); });
  expectNearest(descriptorNeighbours(descriptors, kCount),
                [&](int i, int j) { return apart(descriptors[i], descriptors[j]); });
}

TEST(Neighbours, NearestOfAnotherTable) {
  Random random(4);
  const std::vector<Descriptor> table = {test::randomDescriptor(&random), test::randomDescriptor(&random)};
  const std::vector<Descriptor> queries = {table[1], test::randomDescriptor(&random)};
  const Neighbours nearest = nearestDescriptors(queries, table, 2);
  EXPECT_EQ(nearest.indices(0, 0), 1);
  EXPECT_EQ(nearest.distances(0, 0), 0);
  EXPECT_NEAR(nearest.distances(1, 0), std::min(apart(queries[1], table[0]), apart(queries[1], table[1])), 1e-3);
  EXPECT_NEAR(nearest.distances(1, 1), std::max(apart(queries[1], table[0]), apart(queries[1], table[1])), 1e-3);
}

TEST(Mirror, IsItsOwnInverseAndMovesMostBytes) {
  Descriptor descriptor;
  for (size_t i = 0; i < kDescriptorBytes; ++i) descriptor.bytes[i] = static_cast<uint8_t>(i);
  const Descriptor mirror = mirrorOf(descriptor), back = mirrorOf(mirror);
  size_t unmoved = 0;
  for (size_t i = 0; i < kDescriptorBytes; ++i) {
    EXPECT_EQ(back.bytes[i], descriptor.bytes[i]);
    unmoved += mirror.bytes[i] == descriptor.bytes[i];
  }
  EXPECT_EQ(unmoved, 0u);  // no row of cells is its own image
  EXPECT_EQ(mirror.bytes[1], 3 * 32 + 7);
}

}  // namespace
}  // namespace sphc::host
