#include "runtime/stages/match/search_cone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

constexpr uint32_t kCount = 4000;

// Directions all over the sphere, with the poles, folds and corners of the packing among them.
std::vector<PackedDirection> directions() {
  Random random(1);
  std::vector<PackedDirection> packed;
  const uint16_t edges[] = {1, 2, 16384, 32767, 32768, 32769, 49152, 65535};
  for (const uint16_t u : edges)
    for (const uint16_t v : edges) packed.push_back({u, v});
  while (packed.size() < kCount + kConeOverread) {
    const auto u = static_cast<uint16_t>(1 + random.below(65535)),
               v = static_cast<uint16_t>(1 + random.below(65535));
    packed.push_back({u, v});
  }
  return packed;
}

SearchCone randomCone(Random *random) {
  const Vector3 axis = test::randomDirection(random);
  return {{static_cast<float>(axis.x()), static_cast<float>(axis.y()), static_cast<float>(axis.z())},
          static_cast<float>(std::cos(test::uniformIn(random, 0, kPi)))};
}

TEST(SearchCone, SimdEqualsScalar) {
  const std::vector<PackedDirection> packed = directions();
  Random random(2);
  for (int round = 0; round < 200; ++round) {
    std::vector<DirectionRun> runs;
    for (uint32_t k = random.below(6); k > 0; --k) {
      const uint32_t begin = random.below(kCount - 40);
      runs.push_back({begin, begin + random.below(40)});
    }
    if (round == 0) runs = {{0, kCount}};
    const SearchCone cone = randomCone(&random);
    std::vector<uint32_t> simd(kCount + 240), scalar(kCount + 240);
    simd.resize(findInside(packed.data(), {runs.data(), runs.size()}, cone, simd.data()));
    scalar.resize(findInsideScalar(packed.data(), {runs.data(), runs.size()}, cone, scalar.data()));
    ASSERT_EQ(simd, scalar);
  }
}

TEST(SearchCone, InsideIsWhatTheUnpackedDirectionSays) {
  const std::vector<PackedDirection> packed = directions();
  Random random(3);
  const DirectionRun all = {0, kCount};
  size_t found = 0;
  for (int round = 0; round < 50; ++round) {
    const SearchCone cone = randomCone(&random);
    std::vector<uint32_t> inside(kCount);
    inside.resize(findInside(packed.data(), {&all, 1}, cone, inside.data()));
    std::vector<bool> is_inside(kCount);
    for (uint32_t i : inside) is_inside[i] = true;
    for (uint32_t i = 0; i < kCount; ++i) {
      const Direction d = unpackDirection(packed[i]);
      const float cosine = d.x * cone.axis.x + d.y * cone.axis.y + d.z * cone.axis.z;
      const bool on_the_rim = std::abs(cosine - cone.cosine) < 1e-5f;
      ASSERT_TRUE(on_the_rim || is_inside[i] == (cosine > cone.cosine)) << i;
    }
    found += inside.size();
  }
  EXPECT_GT(found, 50u * kCount / 4);
}

}  // namespace
}  // namespace sphc
