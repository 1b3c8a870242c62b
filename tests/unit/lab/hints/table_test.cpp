#include "lab/hints/table.h"

#include <gtest/gtest.h>

#include "lab/hints/run.h"

namespace sphc::host {
namespace {

HintRow darkRow() {
  HintRow row;
  row.condition = "dark";
  row.mode = "tracking";
  row.frames = 30;
  row.without_pose = 12;
  row.told = 11;
  row.hints = {11, 0, 0, 0, 1, 2};
  return row;
}

TEST(HintTable, EveryCountStandsUnderItsName) {
  const std::string text = hintText({darkRow()});
  const size_t end = text.find('\n');
  const std::string names = text.substr(0, end), row = text.substr(end + 1);
  const auto under = [&](const std::string &name) {
    const size_t last = names.find(name) + name.size();
    return std::stoi(row.substr(last - 5, 5));
  };
  EXPECT_EQ(under("frames"), 30);
  EXPECT_EQ(under("without pose"), 12);
  EXPECT_EQ(under("told"), 11);
  EXPECT_EQ(under("too dark"), 11);
  EXPECT_EQ(under("not in the map"), 1);
  EXPECT_EQ(under("ambiguous"), 2);
}

TEST(HintTable, JsonHasAColumnAHint) {
  const nlohmann::ordered_json json = hintJson({darkRow(), darkRow()});
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(json[1]["condition"], "dark");
  EXPECT_EQ(json[1]["without_pose"], 12);
  EXPECT_EQ(json[1].size(), 5 + kHints);
}

}  // namespace
}  // namespace sphc::host
