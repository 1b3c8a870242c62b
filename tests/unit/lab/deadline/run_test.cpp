#include "lab/deadline/run.h"

#include <gtest/gtest.h>

#include <cstring>

#include "lab/deadline/frames.h"
#include "lab/deadline/table.h"
#include "tests/unit/lab/common/room_frames.h"

namespace sphc::host {
namespace {

constexpr uint32_t kShots = 3;

class DeadlineTest : public testing::Test {
 protected:
  DeadlineTest() {
    sphc::test::RoomFrames room(kShots);
    input_.config = room.config;
    input_.sequence = room.sequence;
    input_.centre_in_world_m = room.centre_in_world_m;
    maps_.push_back(std::move(room.map));
    input_.maps = &maps_;
  }

  std::vector<MapFile> maps_;
  DeadlineInput input_;
};

TEST_F(DeadlineTest, WithoutADeadlineEveryFrameIsInTimeAndNothingIsCut) {
  const DeadlineRow row = runDeadlines(input_)[0];
  EXPECT_EQ(row.frames, kShots);
  EXPECT_EQ(row.in_time, kShots);
  EXPECT_EQ(row.right, kShots);
  EXPECT_EQ(row.wrong, 0u);
  EXPECT_EQ(row.features_cut + row.matches_cut + row.search_cut + row.verification_cut, 0u);
  EXPECT_GE(row.worst_us, row.median_us);
}

TEST_F(DeadlineTest, ADeadlineThatNothingCanMeetLeavesNoPose) {
  input_.repeats = 2;
  input_.deadlines_us = {1};
  const DeadlineRow row = runDeadlines(input_)[1];
  EXPECT_EQ(row.frames, 2 * kShots);
  EXPECT_EQ(row.right + row.wrong, 0u);
  EXPECT_GT(row.features_cut + row.matches_cut + row.search_cut, 0u);
}

TEST_F(DeadlineTest, HalfIsOfWhatFramesTakeWithoutADeadline) {
  input_.deadlines_us = {100000000};
  input_.half = true;
  const std::vector<DeadlineRow> rows = runDeadlines(input_);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1].right, kShots) << "there was time";
  EXPECT_GT(rows[2].deadline_us, 0u);
  EXPECT_LT(rows[2].deadline_us, 0.5 * rows[0].worst_us + 1);
  EXPECT_GT(rows[2].features_cut + rows[2].matches_cut + rows[2].search_cut + rows[2].verification_cut, 0u);
}

TEST_F(DeadlineTest, TablesSayWhatWasCounted) {
  DeadlineRow row;
  row.deadline_us = 3000;
  row.frames = 200;
  row.in_time = 199;
  row.search_cut = 17;
  EXPECT_NE(deadlineText({row}).find("  3.00 ms      200   99.50%"), std::string::npos) << deadlineText({row});
  EXPECT_EQ(deadlineJson({row})[0]["search_cut"], 17);
}

TEST_F(DeadlineTest, NoiseIsTheSameOfTheSameSeed) {
  Shot a = input_.sequence.shots[0], b = input_.sequence.shots[1], c = a;
  makeNoise(1, &a);
  makeNoise(1, &b);
  makeNoise(2, &c);
  EXPECT_EQ(a.color, b.color);
  EXPECT_NE(a.color, c.color);
  EXPECT_EQ(a.color.size(), c.color.size());
}

TEST_F(DeadlineTest, AMapInOneCellHasTheSamePoints) {
  maps_.push_back(inOneCell(maps_[0]));
  maps_.erase(maps_.begin());
  EXPECT_EQ(runDeadlines(input_)[0].right, kShots);
}

}  // namespace
}  // namespace sphc::host
