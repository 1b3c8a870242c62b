#include "host/cli/common/privacy_results.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/support/temp_folder.h"
#include "tests/unit/host/cli/command_runner.h"

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

TEST(PrivacyLedger, ANameMayHaveCommasAndQuotes) {
  const test::TempFolder folder;
  const std::string path = folder / "privacy.csv";
  const auto put = [&path](double value) {
    updatePrivacyResults(path, {{"audit", "a,b \"c\"", "warped", 0.5, "", "auc", value}});
  };
  updatePrivacyResults(path, {{"audit", "a", "b \"c\"", 1, "", "auc", 1}});
  put(0.7);
  put(0.6);
  EXPECT_EQ(fileText(path),
            "attack,map,strategy,eta,variant,metric,value\naudit,a,\"b \"\"c\"\"\",1.00,,auc,1\n"
            "audit,\"a,b \"\"c\"\"\",warped,0.50,,auc,0.6\n");
}

TEST(PrivacyLedger, WhatWasNotMeasuredAgainIsGone) {
  const test::TempFolder folder;
  const std::string path = folder / "privacy.csv";
  const PrivacyRow kept = {"order", "room", "warped", 0.5, "", "auc", 0.9},
                   old = {"audit", "room", "warped", 0.5, "", "auc", 0.8};
  updatePrivacyResults(path, {kept, old});
  replacePrivacyResults(path, keyOf(old), {});
  EXPECT_EQ(fileText(path), "attack,map,strategy,eta,variant,metric,value\n" + lineOf(kept) + "\n");
}

}  // namespace
}  // namespace sphc::host
