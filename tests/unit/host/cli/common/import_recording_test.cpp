#include "host/cli/common/import_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "host/cli/common/console.h"
#include "tests/support/temp_folder.h"
#include "tests/unit/host/cli/command_runner.h"

namespace sphc::host {
namespace {

TEST(ImportFrames, TakesThoseWithImagesAndAPose) {
  const test::TempFolder folder;
  RecordingOptions walk;
  walk.folder = folder / "walk";
  ASSERT_EQ(runCommand("simulate --frames 6 --rate 2 --out " + walk.folder).exit_code, 0);
  EXPECT_EQ(importFrames(walk, 3, "querying", Console()).size(), 3u);
  std::ofstream(walk.folder + "/rgb/000000.png") << "no image";
  EXPECT_EQ(importFrames(walk, 3, "querying", Console()).size(), 3u) << "the one after it stands for it";
  std::ofstream(walk.folder + "/rgb/000001.png") << "no image";
  EXPECT_EQ(importFrames(walk, 3, "querying", Console()).size(), 2u);
  for (const char *name : {"2", "3", "4", "5"})
    std::ofstream(walk.folder + "/rgb/00000" + name + ".png") << "no image";
  EXPECT_THAT([&] { importFrames(walk, 3, "querying", Console()); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("has both images and a pose")));
}

TEST(ImportFrames, SaysHowAWalkWithoutPosesGetsThem) {
  const test::TempFolder folder;
  RecordingOptions walk;
  walk.folder = folder / "walk";
  const std::string found = folder / "walk.tum";
  ASSERT_EQ(runCommand("simulate --frames 2 --rate 2 --out " + walk.folder).exit_code, 0);
  std::filesystem::rename(walk.folder + "/groundtruth.txt", found);
  EXPECT_THAT([&] { importFrames(walk, 2, "querying", Console()); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("its --trajectory by --poses-from")));
  walk.poses = found;
  EXPECT_EQ(importFrames(walk, 2, "querying", Console()).size(), 2u);
}

TEST(ImportFrames, TakesThemFromTheWholeRecordingThoughItHasFewMore) {
  const test::TempFolder folder;
  RecordingOptions walk;
  walk.folder = folder / "walk";
  ASSERT_EQ(runCommand("simulate --frames 7 --rate 2 --out " + walk.folder).exit_code, 0);
  const std::vector<PointModel> all = importFrames(walk, 7, "querying", Console()),
                                some = importFrames(walk, 4, "querying", Console());
  ASSERT_EQ(some.size(), 4u);
  const size_t taken[] = {0, 1, 3, 5};
  for (size_t i = 0; i < some.size(); ++i)
    EXPECT_EQ(some[i].points.at(0).position_m, all[taken[i]].points.at(0).position_m) << i;
  EXPECT_EQ(importFrames(walk, 100, "querying", Console()).size(), 7u);
}

}  // namespace
}  // namespace sphc::host
