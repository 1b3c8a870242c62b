#include "host/cli/common/new_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;

TEST(NewRecording, HasItsNameOnceItIsWhole) {
  const test::TempFolder folder;
  NewRecording file(folder / "a.mcap", NewRecording::IfCut::kRemove);
  EXPECT_EQ(file.part(), folder / "a.mcap.part");
  std::ofstream(file.part()) << "all";
  file.isMade();
  EXPECT_FALSE(fs::exists(folder / "a.mcap"));
  file.finish();
  EXPECT_TRUE(fs::exists(folder / "a.mcap"));
  EXPECT_FALSE(fs::exists(file.part()));

  fs::create_directory(folder / "walk");  // empty: what people make beforehand
  NewRecording walk((folder / "walk") + "/", NewRecording::IfCut::kRemove);
  EXPECT_EQ(walk.part(), folder / "walk.part");
  walk.makeFolder();
  std::ofstream(walk.part() + "/rgb.txt") << "all";
  walk.finish();
  EXPECT_TRUE(fs::exists(folder / "walk/rgb.txt"));
}

TEST(NewRecording, WhatWasCutGoesOrStays) {
  const test::TempFolder folder;
  const std::string image = folder / "walk.part/rgb.txt";
  for (const bool is_kept : {false, true}) {
    {
      NewRecording walk(folder / "walk", NewRecording::IfCut::kRemove);
      walk.makeFolder();
      std::ofstream(image) << "half";
      if (is_kept) walk.keepIfCut();
    }
    EXPECT_EQ(fs::exists(image), is_kept);
    EXPECT_EQ(fs::exists(folder / "walk.part"), is_kept);
  }
}

TEST(NewRecording, APartThatAnotherMadeStays) {
  const test::TempFolder folder;
  for (const char *name : {"a.mcap", "walk"}) {
    NewRecording first(folder / name, NewRecording::IfCut::kRemove);
    EXPECT_FALSE(NewRecording::isBeingWritten(first.part())) << "it is not there";
    first.makeFolder();
    {
      NewRecording second(folder / name, NewRecording::IfCut::kRemove);
      EXPECT_THROW(second.makeFolder(), std::runtime_error);
    }
    EXPECT_TRUE(fs::exists(first.part()));
    EXPECT_TRUE(NewRecording::isBeingWritten(first.part()));
    first.keepIfCut();
  }
  EXPECT_FALSE(NewRecording::isBeingWritten(folder / "walk.part")) << "it was cut";
}

// What the message names is there afterwards.
TEST(NewRecording, TakesNobodysPlaceAndStaysWholeUnderItsOwn) {
  const test::TempFolder folder;
  const std::string part = folder / "a.mcap.part";
  {
    NewRecording file(folder / "a.mcap", NewRecording::IfCut::kRemove);
    std::ofstream(part) << "new";
    file.isMade();
    std::ofstream(folder / "a.mcap") << "came meanwhile";
    EXPECT_THAT(test::refusal([&file] { file.finish(); }), testing::HasSubstr(part));
  }
  EXPECT_EQ(fs::file_size(folder / "a.mcap"), 14u);
  EXPECT_EQ(fs::file_size(part), 3u);
}

}  // namespace
}  // namespace sphc::host
