// Arguments, exit codes and where words go, seen from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "command_runner.h"
#include "explained.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/recording_out.h"
#include "host/recording/recording_reader.h"
#include "tests/support/ros_bag.h"
#include "tests/support/temp_folder.h"
#include "tests/unit/host/tiny_map.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

TEST(CommandLine, HelpIsNoError) {
  const Answer answer = runCommand("--help");
  EXPECT_EQ(answer.exit_code, kExitDone);
  EXPECT_THAT(answer.out, HasSubstr("spherecloud localize --recording"));
}

TEST(CommandLine, VersionIsOneLine) {
  const Answer answer = runCommand("--version");
  EXPECT_EQ(answer.exit_code, kExitDone);
  EXPECT_THAT(answer.out, testing::MatchesRegex("spherecloud [0-9]+\\.[0-9]+\\.[0-9]+(-rc[0-9]+)?\n"));
}

class HelpTest : public testing::TestWithParam<const char *> {};

TEST_P(HelpTest, TeachesByExample) {
  const Answer answer = runCommand(std::string(GetParam()) + " --help");
  EXPECT_EQ(answer.exit_code, kExitDone);
  EXPECT_THAT(answer.out, HasSubstr("Example:\n  spherecloud " + std::string(GetParam())));
  EXPECT_THAT(answer.out, HasSubstr("--json"));
  EXPECT_EQ(answer.err, "");
}

INSTANTIATE_TEST_SUITE_P(EachSubcommand, HelpTest,
                         testing::Values("simulate", "build", "localize", "inspect", "info", "convert",
                                         "calibration", "advise", "record", "live", "devices", "doctor", "audit"));

class UsageTest : public testing::TestWithParam<const char *> {};

TEST_P(UsageTest, IsExitCodeTwoAndPointsToHelp) {
  const Answer answer = runCommand(GetParam());
  EXPECT_EQ(answer.exit_code, kExitUsage);
  EXPECT_EQ(answer.out, "");
  EXPECT_THAT(answer.err, HasSubstr("--help"));
}

INSTANTIATE_TEST_SUITE_P(
    EachMistake, UsageTest,
    testing::Values(
        "", "conquer", "live", "live --device simulated:", "record --out x.mcap",
        "record --device simulated: --out x.txt", "live --device simulated: --map m --tolerance-ms nan",
        "live --device simulated: --map m --seconds -3", "record --device simulated: --out x.mcap --seconds nan",
        "live --device simulated: --map m --seconds inf", "localize --recording r --map m --seed -1",
        "simulate --out x --seed -1", "simulate --out x --rate nan", "simulate --out x --rate 0",
        "simulate --out x --rate 130", "simulate --out x --lap 0", "simulate --out x --exposure 7",
        "simulate --out x --from 1e9", "simulate --out x --threads 65", "simulate --out x --frames 1000001",
        "record --device simulated: --out x.mcap --jpeg 101", "build --recording r --map m --depth-min 0",
        "build --recording r --map m --min-observations 25", "live --device openni2: --color v4l2:x --map m",
        "calibration", "calibration x --to kalibr", "calibration x --format what", "calibration x --color-size 640",
        "calibration x --color-size -1x-1", "info", "info a b", "convert a", "convert a b --to zip",
        "convert a b --to mcap", "convert a b --to raw", "convert a b.raw --to tum", "convert a b.mcap --jpeg 0",
        "audit", "audit m --limit x", "audit m --recording r", "audit m --limit no.such=1",
        "audit m --limit real_or_fake.auc=0.5 --limit real_or_fake.auc=0.6", "audit m --queries 0",
        "audit m --allow-unmeasured luck", "build --map m --recording r --model p",
        "build --map m --model p --save-model q", "simulate", "simulate --out x --frames many",
        "build --recording r", "build --map m", "build --map m --recording r --colmap c",
        "build --map m --colmap c", "build --map m --colmap c --images i",
        "build --map m --colmap c --images i --scale 1 --gravity down", "advise --recording r --folds 1",
        "build --recording r --map m --eta 1.5", "build --recording r --map m --against",
        "localize --recording r --map m --step 0", "localize --recording r --map m --first 9 --last 3",
        "simulate --out x --with hnads", "simulate --out x --with day,night", "simulate --out x --cameras watch",
        "simulate --out x --cameras phone --raw-depth"));

TEST(CommandLine, ALapOfAFlatTakesLongerThanOneOfARoom) {
  const test::TempFolder folder;
  const Answer answer = runCommand("simulate --json --with flat --frames 1 --out " + (folder / "flat"));
  ASSERT_EQ(answer.exit_code, kExitDone) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("\"lap_s\": 150"));
  EXPECT_THAT(runCommand("simulate --json --with tiles --frames 1 --out " + (folder / "room")).out,
              HasSubstr("\"lap_s\": 16"));
}

TEST(CommandLine, AnAuditThatCouldNotMeasureAllEndsWithFive) {
  const test::TempFolder folder;
  writeTinyMap(folder / "m.sphc", 200);
  const std::string alone = "audit " + (folder / "m.sphc") + " --quick --json --limit density.at_centre=0";
  const std::string audit = alone + " --limit file.order_sigma=1e9";
  const Answer missing = runCommand(audit);
  EXPECT_EQ(missing.exit_code, kExitAuditIncomplete) << missing.err;
  EXPECT_THAT(missing.out, HasSubstr("\"real_or_fake.auc\""));
  EXPECT_EQ(runCommand(audit + " --allow-unmeasured truth").exit_code, kExitAuditIncomplete);
  EXPECT_EQ(runCommand(audit + " --allow-unmeasured truth --allow-unmeasured releases").exit_code, kExitDone);
  EXPECT_EQ(runCommand(alone + " --allow-unmeasured truth --limit file.order_sigma=-1").exit_code,
            kExitAuditFailed);
}

// An option takes one value, so that a map behind it is the map.
TEST(CommandLine, OptionsThatAreRepeatedMayStandBeforeTheMap) {
  const test::TempFolder folder;
  const std::string map = folder / "m.sphc";
  writeTinyMap(map, 200);
  for (const char *option : {"--release none.sphc", "--limit density.at_centre=0", "--allow-unmeasured truth"})
    EXPECT_THAT(runCommand(std::string("audit --quick --only density ") + option + " " + map).err,
                testing::Not(HasSubstr("map is required")))
        << option;
  for (const std::string command : {"audit --release", "audit --limit", "build --against", "map --recording"}) {
    const std::string help = runCommand(command.substr(0, command.find(' ')) + " --help").out;
    const size_t at = help.find(command.substr(command.find(' ') + 1) + " ");
    ASSERT_NE(at, std::string::npos) << command;
    EXPECT_THAT(help.substr(at, help.find('\n', at) - at), testing::Not(HasSubstr("..."))) << command;
  }
}

// A value of 0.558 is no "BROKEN, at most 0.56".
TEST(CommandLine, AnAuditTellsItsLimitsAsPreciselyAsItsFigures) {
  const test::TempFolder folder;
  writeTinyMap(folder / "m.sphc", 200);
  const Answer audit = runCommand("audit " + (folder / "m.sphc") + " --only file --limit file.stray_bytes=0.555");
  EXPECT_THAT(audit.out, HasSubstr("holds, at most 0.555: "));
}

TEST(CommandLine, UsageNamesTheSubcommand) {
  EXPECT_THAT(runCommand("build").err, HasSubstr("Try: spherecloud build --help"));
}

TEST(CommandLine, WhatHasNoEffectIsRefusedByName) {
  const std::pair<const char *, const char *> mistakes[] = {
      {"conquer", "there is no subcommand conquer"},
      {"live --device x: --color y: --map m",
       "--device gives colour and depth; leave it out, or --color and --depth"},
      {"build --model p --last 3 --map m", "--first, --last and --step choose frames of a --recording"},
      {"build --model p --recording r --map m", "--recording, --colmap and --model exclude each other"},
      {"build --map m", "--recording, --colmap or --model is required"},
      {"build --model p --calibration c --map m", "--calibration is of a --recording or of --colmap"},
      {"map --recording r --model p --drift 2", "--drift requires --poses"},
      {"map --recording r --model p --pose-sigma 0.1", "--pose-sigma requires --poses"},
      {"map --recording r --model p --poses approximate --drift 2", "--drift is of --poses odometry"},
      {"map --recording r --model p --poses odometry --pose-sigma 0.1", "--pose-sigma is of --poses approximate"},
      {"build --recording r --map m --scale 2", "--scale requires --colmap"},
      {"build --recording r --map m --fakes gaussian --patch-deg 20",
       "--patch-deg says nothing of --fakes gaussian"},
      {"build --recording r --map m --fakes patchwork --sigma2 2", "--sigma2 says nothing of --fakes patchwork"},
      {"calibration c --registered --color-from-depth 1,0,0,0,0,0,0", "--color-from-depth excludes --registered"},
      {"calibration c --registered --depth cam1", "--depth excludes --registered"},
      {"calibration c --registered --depth-size 640x480", "--depth-size excludes --registered"},
      {"convert a b --jpeg 90", "--jpeg is of an MCAP file"},
      {"convert a b.raw --depth-codec rvl", "--depth-codec is of an MCAP file"},
      {"simulate --out walk.raw", "`spherecloud convert` makes a .raw file"},
      {"simulate --out walk.RAW", "`spherecloud convert` makes a .raw file"},
      {"build --map m --model p --min-observations 9", "--min-observations excludes --model"},
      {"build --map m --colmap c --images i --scale 1 --keep-moving", "--keep-moving excludes --colmap"},
      {"inspect m --picture p.png --no-picture", "--picture excludes --no-picture"},
      {"inspect m --picture ''", "--picture is empty"},
      {"advise -r r --picture ''", "--picture is empty"},
      {"audit m --report ''", "--report is empty"},
      {"audit m --figures ''", "--figures is empty"},
      {"audit m --truth t --last 3", "--last requires --recording"},
      {"audit m --truth t --queries 3", "--queries requires --recording"},
      {"audit m --truth t --pose-gap-ms 70", "--pose-gap-ms requires --recording"},
      {"build --model p --map m --pose-gap-ms 70", "--pose-gap-ms requires --recording"},
      {"audit m --name room", "--name requires --figures"},
      {"audit m --limit density.at_centre=inf", "density.at_centre=inf is not NAME=NUMBER"},
      {"audit m --truth t -r r --photos-first 3 --photos-last 2", "--photos-last lies before --photos-first"},
      {"doctor --device ''", "--device is empty"},
      {"doctor --calibration c", "--calibration is of cameras"},
      {"live -m m --device replay:r --width -1", "--width"},
      {"live -m m --device replay:r --fps 0x10", "--fps"},
      {"live -m m --device replay:r --width 320", "--width is of v4l2: and libcamera: cameras"},
      {"record -o w.mcap --color simulated: --depth replay:r --fps 30", "--fps is of v4l2: and libcamera: cameras"},
      {"doctor --device replay:r --depth-min 3 --depth-max 2", "--depth-min must be less than --depth-max"},
      {"live -m m --color '' --depth ''", "--color is empty"}};
  for (const auto &[command, reason] : mistakes) {
    const Answer answer = runCommand(command);
    EXPECT_EQ(answer.exit_code, kExitUsage) << command;
    EXPECT_THAT(answer.err, HasSubstr(reason));
  }
}

// As it was given, and before what is missing because of it.
TEST(CommandLine, WhatNothingTakesIsNamed) {
  const test::TempFolder folder;
  const std::pair<const char *, const char *> mistakes[] = {
      {"info --bogus", "not expected: --bogus\n"},
      {"live --device replay:r --mapp m", "not expected: --mapp m\n"},
      {"record --out w.mcap --device replay:r --frames 3", "not expected: --frames 3\n"},
      {"info -x.sphc", "not expected: -x.sphc\n"},
      {"info", "map is required\n"},
      {"info --", "map is required\n"}};
  for (const auto &[command, reason] : mistakes) {
    const Answer answer = runCommand(command);
    EXPECT_EQ(answer.exit_code, kExitUsage) << command;
    EXPECT_THAT(answer.err, HasSubstr(reason)) << command;
  }
  writeTinyMap(folder / "-x.sphc", 40);
  EXPECT_THAT(runProgram("sh -c", "'cd " + (folder / "") + " && " SPHC_COMMAND " info -x.sphc'").err,
              HasSubstr("not expected: -x.sphc; write the file's name as ./-x.sphc\n"));
}

TEST(CommandLine, MissingInputIsExitCodeOneAndNamesIt) {
  for (const std::string &command :
       {std::string("info /nonexistent.sphc"), std::string("calibration /nonexistent.yaml"),
        std::string("inspect /nonexistent.sphc"),
        std::string("build --recording /nonexistent --map /tmp/never.sphc"),
        std::string("localize --recording /nonexistent --map /tmp/never.sphc")}) {
    const Answer answer = runCommand(command);
    EXPECT_EQ(answer.exit_code, kExitFailure) << command;
    EXPECT_THAT(answer.err, HasSubstr("/nonexistent")) << command;
    EXPECT_EQ(answer.out, "") << command;
  }
}

TEST(CommandLine, APathThatCannotBeLookedUpIsNamedWithTheCure) {
  const std::string path(300, 'a');
  const Answer answer = runCommand("calibration " + path);
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.err, HasSubstr("spherecloud: " + path + ": File name too long; check its name"));
}

TEST(Info, PrintsOneScreenOrJson) {
  const test::TempFolder folder;
  writeTinyMap(folder / "tiny.sphc", 40);
  const Answer human = runCommand("info " + (folder / "tiny.sphc"));
  EXPECT_EQ(human.exit_code, kExitDone);
  EXPECT_THAT(human.out, HasSubstr("valid sphere cloud"));
  const Answer machine = runCommand("info --json " + (folder / "tiny.sphc"));
  const auto json = nlohmann::json::parse(machine.out);
  EXPECT_EQ(json["points"], 40);
  EXPECT_EQ(json["map_id"].get<std::string>().substr(0, 6), "010203");
}

TEST(Info, RefusesADamagedMap) {
  const test::TempFolder folder;
  writeTinyMap(folder / "tiny.sphc", 40);
  std::fstream file(folder / "tiny.sphc", std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(500);
  file.put('\x55');
  file.close();
  const Answer answer = runCommand("info " + (folder / "tiny.sphc"));
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.err, HasSubstr("SPHC_E_MAP_CHECKSUM"));
}

TEST(Inspect, AccountsForEveryByteAndDrawsAPicture) {
  const test::TempFolder folder;
  writeTinyMap(folder / "tiny.sphc", 40);
  const Answer answer = runCommand("inspect --json " + (folder / "tiny.sphc"));
  ASSERT_EQ(answer.exit_code, kExitDone) << answer.err;
  const auto json = nlohmann::json::parse(answer.out);
  uint64_t sum = 0;
  for (const auto &part : json["parts"]) sum += part.get<uint64_t>();
  EXPECT_EQ(sum, json["bytes"].get<uint64_t>());
  EXPECT_EQ(sum, std::filesystem::file_size(folder / "tiny.sphc"));
  EXPECT_TRUE(std::filesystem::exists(folder / "tiny.sphc.directions.png"));
}

// JSON is UTF-8, and names of files are bytes.
TEST(Inspect, GivesJsonOfANameThatIsNoText) {
  const test::TempFolder folder;
  writeTinyMap(folder / "t\xffny.sphc", 40);
  const Answer answer = runCommand("inspect --json " + (folder / "t\xffny.sphc"));
  ASSERT_EQ(answer.exit_code, kExitDone) << answer.err;
  EXPECT_TRUE(nlohmann::json::accept(answer.out));
}

TEST(Inspect, NamesAPictureItCannotWrite) {
  const test::TempFolder folder;
  writeTinyMap(folder / "tiny.sphc", 40);
  const Answer answer = runCommand("inspect " + (folder / "tiny.sphc") + " --picture " + (folder / "picture.what"));
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.err, HasSubstr("picture.what"));
}

// The recording is not there: the name is looked at before hours of work.
TEST(Advise, NamesAPictureItCannotWriteAtOnce) {
  const test::TempFolder folder;
  const Answer answer = runCommand("advise -r " + (folder / "none") + " --picture " + (folder / "advice.jpg"));
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.err, HasSubstr("advice.jpg: end its name in .png"));
}

// Files of two folders, compared to the byte.
bool sameFiles(const std::string &a, const std::string &b) {
  return std::system(("diff -r " + a + " " + b + " >/dev/null").c_str()) == 0;
}

// Frames keep their times; poses are those of the part and of a second around it.
TEST(Convert, TakesAPartOfARecording) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk.mcap", part = folder / "part", one = folder / "one.raw";
  ASSERT_EQ(runCommand("simulate --frames 9 --rate 2 --out " + walk).exit_code, kExitDone);
  const Answer cut = runCommand("convert --json " + walk + " " + part + " --first 3 --last 6 --step 2");
  ASSERT_EQ(cut.exit_code, kExitDone) << cut.err;
  const auto json = nlohmann::json::parse(cut.out);
  EXPECT_EQ(json["color"], 2);
  EXPECT_EQ(json["depth"], 2);
  EXPECT_EQ(json["poses"], 7) << "of 0.5 to 3.5 s";
  const recording::RecordingReader whole(walk), reader(part);
  ASSERT_EQ(reader.frameCount(), 2u);
  EXPECT_EQ(reader.colorOf(0).time_ns, whole.colorOf(3).time_ns);
  EXPECT_EQ(reader.colorOf(1).time_ns, whole.colorOf(5).time_ns);
  EXPECT_TRUE(reader.worldFromCamera(1));
  const Answer last = runCommand("convert --json " + walk + " " + one + " --first 8");
  ASSERT_EQ(last.exit_code, kExitDone) << last.err;
  EXPECT_EQ(nlohmann::json::parse(last.out)["color"], 1);
  EXPECT_THAT(last.err, Not(HasSubstr("poses between frames")));
  const std::string half = folder / "half.mcap";
  ASSERT_EQ(runCommand("convert " + walk + " " + half + " --first 1 --step 2").exit_code, kExitDone);
  const recording::Recording chosen = recording::openRecording(half);
  ASSERT_EQ(chosen.color.size(), 4u);
  EXPECT_EQ(chosen.color[3].sequence, chosen.color[0].sequence + 3);
  EXPECT_EQ(chosen.lost_count, 0u) << "those between were not chosen";
  for (const char *none : {"--first 5 --last 4", "--step 0"})
    EXPECT_EQ(runCommand("convert " + walk + " " + (folder / "none") + " " + none).exit_code, kExitUsage) << none;
  EXPECT_EQ(runCommand("convert " + walk + " ''").exit_code, kExitUsage);
  const Answer beyond = runCommand("convert " + walk + " " + (folder / "none") + " --first 9");
  EXPECT_EQ(beyond.exit_code, kExitFailure);
  EXPECT_THAT(beyond.err, HasSubstr(walk + ": first 9 chooses no frame; the recording has numbers 0 to 8"));
  EXPECT_FALSE(std::filesystem::exists(folder / "none"));
}

// Every third frame of a walk is a rate, and no loss; numbers stay, so that --first means the same frame.
TEST(Convert, NumbersOfFilesAreNoCounter) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk", scenes = folder / "seq-01", file = folder / "walk.mcap",
                    again = folder / "again.mcap";
  ASSERT_EQ(runCommand("simulate --frames 4 --rate 6 --out " + walk).exit_code, kExitDone);
  ASSERT_EQ(runCommand("convert --to 7scenes " + walk + " " + scenes).exit_code, kExitDone);
  for (const char *kind : {".color.png", ".depth.png", ".pose.txt"})
    for (const char *number : {"1", "2"}) std::filesystem::remove(scenes + "/frame-00000" + number + kind);
  ASSERT_EQ(runCommand("convert " + scenes + " " + file).exit_code, kExitDone);
  ASSERT_EQ(runCommand("convert " + file + " " + again).exit_code, kExitDone);
  for (const std::string &made : {file, again}) {
    const recording::Recording reader = recording::openRecording(made);
    EXPECT_EQ(reader.lost_count, 0u);
    ASSERT_EQ(reader.color.size(), 2u);
    EXPECT_EQ(reader.color[1].sequence, 3u);
  }
}

TEST(Convert, AnEndingInLargeLettersIsOneToo) {
  const test::TempFolder folder;
  const std::string mcap = folder / "walk.MCAP", raw = folder / "walk.Raw";
  ASSERT_EQ(runCommand("simulate --frames 1 --out " + mcap).exit_code, kExitDone);
  EXPECT_TRUE(std::filesystem::is_regular_file(mcap));
  ASSERT_EQ(runCommand("convert " + mcap + " " + raw).exit_code, kExitDone);
  EXPECT_TRUE(std::filesystem::is_regular_file(raw));
  EXPECT_EQ(recording::RecordingReader(raw).frameCount(), 1u);
}

TEST(Convert, WritesNothingOfARecordingWithoutImages) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk", out = folder / "out";
  ASSERT_EQ(runCommand("simulate --frames 2 --rate 2 --out " + walk).exit_code, kExitDone);
  for (const char *image : {"rgb/000000", "rgb/000001", "depth/000000", "depth/000001"})
    std::ofstream(walk + "/" + image + ".png") << "no image";
  for (const char *name : {"", ".mcap", ".raw", " --to 7scenes"}) {
    const Answer converted = runCommand("convert " + walk + " " + out + name);
    EXPECT_EQ(converted.exit_code, kExitFailure) << name;
    EXPECT_THAT(converted.err, HasSubstr("can be read, so nothing was written")) << name;
  }
  for (const auto &left : std::filesystem::directory_iterator(std::filesystem::path(walk).parent_path()))
    EXPECT_EQ(left.path().filename(), "walk") << "nothing else is there";
}

TEST(Warnings, OfManyFramesTheFirstTenAreNamedAndTheOthersCounted) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk", map = folder / "room.sphc";
  ASSERT_EQ(runCommand("simulate --frames 14 --rate 6 --out " + walk).exit_code, kExitDone);
  ASSERT_EQ(runCommand("build --map " + map + " -r " + walk).exit_code, kExitDone);
  const std::vector<std::string> ways = {
      "convert " + walk + " " + (folder / "walk.mcap"), "convert --to 7scenes " + walk + " " + (folder / "seq-01"),
      "localize --map " + map + " -r " + walk + " --frames-json " + (folder / "frames.jsonl")};
  for (const std::string command : {"localize -r ", "live --device replay:"})
    EXPECT_THAT(runCommand(command + walk + " --deadline-us 1 --map " + map).err,
                HasSubstr("before its deadline. Raise --deadline-us."));
  for (int i = 0; i < 13; ++i)
    std::ofstream(walk + (i < 10 ? "/rgb/00000" : "/rgb/0000") + std::to_string(i) + ".png") << "no image";
  for (const std::string &way : ways) {
    const std::string said = runCommand(way).err;
    EXPECT_THAT(said, HasSubstr("rgb/000009.png")) << way;
    EXPECT_THAT(said, Not(HasSubstr("rgb/000010.png"))) << way;
    EXPECT_THAT(said, HasSubstr("3 more ")) << way;
  }
  const auto frames = jsonLines(fileText(folder / "frames.jsonl"));
  ASSERT_EQ(frames.size(), 14u);
  EXPECT_EQ(frames[12]["sequence"], 12);
  EXPECT_EQ(frames[12]["outcome"], "unreadable");
  EXPECT_THAT(frames[12]["why"].get<std::string>(), HasSubstr("rgb/000012.png"));
  EXPECT_NE(frames[13]["outcome"], "unreadable");
}

// Colour faster than depth shares depth images: as many frames as depth images do not mean that all of these went.
TEST(Convert, TellsOfDepthImagesLeftOutWhereFramesShareOthers) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk";
  ASSERT_EQ(runCommand("simulate --frames 4 --rate 6 --out " + walk).exit_code, kExitDone);
  std::ofstream list(walk + "/rgb.txt");
  for (int i = 0; i < 4; ++i) list << "1.00" << 2 * i << " rgb/00000" << i << ".png\n";
  list.close();
  for (const char *to : {"seq-01 --to 7scenes", "walk.raw --to raw"}) {
    const Answer converted = runCommand("convert " + walk + " " + (folder / to));
    ASSERT_EQ(converted.exit_code, kExitDone) << converted.err;
    EXPECT_THAT(converted.out, HasSubstr("4 depth images"));
    EXPECT_THAT(converted.err, HasSubstr("left out: 3 depth images without a colour image near in time"));
  }
}

TEST(Advise, TellsOfFramesThatTookNoPart) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk", advise = "advise --json --folds 2 -r " + walk;
  ASSERT_EQ(runCommand("simulate --frames 4 --rate 6 --out " + walk).exit_code, kExitDone);
  const Answer sound = runCommand(advise);
  ASSERT_EQ(sound.exit_code, kExitDone) << sound.err;
  EXPECT_TRUE(nlohmann::json::parse(sound.out)["left_out"].empty());
  std::ofstream(walk + "/rgb/000001.png") << "no image";
  const Answer damaged = runCommand(advise);
  ASSERT_EQ(damaged.exit_code, kExitDone) << damaged.err;
  EXPECT_THAT(damaged.err, HasSubstr("note: 1 frame could not be read and took no part"));
  EXPECT_THAT(damaged.err, HasSubstr("rgb/000001.png"));
  for (const std::string &command :
       {"advise --folds 2 -r " + walk, "build --map " + (folder / "a.sphc") + " -r " + walk})
    EXPECT_THAT(runCommand(command).err,
                HasSubstr("note: 1 frame could not be read and took no part; the first: rgb/000001.png"))
        << command;
  const Answer converted = runCommand("convert --to 7scenes " + walk + " " + (folder / "seq-01"));
  EXPECT_THAT(converted.err, HasSubstr("left out: "));
  EXPECT_THAT(converted.err, Not(HasSubstr("without a colour image near in time")));
  EXPECT_THAT(converted.err, Not(HasSubstr("between frames")));
  EXPECT_THAT(runCommand("guide -r " + walk).err, HasSubstr("note: 1 frame could not be read; the first: "));
  EXPECT_EQ(nlohmann::json::parse(damaged.out)["left_out"].size(), 1u) << "each frame once";
}

// Whoever looks at such a recording needs advice most.
TEST(Advise, DoesNotEndAtABlockThatCannotBeRead) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk";
  ASSERT_EQ(runCommand("simulate --frames 6 --rate 6 --out " + walk).exit_code, kExitDone);
  for (const char *frame : {"0", "1"}) std::ofstream(walk + "/rgb/00000" + frame + ".png") << "no image";
  const Answer advice = runCommand("advise --json --folds 3 -r " + walk);
  ASSERT_EQ(advice.exit_code, kExitDone) << advice.err;
  EXPECT_EQ(nlohmann::json::parse(advice.out)["recall"][0]["frames"], 4);
}

// As where tracking was lost: with blocks of all frames, the first had all that a map is made of.
TEST(Advise, HoldsOutFramesWithAPose) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk";
  ASSERT_EQ(runCommand("simulate --frames 8 --rate 6 --out " + walk).exit_code, kExitDone);
  std::istringstream poses(fileText(walk + "/groundtruth.txt"));
  std::string line, kept;
  for (int i = 0; i < 5 && std::getline(poses, line); ++i) kept += line + "\n";  // the heading and four
  std::ofstream(walk + "/groundtruth.txt") << kept;
  const Answer advice = runCommand("advise --json --folds 2 -r " + walk);
  ASSERT_EQ(advice.exit_code, kExitDone) << advice.err;
  EXPECT_EQ(nlohmann::json::parse(advice.out)["recall"][0]["frames"], 4);
  EXPECT_THAT(runCommand("advise --folds 3 -r " + walk).err,
              HasSubstr("4 frames with a pose, too few for 3 folds"));
}

// A camera that was unplugged counts anew: every number is there twice.
TEST(Advise, HoldsOutFramesThoughNumbersComeTwice) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk", twice = folder / "twice.mcap";
  ASSERT_EQ(runCommand("simulate --frames 8 --rate 6 --out " + walk).exit_code, kExitDone);
  recording::RecordingReader reader(walk);
  const auto out = createRecording(twice, reader.calibration(), patientRecorderConfig());
  for (uint32_t i = 0; i < reader.frameCount(); ++i) {
    const sphc_localizer_frame frame = reader.read(i);
    sphc_capture capture = {};
    capture.struct_size = sizeof capture;
    capture.sequence = i % 4;
    for (const sphc_stream stream : {SPHC_STREAM_COLOR, SPHC_STREAM_DEPTH}) {
      capture.stream = stream;
      capture.image = stream == SPHC_STREAM_COLOR ? frame.color : frame.depth;
      capture.time_ns = stream == SPHC_STREAM_COLOR ? frame.color_time_ns : frame.depth_time_ns;
      out->add(capture);
    }
    out->addPose(frame.color_time_ns, *reader.worldFromCamera(i));
  }
  out->close();
  const Answer advice = runCommand("advise --json --folds 2 -r " + twice);
  ASSERT_EQ(advice.exit_code, kExitDone) << advice.err;
  EXPECT_EQ(nlohmann::json::parse(advice.out)["recall"][0]["frames"], 8) << "each once";
}

TEST(Advise, SaysThatNoFrameWouldBeLocalized) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk";
  ASSERT_EQ(runCommand("simulate --frames 6 --rate 0.6 --out " + walk).exit_code, kExitDone);
  const Answer advice = runCommand("advise --folds 2 -r " + walk);
  ASSERT_EQ(advice.exit_code, kExitDone) << advice.err;
  EXPECT_THAT(advice.out, HasSubstr("0 of 6 held-out frames within 5 cm and 5 deg, not one localized"));
  EXPECT_THAT(advice.out, Not(HasSubstr("nan")));
}

// A line of groundtruth.txt without a finite pose, and a recorder that was cut off: every command says so.
TEST(Damage, IsSaidByWhateverReadsARecording) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk", cut = folder / "cut.mcap", map = folder / "tiny.sphc";
  writeTinyMap(map, 40);
  ASSERT_EQ(runCommand("simulate --frames 3 --rate 6 --out " + walk).exit_code, kExitDone);
  ASSERT_EQ(runCommand("simulate --frames 12 --rate 6 --out " + cut).exit_code, kExitDone);
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) * 2 / 3);
  std::ofstream(walk + "/groundtruth.txt", std::ios::app) << "99.0 nan 0 0 0 0 0 1\n";
  const std::string left_out = "left out: 1 pose,", cut_off = "it was cut off;";
  const auto says = [](const std::string &command, const std::string &recording, const std::string &sentence) {
    EXPECT_THAT(runCommand(command).err, HasSubstr("note: " + recording + ": " + sentence)) << command;
  };
  for (const std::string &command : {std::string("guide -r "), "localize -m " + map + " -r "}) {
    says(command + walk, walk, left_out);
    says(command + cut, cut, cut_off);
  }
  // These fail, for which the note may be the reason.
  for (const std::string &command :
       {"build --map " + (folder / "room.sphc") + " --min-observations 4 -r ",
        "map --min-observations 4 --model " + (folder / "m") + " -r ", std::string("advise -r ")}) {
    EXPECT_NE(runCommand(command + walk).exit_code, kExitDone) << command;
    says(command + walk, walk, left_out);
  }
  says("convert " + walk + " " + (folder / "a"), walk, left_out);
  says("convert " + cut + " " + (folder / "b"), cut, cut_off);
  for (const auto &[recording, sentence] : {std::pair(walk, left_out), {cut, cut_off}}) {
    EXPECT_THAT(runCommand("doctor --device replay:" + recording).out, HasSubstr(sentence));
    for (const std::string json : {"", " --json"})
      EXPECT_THAT(runCommand("live --map " + map + " --device replay:" + recording + json).err, HasSubstr(sentence))
          << json;
  }
  EXPECT_THAT(runCommand("doctor --device replay:" + walk).out, Not(HasSubstr(cut_off)));
  EXPECT_THAT(runCommand("live --map " + map + " --device replay:" + walk).err, Not(HasSubstr(cut_off)));
}

// Once converted, nothing of these can be seen any more.
TEST(Damage, OfTimesAndPosesIsSaidByConvert) {
  constexpr uint32_t kSide = 32;
  const test::TempFolder folder;
  test::RosBag bag;
  const std::string sensor = "sensor_msgs/msg/";
  for (const std::string name : {"/color/", "/depth/"})
    bag.add(name + "camera_info", sensor + "CameraInfo", 1,
            test::rosCameraInfo("camera", kSide, kSide, "plumb_bob", {}, {30, 30, 15.5, 15.5}));
  for (const int64_t i : {0, 1, 5, 2, 2}) {
    const int64_t time_ns = 1000000000 + i * 33000000;
    bag.add("/color/image_raw", sensor + "Image", 1,
            test::rosImage(time_ns, "camera", kSide, kSide, "rgb8", test::Bytes(kSide * kSide * 3, 7)));
    bag.add("/depth/image_raw", sensor + "Image", 1,
            test::rosImage(time_ns, "camera", kSide, kSide, "16UC1", test::Bytes(kSide * kSide * 2, 7)));
    bag.add("/odom", "nav_msgs/msg/Odometry", 1,
            test::rosOdometry(time_ns, {"odom", "base_link", {{1, 0, 0, 0}, {0, 0, 0}}}));
  }
  folder.write("bag.mcap", bag.bytes(test::RosBag::Chunks::kStored));
  for (const char *name : {"walk.mcap", "walk", "walk.raw"}) {
    const Answer converted = runCommand("convert " + (folder / "bag.mcap") + " " + (folder / name));
    EXPECT_EQ(converted.exit_code, kExitDone) << converted.err;
    for (const char *sentence :
         {"the times of /color/image_raw go back once", "left out: 2 images, whose times are not after",
          "it has no poses: odometry or tf moves base_link"})
      EXPECT_THAT(converted.err, HasSubstr(sentence)) << name;
  }
}

TEST(Convert, KeepsAccelerationsInAFile) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk.mcap", part = folder / "part.mcap";
  ASSERT_EQ(runCommand("simulate --frames 9 --rate 2 --accelerometer 50 --out " + walk).exit_code, kExitDone);
  ASSERT_EQ(recording::openRecording(walk).accelerations.size(), 201u);
  const Answer cut = runCommand("convert --json " + walk + " " + part + " --first 4 --last 5");
  ASSERT_EQ(cut.exit_code, kExitDone) << cut.err;
  EXPECT_EQ(nlohmann::json::parse(cut.out)["accelerations"], 126) << "of 1 to 3.5 s";
  const std::vector<recording::TimedAcceleration> whole = recording::openRecording(walk).accelerations,
                                                  kept = recording::openRecording(part).accelerations;
  ASSERT_EQ(kept.size(), 126u);
  EXPECT_EQ(kept[0].time_ns, whole[50].time_ns);
  EXPECT_EQ(kept[0].felt_mps2[1], whole[50].felt_mps2[1]);
  for (const char *to : {"folder", "seq-01 --to 7scenes", "walk.raw"}) {
    const Answer without = runCommand("convert --json " + walk + " " + (folder / to));
    ASSERT_EQ(without.exit_code, kExitDone) << without.err;
    EXPECT_EQ(nlohmann::json::parse(without.out)["accelerations"], 0);
    EXPECT_THAT(without.err, HasSubstr("note: left out: 201 accelerations; an MCAP file keeps them")) << to;
    EXPECT_THAT(runCommand("convert --first 1 " + walk + " " + (folder / "part_") + to).err,
                HasSubstr("note: left out: accelerations; an MCAP file keeps them"))
        << to;
  }
  EXPECT_THAT(runCommand("simulate --frames 1 --accelerometer 50 --out " + (folder / "none")).err,
              HasSubstr("a folder keeps no accelerations"));
}

TEST(Convert, GoesThroughEveryLayoutAndBack) {
  const test::TempFolder folder;
  const std::string file = folder / "walk.mcap", walk = folder / "walk", scenes = folder / "seq-01";
  ASSERT_EQ(runCommand("simulate --frames 2 --rate 6 --out " + file).exit_code, kExitDone);
  const Answer unpacked = runCommand("convert --json " + file + " " + walk);
  ASSERT_EQ(unpacked.exit_code, kExitDone) << unpacked.err;
  const auto json = nlohmann::json::parse(unpacked.out);
  EXPECT_EQ(json["color"], 2);
  EXPECT_EQ(json["depth"], 2);
  EXPECT_EQ(json["poses"], 2);
  ASSERT_EQ(runCommand("convert --depth-codec rvl " + walk + " " + (folder / "b.mcap")).exit_code, kExitDone);
  ASSERT_EQ(runCommand("convert " + (folder / "b.mcap") + " " + (folder / "back")).exit_code, kExitDone);
  EXPECT_TRUE(sameFiles(walk, folder / "back"));

  const Answer numbered = runCommand("convert " + walk + " " + scenes + " --to 7scenes");
  ASSERT_EQ(numbered.exit_code, kExitDone) << numbered.err;
  EXPECT_THAT(numbered.err, HasSubstr("no times"));
  ASSERT_EQ(runCommand("convert " + scenes + " " + (folder / "c.mcap")).exit_code, kExitDone);
  ASSERT_EQ(runCommand("convert " + (folder / "c.mcap") + " " + (folder / "seq-02") + " --to 7scenes").exit_code,
            kExitDone);
  for (const char *name : {"calibration.json", "frame-000000.color.png", "frame-000001.depth.png"})
    EXPECT_TRUE(sameFiles(scenes + "/" + name, folder / ("seq-02/" + std::string(name)))) << name;
  EXPECT_EQ(runCommand("convert " + walk + " " + file).exit_code, kExitFailure) << "nothing is overwritten";

  const std::string raw = folder / "walk.raw";
  const Answer made = runCommand("convert --json " + walk + " " + raw + " --to raw");
  ASSERT_EQ(made.exit_code, kExitDone) << made.err;
  EXPECT_EQ(nlohmann::json::parse(made.out)["poses"], 2);
  ASSERT_EQ(runCommand("convert " + raw + " " + (folder / "from_raw")).exit_code, kExitDone);
  EXPECT_TRUE(sameFiles(walk, folder / "from_raw"));
  EXPECT_EQ(runCommand("convert " + walk + " " + raw).exit_code, kExitFailure) << "nothing is overwritten";
}

const char kChain[] =
    "cam0: {camera_model: pinhole, intrinsics: [500, 501, 319.5, 239.5], distortion_model: equidistant,\n"
    "  distortion_coeffs: [0.01, 0.02, -0.01, 0.001], resolution: [640, 480]}\n"
    "cam1: {camera_model: pinhole, intrinsics: [250, 251, 159.5, 119.5], distortion_model: radtan,\n"
    "  distortion_coeffs: [0.1, -0.2, 0.001, 0.002], resolution: [320, 240],\n"
    "  T_cn_cnm1: [[1, 0, 0, 0.02], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}\n";

TEST(Calibration, ShowsAndConverts) {
  const test::TempFolder folder;
  std::ofstream(folder / "chain.yaml") << kChain;
  const Answer shown = runCommand("calibration " + (folder / "chain.yaml"));
  ASSERT_EQ(shown.exit_code, kExitDone) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("(kalibr)"));
  EXPECT_THAT(shown.out, HasSubstr("20.00 mm"));

  std::string from = folder / "chain.yaml";
  for (const std::string format : {"opencv", "ros", "colmap", "spherecloud", "kalibr"}) {
    const std::string to = folder / ("as_" + format);
    const Answer made = runCommand("calibration " + from + " --json --to " + format + " --out " + to);
    ASSERT_EQ(made.exit_code, kExitDone) << made.err;
    const auto json = nlohmann::json::parse(made.out);
    EXPECT_NEAR(json["baseline_m"].get<double>(), 0.02, 1e-12);
    EXPECT_EQ(json["written"]["round_trip"].size(), 6u);
    for (const auto &part : json["written"]["round_trip"]) EXPECT_LT(part["largest_px"], 1e-6) << format;
    from = to;
  }
}

TEST(Calibration, PixelsWithoutARayAreNamed) {
  const test::TempFolder folder;
  std::string folded = kChain;  // the distortion of cam1 turns back before the edges of its image
  folded.replace(folded.find("0.1, -0.2,"), 10, "-2.0, 0.0,");
  std::ofstream(folder / "folded.yaml") << folded;
  std::ofstream(folder / "chain.yaml") << kChain;
  const Answer sound = runCommand("calibration --json " + (folder / "chain.yaml"));
  EXPECT_EQ(sound.err, "");
  EXPECT_EQ(nlohmann::json::parse(sound.out)["depth_camera"]["without_ray_percent"], 0);
  const Answer shown = runCommand("calibration " + (folder / "folded.yaml"));
  EXPECT_EQ(shown.exit_code, kExitDone);
  EXPECT_THAT(shown.out, AllOf(HasSubstr("sees ? x ? deg"), Not(HasSubstr("nan"))));
  EXPECT_THAT(shown.err, AllOf(HasSubstr("the depth camera has no ray at "), HasSubstr("up to the corners")));
  const auto json = nlohmann::json::parse(runCommand("calibration --json " + (folder / "folded.yaml")).out);
  EXPECT_TRUE(json["depth_camera"]["field_of_view_deg"][0].is_null());
  EXPECT_GT(json["depth_camera"]["without_ray_percent"], 50);
}

// A baseline of 8 mm taken for metres: depth falls nowhere, and a round trip of nothing is none.
TEST(Calibration, DepthThatFallsOnNoColourIsNamed) {
  const test::TempFolder folder;
  std::string chain = kChain;
  chain.replace(chain.find("0, 0.02]"), 8, "0, 8.00]");
  std::ofstream(folder / "millimetres.yaml") << chain;
  const std::string command = "calibration " + (folder / "millimetres.yaml");
  const Answer shown = runCommand(command);
  EXPECT_EQ(shown.exit_code, kExitDone);
  EXPECT_THAT(shown.err, AllOf(HasSubstr("no pixel of depth falls on the colour image"), HasSubstr("in metres")));
  const Answer made = runCommand(command + " --json --out " + (folder / "calibration.json"));
  ASSERT_EQ(made.exit_code, kExitDone) << made.err;
  const auto round_trip = nlohmann::json::parse(made.out)["written"]["round_trip"];
  EXPECT_LT(round_trip[0]["largest_px"], 1e-6);
  EXPECT_EQ(round_trip[2]["samples"], 0);
  EXPECT_TRUE(round_trip[2]["largest_px"].is_null());
  EXPECT_THAT(runCommand(command + " --out " + (folder / "again.json")).out, HasSubstr("nothing was compared"));
}

TEST(Calibration, ADepthUnitThatAFormatDoesNotKeepIsSaid) {
  const test::TempFolder folder;
  std::ofstream(folder / "chain.yaml") << kChain;
  const std::string command = "calibration " + (folder / "chain.yaml") + " --out ";
  const std::string of_tenths = " --depth-unit 1.0e-04";
  EXPECT_THAT(runCommand(command + (folder / "k.yaml") + " --to kalibr" + of_tenths).err,
              HasSubstr("note: kalibr has no depth unit; give --depth-unit 1.0e-04 where "));
  EXPECT_EQ(runCommand(command + (folder / "own.json") + of_tenths).err, "");
  EXPECT_EQ(runCommand(command + (folder / "usual.yaml") + " --to kalibr").err, "");
}

TEST(Calibration, ApproximatesOnlyWhenTold) {
  const test::TempFolder folder;
  std::ofstream(folder / "chain.yaml") << kChain;
  const std::string command =
      "calibration " + (folder / "chain.yaml") + " --to azure-kinect --out " + (folder / "k.json");
  const Answer refused = runCommand(command);
  EXPECT_EQ(refused.exit_code, kExitFailure);
  EXPECT_THAT(refused.err, HasSubstr("--approximate"));
  EXPECT_FALSE(std::filesystem::exists(folder / "k.json"));
  const Answer made = runCommand(command + " --approximate --json");
  ASSERT_EQ(made.exit_code, kExitDone) << made.err;
  const auto written = nlohmann::json::parse(made.out)["written"];
  EXPECT_FALSE(written["exact"]);
  EXPECT_LT(written["round_trip"][0]["largest_px"], 0.5);
  EXPECT_EQ(written["round_trip"][0]["lost"], 0);
}

TEST(Calibration, OptionsSayWhatAFileLeavesOpen) {
  const test::TempFolder folder;
  std::ofstream(folder / "cameras.txt") << "1 PINHOLE 640 480 500 501 320 240\n2 PINHOLE 320 240 250 251 160 120\n";
  const std::string command =
      "calibration " + (folder / "cameras.txt") + " --json --color 2 --depth 1 --depth-unit 0.0002";
  const Answer open = runCommand(command);
  EXPECT_EQ(open.exit_code, kExitFailure);
  EXPECT_THAT(open.err, HasSubstr("--color-from-depth"));
  const Answer given = runCommand(command + " --color-from-depth -0.6,0,-0.8,0,-0.1,0,0.2");
  ASSERT_EQ(given.exit_code, kExitDone) << given.err;
  const auto json = nlohmann::json::parse(given.out);
  EXPECT_EQ(json["color_camera"]["width"], 320);
  EXPECT_EQ(json["color_from_depth"]["q_wxyz"][2], -0.8);
  EXPECT_EQ(json["depth_unit_m"], 0.0002);
}

// The localizer of cameras is that of recordings.
void expectTheSameAnswersOfBoth(const test::TempFolder &folder, const std::string &walk, const std::string &map,
                                const std::string &options) {
  const std::string file = folder / "answers.jsonl";
  runCommand("localize --force -r " + walk + " -m " + map + " --frames-json " + file + options);
  const auto answers = jsonLines(fileText(file));
  const auto seen = jsonLines(runCommand("live --json --device replay:" + walk + " -m " + map + options).out);
  ASSERT_EQ(seen.size(), answers.size()) << options;
  for (size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i]["outcome"], answers[i]["outcome"]) << options;
    EXPECT_EQ(seen[i]["inliers"], answers[i]["inliers"]) << options;
    EXPECT_EQ(seen[i]["hints"], answers[i]["hints"]) << options;
  }
}

// A recording in a camera's place.
void expectCaptures(const test::TempFolder &folder, const std::string &walk, const std::string &map) {
  const std::string camera = " --device replay:" + walk;
  const Answer live = runCommand("live --json --map " + map + camera);
  EXPECT_EQ(live.exit_code, kExitDone) << live.err;
  const auto lines = jsonLines(live.out);
  EXPECT_EQ(lines.size(), 6u);
  EXPECT_GE(std::count_if(lines.begin(), lines.end(), [](const auto &line) { return line["localized"]; }), 5);
  for (const char *options :
       {"", " --mode single --max-keypoints 300 --seed 7", " --depth-max 1.2 --depth-sigma 0.02",
        " --probes 1 --ratio 0.7 --max-iterations 500 --min-inliers 30"})
    expectTheSameAnswersOfBoth(folder, walk, map, options);

  const std::string file = folder / "again.mcap";
  const Answer recorded = runCommand("record --json --out " + file + camera);
  ASSERT_EQ(recorded.exit_code, kExitDone) << recorded.err;
  const auto json = nlohmann::json::parse(recorded.out);
  EXPECT_EQ(json["color"], 6);
  EXPECT_EQ(json["depth"], 6);
  EXPECT_EQ(json["dropped"], 0);
  EXPECT_THAT(recorded.err, HasSubstr("left out: 6 poses of the recording that is played"));
  EXPECT_EQ(runCommand("localize -r " + file + " -m " + map).exit_code, kExitDone);

  const Answer doctor = runCommand("doctor --json" + camera);
  EXPECT_EQ(doctor.exit_code, kExitDone) << doctor.err << doctor.out;
  EXPECT_FALSE(nlohmann::json::parse(doctor.out)["wrong"].get<bool>());
}

// What the ledger beside the map allows, and what not.
void expectDiscipline(const test::TempFolder &folder, const std::string &build, const std::string &map) {
  const std::string again = folder / "again.sphc", ledger = folder / "spherecloud.ledger";
  const Answer same = runCommand(build + "--json -m " + again);
  ASSERT_EQ(same.exit_code, kExitDone) << same.err;
  const auto json = nlohmann::json::parse(same.out);
  EXPECT_TRUE(json["release"]["same_as_before"].get<bool>());
  expectExplained(json);
  EXPECT_EQ(std::system(("cmp -s " + map + " " + again).c_str()), 0) << "one recording, other bytes";

  const Answer other_eta = runCommand(build + "--eta 0.5 -m " + again);
  EXPECT_EQ(other_eta.exit_code, kExitFailure);
  EXPECT_THAT(other_eta.err, HasSubstr("--i-understand"));
  const std::string elsewhere =
      build + "-m " + again + " --ledger " + (folder / "other") + " --against " + ledger + " --force";
  const Answer heeded = runCommand(elsewhere);
  EXPECT_THAT(heeded.err, HasSubstr("released by another ledger"));
  EXPECT_THAT(heeded.err, testing::Not(HasSubstr("is not heeded")));
  const Answer unheeded =
      runCommand(build + "-m " + (folder / "unheeded.sphc") + " --ledger " + (folder / "third"));
  EXPECT_EQ(unheeded.exit_code, kExitDone) << unheeded.err;
  EXPECT_THAT(unheeded.err, HasSubstr("--ledger names another: what it released is not heeded"));
  EXPECT_THAT(runCommand(elsewhere + " --i-understand").err, HasSubstr("now exposed"));
  EXPECT_NE(std::system(("cmp -s " + map + " " + again).c_str()), 0);
}

// Maps and cameras of two bands are kept apart.
void expectBands(const test::TempFolder &folder, const std::string &build, const std::string &localize) {
  const std::string infrared = folder / "infrared.sphc", model = folder / "infrared.model";
  EXPECT_THAT(runCommand(build + "-m " + infrared + " --band infrared").err, HasSubstr("another band"));
  const std::string ledger = " --ledger " + (folder / "infrared.ledger");
  const Answer built =
      runCommand(build + "-m " + infrared + " --band infrared --json --save-model " + model + ledger);
  ASSERT_EQ(built.exit_code, kExitDone) << built.err;
  EXPECT_EQ(nlohmann::json::parse(built.out)["band"], "infrared");
  EXPECT_EQ(nlohmann::json::parse(runCommand("info --json " + infrared).out)["band"], "infrared");
  EXPECT_THAT(runCommand("info " + infrared).out, HasSubstr("infrared"));
  // The model knows.
  const Answer again = runCommand("build --model " + model + " --force --json -m " + infrared + ledger);
  ASSERT_EQ(again.exit_code, kExitDone) << again.err;
  EXPECT_EQ(nlohmann::json::parse(again.out)["band"], "infrared");
  EXPECT_EQ(runCommand("build --model " + model + " --band infrared -m x").exit_code, kExitUsage);

  const Answer refused = runCommand(localize + " -m " + infrared);
  EXPECT_EQ(refused.exit_code, kExitFailure);
  EXPECT_THAT(refused.err, HasSubstr("the map is of infrared, and --band is visible"));
  EXPECT_EQ(runCommand(localize + " --band infrared -m " + infrared).exit_code, kExitDone);
  EXPECT_EQ(runCommand(localize + " --band ultraviolet -m " + infrared).exit_code, kExitUsage);
}

// From the headset to the localizer, and not lost on the way without a word.
void expectAmplitudes(const test::TempFolder &folder, const std::string &map) {
  const std::string raw = folder / "raw.mcap", again = folder / "raw_again.mcap";
  ASSERT_EQ(runCommand("simulate --raw-depth --frames 2 --rate 6 --out " + raw).exit_code, kExitDone);
  ASSERT_EQ(runCommand("convert " + raw + " " + again).exit_code, kExitDone);
  const Answer masked = runCommand("localize --json --amplitude-min 75 -r " + again + " -m " + map);
  EXPECT_EQ(masked.exit_code, kExitDone) << masked.err;
  EXPECT_EQ(nlohmann::json::parse(masked.out)["settings"]["amplitude_min"], "75");
  EXPECT_EQ(runCommand("live --json --amplitude-min 75 --device replay:" + again + " -m " + map).exit_code,
            kExitDone);
  EXPECT_EQ(runCommand("localize -r " + again + " -m " + map).exit_code, kExitDone);  // they are not asked for

  const Answer folder_of_it = runCommand("convert " + raw + " " + (folder / "raw_walk"));
  EXPECT_THAT(folder_of_it.err, HasSubstr("left out: amplitudes of 2 depth images"));
  const Answer without = runCommand("localize --amplitude-min 75 -r " + (folder / "raw_walk") + " -m " + map);
  EXPECT_EQ(without.exit_code, kExitFailure);
  EXPECT_THAT(without.err, HasSubstr("amplitude image is missing"));
  const Answer live = runCommand("live --amplitude-min 75 --device replay:" + (folder / "raw_walk") + " -m " + map);
  EXPECT_EQ(live.exit_code, kExitFailure);
  EXPECT_THAT(live.err, HasSubstr("the depth camera gave no amplitudes; leave --amplitude-min out"));
  EXPECT_THAT(live.err, Not(HasSubstr("calibration")));
  EXPECT_THAT(runCommand("simulate --raw-depth --frames 1 --out " + (folder / "raw_folder")).err,
              HasSubstr("keeps no amplitudes"));
}

TEST(Simulate, SaysThatAnExposureWithoutBlurChangesNothing) {
  const test::TempFolder folder;
  const std::string simulate = "simulate --frames 1 --out ", note = "note: --exposure: with --no-blur";
  EXPECT_THAT(runCommand(simulate + (folder / "both") + " --no-blur --exposure 0.02").err, HasSubstr(note));
  EXPECT_THAT(runCommand(simulate + (folder / "one") + " --no-blur").err, Not(HasSubstr(note)));
}

// The whole way on a few frames of a simulated walk.
TEST(RoundTrip, SimulateBuildLocalize) {
  const test::TempFolder folder;
  const std::string walk = folder / "walk", map = folder / "room.sphc";
  const Answer recorded = runCommand("simulate --json --frames 6 --rate 6 --out " + walk);
  ASSERT_EQ(recorded.exit_code, kExitDone) << recorded.err;
  EXPECT_EQ(nlohmann::json::parse(recorded.out)["frames"], 6);
  EXPECT_EQ(runCommand("simulate --frames 6 --out " + walk).exit_code, kExitFailure);  // nothing is overwritten

  const std::string build = "build -r " + walk + " --step 2 ";
  const Answer built = runCommand(build + "-m " + map);
  ASSERT_EQ(built.exit_code, kExitDone) << built.err;
  EXPECT_THAT(built.out, HasSubstr("never ship it"));
  expectDiscipline(folder, build, map);

  const std::string localize = "localize -r " + walk + " -m " + map + " --first 1 --step 2 --json";
  const Answer found =
      runCommand(localize + " --owner-note " + map + ".owner.json --trajectory " + (folder / "p.tum") +
                 " --frames-json " + (folder / "f.jsonl") + " --report " + (folder / "report"));
  ASSERT_EQ(found.exit_code, kExitDone) << found.err;
  const auto json = nlohmann::json::parse(found.out);
  EXPECT_EQ(json["frames"], 3);
  EXPECT_EQ(json["within_5cm_5deg"], 3);
  for (const char *file : {"p.tum", "f.jsonl", "report/report.html"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
  }

  expectExplained(json);
  expectExplained(nlohmann::json::parse(fileText(map + ".owner.json")));
  for (const auto &line : jsonLines(fileText(folder / "f.jsonl"))) expectExplained(line);

  const Answer mixed_up = runCommand(localize + " --frames-json /dev/stdout");
  EXPECT_EQ(mixed_up.exit_code, kExitFailure);
  EXPECT_THAT(mixed_up.err, HasSubstr("/dev/stdout is where this command's own words go"));

  expectBands(folder, build, "localize -r " + walk + " --first 1 --step 2");

  // Without the note: no truth, poses in the map's frame.
  const auto blind = nlohmann::json::parse(runCommand(localize).out);
  EXPECT_EQ(blind["base"], "map");
  EXPECT_TRUE(blind["within_5cm_5deg_percent"].is_null());

  expectCaptures(folder, walk, map);
  expectAmplitudes(folder, map);

  // In another place's map.
  writeTinyMap(folder / "other.sphc", 200);
  const Answer lost = runCommand("localize -r " + walk + " -m " + (folder / "other.sphc"));
  EXPECT_EQ(lost.exit_code, kExitNotLocalized);
  EXPECT_THAT(lost.err, HasSubstr("Not one frame"));
  const Answer live = runCommand("live -m " + (folder / "other.sphc") + " --device replay:" + walk);
  EXPECT_EQ(live.exit_code, kExitNotLocalized);
  EXPECT_THAT(live.err, HasSubstr("Not one frame"));
  const Answer mixed =
      runCommand("localize -r " + walk + " -m " + (folder / "other.sphc") + " --owner-note " + map + ".owner.json");
  EXPECT_EQ(mixed.exit_code, kExitFailure);
  EXPECT_THAT(mixed.err, HasSubstr("no note of " + (folder / "other.sphc") + " is given"));
}

}  // namespace
}  // namespace sphc::host
