#include "runtime/stages/match/sector_cones.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "runtime/map/sector.h"
#include "tests/support/arena_memory.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

class SectorConesTest : public testing::Test {
 protected:
  std::vector<SectorRun> touched(const SearchCone &cone) {
    std::vector<SectorRun> runs(SectorCones::kMaxRuns);
    cones_.prepare(side_, cone.cosine);
    runs.resize(cones_.touched(cone.axis, {runs.data(), runs.size()}));
    return runs;
  }

  uint32_t side_ = 1;
  SectorCones cones_;
  test::ArenaMemory memory_{
      [this](Arena &arena, bool has_memory) { SectorCones::layout(arena, has_memory ? &cones_ : nullptr); }};
};

PackedDirection randomPacked(Random *random) {
  const auto u = static_cast<uint16_t>(1 + random->below(65535)),
             v = static_cast<uint16_t>(1 + random->below(65535));
  return {u, v};
}

bool holds(const std::vector<SectorRun> &runs, uint32_t sector) {
  for (const SectorRun &run : runs)
    if (sector >= run.first && sector <= run.last) return true;
  return false;
}

// Whatever lies inside the cone lies in a sector that was named: poles, folds and corners too.
TEST_F(SectorConesTest, NoSectorOfAPointInsideIsLeftOut) {
  Random random(1);
  for (const uint32_t side : {1u, 2u, 4u, 8u, 16u, 32u}) {
    side_ = side;
    for (int i = 0; i < 300; ++i) {
      const Vector3 axis =
          i % 3 ? test::randomDirection(&random)
                : (Vector3(i % 2, i % 5 > 2, i % 7 > 3 ? -1 : 1) + 0.01 * test::normalVector(&random)).normalized();
      const double angle = test::uniformIn(&random, 0.001, i % 4 ? 0.2 : kPi);
      const SearchCone cone = {
          {static_cast<float>(axis.x()), static_cast<float>(axis.y()), static_cast<float>(axis.z())},
          static_cast<float>(std::cos(angle))};
      const std::vector<SectorRun> runs = touched(cone);
      for (int k = 0; k < 200; ++k) {
        const Vector3 near = (axis + angle * test::normalVector(&random)).normalized();
        const double sum = near.cwiseAbs().sum();
        double u = near.x() / sum, v = near.y() / sum;
        if (near.z() < 0) {
          const double folded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
          v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
          u = folded;
        }
        const PackedDirection packed = {static_cast<uint16_t>(32768 + std::lround(u * 32767)),
                                        static_cast<uint16_t>(32768 + std::lround(v * 32767))};
        const Direction d = unpackDirection(packed);
        const bool inside = d.x * cone.axis.x + d.y * cone.axis.y + d.z * cone.axis.z > cone.cosine;
        ASSERT_TRUE(!inside || holds(runs, sectorOf(packed, side)))
            << side << " " << axis.transpose() << " " << angle;
      }
    }
  }
}

TEST_F(SectorConesTest, ASmallCapTouchesFewSectors) {
  Random random(2);
  side_ = 16;
  uint32_t sum = 0;
  for (int i = 0; i < 1000; ++i) {
    const Direction d = unpackDirection(randomPacked(&random));
    for (const SectorRun &run : touched({d, 0.9986f})) sum += run.last - run.first + 1;  // 3 degrees
  }
  EXPECT_LT(sum, 1000u * 6);  // of 256
}

TEST_F(SectorConesTest, TheWholeSphereIsOneRun) {
  for (const uint32_t side : {1u, 8u, 32u}) {
    side_ = side;
    const std::vector<SectorRun> runs = touched({{0, 0, 1}, -1.0f});
    ASSERT_EQ(runs.size(), 1u);
    EXPECT_EQ(runs[0].first, 0u);
    EXPECT_EQ(runs[0].last, side * side - 1);
  }
}

}  // namespace
}  // namespace sphc
