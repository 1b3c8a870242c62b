#include "runtime/localizer/map_set.h"

#include <gtest/gtest.h>

#include "tests/support/arena_memory.h"

namespace sphc {
namespace {

class Maps : public testing::Test {
 protected:
  Maps() : memory_([this](Arena &arena, bool real) { MapSet::layout(3, arena, real ? &maps_ : nullptr); }) {}
  uint32_t set(uint32_t id) { return maps_.set(id, MapView()); }

  MapSet maps_;

 private:
  test::ArenaMemory memory_;
};

TEST_F(Maps, HaveSlotsByTheirIds) {
  EXPECT_EQ(maps_.count(), 0u);
  EXPECT_EQ(maps_.slotOf(0), kNoMap);
  EXPECT_EQ(set(70), 0u);
  EXPECT_EQ(set(0), 1u);
  EXPECT_EQ(maps_.slotOf(70), 0u);
  EXPECT_EQ(maps_.slotOf(0), 1u);
  EXPECT_EQ(maps_.idOf(0), 70u);
  EXPECT_EQ(maps_.count(), 2u);
  EXPECT_FALSE(maps_.isTaken(2));
  EXPECT_EQ(maps_.slotOf(kNoMap), kNoMap);  // the id of an empty slot is nobody's
}

TEST_F(Maps, AreReplacedWhereTheyLie) {
  set(1), set(2), set(3);
  EXPECT_EQ(set(2), 1u);
  EXPECT_EQ(maps_.count(), 3u);
  EXPECT_EQ(set(4), kNoMap);  // all are taken
  EXPECT_EQ(maps_.count(), 3u);
  EXPECT_EQ(maps_.slotOf(4), kNoMap);
}

TEST_F(Maps, LeaveRoomForOthers) {
  set(1), set(2), set(3);
  maps_.remove(maps_.slotOf(2));
  EXPECT_EQ(maps_.count(), 2u);
  EXPECT_EQ(maps_.slotOf(2), kNoMap);
  EXPECT_EQ(maps_.slotOf(3), 2u);  // others stay where they are
  EXPECT_EQ(set(9), 1u);
}

TEST_F(Maps, LieToEachOtherAsTheyLieToWhatTheyShare) {
  const auto at = [](double turn_rad, double x_m) {
    return Rigid{rotationFromVector(Vector3(0, turn_rad, 0)), Vector3(x_m, 1, 2)};
  };
  set(1), set(2), set(3);
  EXPECT_FALSE(maps_.placementIn(0, 1).is_known);
  maps_.place(0, {true, at(0.5, 3), 0.03, 0.3});
  EXPECT_FALSE(maps_.placementIn(0, 1).is_known) << "the other has none";
  EXPECT_FALSE(maps_.placementIn(1, 0).is_known);
  maps_.place(1, {true, at(-0.2, 5), 0.04, 0.4});
  const Placement placement = maps_.placementIn(0, 1);
  ASSERT_TRUE(placement.is_known);
  const Vector3 point(0.1, -0.4, 0.7);  // in the second map
  EXPECT_LT((at(0.5, 3) * (placement.common_from_map * point) - at(-0.2, 5) * point).norm(), 1e-14);
  EXPECT_NEAR(placement.rotation_sigma_rad, 0.05, 1e-12);
  EXPECT_NEAR(placement.translation_sigma_m, 0.5, 1e-12);
  set(2);
  EXPECT_TRUE(maps_.placementIn(0, 1).is_known) << "a newer release lies where the older one did";
  maps_.remove(1);
  set(9);
  EXPECT_FALSE(maps_.placementIn(0, 1).is_known) << "another map";
}

}  // namespace
}  // namespace sphc
