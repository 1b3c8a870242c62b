#include "host/cli/common/file_use.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "host/base/usage_error.h"
#include "host/cli/common/new_recording.h"
#include "tests/support/nobody.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string said(const FileUse &files) {
  const std::string refused = test::refusal([&] { files.check(); });
  return refused.empty() ? "fine" : refused;
}

class FileUseTest : public testing::Test {
 protected:
  FileUseTest() {
    fs::create_directory(folder_ / "walk");
    put("walk/rgb.txt", "# colour");
    put("map", "a map");
  }
  void put(const std::string &name, const std::string &text) const { std::ofstream(folder_ / name) << text; }

  // What is said of an output beside the inputs --recording walk and --map map.
  std::string wrongUse(const std::string &output) const {
    try {
      use(output, false).check();
    } catch (const UsageError &error) {
      return error.what();
    } catch (const std::runtime_error &error) {
      return std::string("no wrong use: ") + error.what();
    }
    return "fine";
  }
  std::string refusal(const std::string &output, bool force = false) const {
    try {
      use(output, force).check();
    } catch (const UsageError &error) {
      return std::string("wrong use: ") + error.what();
    } catch (const std::runtime_error &error) {
      return error.what();
    }
    return "fine";
  }
  FileUse use(const std::string &output, bool force) const {
    FileUse files(force);
    files.reads("--recording", folder_ / "walk");
    files.reads("--map", folder_ / "map");
    files.writes("--out", output, holds("ours"));
    return files;
  }

  const test::TempFolder folder_;
};

TEST_F(FileUseTest, ANewFileAndOneOfOursAreFine) {
  EXPECT_EQ(refusal(folder_ / "new"), "fine");
  put("mine", "this is ours");
  EXPECT_EQ(refusal(folder_ / "mine"), "fine");
  put("empty", "");
  EXPECT_EQ(refusal(folder_ / "empty"), "fine");
  EXPECT_EQ(refusal(""), "fine");
}

TEST_F(FileUseTest, AnOutputIsNeverAnInputWhateverItIsCalled) {
  fs::create_symlink(folder_ / "map", folder_ / "link");
  fs::create_hard_link(folder_ / "map", folder_ / "hard");
  fs::create_directory_symlink(folder_ / "walk", folder_ / "way");
  for (const std::string name : {"map", "link", "hard", "walk/../map", "./map"})
    EXPECT_THAT(wrongUse(folder_ / name), HasSubstr("would replace what --map reads")) << name;
  EXPECT_THAT(wrongUse(folder_ / "walk"), HasSubstr("would replace what --recording reads"));
  EXPECT_THAT(wrongUse(folder_ / "walk/"), HasSubstr("would replace what --recording reads"));
  for (const std::string name : {"walk/rgb.txt", "walk/new", "way/new", "walk/deep/new", "walk/./x/../new"})
    EXPECT_THAT(wrongUse(folder_ / name), HasSubstr("lies in the folder that --recording reads")) << name;
  EXPECT_EQ(refusal(folder_ / "walk2"), "fine");
}

TEST_F(FileUseTest, ForceIsForFilesOfOthersAlone) {
  put("notes", "years of work");
  EXPECT_THAT(refusal(folder_ / "notes"), HasSubstr("--force"));
  EXPECT_EQ(refusal(folder_ / "notes", true), "fine");
  EXPECT_THAT(refusal(folder_ / "map", true), HasSubstr("wrong use"));
  put("a.ledger", std::string("SQLite format 3\0", 16) + std::string(52, 'x') + "SPLG and more");
  EXPECT_THAT(refusal(folder_ / "a.ledger", true), HasSubstr("never replaced"));
  fs::create_directory(folder_ / "other");
  EXPECT_THAT(refusal(folder_ / "other", true), HasSubstr("is a folder"));
  EXPECT_THAT(refusal(folder_ / "none/new", true), HasSubstr("there is no folder"));
  EXPECT_THAT(refusal(folder_ / "none/../new", true), HasSubstr("none/..; make it first"));
}

TEST_F(FileUseTest, AMinusIsNoName) {
  EXPECT_EQ(wrongUse("-").substr(0, 8), "--out: -");
  EXPECT_EQ(refusal("./-"), "fine");
  // Of what is never written into a pipe, /dev/stdout is none either.
  using Write = void (*)(FileUse *, const std::string &path);
  for (const Write write :
       {Write([](FileUse *f, const std::string &path) { f->writesRecording("--out", path); }),
        Write([](FileUse *f, const std::string &path) { f->writesNew("--out", path); }),
        Write([](FileUse *f, const std::string &path) { f->keeps("--out", path); }),
        Write([](FileUse *f, const std::string &path) { f->writesFolder("--out", path, never()); })}) {
    FileUse files(false);
    write(&files, "-");
    try {
      files.check();
      ADD_FAILURE() << "- was taken";
    } catch (const UsageError &error) {
      EXPECT_STREQ(error.what(), "--out: - is no name; give one, or ./- where that is meant");
    }
  }
}

TEST_F(FileUseTest, TwoOutputsAreTwoFiles) {
  for (const std::string &second : {folder_ / "a", folder_ / "walk/../a"}) {
    FileUse files(true);
    files.writes("--map", folder_ / "a", never());
    files.keeps("--ledger", second);
    EXPECT_THROW(files.check(), UsageError) << second;
  }
}

// The folder's own files would replace it.
TEST_F(FileUseTest, AnOutputLiesInNoFolderOfAnother) {
  const auto check = [this](const std::string &file, bool folder_first) {
    FileUse files(true);
    if (!folder_first) files.writes("--frames-json", folder_ / file, never());
    files.writesFolder("--report", folder_ / "report", never());
    if (folder_first) files.writes("--frames-json", folder_ / file, never());
    files.check();
  };
  for (const bool is_there : {false, true}) {
    if (is_there) fs::create_directory(folder_ / "report");
    for (const bool folder_first : {false, true}) {
      for (const std::string file : {"report/summary.json", "walk/../report/a"})
        EXPECT_THROW(check(file, folder_first), UsageError) << file;
      check("report.json", folder_first);
    }
  }
}

TEST_F(FileUseTest, AKeyIsANewFileInAFolderThatIsThere) {
  const auto refused = [](const std::string &path) {
    FileUse files(true);
    files.writesNew("--out", path);
    return said(files);
  };
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("nowhere", folder_ / "link");
  for (const std::string &path : {std::string("/dev/null"), folder_ / "pipe"})
    EXPECT_EQ(refused(path),
              "--out: " + path + " is a device or a pipe, which keeps no key; give the name of a new file");
  EXPECT_THAT(refused(folder_ / "walk"), HasSubstr("is a folder"));
  for (const char *name : {"map", "link"})
    EXPECT_THAT(refused(folder_ / name), HasSubstr("is there already, and keys are never replaced")) << name;
  EXPECT_THAT(refused(folder_ / "none/new"), HasSubstr("there is no folder"));
  EXPECT_EQ(refused(folder_ / "new"), "fine");
}

TEST_F(FileUseTest, WhatIsKeptIsThereAlready) {
  put("a.ledger", "whatever");
  FileUse files(false);
  files.keeps("--ledger", folder_ / "a.ledger");
  EXPECT_NO_THROW(files.check());
}

// A file is made beside the one that it replaces, and a journal beside a ledger.
TEST_F(FileUseTest, AFolderWhereNothingMayBeMadeIsNamed) {
  put("a.ledger", "whatever");
  put("mine", "this is ours");
  const std::string where = folder_ / "";
  fs::permissions(where, fs::perms(0555));
  {
    const test::Nobody nobody;
    for (const std::string name : {"new", "mine"})
      EXPECT_THAT(refusal(folder_ / name), HasSubstr("nothing may be made in")) << name;
    FileUse files(false);
    files.keeps("--ledger", folder_ / "a.ledger");
    EXPECT_THROW(files.check(), std::runtime_error);
    for (const std::string name : {"new", "deep/new", "walk"}) {
      FileUse folder(true);
      folder.writesFolder("--report", folder_ / name, never());
      EXPECT_THROW(folder.check(), std::runtime_error) << name;
    }
    EXPECT_EQ(refusal("/dev/null"), "fine");
  }
  fs::permissions(where, fs::perms(0755));
}

TEST_F(FileUseTest, AFolderIsOursByOneOfItsFiles) {
  const auto refused = [&](const std::string &name, bool force) {
    FileUse files(force);
    files.reads("--map", folder_ / "map");
    files.writesFolder("--report", folder_ / name, holds("a page of ours"));
    return said(files);
  };
  EXPECT_EQ(refused("new", false), "fine");
  fs::create_directory(folder_ / "empty");
  EXPECT_EQ(refused("empty", false), "fine");
  EXPECT_THAT(refused("walk", false), HasSubstr("--force"));
  EXPECT_EQ(refused("walk", true), "fine");
  put("walk/page.html", "<html> a page of ours");
  EXPECT_EQ(refused("walk", false), "fine");
  EXPECT_THAT(refused("map", false), HasSubstr("--map reads"));
  put("file", "x");
  EXPECT_THAT(refused("file", true), HasSubstr("is a file"));
  EXPECT_EQ(refused("deep/new", false), "fine");
  EXPECT_THAT(refused("file/new", true), HasSubstr("file is no folder"));
}

TEST_F(FileUseTest, AFolderOfUnfinishedFilesIsWhatAKilledCommandLeft) {
  const auto check = [this] {
    FileUse files(false);
    files.writesFolder("--report", folder_ / "report", holds("a page of ours"));
    files.check();
  };
  std::filesystem::create_directory(folder_ / "report");
  std::ofstream(folder_ / "report/page.html.0a1b2c3d.part") << "a pa";
  check();
  std::ofstream(folder_ / "report/film.mp4.part") << "a browser's";
  EXPECT_THROW(check(), std::runtime_error);
}

TEST_F(FileUseTest, ARecordingIsNeverReplaced) {
  const auto refused = [&](const std::string &name) {
    FileUse files(true);
    files.writesRecording("--out", folder_ / name);
    return said(files);
  };
  EXPECT_EQ(refused("new.mcap"), "fine");
  EXPECT_EQ(refused("new/"), "fine");
  EXPECT_THAT(refused("map"), HasSubstr("never replaced"));
  EXPECT_THAT(refused("walk"), HasSubstr("never replaced"));
  fs::create_directory(folder_ / "empty");
  EXPECT_EQ(refused("empty/"), "fine");
  put("cut.mcap.part", "half");
  EXPECT_THAT(refused("cut.mcap"), HasSubstr("cut off"));
  fs::create_directory(folder_ / "copied.part");
  EXPECT_THAT(refused("copied"), HasSubstr("a folder that was not finished; remove it"));
  NewRecording other(folder_ / "other", NewRecording::IfCut::kRemove);
  other.makeFolder();
  EXPECT_THAT(refused("other"), HasSubstr("another program is writing it"));
  fs::create_symlink("nowhere", folder_ / "link.mcap");
  EXPECT_THAT(refused("link.mcap"), HasSubstr("a link to nothing"));
}

}  // namespace
}  // namespace sphc::host
