#include "host/cli/common/privacy_results.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace sphc::host {
namespace {

TEST(PrivacyLedger, ReplacesItsOwnAttacksAndKeepsTheOthers) {
  const std::string path = testing::TempDir() + "sphc_privacy_" + std::to_string(getpid()) + ".csv";
  updatePrivacyResults(path, {{"density", "room", "none", 1, "ulc, own", "median_cm", 1.5}});
  updatePrivacyResults(path, {{"order", "room", "gaussian", 0.333, "", "auc", 0.9}});
  updatePrivacyResults(path, {{"order", "room", "gaussian", 0.333, "", "auc", 0.5}});
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  EXPECT_EQ(text.str(),
            "attack,map,strategy,eta,variant,metric,value\ndensity,room,none,1.00,\"ulc, own\",median_cm,1.5\n"
            "order,room,gaussian,0.33,,auc,0.5\n");
  unlink(path.c_str());
  EXPECT_THROW(
      updatePrivacyResults("/nonexistent-folder/x.csv", {{"order", "room", "gaussian", 0.333, "", "auc", 0.9}}),
      std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
