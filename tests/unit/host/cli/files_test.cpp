// No command loses a file: what it reads, what others wrote, and what was there before it failed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "command_runner.h"
#include "host/cli/common/exit_code.h"
#include "host/recording/calibration_json.h"
#include "host/recording/recording_writer.h"
#include "tests/support/session.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

unsigned modeOf(const std::string &path) {
  struct stat facts = {};
  return stat(path.c_str(), &facts) == 0 ? facts.st_mode & 0777 : 0;
}

// One walk and one map of it, made once.
class FilesTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::TempFolder>();
    const Answer walk = runCommand("simulate --frames 3 --rate 3 --out " + at("walk"));
    ASSERT_EQ(walk.exit_code, kExitDone) << walk.err;
    const Answer map = runCommand("build -r " + at("walk") + " -m " + at("room.sphc"));
    ASSERT_EQ(map.exit_code, kExitDone) << map.err;
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::string at(const std::string &name) { return *folder_ / name; }
  static void put(const std::string &name, const std::string &text) { std::ofstream(at(name)) << text; }

  // The command is refused with this status, says this, and changes not a byte of the file.
  static void expectKept(const std::string &file, const std::string &command, int status, const std::string &told) {
    const std::string before = fileText(file);
    const Answer answer = runCommand(command);
    EXPECT_EQ(answer.exit_code, status) << command;
    EXPECT_THAT(answer.err, HasSubstr(told)) << command;
    EXPECT_EQ(fileText(file), before) << command;
  }

  static std::unique_ptr<test::TempFolder> folder_;
};
std::unique_ptr<test::TempFolder> FilesTest::folder_;

// A private model stands for the recording that it was made of: with one key the map has the same bytes.
TEST_F(FilesTest, AMapOfASavedModelIsTheMapMadeAtOnce) {
  const std::string key = at("model.key"), model = at("walk.model"), by_key = " --key " + key + " --ledger ";
  put("model.key", std::string(64, 'a'));
  fs::permissions(key, fs::perms::owner_read | fs::perms::owner_write);
  const Answer at_once = runCommand("build -r " + at("walk") + " -m " + at("at_once.sphc") + by_key +
                                    at("at_once.ledger") + " --save-model " + model);
  ASSERT_EQ(at_once.exit_code, kExitDone) << at_once.err;
  EXPECT_EQ(modeOf(model), 0600u);
  const Answer later =
      runCommand("build --model " + model + " -m " + at("later.sphc") + by_key + at("later.ledger"));
  ASSERT_EQ(later.exit_code, kExitDone) << later.err;
  EXPECT_EQ(fileText(at("later.sphc")), fileText(at("at_once.sphc")));
  // and the key is what the map depends on
  put("model.key", std::string(64, 'b'));
  const Answer other =
      runCommand("build --model " + model + " -m " + at("other.sphc") + by_key + at("other_key.ledger"));
  ASSERT_EQ(other.exit_code, kExitDone) << other.err;
  EXPECT_NE(fileText(at("other.sphc")), fileText(at("at_once.sphc")));
}

// Poses in millimetres: what is published could not be taken back.
TEST_F(FilesTest, ARecordingThatContradictsItselfIsNotPublished) {
  const std::string walk = at("millimetres");
  ASSERT_EQ(runCommand("simulate --frames 10 --rate 3 --out " + walk).exit_code, kExitDone);
  std::istringstream truth(fileText(walk + "/groundtruth.txt"));
  std::ostringstream scaled;
  for (std::string line; std::getline(truth, line);) {
    std::istringstream fields(line);
    std::string time, rest;
    double x, y, z;
    if (fields >> time >> x >> y >> z && std::getline(fields, rest))
      scaled << time << ' ' << 1000 * x << ' ' << 1000 * y << ' ' << 1000 * z << rest << '\n';
  }
  put("millimetres/groundtruth.txt", scaled.str());
  const std::string build = "build -r " + walk + " -m " + at("wrong.sphc") + " --ledger " + at("wrong.ledger") +
                            " --save-model " + at("wrong.model");
  const Answer refused = runCommand(build);
  EXPECT_EQ(refused.exit_code, kExitFailure);
  EXPECT_THAT(refused.err, testing::AllOf(HasSubstr("contradicts itself"), HasSubstr("in metres"),
                                          HasSubstr("Nothing was published"), HasSubstr("--anyway")));
  for (const char *file : {"wrong.sphc", "wrong.sphc.owner.json", "wrong.model"})
    EXPECT_FALSE(fs::exists(at(file))) << file;
  const Answer anyway = runCommand(build + " --anyway --json");
  ASSERT_EQ(anyway.exit_code, kExitDone) << anyway.err;
  EXPECT_EQ(nlohmann::json::parse(anyway.out)["release"]["release"], 1) << "the first of this ledger";
}

TEST_F(FilesTest, AMapWithoutFakesIsWarnedOf) {
  const std::string build = "build -r " + at("walk") + " -m " + at("bare.sphc") + " --ledger ";
  const Answer bare = runCommand(build + at("bare.ledger") + " --eta 1");
  ASSERT_EQ(bare.exit_code, kExitDone) << bare.err;
  EXPECT_THAT(bare.err, HasSubstr("Warning: at --eta 1 nothing is faked"));
  EXPECT_THAT(runCommand(build + at("bare.ledger")).err, HasSubstr("nothing is faked")) << "an update";
  const Answer cured = runCommand("build -r " + at("walk") + " -m " + at("cured.sphc") + " --ledger " +
                                  at("bare.ledger") + " --i-understand --json");
  ASSERT_EQ(cured.exit_code, kExitDone) << cured.err;
  EXPECT_LT(nlohmann::json::parse(cured.out)["eta"], 0.5) << "as the warning says";
  EXPECT_THAT(cured.err, Not(HasSubstr("nothing is faked")));
  EXPECT_THAT(
      runCommand("build -r " + at("walk") + " -m " + at("faked.sphc") + " --eta 0.5 --ledger " + at("faked.ledger"))
          .err,
      testing::Not(HasSubstr("nothing is faked")));
}

TEST_F(FilesTest, PatchesWithoutFakesAreWarnedOf) {
  const auto warnings = [](const std::string &options) {
    return runCommand("build -r " + at("walk") + " -m " + at("few.sphc") + " --ledger " + at("few.ledger") +
                      " --force --i-understand " + options)
        .err;
  };
  EXPECT_THAT(warnings("--eta 0.8"), HasSubstr("Warning: at --eta 0.80 about 75 % of the patches that are real"));
  EXPECT_THAT(warnings("--eta 0.5"), Not(HasSubstr("have no fake")));
  EXPECT_THAT(warnings("--eta 0.8 --fakes gaussian"), Not(HasSubstr("have no fake")));
}

// What it protects against would else be done by the option that replaces a file.
TEST_F(FilesTest, AMapWhoseLedgerIsGoneIsNotReleasedAnew) {
  const std::string map = at("lost.sphc"), ledger = at("lost.ledger"), kept = at("kept.ledger");
  const std::string build = "build -r " + at("walk") + " -m " + map + " --ledger ";
  ASSERT_EQ(runCommand(build + ledger).exit_code, kExitDone);
  fs::rename(ledger, kept);
  for (const char *force : {"", " --force"}) {
    expectKept(map, build + ledger + force, kExitFailure, "there is no " + ledger);
    EXPECT_FALSE(fs::exists(ledger));
    expectKept(map, build + at("spherecloud.ledger") + force, kExitFailure, "does not know that release");
  }
  expectKept(map, build + ledger + " --force --against " + kept, kExitFailure, "released by another ledger");
  EXPECT_EQ(runCommand(build + kept).exit_code, kExitDone) << "restored";
  const Answer understood = runCommand(build + ledger + " --i-understand --force");
  EXPECT_EQ(understood.exit_code, kExitDone) << understood.err;
}

TEST_F(FilesTest, AModelIsSavedOverNothingElse) {
  const std::string build = "build -r " + at("walk") + " -m " + at("room.sphc") + " --save-model ";
  expectKept(at("room.sphc"), build + at("room.sphc"), kExitUsage, "are one file");
  expectKept(at("spherecloud.ledger"), build + at("spherecloud.ledger") + " --force", kExitUsage, "are one file");
}

TEST_F(FilesTest, BuildReplacesItsOwnMapAlone) {
  const std::string build = "build -r " + at("walk") + " -m ", ledger = at("spherecloud.ledger");
  expectKept(ledger, build + ledger, kExitUsage, "are one file");
  expectKept(ledger, build + ledger + " --ledger " + at("other.ledger") + " --force", kExitFailure, "is a ledger");
  expectKept(at("walk/rgb.txt"), build + at("walk/rgb.txt"), kExitUsage,
             "lies in the folder that --recording reads");
  put("foreign.sphc", "a map of somebody else");
  expectKept(at("foreign.sphc"), build + at("foreign.sphc"), kExitFailure, "--force");
  put("new.sphc.owner.json", "notes");
  expectKept(at("new.sphc.owner.json"), build + at("new.sphc"), kExitFailure, "the owner's note");
  EXPECT_FALSE(fs::exists(at("other.ledger"))) << "a refused build made a ledger";
  EXPECT_FALSE(fs::exists(at("new.sphc")));
  // Another ledger did not release this map.
  expectKept(at("room.sphc"), build + at("room.sphc") + " --ledger " + at("other.ledger"), kExitFailure,
             "by a ledger that is not here");
  EXPECT_EQ(runCommand(build + at("room.sphc")).exit_code, kExitDone) << "its own map";
  EXPECT_EQ(runCommand(build + at("foreign.sphc") + " --force").exit_code, kExitDone);
}

TEST_F(FilesTest, AMapOfAnotherPlaceOfTheLedgerStays) {
  const std::string build = "build -r " + at("walk") + " -m " + at("place2.sphc") + " --ledger " + at("two.ledger");
  ASSERT_EQ(
      runCommand("build -r " + at("walk") + " -m " + at("place1.sphc") + " --ledger " + at("two.ledger")).exit_code,
      kExitDone);
  expectKept(at("place1.sphc"),
             "build -r " + at("walk") + " -m " + at("place1.sphc") + " --ledger " + at("two.ledger") +
                 " --new-place --i-understand --eta 0.5",
             kExitFailure, "another place of the ledger");
  EXPECT_EQ(runCommand(build + " --new-place --i-understand --eta 0.5").exit_code, kExitDone);
  const Answer update = runCommand(build + " --json");
  EXPECT_EQ(update.exit_code, kExitDone) << update.err;
  EXPECT_EQ(nlohmann::json::parse(update.out)["release"]["place"], 2) << "the first one was given up";
}

TEST_F(FilesTest, AFailedBuildLeavesNoLedger) {
  put("key1", std::string(64, '1'));
  put("key2", std::string(64, '2'));
  const std::string build =
      "build -r " + at("walk") + " -m " + at("keyed.sphc") + " --ledger " + at("keyed.ledger");
  EXPECT_THAT(runCommand(build + " --key " + at("key1")).err, HasSubstr("chmod 600 " + at("key1")));
  for (const char *key : {"key1", "key2"}) fs::permissions(at(key), fs::perms(0600));
  const Answer failed = runCommand(build + " --key " + at("key1") + " --depth-min 5.9");
  EXPECT_EQ(failed.exit_code, kExitFailure);
  EXPECT_FALSE(fs::exists(at("keyed.ledger")));
  EXPECT_EQ(runCommand(build + " --key " + at("key2")).exit_code, kExitDone);
  fs::create_directory(at("folder.ledger"));
  const Answer folder =
      runCommand("build -r " + at("walk") + " -m " + at("x.sphc") + " --ledger " + at("folder.ledger"));
  EXPECT_THAT(folder.err, HasSubstr("is a folder"));
}

TEST_F(FilesTest, WhatIsPrivateIsReadByItsOwnerAlone) {
  EXPECT_EQ(modeOf(at("room.sphc.owner.json")), 0600u);
  EXPECT_EQ(modeOf(at("spherecloud.ledger")), 0600u);
  ASSERT_EQ(runCommand("simulate --frames 4 --rate 3 --out " + at("private")).exit_code, kExitDone);
  for (const std::string &command :
       {"advise --folds 2 -r " + at("private") + " --picture " + at("private.png"),
        "map -r " + at("private") + " --model " + at("private.model") + " --trajectory " + at("private.tum"),
        "localize -r " + at("walk") + " -m " + at("room.sphc") + " --report " + at("shown"),
        "localize -r " + at("walk") + " -m " + at("room.sphc") + " --owner-note " + at("room.sphc.owner.json") +
            " --report " + at("private_report")}) {
    const Answer answer = runCommand(command);
    ASSERT_EQ(answer.exit_code, kExitDone) << command << answer.err;
  }
  ASSERT_EQ(runCommand("audit " + at("room.sphc") + " --only file --report " + at("private_audit")).exit_code,
            kExitAuditIncomplete);
  for (const char *file : {"private.png", "private.tum", "private_audit/audit.html"})
    EXPECT_EQ(modeOf(at(file)), 0600u) << file;
  EXPECT_EQ(modeOf(at("private_report")), 0700u) << "its drawings show the sphere centre";
  EXPECT_EQ(modeOf(at("shown")), modeOf(at("walk"))) << "in the map's own frame nothing is private";
}

TEST_F(FilesTest, LocalizeReplacesItsOwnOutputsAlone) {
  const std::string localize = "localize -r " + at("walk") + " -m " + at("room.sphc");
  expectKept(at("room.sphc"), localize + " --trajectory " + at("room.sphc"), kExitUsage, "--map reads");
  expectKept(at("room.sphc"), localize + " --frames-json " + at("walk/../room.sphc"), kExitUsage, "--map reads");
  expectKept(at("walk/groundtruth.txt"), localize + " --trajectory " + at("walk/groundtruth.txt"), kExitUsage,
             "--recording reads");
  put("truth.tum", "# my own truth\n0 1 2 3 0 0 0 1\n");
  expectKept(at("truth.tum"), localize + " --trajectory " + at("truth.tum"), kExitFailure, "--force");
  const std::string outputs =
      localize + " --trajectory " + at("a.tum") + " --frames-json " + at("a.jsonl") + " --report " + at("report");
  EXPECT_EQ(runCommand(localize + " --trajectory " + at("a") + " --frames-json " + at("a")).exit_code, kExitUsage);
  for (int run = 0; run < 2; ++run) {
    const Answer answer = runCommand(outputs);
    EXPECT_EQ(answer.exit_code, kExitDone) << answer.err;
  }
  EXPECT_THAT(runCommand(localize + " --report " + at("walk")).err, HasSubstr("--recording reads"));
  EXPECT_THAT(runCommand(localize + " --report " + at(".")).err, HasSubstr("--force"));
  EXPECT_EQ(runCommand(localize + " --frames-json -").exit_code, kExitUsage);
}

TEST_F(FilesTest, PicturesReplacePicturesAlone) {
  const std::string inspect = "inspect " + at("room.sphc");
  for (int run = 0; run < 2; ++run) EXPECT_EQ(runCommand(inspect).exit_code, kExitDone);
  expectKept(at("room.sphc"), inspect + " --picture " + at("room.sphc"), kExitUsage, "reads");
  put("holiday.png", "a picture of somebody");
  fs::copy(at("room.sphc"), at("seen.sphc"));
  fs::copy(at("holiday.png"), at("seen.sphc.directions.png"));
  const Answer unasked = runCommand("inspect " + at("seen.sphc"));
  EXPECT_EQ(unasked.exit_code, kExitDone);
  EXPECT_THAT(unasked.err, HasSubstr("no picture is made"));
  EXPECT_THAT(unasked.out, AllOf(HasSubstr("nearest neighbour"), Not(HasSubstr("Picture"))));
  EXPECT_EQ(fileText(at("seen.sphc.directions.png")), fileText(at("holiday.png")));
  expectKept(at("holiday.png"), inspect + " --picture " + at("holiday.png"), kExitFailure, "--force");
  expectKept(at("holiday.png"), "advise -r " + at("walk") + " --picture " + at("holiday.png"), kExitFailure,
             "--force");
}

TEST_F(FilesTest, CalibrationsAreReplacedByForceAlone) {
  const std::string calibration = "calibration " + at("walk/calibration.json") + " --out ";
  expectKept(at("walk/calibration.json"), calibration + at("walk/calibration.json"), kExitUsage, "reads");
  ASSERT_EQ(runCommand(calibration + at("c.json")).exit_code, kExitDone);
  expectKept(at("c.json"), calibration + at("c.json"), kExitFailure, "--force");
  EXPECT_EQ(runCommand(calibration + at("c.json") + " --force").exit_code, kExitDone);
}

TEST_F(FilesTest, AuditKeepsTheLedger) {
  const std::string audit = "audit " + at("room.sphc") + " --truth " + at("spherecloud.ledger") + " --figures ";
  expectKept(at("spherecloud.ledger"), audit + at("spherecloud.ledger"), kExitUsage, "--truth reads");
}

TEST_F(FilesTest, AnAuditTakesTheNetworksOfTheFolderThatItIsTold) {
  fs::create_directory(at("networks"));
  const std::string audit =
      "audit " + at("room.sphc") + " --truth " + at("spherecloud.ledger") + " --quick --only inversion --networks ";
  for (const auto &[folder, told] : {std::pair("networks", "networks/mixed.embedding.onnx cannot be read"),
                                     {"none", "none is not a folder; give the one with *.onnx"}}) {
    const Answer answer = runCommand(audit + at(folder));
    EXPECT_EQ(answer.exit_code, kExitFailure) << folder;
    EXPECT_THAT(answer.err, HasSubstr(told));
  }
}

TEST_F(FilesTest, AnAuditsReportHasNoPictureOfAnAuditBefore) {
  const std::string audit = "audit " + at("room.sphc") + " --only file --report " + at("audit");
  ASSERT_EQ(runCommand(audit).exit_code, kExitAuditIncomplete);
  put("audit/inversion.png", "of an audit before");
  ASSERT_EQ(runCommand(audit).exit_code, kExitAuditIncomplete);
  EXPECT_FALSE(fs::exists(at("audit/inversion.png")));
}

// Beside itself it would hold.
TEST_F(FilesTest, AnAuditBesideTheMapItselfIsRefused) {
  fs::copy(at("room.sphc"), at("itself.sphc"));
  const Answer itself =
      runCommand("audit " + at("room.sphc") + " --only triangulation --release " + at("itself.sphc"));
  EXPECT_EQ(itself.exit_code, kExitFailure);
  EXPECT_THAT(itself.err, HasSubstr("itself.sphc is the map that is audited; give the other releases"));
}

// Two places of the ledger, and the same points.
TEST_F(FilesTest, AnAuditMissesTheMapThatWasPublishedBefore) {
  const std::string ledger = at("anew.ledger"), before = at("before.sphc"), anew = at("anew.sphc");
  const std::string build = "build -r " + at("walk") + " --ledger " + ledger + " -m ";
  ASSERT_EQ(runCommand(build + before).exit_code, kExitDone);
  ASSERT_EQ(runCommand(build + anew + " --i-understand").exit_code, kExitDone);
  const std::string audit = "audit " + anew + " --truth " + ledger + " --quick --only intersection_gain";
  const Answer missing = runCommand(audit);
  EXPECT_EQ(missing.exit_code, kExitAuditIncomplete) << missing.err;
  EXPECT_THAT(missing.out, HasSubstr("needs the other releases of the place (--release)"));
  EXPECT_EQ(runCommand(audit + " --release " + before).exit_code, kExitAuditFailed);
}

TEST_F(FilesTest, AReleaseThatIsNoMapIsRefusedByItsNameBeforeTheAttacks) {
  put("release.sphc", "no map");
  const Answer answer = runCommand("audit " + at("room.sphc") + " --only file --release " + at("release.sphc"));
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.err, HasSubstr("release.sphc: no valid map"));
}

// Its pictures would be told by chance, and hold.
TEST_F(FilesTest, AnAuditByTheRecordingOfAnotherRoomIsRefused) {
  ASSERT_EQ(runCommand("simulate --frames 2 --rate 3 --seed 8 --out " + at("another")).exit_code, kExitDone);
  const std::string audit = "audit " + at("room.sphc") + " --truth " + at("spherecloud.ledger") +
                            " --only querying_client --quick --recording ";
  const Answer another = runCommand(audit + at("another"));
  EXPECT_EQ(another.exit_code, kExitFailure);
  EXPECT_THAT(another.err, HasSubstr("give the first recording of the place"));
  EXPECT_EQ(runCommand(audit + at("walk")).exit_code, kExitAuditIncomplete) << "the others are left out";
  // And so would a recording that shows nothing, here since all depth is too near.
  const std::string near = std::regex_replace(fileText(at("walk/calibration.json")),
                                              std::regex("(\"depth_unit_m\": )[0-9.e-]+"), "$010.00001");
  put("near.json", near);
  EXPECT_THAT(runCommand(audit + at("walk") + " -c " + at("near.json")).err, HasSubstr("--recording: of 0 points"));
  // Photos of it would mark nothing.
  const Answer photos = runCommand(audit + at("walk") + " --photos " + at("another"));
  EXPECT_EQ(photos.exit_code, kExitFailure);
  EXPECT_THAT(photos.err, HasSubstr("--photos: of "));
  EXPECT_THAT(photos.err, HasSubstr("give frames of the place, posed in the recording's world"));
  const Answer none = runCommand(audit + at("walk") + " --photos-first 9");
  EXPECT_THAT(none.err,
              HasSubstr("--photos: cannot open the recording: " + at("walk") + ": first 9 chooses no frame"));
}

// Photos of the recording itself have its poses, wherever these come from.
TEST_F(FilesTest, AnAuditTakesTheToldPosesForPhotosToo) {
  fs::copy(at("walk"), at("audited_walk"), fs::copy_options::recursive);
  fs::remove(at("audited_walk/groundtruth.txt"));
  const Answer audited = runCommand("audit " + at("room.sphc") + " --truth " + at("spherecloud.ledger") +
                                    " --only photos --json --recording " + at("audited_walk") +
                                    " --last 1 --photos-first 2 --poses-from " + at("walk/groundtruth.txt"));
  EXPECT_EQ(audited.exit_code, kExitAuditIncomplete) << audited.err;
  for (const auto &figure : nlohmann::json::parse(audited.out)["figures"])
    if (figure["name"] == "photos.share_of_real") {
      EXPECT_GT(figure["value"], 0);
    }
}

TEST_F(FilesTest, AuditReplacesAnotherTableByForceAndAnEmptyOneAnyway) {
  put("empty.csv", "");
  put("others.csv", "name,age\n");
  const std::string audit = "audit " + at("room.sphc") + " --quick --only density --figures ";
  expectKept(at("others.csv"), audit + at("others.csv"), kExitFailure, "--force");
  for (const std::string &figures : {at("empty.csv"), at("others.csv") + " --force"})
    EXPECT_EQ(runCommand(audit + figures).exit_code, kExitAuditIncomplete) << figures;
  for (const std::string &table : {at("empty.csv"), at("others.csv")})
    EXPECT_EQ(fileText(table).rfind("attack,map,", 0), 0u) << table;
}

TEST_F(FilesTest, AnAuditOfAFewAttacksLeavesNoFiguresOfOthersFromBefore) {
  const std::string table = at("figures.csv"), audit = "audit " + at("room.sphc") + " --truth " +
                                                       at("spherecloud.ledger") + " --quick --figures " + table +
                                                       " --name 'a,\"b\"' --only ";
  runCommand(audit + "real_or_fake");  // whose limit may be broken
  EXPECT_THAT(fileText(table), HasSubstr("\nreal_or_fake,\"a,\"\"b\"\"\","));
  ASSERT_EQ(runCommand(audit + "density").exit_code, kExitAuditIncomplete);
  EXPECT_THAT(fileText(table), AllOf(Not(HasSubstr("real_or_fake")), HasSubstr("\naudit,\"a,\"\"b\"\"\",")));
  const Answer two_lines =
      runCommand("audit " + at("room.sphc") + " --only density --figures " + table + " --name 'a\nb'");
  EXPECT_EQ(two_lines.exit_code, kExitUsage);
  EXPECT_THAT(two_lines.err, HasSubstr("--name: the name of the map in the table has no line's end"));
}

TEST_F(FilesTest, RecordingsAreWholeOrNotThere) {
  expectKept(at("walk/rgb.txt"), "convert " + at("walk") + " " + at("walk/in.mcap"), kExitUsage, "lies in");
  expectKept(at("room.sphc"), "simulate --frames 1 --out " + at("room.sphc"), kExitFailure, "never replaced");
  // As a killed program leaves it.
  fs::copy(at("walk"), at("half.part"), fs::copy_options::recursive);
  const Answer there = runCommand("simulate --frames 1 --out " + at("half"));
  EXPECT_EQ(there.exit_code, kExitFailure);
  EXPECT_THAT(there.err, HasSubstr("a folder that was not finished; remove it"));
  // A failure on the way.
  fs::copy(at("walk"), at("bad"), fs::copy_options::recursive);
  std::ofstream(at("bad/groundtruth.txt"), std::ios::app) << "0.5 0 0 0 0 0 0 1\n";
  for (const char *to : {"to.mcap", "to"}) {
    runCommand("convert " + at("bad") + " " + at(to));
    EXPECT_FALSE(fs::exists(at(to + std::string(".part")))) << to;
  }
}

// All are begun before any of them has made its file.
TEST_F(FilesTest, CommandsOfOneNameLoseNoRecording) {
  for (const std::string to : {"rivals.mcap", "rivals"}) {
    const std::string one = SPHC_COMMAND " convert " + at("walk") + " " + at(to) + " & ";
    const Answer answer = runProgram("sh -c", "'" + one + one + one + one + "wait'");
    EXPECT_TRUE(fs::exists(at(to))) << answer.err;
    EXPECT_FALSE(fs::exists(at(to + ".part"))) << answer.err;
  }
}

TEST_F(FilesTest, ARecordingThatIsBeingWrittenIsNamedAsThat) {
  const std::string out = at("busy.mcap");
  const Answer answer =
      runProgram("sh -c", "'" SPHC_COMMAND " record --device simulated: --out " + out +
                              " & child=$!; while kill -0 $child && ! [ -s " + out +
                              ".part ]; do sleep 0.1; done; " SPHC_COMMAND " record --device simulated: --out " +
                              out + "; kill -TERM $child; wait $child'");
  EXPECT_EQ(answer.exit_code, kExitDone) << answer.err;
  EXPECT_THAT(answer.err, HasSubstr("busy.mcap.part is there, and another program is writing it"));
  EXPECT_TRUE(fs::exists(out));
}

// What holds no image is of no use, and would be in the way of the next try.
TEST_F(FilesTest, ARecordingThatFailsAtItsFirstImageLeavesNothing) {
  sphc_rig rig = recording::readCalibration(at("walk/calibration.json"));
  rig.color_camera.width = rig.depth_camera.width = 1280;
  recording::writeCalibration(at("wider.json"), rig);
  const Answer answer =
      runCommand("record --device simulated: -c " + at("wider.json") + " --out " + at("wider.mcap"));
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.err, AllOf(HasSubstr("choose that mode"), Not(HasSubstr("until then"))));
  EXPECT_FALSE(fs::exists(at("wider.mcap")) || fs::exists(at("wider.mcap.part")));
}

// The first images do not fit in.
TEST_F(FilesTest, ARecordingWithoutRoomForAnImageLeavesNothing) {
  const std::string out = at("no_room.mcap");
  const Answer answer =
      runProgram("sh -c", "'ulimit -f 300; exec " SPHC_COMMAND " record --device replay:" + at("walk") + " --out " +
                              out + "'");
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.err,
              AllOf(HasSubstr("no image was written, so no file is left"), Not(HasSubstr("until then"))));
  EXPECT_FALSE(fs::exists(out) || fs::exists(out + ".part"));
}

// As batch systems set one.
TEST_F(FilesTest, ALimitOnSizesOfFilesIsAFailureThatLeavesNothing) {
  const test::TempFolder folder;
  for (const std::string &command :
       {"build -r " + at("walk") + " -m " + (folder / "m.sphc") + " --ledger " + at("limited.ledger"),
        "convert " + at("walk") + " " + (folder / "c.mcap"), "convert " + at("walk") + " " + (folder / "c.raw"),
        "convert " + at("walk") + " " + (folder / "c")}) {
    const Answer answer = runProgram("sh -c", "'ulimit -f 150; exec " SPHC_COMMAND " " + command + "'");
    EXPECT_EQ(answer.exit_code, kExitFailure) << command;
    EXPECT_THAT(answer.err, testing::AnyOf(HasSubstr("File too large"), HasSubstr("is the disk full"))) << command;
    EXPECT_TRUE(fs::is_empty(folder.path())) << command;
  }
}

// The signal comes once something is recorded; how long that takes does not matter.
TEST_F(FilesTest, APoliteKillEndsARecordingAsCtrlCDoes) {
  for (const std::string signal : {"TERM", "HUP"}) {
    const std::string out = at(signal + ".mcap");
    // More bytes than one image of colour has: both streams are in.
    const std::string script =
        "'" SPHC_COMMAND " record --device simulated: --json --out " + out + " >" + out +
        ".json & child=$!; size=0; while kill -0 $child && [ $size -lt 2000000 ]; do sleep 0.1; "
        "size=$(stat -c %s " +
        out + ".part 2>/dev/null || echo 0); done; kill -" + signal + " $child; wait $child'";
    const Answer answer = runProgram("sh -c", script);
    EXPECT_EQ(answer.exit_code, kExitDone) << answer.err;
    EXPECT_TRUE(fs::exists(out));
    EXPECT_FALSE(fs::exists(out + ".part"));
    EXPECT_THAT(fileText(out + ".json"), HasSubstr("\"color\""));
    EXPECT_EQ(runCommand("convert " + out + " " + at(signal)).exit_code, kExitDone) << "the file is not whole";
  }
}

TEST_F(FilesTest, AnInterruptedSimulationLeavesNothing) {
  const std::string out = at("interrupted");
  const Answer answer =
      runProgram("sh -c", "'" SPHC_COMMAND " simulate --frames 900 --rate 30 --accelerometer 100 --out " + out +
                              " & child=$!; while kill -0 $child && ! [ -e " + out +
                              ".part ]; do sleep 0.1; done; kill -TERM $child; wait $child'");
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.err, AllOf(HasSubstr("interrupted"), HasSubstr("a folder keeps no accelerations")));
  EXPECT_FALSE(fs::exists(out) || fs::exists(out + ".part"));
}

// Not even the lock of a new ledger finds room.
TEST_F(FilesTest, AFullDiskLeavesNoNewLedger) {
  const std::string ledger = at("full.ledger");
  const Answer answer = runProgram("sh -c", "'ulimit -f 0; exec " SPHC_COMMAND " build -r " + at("walk") + " -m " +
                                                at("full.sphc") + " --ledger " + ledger + "'");
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_FALSE(fs::exists(ledger) || fs::exists(ledger + "-journal") || fs::exists(at("full.sphc")));
}

// The lines of a list again and again, later each time.
void repeatLines(const std::string &list) {
  const std::string once = fileText(list);
  std::ofstream out(list, std::ios::app);
  for (int k = 1; k < 300; ++k) {
    std::istringstream lines(once);
    for (std::string line; std::getline(lines, line);)
      if (line[0] != '#') out << std::fixed << std::stod(line) + 10 * k << line.substr(line.find(' ')) << '\n';
  }
}

// The signal comes once there is a ledger, in a build of many frames.
TEST_F(FilesTest, AnInterruptedBuildLeavesNothing) {
  const std::string map = at("cut.sphc"), ledger = at("cut.ledger"), model = at("cut.model"), walk = at("long");
  fs::copy(at("walk"), walk, fs::copy_options::recursive);
  for (const char *list : {"/rgb.txt", "/depth.txt", "/groundtruth.txt"}) repeatLines(walk + list);
  for (const std::string signal : {"INT", "TERM"}) {
    const Answer answer =
        runProgram("sh -c", "'" SPHC_COMMAND " build -r " + walk + " -m " + map + " --ledger " + ledger +
                                " --save-model " + model + " & child=$!; while kill -0 $child && ! [ -e " + ledger +
                                " ]; do sleep 0.01; done; kill -" + signal + " $child; wait $child'");
    EXPECT_EQ(answer.exit_code, kExitFailure) << signal;
    EXPECT_THAT(answer.err, HasSubstr("interrupted")) << signal;
    for (const std::string &file : {map, map + ".owner.json", ledger, ledger + "-journal", model})
      EXPECT_FALSE(fs::exists(file)) << file;
  }
}

TEST_F(FilesTest, AFullDiskIsNoSuccess) {
  for (const std::string &command :
       {"info --json " + at("room.sphc"), "info " + at("room.sphc"),
        "localize --json -r " + at("walk") + " -m " + at("room.sphc"),
        "calibration --json " + at("walk/calibration.json"), std::string("--version"), std::string("build --help"),
        "live --json --map " + at("room.sphc") + " --device replay:" + at("walk")}) {
    const Answer answer = runProgram("sh -c", "'" SPHC_COMMAND " " + command + " >/dev/full'");
    EXPECT_EQ(answer.exit_code, kExitFailure) << command;
    EXPECT_THAT(answer.err, HasSubstr("output cannot be written")) << command;
  }
}

// As behind `| head` or `| grep -q`, which end at the first line that they want.
TEST_F(FilesTest, FilesAreWrittenThoughNobodyReadsTheWords) {
  const std::string poses = at("unread.tum"), lines = at("unread.jsonl"), model = at("unread.model");
  runProgram("sh -c", "'" SPHC_COMMAND " localize -r " + at("walk") + " -m " + at("room.sphc") + " --trajectory " +
                          poses + " --frames-json " + lines + " >/dev/full'");
  EXPECT_TRUE(fs::exists(poses));
  EXPECT_TRUE(fs::exists(lines));
  runProgram("sh -c", "'" SPHC_COMMAND " map -r " + at("walk") + " --model " + model + " --trajectory " + poses +
                          ".map >/dev/full'");
  EXPECT_TRUE(fs::exists(model));
  EXPECT_TRUE(fs::exists(poses + ".map"));
  ASSERT_EQ(runCommand("simulate --frames 4 --rate 3 --out " + at("advised")).exit_code, kExitDone);
  const std::string picture = at("advised.png");
  runProgram("sh -c",
             "'" SPHC_COMMAND " advise --folds 2 -r " + at("advised") + " --picture " + picture + " >/dev/full'");
  EXPECT_TRUE(fs::exists(picture));
  const std::string sky = at("unread.png");
  runProgram("sh -c", "'" SPHC_COMMAND " inspect " + at("room.sphc") + " --picture " + sky + " >/dev/full'");
  EXPECT_TRUE(fs::exists(sky));
}

// As of a program that was sent into the background: a file that it opens must not become its output.
TEST_F(FilesTest, WordsForNobodyGoIntoNoFile) {
  const std::string walk = at("background");
  const Answer answer =
      runProgram("sh -c", "'" SPHC_COMMAND " simulate --frames 1 --out " + walk + " <&- >&- 2>&-'");
  EXPECT_EQ(answer.exit_code, kExitFailure) << "nobody hears that it is done";
  EXPECT_THAT(fileText(walk + "/depth.txt"), testing::Not(HasSubstr("Recorded")));
  EXPECT_EQ(runCommand("convert " + walk + " " + at("background.mcap")).exit_code, kExitDone);
}

// Where the library knows the bounds, the command line is wrong all the same.
TEST_F(FilesTest, AValueThatTheLocalizerRefusesIsWrongUse) {
  for (const std::string option :
       {"--ratio 7", "--max-keypoints 1", "--probes -1", "--min-inliers nan", "--max-iterations 1e9",
        "--depth-max 0", "--pixel-sigma 0", "--depth-sigma nan", "--depth-sigma-per-m2 -1", "--map-sigma -1",
        "--depth-mid -1", "--depth-offset-sigma -1", "--depth-slope-sigma -1", "--depth-min 7"}) {
    const Answer answer = runCommand("localize -r " + at("walk") + " -m " + at("room.sphc") + " " + option);
    EXPECT_EQ(answer.exit_code, kExitUsage) << option;
    EXPECT_THAT(answer.err, HasSubstr("--help")) << option;
    EXPECT_THAT(answer.err, HasSubstr(option == "--depth-min 7" ? "--depth-max is 6"
                                                                : option.substr(0, option.find(' ')) + " is "));
  }
}

TEST_F(FilesTest, LiveDoesNotFillTheTerminalWithUnreadableCaptures) {
  const std::string walk = at("broken");
  fs::copy(at("walk"), walk, fs::copy_options::recursive);
  std::ofstream depth(walk + "/depth.txt", std::ios::app);
  for (int i = 10; i < 22; ++i) depth << "2." << i << " depth/none_" << i << ".png\n";
  depth.close();
  const Answer answer = runCommand("live --json --every --map " + at("room.sphc") + " --device replay:" + walk);
  EXPECT_EQ(std::count(answer.out.begin(), answer.out.end(), '\n'), 3) << "a line for each pair";
  EXPECT_THAT(answer.err, AllOf(HasSubstr("none_19.png"), Not(HasSubstr("none_20.png")),
                                HasSubstr("2 more captures had such troubles")));
}

// A baseline of another unit: not a pixel of depth falls on colour.
TEST_F(FilesTest, LiveNamesTheCalibrationWhereNoFrameHasDepth) {
  sphc_rig rig = recording::readCalibration(at("walk/calibration.json"));
  rig.color_from_depth.t_m[0] = 8;
  recording::writeCalibration(at("far.json"), rig);
  const std::string of_walk = " -c " + at("far.json") + " --device replay:" + at("walk");
  const Answer answer = runCommand("live --every --map " + at("room.sphc") + of_walk);
  EXPECT_EQ(answer.exit_code, kExitNotLocalized);
  EXPECT_THAT(answer.err,
              AllOf(HasSubstr("no pixel of depth falls on the colour image"),
                    HasSubstr("Not one frame had depth in range"), Not(HasSubstr("Is this the place"))));
}

// A pipe that nobody writes to, and a device that never ends.
TEST_F(FilesTest, WhatIsNoFileIsNotWaitedFor) {
  const std::string map = at("room.sphc"), key = at("pipe.key"), localize = "localize -r " + at("walk") + " -m ";
  ASSERT_EQ(runCommand("key --out " + key).exit_code, kExitDone);
  ASSERT_EQ(runCommand("key --for encryption --out " + at("pipe.secret")).exit_code, kExitDone);
  ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
  for (const std::string &input : {at("pipe"), std::string("/dev/zero")})
    for (const std::string &command :
         {"info " + input, localize + input, "localize -m " + map + " -r " + input,
          "convert " + input + " " + at("none"), localize + map + " --owner-note " + input,
          localize + map + " --trusted-key " + input, localize + map + " -c " + input,
          "verify " + map + " --trusted-key " + key + ".pub --signature " + input,
          "sign " + map + " --release 1 --key " + input, "encrypt " + map + " --key " + input,
          "decrypt " + input + " --out " + at("none") + " --key " + at("pipe.secret"), "calibration " + input,
          "audit " + input,
          "build -r " + at("walk") + " -m " + at("none") + " --ledger " + at("none.ledger") + " --key " + input,
          "build -r " + at("walk") + " -m " + at("none") + " --ledger " + input}) {
      const Answer answer = runProgram("timeout 60 " SPHC_COMMAND, command);
      EXPECT_EQ(answer.exit_code, kExitFailure) << command;
      EXPECT_THAT(answer.err, HasSubstr(input)) << command;
      EXPECT_THAT(answer.err, testing::ContainsRegex("is a (device|pipe|FIFO)")) << command;
    }
  const Answer figures =
      runProgram("timeout 60 " SPHC_COMMAND, "audit " + map + " --quick --only density --figures /dev/zero");
  EXPECT_EQ(figures.exit_code, kExitAuditIncomplete) << figures.err;
}

TEST_F(FilesTest, OdometryThatIsNotThereIsSaid) {
  fs::copy(at("walk"), at("unposed"), fs::copy_options::recursive);
  fs::remove(at("unposed/groundtruth.txt"));
  const std::string localize = " --odometry -m " + at("room.sphc"),
                    note = "--odometry: the recording holds no poses";
  const Answer unposed = runCommand("localize -r " + at("unposed") + localize);
  EXPECT_EQ(unposed.exit_code, kExitDone) << unposed.err;
  EXPECT_THAT(unposed.err, HasSubstr(note));
  EXPECT_THAT(runCommand("localize -r " + at("walk") + localize).err, testing::Not(HasSubstr(note)));
  const Answer single = runCommand("localize --json --mode single -r " + at("walk") + localize);
  EXPECT_THAT(single.err, HasSubstr("so odometry changes nothing"));
  EXPECT_EQ(nlohmann::json::parse(single.out)["settings"]["odometry"], "played");
}

TEST_F(FilesTest, OfARecordingWithoutPosesNoneIsSpokenOf) {
  fs::copy(at("walk"), at("without_poses"), fs::copy_options::recursive);
  fs::remove(at("without_poses/groundtruth.txt"));
  const Answer answer = runCommand("localize --align -r " + at("without_poses") + " -m " + at("room.sphc") +
                                   " --owner-note " + at("room.sphc.owner.json"));
  EXPECT_EQ(answer.exit_code, kExitDone) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("not known   the recording holds no poses"));
  EXPECT_THAT(answer.err, HasSubstr("--align: the recording holds no poses, so no errors are known"));
}

// Of three frames the middle one has no pose, and its neighbours are 0.67 s apart.
TEST_F(FilesTest, PosesThatComeSeldomAreInterpolatedWhereItIsAsked) {
  fs::copy(at("walk"), at("seldom"), fs::copy_options::recursive);
  std::istringstream lines(fileText(at("walk/groundtruth.txt")));
  std::string kept, line;
  for (int poses = 0; std::getline(lines, line);)
    if (line[0] == '#' || ++poses != 2) kept += line + "\n";
  put("seldom/groundtruth.txt", kept);
  const std::string seldom = " -r " + at("seldom"), middle = seldom + " --first 1 --last 1",
                    build = "build --json -m " + at("seldom.sphc") + " --ledger " + at("seldom.ledger");
  const std::string cause =
      "none of 2 poses is near enough in time to a frame that was chosen: they are 667 ms apart "
      "there, and are interpolated over at most 50 ms; --pose-gap-ms takes more";
  for (const std::string &command :
       {build + middle, "localize -m " + at("room.sphc") + " --owner-note " + at("room.sphc.owner.json") + middle,
        "map --poses odometry --model " + at("seldom.model") + middle})
    EXPECT_THAT(runCommand(command).err, HasSubstr(cause)) << command;
  const Answer two = runCommand(build + seldom);
  ASSERT_EQ(two.exit_code, kExitDone) << two.err;
  EXPECT_EQ(nlohmann::json::parse(two.out)["frames_used"], 2);
  EXPECT_THAT(two.err,
              HasSubstr("1 frame without a pose took no part: poses around 1 of them are 667 ms apart, too "
                        "far to interpolate; --pose-gap-ms takes more"));
  const Answer all = runCommand(build + seldom + " --force --pose-gap-ms 700");
  ASSERT_EQ(all.exit_code, kExitDone) << all.err;
  EXPECT_EQ(nlohmann::json::parse(all.out)["frames_used"], 3);
  EXPECT_THAT(runCommand("convert " + at("seldom") + " " + at("seldom.mcap") + " --pose-gap-ms 700").err,
              HasSubstr("--pose-gap-ms is of raw and 7scenes"));
  EXPECT_EQ(
      runCommand("build -m " + at("x.sphc") + " --model " + at("walk.model") + " --pose-gap-ms 700").exit_code,
      kExitUsage);
}

TEST_F(FilesTest, PosesOfAFileAreTakenInPlaceOfTheRecordings) {
  fs::copy(at("walk"), at("untold"), fs::copy_options::recursive);
  fs::remove(at("untold/groundtruth.txt"));
  const std::string untold = " --json -r " + at("untold"), poses = " --poses-from " + at("walk/groundtruth.txt");
  const std::string build = "build -m " + at("again.sphc") + " --ledger " + at("again");
  EXPECT_THAT(runCommand(build + untold).err, HasSubstr("--poses-from FILE"));
  const Answer built = runCommand(build + untold + poses);
  ASSERT_EQ(built.exit_code, kExitDone) << built.err;
  EXPECT_EQ(nlohmann::json::parse(built.out)["frames_used"], 3);
  const Answer found =
      runCommand("localize -m " + at("room.sphc") + " --owner-note " + at("room.sphc.owner.json") + untold + poses);
  ASSERT_EQ(found.exit_code, kExitDone) << found.err;
  EXPECT_EQ(nlohmann::json::parse(found.out)["within_5cm_5deg"], 3);
  const Answer missing = runCommand(build + untold + " --poses-from " + at("nothing.tum"));
  EXPECT_EQ(missing.exit_code, kExitFailure);
  EXPECT_THAT(missing.err, HasSubstr("nothing.tum"));
  put("empty.tum", "# seconds tx ty tz qx qy qz qw\n");
  EXPECT_THAT(runCommand(build + untold + " --poses-from " + at("empty.tum")).err,
              HasSubstr("empty.tum: no pose in it"));
  expectKept(at("walk/groundtruth.txt"),
             "localize -m " + at("room.sphc") + untold + poses + " --trajectory " + at("walk/groundtruth.txt"),
             kExitUsage, "--poses-from reads");
}

TEST_F(FilesTest, PosesOfAnotherClockAreSaid) {
  fs::copy(at("walk"), at("apart"), fs::copy_options::recursive);
  put("apart/groundtruth.txt", "1700000000.5 0 0 0 0 0 0 1\n1700000001.5 0 0 0 0 0 0 1\n");
  const std::string localize = " -m " + at("room.sphc"), note = "none of 2 poses is of the time";
  for (const std::string &option : {std::string(" --odometry"), " --owner-note " + at("room.sphc.owner.json")}) {
    EXPECT_THAT(runCommand("localize -r " + at("apart") + localize + option).err, HasSubstr(note));
    EXPECT_THAT(runCommand("localize -r " + at("walk") + localize + option).err, testing::Not(HasSubstr(note)));
  }
}

TEST_F(FilesTest, NotesComeInAnyOrderAndMapsOnce) {
  const std::string localize = "localize -r " + at("walk") + " -m " + at("room.sphc");
  fs::copy_file(at("room.sphc"), at("copy.sphc"));
  const Answer twice = runCommand(localize + " -m " + at("copy.sphc"));
  EXPECT_EQ(twice.exit_code, kExitUsage);
  EXPECT_THAT(twice.err, HasSubstr(at("copy.sphc") + " are one map"));
  ASSERT_EQ(runCommand("simulate --frames 3 --rate 3 --seed 9 --out " + at("elsewhere")).exit_code, kExitDone);
  ASSERT_EQ(runCommand("build -r " + at("elsewhere") + " -m " + at("elsewhere.sphc") + " --ledger " + at("else"))
                .exit_code,
            kExitDone);
  const Answer turned = runCommand(localize + " -m " + at("elsewhere.sphc") + " --json --owner-note " +
                                   at("elsewhere.sphc.owner.json") + " --owner-note " + at("room.sphc.owner.json"));
  ASSERT_EQ(turned.exit_code, kExitDone) << turned.err;
  EXPECT_EQ(nlohmann::json::parse(turned.out)["within_5cm_5deg"], 3);

  // Poses of both maps in one path.
  fs::copy(at("walk"), at("both"), fs::copy_options::recursive);
  for (const char *file : {"/rgb/000002.png", "/depth/000002.png"})
    fs::copy_file(at("elsewhere") + file, at("both") + file, fs::copy_options::overwrite_existing);
  const std::string mixed = "localize --mode single -r " + at("both") + " -m " + at("room.sphc") + " -m " +
                            at("elsewhere.sphc") + " --trajectory " + at("both.tum"),
                    note = "--trajectory: its poses are of 2 maps, each in the frame of its own";
  EXPECT_THAT(runCommand(mixed).err, HasSubstr(note));
  const std::string notes =
      " --owner-note " + at("room.sphc.owner.json") + " --owner-note " + at("elsewhere.sphc.owner.json");
  EXPECT_THAT(runCommand(mixed + notes).err, testing::Not(HasSubstr(note)));
}

// The focal length of another camera.
TEST_F(FilesTest, ManyContradictionsAreSaidOfTheOtherPosesToo) {
  auto calibration = nlohmann::json::parse(fileText(at("walk/calibration.json")));
  for (size_t i = 0; i < 2; ++i) {
    auto &focal = calibration["color_camera"]["params"][i];
    focal = 0.8 * focal.get<double>();
  }
  put("wrong.json", calibration.dump());
  const std::string localize = "localize --mode single -r " + at("walk") + " -m " + at("room.sphc");
  // Keys differ from run to run, and with some the matches say it too.
  const auto named = testing::AllOf(HasSubstr("contradict themselves (depth and colour disagree"),
                                    HasSubstr("): the poses of the others may be wrong too"));
  EXPECT_THAT(runCommand(localize + " -c " + at("wrong.json")).err, named);
  EXPECT_THAT(runCommand(localize).err, testing::Not(HasSubstr("contradict themselves")));
}

// Of one frame, whose depths scatter by 3 %.
TEST_F(FilesTest, PointsThatAreNotSureAreNamedAsTheCause) {
  const sphc_localizer_config config = test::sceneConfig();
  const auto rough = test::sceneFrame(config, 0);
  std::vector<uint16_t> &depth_mm = rough->images.depth_mm;
  for (size_t i = 0; i < depth_mm.size(); i += 2) depth_mm[i] = static_cast<uint16_t>(depth_mm[i] * 0.97);
  sphc_recording_writer *writer = nullptr;
  ASSERT_EQ(sphc_recording_create(at("rough").c_str(), &config.rig, &writer, nullptr), SPHC_OK);
  EXPECT_EQ(sphc_recording_add_frame(writer, &rough->frame, nullptr), SPHC_OK);
  const sphc_rigid pose = rigidToC({});
  EXPECT_EQ(sphc_recording_add_pose(writer, rough->frame.color_time_ns, &pose, nullptr), SPHC_OK);
  ASSERT_EQ(sphc_recording_close(&writer, nullptr), SPHC_OK);
  const Answer answer = runCommand("build -r " + at("rough") + " -m " + at("rough.sphc"));
  EXPECT_THAT(answer.err, HasSubstr("the depth around each scatters"));
  EXPECT_THAT(answer.err, testing::Not(HasSubstr("--min-observations")));
}

TEST_F(FilesTest, TheCauseIsTheRightOne) {
  const std::string build = "build -r " + at("walk") + " -m " + at("cause.sphc") + " ";
  for (const char *options : {"--depth-min 5 --depth-max 1", "--max-keypoints 0", "--min-observations 4",
                              "--eta nan", "--depth-max nan", "--min-observations 0"})
    EXPECT_EQ(runCommand(build + options).exit_code, kExitUsage) << options;
  EXPECT_THAT(runCommand(build + "--min-observations 4").err, HasSubstr("so many of 3 frames"));
  EXPECT_THAT(runCommand(build + "--depth-min 50 --depth-max 60").err, HasSubstr("depth of 50.00 to 60.00 m"));
  EXPECT_THAT(runCommand(build + "--eta 1e-6 --ledger " + at("cause.ledger")).err, HasSubstr("larger --eta"));
  fs::copy(at("walk"), at("cut"), fs::copy_options::recursive);
  for (const auto &image : fs::directory_iterator(at("cut/rgb"))) fs::resize_file(image.path(), 100);
  const Answer cut = runCommand("build -r " + at("cut") + " -m " + at("cause.sphc"));
  EXPECT_THAT(cut.err, HasSubstr("not one frame can be read"));
  EXPECT_THAT(cut.err, testing::Not(HasSubstr("poses")));
}

}  // namespace
}  // namespace sphc::host
