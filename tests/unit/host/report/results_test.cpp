#include "host/report/results.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "host/base/write_file.h"

namespace sphc::host {
namespace {

class Results : public testing::Test {
 protected:
  Results()
      : path_(std::filesystem::temp_directory_path() /
              ("ledger_" + std::to_string(getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv")) {}
  ~Results() override { std::filesystem::remove(path_); }

  std::string text() const {
    std::ostringstream all;
    all << std::ifstream(path_).rdbuf();
    return all.str();
  }
  const std::string path_;
};

TEST_F(Results, IsMadeWhenThereIsNone) {
  replaceRows(path_, "what,value", "a,", {"a,1"});
  EXPECT_EQ(text(), "what,value\na,1\n");
}

TEST_F(Results, RowsTakeThePlaceOfTheirOldOnes) {
  writeFile(path_, "what,value\na,1\na,2\nab,5\na,3\nb,1\n");
  replaceRows(path_, "what,value", "a,", {"a,9"});
  EXPECT_EQ(text(), "what,value\na,9\nab,5\nb,1\n");
  replaceRows(path_, "what,value", "c,", {"c,7", "c,8"});
  EXPECT_EQ(text(), "what,value\na,9\nab,5\nb,1\nc,7\nc,8\n");
}

TEST_F(Results, AnotherFileIsLeftAlone) {
  writeFile(path_, "something else\n");
  EXPECT_THROW(replaceRows(path_, "what,value", "a,", {"a,9"}), std::runtime_error);
  EXPECT_EQ(text(), "something else\n");
}

}  // namespace
}  // namespace sphc::host
