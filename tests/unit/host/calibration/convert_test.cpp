// Every format written and read again, and files that are none.
#include "host/calibration/convert.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "golden.h"
#include "host/calibration/compare.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

const sphc_camera kCameras[] = {
    {SPHC_CAMERA_PINHOLE, 640, 480, 4, {525.5, 524.25, 320.125, 238}},
    {SPHC_CAMERA_BROWN5, 752, 480, 9, {461.629, 460.152, 363.18, 246.549, -0.277, 0.067, 0.00087, 0.00011, 0}},
    {SPHC_CAMERA_BROWN5, 640, 480, 9, {517.3, 516.5, 318.6, 255.3, 0.26, -0.95, -0.005, 0.003, 1.16}},
    {SPHC_CAMERA_BROWN8, 1280, 720, 12, {614, 613, 639, 366, 0.5, -2.6, 0.0008, -0.0003, 1.49, 0.38, -2.44, 1.42}},
    {SPHC_CAMERA_KANNALA_BRANDT4, 320, 288, 8, {160.1, 160.2, 161.3, 144.7, 0.05, -0.02, 0.004, -0.0005}}};

sphc_rig calibrationOf(const sphc_camera &color, const sphc_camera &depth) {
  sphc_rig c;
  sphc_rig_init(&c);
  c.color_camera = color;
  c.depth_camera = depth;
  const double q[4] = {0.96, 0.08, -0.24, 0.12};
  for (int i = 0; i < 4; ++i) c.color_from_depth.q_wxyz[i] = q[i];
  c.color_from_depth.t_m[0] = -0.032;
  c.color_from_depth.t_m[1] = 1.0 / 300;
  return c;
}

sphc_rig writtenAndRead(Format format, const sphc_rig &calibration) {
  const test::TempFolder folder;
  std::vector<std::string> paths;
  for (const TextFile &file : writeCalibration(format, calibration))
    paths.push_back(folder.write(file.name.empty() ? "file" : file.name, file.text));
  if (format == Format::kColmap) paths.pop_back();
  JoinOptions options;
  options.depth_unit_m = calibration.depth_unit_m;
  const ReadCalibration read = readCalibrationFiles(paths, {}, options);  // each format tells itself
  EXPECT_EQ(read.files[0].format, format);
  return read.calibration;
}

class RoundTrip : public testing::TestWithParam<size_t> {};

TEST_P(RoundTrip, IsExactForWhatTheFormatHolds) {
  const Format format = formatNames()[GetParam()].format;
  int held = 0;
  for (const sphc_camera &color : kCameras) {
    for (const sphc_camera &depth : kCameras) {
      if (!formatHolds(format, color) || !formatHolds(format, depth)) continue;
      ++held;
      const sphc_rig calibration = calibrationOf(color, depth);
      const CalibrationDifference difference =
          compareCalibrations(calibration, writtenAndRead(format, calibration));
      EXPECT_LT(difference.largestPx(), 1e-6) << color.model << " " << depth.model;
      EXPECT_EQ(difference.lost(), 0u);
      EXPECT_GT(difference.color.samples, 0u);
      EXPECT_GT(difference.depth_to_color[2].samples, 0u);
    }
  }
  EXPECT_EQ(held, format == Format::kKalibr ? 9 : format == Format::kAzureKinect ? 16 : 25);
}

INSTANTIATE_TEST_SUITE_P(Each, RoundTrip, testing::Range<size_t>(0, 6), [](const auto &test) {
  std::string name = formatNames()[test.param].name;
  name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
  return name;
});

TEST(Fit, RefusesWhatTheFormatCannotHoldUnlessToldSo) {
  const sphc_rig calibration = calibrationOf(kCameras[3], kCameras[4]);
  for (const Format format : {Format::kKalibr, Format::kAzureKinect}) {
    EXPECT_THAT(test::refusal([&] { fitToFormat(calibration, format, false); }),
                testing::HasSubstr("--approximate"));
    const sphc_rig fitted = fitToFormat(calibration, format, true);
    const CalibrationDifference difference = compareCalibrations(calibration, fitted);
    EXPECT_LT(difference.color.largest_px, 10);  // of a lens that bends as strongly as an Azure Kinect's
    EXPECT_LT(difference.depth.largest_px, 1);
    EXPECT_EQ(difference.lost(), 0u);
    EXPECT_GT(difference.largestPx(), 1e-6);
    EXPECT_LT(compareCalibrations(fitted, writtenAndRead(format, fitted)).largestPx(), 1e-6);
  }
}

TEST(ReadFiles, ColmapFindsItsRigsBesideTheCameras) {
  const test::TempFolder folder;
  const std::string cameras = folder.write("cameras.txt", kColmapCamerasFile);
  folder.write("rigs.txt", kColmapRigsFile);
  const std::string parent = std::filesystem::path(cameras).parent_path().string();
  EXPECT_EQ(readCalibrationFiles({parent}, {}, {}).files[0].path, parent + "/cameras.txt");
  EXPECT_EQ(readCalibrationFiles({cameras}, {}, {}).calibration.color_camera.width, 3072u);
}

TEST(ReadFiles, FormatsTellThemselves) {
  EXPECT_EQ(detectFormat({"f", kKalibrFile}), Format::kKalibr);
  EXPECT_EQ(detectFormat({"f", kRosColorFile}), Format::kRos);
  EXPECT_EQ(detectFormat({"f", std::string("# of cam0\n") + kRosColorFile}), Format::kRos);
  EXPECT_EQ(detectFormat({"f", kOpencvSampleFile}), Format::kOpencv);
  EXPECT_EQ(detectFormat({"f", kAzureKinectFile}), Format::kAzureKinect);
  EXPECT_EQ(detectFormat({"a/cameras.txt", kColmapCamerasFile}), Format::kColmap);
  EXPECT_THROW(detectFormat({"f", kColmapCamerasFile}), std::runtime_error);
}

TEST(ReadFiles, MayBeginWithAByteOrderMark) {
  const test::TempFolder folder;
  const std::string mark = "\xEF\xBB\xBF";
  const std::string cameras = folder.write("cameras.txt", mark + kColmapCamerasFile);
  folder.write("rigs.txt", mark + kColmapRigsFile);
  EXPECT_EQ(readCalibrationFiles({cameras}, {}, {}).calibration.color_camera.width, 3072u);
  const sphc_rig rig = calibrationOf(kCameras[0], kCameras[1]);
  const std::string own = folder.write("own.json", mark + writeCalibration(Format::kSpherecloud, rig)[0].text);
  EXPECT_EQ(readCalibrationFiles({own}, {}, {}).files[0].format, Format::kSpherecloud);
}

TEST(ReadFiles, AFolderOfTwoFormatsIsReadAsTheOneThatIsSaid) {
  const test::TempFolder folder;
  const sphc_rig ros = calibrationOf(kCameras[0], kCameras[1]);
  for (const TextFile &file : writeCalibration(Format::kRos, ros)) folder.write(file.name, file.text);
  folder.write("cameras.txt", kColmapCamerasFile);
  folder.write("rigs.txt", kColmapRigsFile);
  const std::string path = folder.path().string();
  EXPECT_THAT(test::refusal([&] { readCalibrationFiles({path}, {}, {}); }),
              testing::AllOf(testing::HasSubstr(path + ": holds both color.yaml of ROS and cameras.txt"),
                             testing::HasSubstr("--format ros or --format colmap")));
  EXPECT_EQ(readCalibrationFiles({path}, Format::kColmap, {}).calibration.color_camera.width, 3072u);
  EXPECT_EQ(readCalibrationFiles({path}, Format::kRos, {}).calibration.color_camera.width, ros.color_camera.width);
}

TEST(ReadFiles, SaysWhichFileIsWrong) {
  const test::TempFolder folder;
  const auto refusal = [](const std::string &path) {
    return test::refusal([&] { readCalibrationFiles({path}, {}, {}); });
  };
  using testing::HasSubstr;
  EXPECT_THAT(refusal("/nonexistent/file"), HasSubstr("/nonexistent/file: no such file"));
  EXPECT_THAT(refusal(folder.write("big", std::string(300000, ' '))), HasSubstr("over 256 KiB"));
  EXPECT_THAT(refusal(folder.write("wide.json", std::string("\xFF\xFE{\0", 4))),
              HasSubstr("UTF-16; save it as UTF-8"));
  EXPECT_THAT(refusal(folder.write("empty", "")), HasSubstr("say it with --format"));
  EXPECT_THAT(refusal(folder.write("own.json", "{\"format\": \"spherecloud-calibration\"}")),
              HasSubstr("own.json: version"));
  EXPECT_THAT(refusal(folder.write("chain.yaml", changed(kKalibrFile, "intrinsics: [", "intrinsics: [-"))),
              HasSubstr("chain.yaml: color_camera.params[0] is -"));
}

}  // namespace
}  // namespace sphc::host
