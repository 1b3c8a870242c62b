#include "host/cli/common/new_recording.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;

TEST(NewRecording, HasItsNameOnceItIsWhole) {
  const test::TempFolder folder;
  NewRecording file(folder / "a.mcap", NewRecording::IfCut::kRemove);
  EXPECT_EQ(file.part(), folder / "a.mcap.part");
  std::ofstream(file.part()) << "all";
  EXPECT_FALSE(fs::exists(folder / "a.mcap"));
  file.finish();
  EXPECT_TRUE(fs::exists(folder / "a.mcap"));
  EXPECT_FALSE(fs::exists(file.part()));

  fs::create_directory(folder / "walk");  // empty: what people make beforehand
  NewRecording walk((folder / "walk") + "/", NewRecording::IfCut::kRemove);
  EXPECT_EQ(walk.part(), folder / "walk.part");
  fs::create_directory(walk.part());
  std::ofstream(walk.part() + "/rgb.txt") << "all";
  walk.finish();
  EXPECT_TRUE(fs::exists(folder / "walk/rgb.txt"));
}

TEST(NewRecording, WhatWasCutGoesOrStays) {
  const test::TempFolder folder;
  for (const auto if_cut : {NewRecording::IfCut::kRemove, NewRecording::IfCut::kKeep}) {
    NewRecording walk(folder / "walk", if_cut);
    fs::create_directory(walk.part());
    std::ofstream(walk.part() + "/rgb.txt") << "half";
  }
  EXPECT_TRUE(fs::exists(folder / "walk.part/rgb.txt"));
  {
    NewRecording walk(folder / "walk", NewRecording::IfCut::kRemove);
    walk.keepIfCut();
  }
  EXPECT_TRUE(fs::exists(folder / "walk.part/rgb.txt"));
  { const NewRecording walk(folder / "walk", NewRecording::IfCut::kRemove); }
  EXPECT_FALSE(fs::exists(folder / "walk.part"));
}

TEST(NewRecording, TakesNobodysPlace) {
  const test::TempFolder folder;
  NewRecording file(folder / "a.mcap", NewRecording::IfCut::kKeep);
  std::ofstream(file.part()) << "new";
  std::ofstream(folder / "a.mcap") << "came meanwhile";
  EXPECT_THROW(file.finish(), std::runtime_error);
  EXPECT_EQ(fs::file_size(folder / "a.mcap"), 14u);
  EXPECT_EQ(fs::file_size(file.part()), 3u);
}

}  // namespace
}  // namespace sphc::host
