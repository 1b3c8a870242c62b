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

}  // namespace
}  // namespace sphc
