#include "golden.h"

namespace sphc::host {
namespace {

TEST(Ros, ReadsCameraInfo) {
  const CalibrationPart color = readRos({"color.yaml", kRosColorFile}),
                        depth = readRos({"depth.yaml", kRosDepthFile});
  ASSERT_EQ(color.cameras.size(), 1u);
  EXPECT_EQ(color.cameras[0].name, "narrow_stereo");
  expectCamera(color.cameras[0].camera, SPHC_CAMERA_BROWN5, 640, 480,
               {438.783367, 437.302876, 306.093336, 244.238352, -0.361976, 0.110510, 0.001014, 0.000505, 0});
  expectProjectsAsOpencv(color.cameras[0].camera, {438.783367, 437.302876, 305.593336, 243.738352},
                         {-0.361976, 0.110510, 0.001014, 0.000505, 0});
  expectCamera(depth.cameras[0].camera, SPHC_CAMERA_BROWN8, 320, 288,
               {252.1, 252.3, 160.7, 140.9, 0.5, -2.6, 0.0008, -0.0003, 1.49, 0.38, -2.44, 1.42});
  expectProjectsAsOpencv(depth.cameras[0].camera, {252.1, 252.3, 160.2, 140.4},
                         {0.5, -2.6, 0.0008, -0.0003, 1.49, 0.38, -2.44, 1.42});
}

TEST(Ros, EquidistantIsAFisheye) {
  const std::string text =
      changed(changed(kRosColorFile, "plumb_bob", "equidistant"), ", 0.000000]\nrect", "]\nrect");
  const CalibrationPart part = readRos({"f", text});
  expectProjectsAsOpencv(part.cameras[0].camera, {438.783367, 437.302876, 305.593336, 243.738352},
                         {-0.361976, 0.110510, 0.001014, 0.000505});
}

// As in a recording: without the fifth number, which is 0 then, or all of them 0 under whatever name.
TEST(Ros, FourNumbersOrNoneAreEnough) {
  const CalibrationPart four = readRos({"f", changed(kRosColorFile, ", 0.000000]\nrect", "]\nrect")});
  expectCamera(four.cameras[0].camera, SPHC_CAMERA_BROWN5, 640, 480,
               {438.783367, 437.302876, 306.093336, 244.238352, -0.361976, 0.110510, 0.001014, 0.000505, 0});
  const std::string text = changed(changed(kRosColorFile, "plumb_bob", "None"),
                                   "[-0.361976, 0.110510, 0.001014, 0.000505, 0.000000]", "[]");
  EXPECT_EQ(readRos({"f", text}).cameras[0].camera.model, SPHC_CAMERA_PINHOLE);
}

TEST(Ros, SaysWhatIsWrong) {
  expectRefused(
      Format::kRos, kRosColorFile,
      {{"image_width: 640\n", "", "image_width", "missing"},
       {"image_width: 640", "image_width: 9000", "image_width", "is '9000'; must be a whole number"},
       {"image_height: 480", "image_height: -480", "image_height", "from 16 to 8192"},
       {"[438.783367, 0.000000,", "[438.783367, 0.1,", "camera_matrix.data", "skew is not supported"},
       {"[438.783367, ", "[", "camera_matrix.data", "must be 3 x 3"},
       {"plumb_bob", "thin_prism", "distortion_model", "is 'thin_prism' with 5 numbers; plumb_bob (4 or 5)"},
       {"[-0.361976, 0.110510, ", "[", "distortion_model", "is 'plumb_bob' with 3 numbers; plumb_bob (4"},
       {"-0.361976", ".nan", "distortion_coefficients.data", "finite numbers"}});
}

}  // namespace
}  // namespace sphc::host
