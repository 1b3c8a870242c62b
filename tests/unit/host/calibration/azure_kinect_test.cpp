#include <cmath>

#include "golden.h"
#include "host/calibration/compare.h"
#include "host/cameras/azure_kinect.h"
#include "host/cameras/join.h"

namespace sphc::host {
namespace {

TEST(AzureKinect, ReadsRawCalibration) {
  const sphc_rig joined = joinParts({readAzureKinect({"k.json", kAzureKinectFile})}, {});
  expectCamera(joined.depth_camera, SPHC_CAMERA_BROWN8, 1024, 1024,
               {0.4925 * 1024, 0.4926 * 1024, 0.51 * 1024, 0.49 * 1024, 0.5, -2.6, 3.0e-5, -2.5e-5, 1.49, 0.38,
                -2.44, 1.42});
  expectCamera(joined.color_camera, SPHC_CAMERA_BROWN8, 4096, 3072,
               {0.6 * 4096, 0.8 * 3072, 2048, 0.48 * 3072, 0.6, -2.7, -0.0001, -0.0004, 1.6, 0.48, -2.5, 1.5});
  // Rt takes points of the depth camera to the colour camera.
  const double c = std::sqrt(0.9), s = -std::sqrt(0.1);
  expectRigid(joined.color_from_depth, {c, s, 0, 0}, {-0.032, -0.002, 0.004});
}

// The kit's own rule: scale by the binned size, cut, and count from the centre of the first pixel (less 0.5).
TEST(AzureKinect, SizesChooseTheMode) {
  JoinOptions options;
  options.color_size = {1280, 720};
  options.depth_size = {320, 288};
  const sphc_rig joined = joinParts({readAzureKinect({"k.json", kAzureKinectFile})}, options);
  const double color_cx = 0.5 * 1280 - 0.5, color_cy = 0.48 * 960 - 120 - 0.5;
  expectProjectsAsOpencv(joined.color_camera, {0.6 * 1280, 0.8 * 960, color_cx, color_cy},
                         {0.6, -2.7, -0.0001, -0.0004, 1.6, 0.48, -2.5, 1.5});
  const double depth_cx = 0.51 * 512 - 96 - 0.5, depth_cy = 0.49 * 512 - 90 - 0.5;
  expectProjectsAsOpencv(joined.depth_camera, {0.4925 * 512, 0.4926 * 512, depth_cx, depth_cy},
                         {0.5, -2.6, 3.0e-5, -2.5e-5, 1.49, 0.38, -2.44, 1.42});
  EXPECT_EQ(joined.color_camera.height, 720u);
  EXPECT_EQ(joined.depth_camera.width, 320u);
}

TEST(AzureKinect, TakesTheZeroThatTheKitLeavesAtTheEnd) {
  EXPECT_EQ(readAzureKinect({"k.json", std::string(kAzureKinectFile) + '\0'}).cameras.size(), 2u);
}

TEST(AzureKinect, AnotherModelIsTakenOnlyWhenToldSo) {
  const std::string text = changed(kAzureKinectFile, "ModelBrownConrady", "ModelRational6KT");
  const CalibrationPart part = readCalibration(Format::kAzureKinect, {"k.json", text}, nullptr);
  EXPECT_THROW(joinParts({part}, {}), std::runtime_error);
  JoinOptions options;
  options.approximate = true;
  const sphc_rig near = joinParts({part}, options);
  // As the model is defined: p1 = 3e-5, p2 = -2.5e-5, with half of OpenCV's cross terms.
  const double x = 0.4, y = -0.3, r2 = 0.25, p1 = 3.0e-5, p2 = -2.5e-5;
  const double radial = (1 + r2 * (0.5 + r2 * (-2.6 + r2 * 1.49))) / (1 + r2 * (0.38 + r2 * (-2.44 + r2 * 1.42)));
  const double u = 0.51 * 1024 + 0.4925 * 1024 * (x * radial + p2 * (r2 + 2 * x * x) + p1 * x * y);
  const double v = 0.49 * 1024 + 0.4926 * 1024 * (y * radial + p1 * (r2 + 2 * y * y) + p2 * x * y);
  const double point[3] = {x, y, 1};
  double pixel[2];
  ASSERT_EQ(sphc_camera_project(&near.depth_camera, point, pixel), SPHC_OK);
  EXPECT_NEAR(pixel[0], u, 0.01);
  EXPECT_NEAR(pixel[1], v, 0.01);
}

TEST(AzureKinect, WithoutTangentialPartTheOtherModelIsTheSame) {
  std::string text = changed(kAzureKinectFile, "ModelBrownConrady", "ModelRational6KT");
  text = changed(text, "-2.5e-5, 3.0e-5", "0.0, 0.0");
  const sphc_rig joined = joinParts({readAzureKinect({"k.json", text})}, {});
  expectCamera(joined.depth_camera, SPHC_CAMERA_BROWN8, 1024, 1024,
               {0.4925 * 1024, 0.4926 * 1024, 0.51 * 1024, 0.49 * 1024, 0.5, -2.6, 0, 0, 1.49, 0.38, -2.44, 1.42});
}

TEST(AzureKinect, SaysWhatIsWrong) {
  expectRefused(
      Format::kAzureKinect, kAzureKinectFile,
      {{"{\"CalibrationInformation\"", "{{\"CalibrationInformation\"", "the file", "no valid JSON"},
       {"CalibrationInformation", "Calibration", "CalibrationInformation", "missing; is it an Azure Kinect's"},
       {"\"Cameras\": [", "\"Cameras\": 5, \"Other\": [", "Cameras", "must be a list"},
       {"BrownConrady", "Theta", "Cameras[0].Intrinsics.ModelType", "known here"},
       {"[0.51, ", "[", "Cameras[0].Intrinsics.ModelParameters", "has 13 numbers; must be 14"},
       {"[0.51, ", "[\"x\", ", "ModelParameters[0]", "must be a finite number"},
       {"1.42, 0.0", "1.42, 0.1", "ModelParameters", "centre of distortion"},
       {"\"SensorWidth\": 1024", "\"SensorWidth\": 10.5", "Cameras[0].SensorWidth", "from 16 to 8192"},
       {"\"SensorWidth\": 1024", "\"SensorWidth\": \"x\"", "Cameras[0].SensorWidth", "must be a finite number"},
       {"[1, 0, 0, 0, 1, 0, 0, 0, 1]", "[1, 0, 0, 0, 1, 0, 0, 0, 2]", "Cameras[0].Rt", "is no rotation"},
       {"[1, 0, 0, 0, 1, 0, 0, 0, 1]", "[1]", "Cameras[0].Rt", "must be 3 x 3"},
       {"\"Translation\": [0, 0, 0]", "\"Translation\": [0]", "Cameras[0].Rt", "in metres"},
       {"\"Purpose\": \"CALIBRATION_CameraPurposeDepth\"", "\"Purpose\": 5", "Cameras[0].Purpose",
        "word in quotes"}});
}

}  // namespace
}  // namespace sphc::host
