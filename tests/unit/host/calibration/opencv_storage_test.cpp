#include <opencv2/core.hpp>

#include "golden.h"
#include "host/cameras/join.h"

namespace sphc::host {
namespace {

TEST(OpencvStorage, ReadsTheCalibrationSample) {
  const CalibrationPart part = readOpencv({"out_camera_data.yml", kOpencvSampleFile});
  ASSERT_EQ(part.cameras.size(), 1u);
  expectCamera(
      part.cameras[0].camera, SPHC_CAMERA_BROWN5, 640, 480,
      {535.91573396163199, 535.91573396163199, 342.78315473308373, 236.07082909788173, -0.26637260909660682,
       -0.038588898922304653, 0.0017831947042852964, -0.00028122100441115472, 0.23839153080878486});
  EXPECT_FALSE(part.second_from_first);
}

TEST(OpencvStorage, ReadsTheStereoSample) {
  const CalibrationPart part = readOpencv({"stereo.yml", kOpencvStereoFile});
  ASSERT_EQ(part.cameras.size(), 2u);
  expectCamera(part.cameras[0].camera, SPHC_CAMERA_BROWN8, 640, 480,
               {534, 533, 342, 234.75, -0.29, 0.1, 0.001, -0.002, 0.01, 0.03, 0.02, 0.01});
  expectCamera(part.cameras[1].camera, SPHC_CAMERA_PINHOLE, 640, 480, {532, 531, 327.75, 250.25});
  const double s = std::sqrt(0.5);
  expectRigid(*part.second_from_first, {s, s, 0, 0}, {-0.25, 0.5, 0.125});
  // Colour is camera 1: x_1 = R^T (x_2 - T).
  expectRigid(joinParts({part}, {}).color_from_depth, {s, -s, 0, 0}, {0.25, -0.125, 0.5});
}

TEST(OpencvStorage, IntrinsicsAndExtrinsicsMayBeTwoFiles) {
  const std::string all = kOpencvStereoFile;
  const size_t split = all.find("R: ");
  const CalibrationPart in = readOpencv({"intrinsics.yml", all.substr(0, split)});
  const CalibrationPart out = readOpencv({"extrinsics.yml", "%YAML:1.0\n---\n" + all.substr(split)});
  EXPECT_TRUE(out.cameras.empty());
  const double s = std::sqrt(0.5);
  expectRigid(joinParts({in, out}, {}).color_from_depth, {s, -s, 0, 0}, {0.25, -0.125, 0.5});
}

class PeerFormat : public testing::TestWithParam<const char *> {};

// What OpenCV itself writes.
TEST_P(PeerFormat, IsRead) {
  const cv::Mat k = (cv::Mat_<double>(3, 3) << 525, 0, 319.5, 0, 526, 239.5, 0, 0, 1);
  const cv::Mat d = (cv::Mat_<double>(1, 4) << 0.1, -0.05, 0.01, -0.001);
  cv::FileStorage storage(GetParam(), cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  storage << "image_width" << 640 << "image_height" << 480 << "fisheye_model" << 1 << "camera_matrix" << k
          << "distortion_coefficients" << d;
  const CalibrationPart part = readOpencv({"f", storage.releaseAndGetString()});
  expectCamera(part.cameras.at(0).camera, SPHC_CAMERA_KANNALA_BRANDT4, 640, 480,
               {525, 526, 320, 240, 0.1, -0.05, 0.01, -0.001});
  expectProjectsAsOpencv(part.cameras[0].camera, {525, 526, 319.5, 239.5}, {0.1, -0.05, 0.01, -0.001});
}
INSTANTIATE_TEST_SUITE_P(Each, PeerFormat, testing::Values("x.yml", "x.json", "x.xml"));

TEST(OpencvStorage, OpencvReadsWhatWeWrite) {
  const sphc_rig joined = joinParts({readOpencv({"stereo.yml", kOpencvStereoFile})}, {});
  const cv::FileStorage storage(opencvText(joined), cv::FileStorage::READ | cv::FileStorage::MEMORY);
  cv::Mat m1, d2, r, t;
  storage["M1"] >> m1;
  storage["D2"] >> d2;
  storage["R"] >> r;
  storage["T"] >> t;
  ASSERT_EQ(m1.size(), cv::Size(3, 3));
  EXPECT_EQ(m1.at<double>(0, 2), 341.5);
  EXPECT_EQ(d2.total(), 5u);
  EXPECT_NEAR(r.at<double>(1, 2), -1, 1e-15);
  EXPECT_NEAR(t.at<double>(1, 0), 0.5, 1e-15);
}

// OpenCV's own parser calls itself for each level, down to the end of the stack.
TEST(OpencvStorage, RefusesWhatIsNestedDeeply) {
  const auto repeated = [](const std::string &word) {
    std::string all;
    while (all.size() < 240000) all += word;
    return all;
  };
  const std::string yaml = "%YAML:1.0\n---\n";
  for (const std::string &text :
       {"{\"camera_matrix\": " + repeated("["), yaml + "camera_matrix: " + repeated("{a: "),
        yaml + "camera_matrix:\n  " + repeated("- "), yaml + repeated("a:"), yaml + "a:\n  " + repeated("-"),
        "<?xml version=\"1.0\"?>\n<opencv_storage>" + repeated("<a>")})
    expectRefused(Format::kOpencv, "all", {{"all", text.c_str(), "the file", "nested too deeply"}});
}

TEST(OpencvStorage, SaysWhatIsWrong) {
  expectRefused(Format::kOpencv, kOpencvStereoFile,
                {{"%YAML:1.0", "# YAML", "the file", "no valid OpenCV FileStorage"},
                 {"M1: !!opencv-matrix", "M1: !!opencv-matrix [", "the file", "no valid OpenCV FileStorage"},
                 {"image_width: 640", "image_width: 640\nimage_width: 641", "image_width", "given twice"},
                 {"image_width: 640", "image_width: 6.5", "image_width", "from 16 to 8192"},
                 {"image_width: 640", "image_width: wide", "image_width", "from 16 to 8192"},
                 {"image_width: 640", "fisheye_model: yes\nimage_width: 640", "fisheye_model", "must be 0 or 1"},
                 {"rows: 3", "rows: 300000", "M1", "not rows x cols"},
                 {"data: [ 534.,", "data: [ wide,", "M1", "no number"},
                 {"data: [ 534.,", "data: [ .Inf,", "M1", "not finite"},
                 {"data: [ 534., 0.,", "data: [ 534., 0.5,", "M1", "skew is not supported"},
                 {"D1: !!opencv-matrix", "E1: !!opencv-matrix", "D1", "missing"},
                 {"0., 0. ]\nM2", "0., 0.5 ]\nM2", "D1", "tilt part"},
                 {"cols: 4\n   dt: d\n   data: [ 0.,", "cols: 3\n   dt: d\n   data: [", "D2", "has 3 numbers"},
                 {"[ 1., 0., 0., 0., 0., -1., 0., 1., 0. ]", "[ 1., 0., 0., 0., 1., 0., 0., 0., -1. ]", "R, T",
                  "is no rotation"},
                 {"T: !!", "Translation: !!", "T", "missing"}});
  expectRefused(Format::kOpencv, kOpencvSampleFile, {{"camera_matrix", "matrix", "camera_matrix", "missing"}});
}

}  // namespace
}  // namespace sphc::host
