#include "lab/deadline/run.h"

#include <gtest/gtest.h>

#include <cstring>

#include "lab/deadline/frames.h"
#include "lab/deadline/table.h"
#include "tests/support/session.h"

namespace sphc::host {
namespace {

constexpr uint32_t kShots = 3;

// The test room as frames of a recording, and its map.
class DeadlineTest : public testing::Test {
 protected:
  DeadlineTest() {
    input_.config = sphc::test::sceneConfig();
    const sphc::test::SceneMap made =
        sphc::test::makeSceneMap(input_.config.rig.color_camera, input_.config.max_keypoints, 3, 0.5);
    maps_.push_back(openMapBytes(made.file));
    Sequence sequence;
    sequence.rig = input_.config.rig;
    sequence.color_format = SPHC_FORMAT_GRAY8;
    for (uint32_t i = 0; i < kShots; ++i) {
      const auto frame = sphc::test::sceneFrame(input_.config, i);
      Shot shot;
      shot.color = frame->images.gray;
      shot.depth = frame->images.depth_mm;
      shot.color_time_ns = shot.depth_time_ns = int64_t{1000000000} * (i + 1);
      shot.world_from_camera = rigidToC(sphc::test::sceneViewpoint(i).inverse());
      sequence.shots.push_back(shot);
    }
    for (size_t k = 0; k < 3; ++k) input_.centre_in_world_m[k] = made.centre_in_world_m[static_cast<int>(k)];
    input_.sequences = {sequence};
    input_.maps = &maps_;
  }

  std::vector<MapFile> maps_;
  DeadlineInput input_;
};

TEST_F(DeadlineTest, WithoutADeadlineEveryFrameIsInTimeAndNothingIsCut) {
  const DeadlineRow row = runDeadline(input_, 0);
  EXPECT_EQ(row.frames, kShots);
  EXPECT_EQ(row.in_time, kShots);
  EXPECT_EQ(row.right, kShots);
  EXPECT_EQ(row.wrong, 0u);
  EXPECT_EQ(row.features_cut + row.matches_cut + row.search_cut + row.verification_cut, 0u);
  EXPECT_GE(row.worst_us, row.median_us);
}

TEST_F(DeadlineTest, ADeadlineThatNothingCanMeetLeavesNoPose) {
  input_.repeats = 2;
  const DeadlineRow row = runDeadline(input_, 1);
  EXPECT_EQ(row.frames, 2 * kShots);
  EXPECT_EQ(row.right + row.wrong, 0u);
  EXPECT_GT(row.features_cut + row.matches_cut + row.search_cut, 0u);
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
  Shot a = input_.sequences[0].shots[0], b = input_.sequences[0].shots[1], c = a;
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
  EXPECT_EQ(runDeadline(input_, 0).right, kShots);
}

}  // namespace
}  // namespace sphc::host
