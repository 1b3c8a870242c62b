#include "lab/worst/run.h"

#include <gtest/gtest.h>

#include <set>

#include "lab/worst/cases.h"
#include "lab/worst/table.h"
#include "tests/unit/lab/common/room_frames.h"

namespace sphc::host {
namespace {

constexpr uint32_t kShots = 2;

class WorstTest : public testing::Test {
 protected:
  WorstTest() {
    input_.config = room_.config;
    input_.sequence = room_.sequence;
    input_.centre_in_world_m = room_.centre_in_world_m;
    input_.map = &room_.map;
  }
  static WorstCase named(const std::string &name) {
    for (const WorstCase &each : worstCases())
      if (each.name == name) return each;
    throw std::runtime_error(name);
  }

  sphc::test::RoomFrames room_{kShots};
  WorstInput input_;
};

TEST_F(WorstTest, CasesHaveNamesOfTheirOwnAndTheFirstIsNormal) {
  std::set<std::string> names;
  for (const WorstCase &each : worstCases()) names.insert(each.name);
  EXPECT_EQ(names.size(), worstCases().size());
  EXPECT_EQ(worstCases()[0].name, "normal");
}

TEST_F(WorstTest, ARowSaysWhatItsCaseDid) {
  const std::vector<WorstRow> rows =
      runWorst(input_, {named("normal"), named("all matches wrong"), named("one descriptor"), named("one cell")});
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].localized, kShots);
  EXPECT_EQ(rows[1].localized, 0u);
  EXPECT_GT(rows[1].iterations, rows[0].iterations) << "nothing ends the search early";
  EXPECT_EQ(rows[2].matches, 0) << "every second neighbour is as near as the first";
  EXPECT_EQ(rows[3].localized, kShots) << "the same points";
  for (const WorstRow &row : rows) {
    EXPECT_EQ(row.frames, kShots);
    EXPECT_EQ(row.wrong, 0u);
    EXPECT_GT(row.times_normal_median, 0);
    EXPECT_GE(row.times_normal_worst, row.times_normal_median);
    EXPECT_GT(row.stack_bytes, 0u);
    EXPECT_GT(row.state_bytes, 0u);
  }
  EXPECT_EQ(worstJson(rows)[1]["case"], "all matches wrong");
  EXPECT_NE(worstText(rows).find("one descriptor"), std::string::npos);
}

TEST_F(WorstTest, EveryCaseCanBeMade) {
  input_.sequence.shots.resize(1);
  for (const WorstCase &each : worstCases()) EXPECT_NO_THROW(runOnce(input_, each)) << each.name;
}

TEST_F(WorstTest, DotsAreManyKeypointsThatAllLookAlike) {
  const std::vector<WorstRow> rows = runWorst(input_, {named("normal"), named("dots")});
  EXPECT_EQ(rows[1].keypoints, input_.config.max_keypoints);
  EXPECT_EQ(rows[1].localized, 0u);
}

}  // namespace
}  // namespace sphc::host
