// What doctor says of recordings, and advise and build after it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "command_runner.h"
#include "host/cli/common/exit_code.h"
#include "host/report/run.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// One walk, made once.
class DoctorTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::TempFolder>();
    const Answer walk = runCommand("simulate --frames 12 --rate 5 --out " + at("walk"));
    ASSERT_EQ(walk.exit_code, kExitDone) << walk.err;
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::string at(const std::string &name) { return *folder_ / name; }
  static std::string copyOfWalk(const std::string &name) {
    fs::copy(at("walk"), at(name), fs::copy_options::recursive);
    return at(name);
  }
  static Answer doctor(const std::string &recording) { return runCommand("doctor --device replay:" + recording); }

  // Each line of a list but comments as `changed` makes it of its time and the rest.
  using Change = std::function<std::string(double time_s, const std::string &rest)>;
  static void change(const std::string &list, const Change &changed) {
    std::istringstream lines(fileText(list));
    std::ofstream out(list);
    for (std::string line; std::getline(lines, line);) {
      if (line[0] == '#') continue;
      const size_t space = line.find(' ');
      out << changed(std::stod(line), line.substr(space + 1)) << '\n';
    }
  }

  static std::unique_ptr<test::TempFolder> folder_;
};
std::unique_ptr<test::TempFolder> DoctorTest::folder_;

// The places of the poses are twice as far apart.
std::string twiceAsFar(double time_s, const std::string &pose) {
  std::istringstream fields(pose);
  double x = 0, y = 0, z = 0;
  std::string rotation;
  fields >> x >> y >> z;
  std::getline(fields, rotation);
  std::ostringstream out;
  out << std::fixed << time_s << ' ' << 2 * x << ' ' << 2 * y << ' ' << 2 * z << rotation;
  return out.str();
}

TEST_F(DoctorTest, PosesOfAnotherScaleThanDepthAreNamedByAdviseToo) {
  const std::string walk = copyOfWalk("scale"), advise = "advise --json --folds 2 -r ";
  change(walk + "/groundtruth.txt", twiceAsFar);
  const auto factor =
      AllOf(HasSubstr("the camera goes about 1.9 times"), HasSubstr("as far by the poses as by depth"),
            HasSubstr("depth_unit_m of the calibration, or the unit of the poses, is another"));
  const Answer wrong = doctor(walk);
  EXPECT_EQ(wrong.exit_code, kExitFailure) << wrong.err;
  EXPECT_THAT(wrong.out, factor);
  const Answer warned = runCommand(advise + walk);
  EXPECT_THAT(warned.err, AllOf(HasSubstr("contradicts itself, and build refuses it: "), factor));
  EXPECT_EQ(nlohmann::json::parse(warned.out)["contradictions"].size(), 1u);
  EXPECT_THAT(doctor(at("walk")).out, HasSubstr("lie where poses and depth say"));
  const Answer sound = runCommand(advise + at("walk"));
  const auto advice = nlohmann::json::parse(sound.out);
  EXPECT_TRUE(advice["contradictions"].empty()) << sound.err;
  for (const auto &recall : advice["recall"]) EXPECT_TRUE(recall.contains("median_m")) << recall;
  for (const auto &failure : advice["failures"])
    EXPECT_TRUE(failure.contains("yaw_deg") && failure.contains("pitch_deg")) << failure;
}

TEST_F(DoctorTest, ImagesWithoutAPartnerAreDoubtful) {
  const std::string walk = copyOfWalk("unpaired");
  int line = 0;
  change(walk + "/depth.txt", [&line](double time_s, const std::string &file) {
    std::ostringstream out;
    out << std::fixed << time_s + (line++ % 3 == 2 ? 0.1 : 0) << ' ' << file;
    return out.str();
  });
  EXPECT_THAT(doctor(walk).out, HasSubstr("look   pairs          of 8 pairs "));
  EXPECT_THAT(doctor(at("walk")).out, HasSubstr("fine   pairs          of 12 pairs "));
}

TEST_F(DoctorTest, PixelsWithoutARayAreNamed) {
  const std::string walk = copyOfWalk("folded");
  auto calibration = nlohmann::json::parse(fileText(walk + "/calibration.json"));
  calibration["color_camera"]["params"][4] = -2.0;  // turns back well before the corners
  std::ofstream(walk + "/calibration.json") << calibration.dump();
  EXPECT_THAT(doctor(walk).out, HasSubstr("look   colour camera  by the calibration it has no ray at "));
  EXPECT_THAT(doctor(at("walk")).out, Not(HasSubstr("no ray")));
}

TEST_F(DoctorTest, AdviseNamesTheFoldWithTooFewPointsAndTheCameraThatSeesNothing) {
  const std::string walk = copyOfWalk("blind"), advise = "advise --folds 2 -r ";
  auto calibration = nlohmann::json::parse(fileText(walk + "/calibration.json"));
  calibration["color_camera"]["params"][4] = -2000.0;  // turns back around the centre
  std::ofstream(walk + "/calibration.json") << calibration.dump();
  const Answer blind = runCommand(advise + walk);
  EXPECT_EQ(blind.exit_code, kExitFailure);
  EXPECT_THAT(blind.err,
              AllOf(HasSubstr("Warning: the colour camera has no ray at "),
                    HasSubstr("where the distortion turns back"), HasSubstr("check focal lengths and distortion"),
                    HasSubstr("the map without frames 0 to 5, a fold that is held out: there are "),
                    HasSubstr("too few for a map"), HasSubstr("give more --folds")));
  EXPECT_THAT(runCommand(advise + at("walk")).err, Not(HasSubstr("no ray")));
}

TEST_F(DoctorTest, FewPosesAreTooFewToCheckAndAreNamed) {
  const std::string walk = copyOfWalk("few");
  std::istringstream lines(fileText(walk + "/groundtruth.txt"));
  std::ofstream few(walk + "/groundtruth.txt");
  std::string line;
  for (int i = 0; i < 5 && std::getline(lines, line); ++i) few << line << '\n';
  few.close();
  const auto named = HasSubstr("scale and consistency could not be checked: 4 of 12 frames have a pose");
  EXPECT_THAT(doctor(walk).out, named);
  const Answer built = runCommand("build -r " + walk + " -m " + at("few.sphc"));
  EXPECT_EQ(built.exit_code, kExitDone) << built.err;
  EXPECT_THAT(built.err, AllOf(HasSubstr("Warning: "), named));
  const Answer checked =
      runCommand("build -r " + at("walk") + " --ledger " + at("checked.ledger") + " -m " + at("checked.sphc"));
  EXPECT_THAT(checked.err, Not(HasSubstr("could not be checked")));
}

// The walk, and 40 times as many frames that nobody knows the place of.
TEST_F(DoctorTest, FramesWithoutAPoseLeaveTheScaleAsWellKnown) {
  const std::string walk = copyOfWalk("longer");
  for (const char *list : {"/rgb.txt", "/depth.txt"}) {
    std::istringstream lines(fileText(walk + list));
    std::string first, file;
    while (std::getline(lines, first) && first[0] == '#') continue;
    file = first.substr(first.find(' '));
    std::ofstream out(walk + list, std::ios::app);
    for (int i = 0; i < 480; ++i) out << 1000 + i << file << '\n';
  }
  const auto matchesOf = [](const std::string &recording) {
    const std::string map = recording + ".sphc";
    const Answer built = runCommand("build --json -r " + recording + " -m " + map + " --ledger " + map + ".ledger");
    EXPECT_EQ(built.exit_code, kExitDone) << built.err;
    return nlohmann::json::parse(built.out)["matches_between_frames"].get<uint32_t>();
  };
  EXPECT_EQ(matchesOf(walk), matchesOf(at("walk")));
}

TEST_F(DoctorTest, EveryThirdFrameIsARateAndNoLoss) {
  ASSERT_EQ(runCommand("convert --to 7scenes --step 3 " + at("walk") + " " + at("third")).exit_code, kExitDone);
  const Answer third = doctor(at("third"));
  EXPECT_THAT(third.out, HasSubstr("fine   colour rate    10.0 images a second"));
  EXPECT_THAT(third.out, HasSubstr("0 of 4 never came"));
}

// Played as it was recorded it would take 37 minutes.
TEST_F(DoctorTest, TimesInMillisecondsAreNamedAtOnce) {
  const std::string walk = copyOfWalk("milliseconds");
  for (const char *list : {"/rgb.txt", "/depth.txt", "/groundtruth.txt"})
    change(walk + list, [](double time_s, const std::string &rest) {
      return std::to_string(std::lround(1000 * time_s)) + " " + rest;
    });
  const Answer slow = doctor(walk);
  EXPECT_EQ(slow.exit_code, kExitFailure);
  EXPECT_THAT(slow.out, HasSubstr("WRONG  colour rate    an image every 200 s"));
  EXPECT_THAT(slow.out, HasSubstr("are the times in milliseconds?"));
}

TEST_F(DoctorTest, ImagesThatCannotBeReadDidCome) {
  const std::string walk = copyOfWalk("unreadable");
  for (const char *image : {"/rgb/000003.png", "/rgb/000007.png"}) fs::resize_file(walk + image, 100);
  const Answer answer = doctor(walk);
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.out, AllOf(HasSubstr("0 of 12 never came, and 2 cannot be read"), HasSubstr("000003.png")));
}

// The signal comes once it is heard.
TEST_F(DoctorTest, AnInterruptedOneIsNoSuccess) {
  const Answer answer = runProgram(
      "sh -c",
      "'" SPHC_COMMAND
      " doctor --device simulated: --frames 10000 & child=$!; while kill -0 $child && ! grep -q "
      "\"SigCgt:.*[4567cdef]...$\" /proc/$child/status; do sleep 0.1; done; kill -TERM $child; wait $child'");
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.out, AllOf(HasSubstr("interrupted after "), HasSubstr(" of 10000 pairs")));
}

// What was not looked at is not judged: poses are compared after the last pair.
TEST_F(DoctorTest, AnInterruptedOneComparesNoPoses) {
  const Answer answer = runProgram(
      "sh -c", "'" SPHC_COMMAND " doctor --device replay:" + at("walk") +
                   " --frames 10000 & child=$!; while kill -0 $child && ! grep -q \"SigCgt:.*[4567cdef]...$\" "
                   "/proc/$child/status; do :; done; kill -TERM $child; wait $child'");
  EXPECT_EQ(answer.exit_code, kExitFailure);
  EXPECT_THAT(answer.out, AllOf(HasSubstr("interrupted "), Not(HasSubstr("lie where poses"))));
}

TEST_F(DoctorTest, SwappedImagesAreNotToBeCopiedAgain) {
  const std::string walk = copyOfWalk("swapped");
  fs::rename(walk + "/rgb.txt", walk + "/other.txt");
  fs::rename(walk + "/depth.txt", walk + "/rgb.txt");
  fs::rename(walk + "/other.txt", walk + "/depth.txt");
  const Answer swapped = doctor(walk);
  EXPECT_EQ(swapped.exit_code, kExitFailure);
  EXPECT_THAT(swapped.out, AllOf(HasSubstr("colour and depth are swapped"), Not(HasSubstr("opy it again"))));
}

// The first column of the page's tables.
std::string reasonsOf(const std::string &page) {
  std::istringstream lines(page);
  std::string reasons;
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("| ", 0) == 0) reasons += line.substr(0, line.find(" | ")) + "\n";
  return reasons;
}

TEST_F(DoctorTest, EveryReasonOfAdviceIsExplained) {
  const std::string reasons = reasonsOf(fileText(SPHC_ADVICE_PAGE));
  for (const sphc_localizer_outcome outcome :
       {SPHC_OUTCOME_LOCALIZED, SPHC_OUTCOME_FEW_KEYPOINTS, SPHC_OUTCOME_FEW_DEPTHS, SPHC_OUTCOME_FEW_MATCHES,
        SPHC_OUTCOME_NO_CONSENSUS, SPHC_OUTCOME_UNCERTAIN, SPHC_OUTCOME_CONTRADICTION})  // advise sets no deadline
    EXPECT_THAT(reasons, HasSubstr(outcomeName(outcome)));
}

}  // namespace
}  // namespace sphc::host
