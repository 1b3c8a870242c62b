#include "host/recording/calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "file_size_limit.h"
#include "host/recording/calibration_json.h"
#include "tests/support/temp_folder.h"
#include "tiny_recording.h"

namespace sphc::contract {

namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char *kGood = R"({
  "format": "spherecloud-calibration", "version": 1, "pixel_center": 0.5,
  "color_camera": {"model": "pinhole", "width": 640, "height": 480, "params": [525.505, 525.5, 320, 240]},
  "depth_camera": {"model": "pinhole", "width": 320, "height": 240, "params": [290, 291, 160, 120]},
  "color_from_depth": {"q_wxyz": [0.6, 0, 0.8, 0], "t_m": [0.02, -0.005, -0.0125]},
  "depth_unit_m": 0.001
})";

std::string replaced(std::string text, const std::string &from, const std::string &to) {
  const size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no " + from);
  return text.replace(at, from.size(), to);
}

struct Parsed {
  sphc_status status;
  sphc_rig calibration;
  std::string message;
};

Parsed parse(const std::string &text) {
  Parsed parsed{};
  sphc_message message{};
  sphc_rig_init(&parsed.calibration);
  parsed.status = sphc_calibration_parse(text.data(), text.size(), "rig.json", &parsed.calibration, &message);
  parsed.message = message.text;
  return parsed;
}

TEST(Calibration, AFullDiskLeavesTheOldFile) {
  const test::TempFolder temp;
  const std::string path = temp / "rig.json";
  sphc_rig rig = tinyCalibration();
  ASSERT_EQ(sphc_calibration_write(path.c_str(), &rig, nullptr), SPHC_OK);
  const std::string before = temp.read("rig.json");
  rig.depth_unit_m = 0.002;
  sphc_message message{};
  {
    const FileSizeLimit limit(before.size() / 2);
    EXPECT_EQ(sphc_calibration_write(path.c_str(), &rig, &message), SPHC_E_DEVICE);
  }
  EXPECT_THAT(message.text, HasSubstr("rig.json"));
  EXPECT_EQ(temp.read("rig.json"), before);
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  ASSERT_EQ(sphc_calibration_write(path.c_str(), &rig, nullptr), SPHC_OK);
  EXPECT_NE(temp.read("rig.json"), before);
}

TEST(Calibration, ReadsEveryField) {
  const Parsed parsed = parse(kGood);
  ASSERT_EQ(parsed.status, SPHC_OK) << parsed.message;
  const sphc_rig &c = parsed.calibration;
  EXPECT_EQ(c.color_camera.model, SPHC_CAMERA_PINHOLE);
  EXPECT_EQ(c.color_camera.width, 640u);
  EXPECT_EQ(c.color_camera.height, 480u);
  EXPECT_EQ(c.color_camera.param_count, 4u);
  EXPECT_EQ(c.color_camera.params[0], 525.505);
  EXPECT_EQ(c.color_camera.params[2], 320);
  EXPECT_EQ(c.depth_camera.params[1], 291);
  EXPECT_EQ(c.color_from_depth.q_wxyz[2], 0.8);
  EXPECT_EQ(c.color_from_depth.t_m[0], 0.02);
  EXPECT_EQ(c.depth_unit_m, 0.001);
}

TEST(Calibration, ShiftsOpenCvPixelsByAHalf) {
  const Parsed parsed = parse(replaced(kGood, "\"pixel_center\": 0.5", "\"pixel_center\": 0"));
  ASSERT_EQ(parsed.status, SPHC_OK) << parsed.message;
  EXPECT_EQ(parsed.calibration.color_camera.params[0], 525.505);
  EXPECT_EQ(parsed.calibration.color_camera.params[2], 320.5);
  EXPECT_EQ(parsed.calibration.color_camera.params[3], 240.5);
  EXPECT_EQ(parsed.calibration.depth_camera.params[2], 160.5);
}

TEST(Calibration, TakesRegisteredDepthForTheColourCamera) {
  const Parsed parsed = parse(R"({"format": "spherecloud-calibration", "version": 1, "pixel_center": 0.5,
    "color_camera": {"model": "kannala_brandt4", "width": 540, "height": 360, "params": [495, 496, 270, 169, 0, 0, 0, 0]},
    "depth_unit_m": 0.001, "depth_registered": true})");
  ASSERT_EQ(parsed.status, SPHC_OK) << parsed.message;
  EXPECT_EQ(std::memcmp(&parsed.calibration.color_camera, &parsed.calibration.depth_camera, sizeof(sphc_camera)),
            0);
  EXPECT_EQ(parsed.calibration.color_from_depth.q_wxyz[0], 1);
}

// What has one number of its own is not registered, and is not written so.
TEST(Calibration, OneNumberApartIsNotRegistered) {
  const Parsed registered = parse(R"({"format": "spherecloud-calibration", "version": 1, "pixel_center": 0.5,
    "color_camera": {"model": "pinhole", "width": 640, "height": 480, "params": [525, 526, 320, 240]},
    "depth_unit_m": 0.001, "depth_registered": true})");
  ASSERT_EQ(registered.status, SPHC_OK) << registered.message;
  ASSERT_TRUE(recording::isRegistered(registered.calibration));
  void (*const changes[])(sphc_rig *) = {[](sphc_rig *c) { c->depth_camera.model = SPHC_CAMERA_BROWN5; },
                                         [](sphc_rig *c) { c->depth_camera.width = 320; },
                                         [](sphc_rig *c) { c->depth_camera.height = 240; },
                                         [](sphc_rig *c) { c->depth_camera.params[3] = 241; },
                                         [](sphc_rig *c) { c->color_from_depth.q_wxyz[3] = 1e-9; },
                                         [](sphc_rig *c) { c->color_from_depth.t_m[2] = 1e-9; }};
  for (const auto &change : changes) {
    sphc_rig rig = registered.calibration;
    change(&rig);
    EXPECT_FALSE(recording::isRegistered(rig)) << &change - changes;
  }
}

struct Mistake {
  const char *name;
  const char *from, *to;
  const char *key;   // must stand in the message
  const char *cure;  // likewise
};
void PrintTo(const Mistake &mistake, std::ostream *out) { *out << mistake.name; }  // NOLINT: GoogleTest's name

class CalibrationMistake : public ::testing::TestWithParam<Mistake> {};

TEST_P(CalibrationMistake, IsExplained) {
  const Mistake &mistake = GetParam();
  const Parsed parsed = parse(replaced(kGood, mistake.from, mistake.to));
  EXPECT_EQ(parsed.status, SPHC_E_ARGUMENT);
  EXPECT_THAT(parsed.message, AllOf(HasSubstr("rig.json"), HasSubstr(mistake.key), HasSubstr(mistake.cure)));
  EXPECT_EQ(parsed.calibration.color_camera.width, 0u) << "output touched";
}

INSTANTIATE_TEST_SUITE_P(
    All, CalibrationMistake,
    ::testing::Values(
        Mistake{"NotJson", "\"version\"", "version", "not valid JSON", "line 2"},
        Mistake{"CutShort", "\"depth_unit_m\": 0.001\n}", "", "not valid JSON", "line"},
        Mistake{"Format", "spherecloud-calibration", "other", "format", "must be"},
        Mistake{"Version", "\"version\": 1", "\"version\": 2", "version", "reads 1"},
        Mistake{"NoPixelCenter", "\"pixel_center\": 0.5,", "", "pixel_center", "missing; add it"},
        Mistake{"PixelCenter", "\"pixel_center\": 0.5", "\"pixel_center\": 1", "pixel_center", "OpenCV"},
        Mistake{"UnknownKey", "\"version\": 1", "\"version\": 1, \"depth_unit\": 1", "depth_unit: unknown key",
                "depth_unit_m"},
        Mistake{"UnknownCameraKey", "\"width\": 640", "\"width\": 640, \"fov\": 1", "color_camera.fov",
                "known here: height"},
        Mistake{"KeyTwice", "\"version\": 1", "\"version\": 1, \"version\": 1", "version", "twice"},
        Mistake{"NoCamera", "\"color_camera\"", "\"colour_camera\"", "color_camera", "missing"},
        Mistake{"CameraNoObject",
                "{\"model\": \"pinhole\", \"width\": 320, \"height\": 240, \"params\": [290, 291, 160, 120]}", "[]",
                "depth_camera", "must be an object"},
        Mistake{"Model", "\"pinhole\"", "\"fisheye\"", "color_camera.model", "kannala_brandt4"},
        Mistake{"ModelNumber", "\"pinhole\"", "1", "color_camera.model", "brown5"},
        Mistake{"ParamCount", "[290, 291, 160, 120]", "[290, 291, 160]", "depth_camera.params",
                "has 3 numbers; pinhole takes 4: fx fy cx cy"},
        Mistake{"ParamString", "[290, 291,", "[\"290\", 291,", "depth_camera.params[0]", "must be a number"},
        Mistake{"ParamNan", "[290, 291,", "[NaN, 291,", "not valid JSON", "finite"},
        Mistake{"ParamInfinite", "[290, 291,", "[1e999, 291,", "not valid JSON", "finite"},
        Mistake{"Focal", "[290, 291,", "[290, -291,", "depth_camera.params[1]", "must be positive"},
        Mistake{"WidthNegative", "\"width\": 640", "\"width\": -640", "color_camera.width", "16 to 8192"},
        Mistake{"WidthFraction", "\"width\": 640", "\"width\": 640.5", "color_camera.width", "whole number"},
        Mistake{"HeightTooSmall", "\"height\": 240", "\"height\": 2", "depth_camera.height", "16 to 8192"},
        Mistake{"QuaternionCount", "[0.6, 0, 0.8, 0]", "[1, 0, 0]", "color_from_depth.q_wxyz",
                "must be 4: w x y z"},
        Mistake{"QuaternionLength", "[0.6, 0, 0.8, 0]", "[0.6, 0.1, 0.8, 0.2]", "color_from_depth.q_wxyz",
                "divide by its length"},
        Mistake{"QuaternionZero", "[0.6, 0, 0.8, 0]", "[0, 0, 0, 0]", "color_from_depth.q_wxyz", "must be 1"},
        Mistake{"TranslationCount", "[0.02, -0.005, -0.0125]", "[0.02]", "color_from_depth.t_m", "must be 3"},
        Mistake{"NoTransform", "\"color_from_depth\"", "\"depth_from_color\"", "color_from_depth", "missing"},
        Mistake{"UnitZero", "\"depth_unit_m\": 0.001", "\"depth_unit_m\": 0", "depth_unit_m",
                "0.001 for millimetres"},
        Mistake{"UnitBeyondTheRuntimes", "\"depth_unit_m\": 0.001", "\"depth_unit_m\": 0.2", "depth_unit_m",
                "to 0.1"},
        Mistake{"ParamHuge", "[290, 291,", "[290, 2e6,", "depth_camera.params[1]", "at most 1000000"},
        Mistake{"TranslationFar", "[0.02, -0.005, -0.0125]", "[0.02, -101, 0]", "color_from_depth.t_m",
                "give metres"},
        Mistake{"UnitString", "\"depth_unit_m\": 0.001", "\"depth_unit_m\": \"mm\"", "depth_unit_m",
                "must be a number"},
        Mistake{"Registered", "\"version\": 1", "\"version\": 1, \"depth_registered\": true", "depth_registered",
                "remove them or say false"},
        Mistake{"RegisteredString", "\"version\": 1", "\"version\": 1, \"depth_registered\": \"yes\"",
                "depth_registered", "true or false"}),
    [](const auto &suite) { return suite.param.name; });

// Of lists in lists; to show or to destroy them must not use up the stack.
TEST(Calibration, RefusesWhatIsNestedDeeply) {
  const std::string lists = std::string(200000, '[') + std::string(200000, ']');
  for (const char *from : {"\"pinhole\"", "0.5", "[290, 291, 160, 120]"}) {
    const Parsed parsed = parse(replaced(kGood, from, lists.c_str()));
    EXPECT_EQ(parsed.status, SPHC_E_ARGUMENT);
    EXPECT_THAT(parsed.message, AllOf(HasSubstr("rig.json"), HasSubstr("nested too deeply")));
  }
}

TEST(Calibration, ExplainsAFileThatIsNotThere) {
  const test::TempFolder folder;
  sphc_rig calibration;
  sphc_rig_init(&calibration);
  sphc_message message{};
  EXPECT_EQ(sphc_calibration_read((folder / "rig.json").c_str(), &calibration, &message), SPHC_E_DEVICE);
  EXPECT_THAT(message.text, AllOf(HasSubstr("rig.json"), HasSubstr("no such"), HasSubstr("docs/drivers.md")));
  EXPECT_EQ(sphc_calibration_read(folder.path().c_str(), &calibration, &message), SPHC_E_DEVICE) << "a folder";
  EXPECT_THAT(message.text, HasSubstr("is a folder"));
}

TEST(Calibration, RefusesWhatIsNoRegularFile) {
  const test::TempFolder folder;
  sphc_rig calibration;
  sphc_rig_init(&calibration);
  sphc_message message{};
  ASSERT_EQ(mkfifo((folder / "rig.json").c_str(), 0600), 0);
  EXPECT_EQ(sphc_calibration_read((folder / "rig.json").c_str(), &calibration, &message), SPHC_E_DEVICE);
  EXPECT_THAT(message.text, AllOf(HasSubstr("rig.json"), HasSubstr("is a FIFO")));
  EXPECT_EQ(sphc_calibration_read("/dev/zero", &calibration, &message), SPHC_E_DEVICE);
  EXPECT_THAT(message.text, AllOf(HasSubstr("/dev/zero"), HasSubstr("is a device")));
  folder.write("large.json", std::string((1 << 20) + 1, ' '));
  EXPECT_EQ(sphc_calibration_read((folder / "large.json").c_str(), &calibration, &message), SPHC_E_ARGUMENT);
  EXPECT_THAT(message.text, HasSubstr("over 1 MiB"));
}

TEST(Calibration, ShortensALongPathInMessages) {
  sphc_rig calibration;
  sphc_rig_init(&calibration);
  sphc_message message{};
  const std::string path = std::string(300, 'd') + "/rig.json";
  EXPECT_EQ(sphc_calibration_read(path.c_str(), &calibration, &message), SPHC_E_DEVICE);
  EXPECT_THAT(message.text, AllOf(HasSubstr("/rig.json: no such"), HasSubstr("give its path")));
}

TEST(Calibration, ReadsBackTheSameBits) {
  const test::TempFolder folder;
  const sphc_rig written = tinyCalibration();
  sphc_message message{};
  ASSERT_EQ(sphc_calibration_write((folder / "c.json").c_str(), &written, &message), SPHC_OK) << message.text;
  sphc_rig read;
  sphc_rig_init(&read);
  ASSERT_EQ(sphc_calibration_read((folder / "c.json").c_str(), &read, &message), SPHC_OK) << message.text;
  EXPECT_EQ(std::memcmp(&read, &written, sizeof read), 0);
}

TEST(Calibration, RefusesToWriteWhatItWouldNotRead) {
  const test::TempFolder folder;
  sphc_rig calibration = tinyCalibration();
  calibration.depth_camera.params[8] = std::numeric_limits<double>::quiet_NaN();
  sphc_message message{};
  EXPECT_EQ(sphc_calibration_write((folder / "c.json").c_str(), &calibration, &message), SPHC_E_ARGUMENT);
  EXPECT_THAT(message.text, HasSubstr("depth_camera.params[8] is nan; a parameter must be finite"));
  EXPECT_FALSE(std::filesystem::exists(folder / "c.json"));
  calibration = tinyCalibration();
  EXPECT_EQ(sphc_calibration_write((folder / "no/such/c.json").c_str(), &calibration, &message), SPHC_E_DEVICE);
}

TEST(Calibration, ChecksItsArguments) {
  sphc_rig rig;
  EXPECT_EQ(sphc_calibration_read(nullptr, &rig, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_calibration_read("x", nullptr, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_calibration_parse("{}", 2, "x", nullptr, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_calibration_write("x", nullptr, nullptr), SPHC_E_ARGUMENT);
}

}  // namespace

}  // namespace sphc::contract
