#include "golden.h"
#include "host/cameras/join.h"
#include "tests/support/refusal.h"

namespace sphc::host {
namespace {

CalibrationPart readRigged(const std::string &rigs) {
  const TextFile file = {"rigs.txt", rigs};
  return readColmap({"cameras.txt", kColmapCamerasFile}, &file);
}

TEST(Colmap, ReadsCamerasAndTheirRig) {
  const CalibrationPart part = readRigged(kColmapRigsFile);
  ASSERT_EQ(part.cameras.size(), 2u);
  expectCamera(part.cameras[0].camera, SPHC_CAMERA_BROWN5, 3072, 2304,
               {2559.69, 2559.69, 1536, 1152, -0.0218531, 0, 0, 0, 0});
  expectCamera(part.cameras[1].camera, SPHC_CAMERA_BROWN5, 640, 480,
               {525.5, 524.5, 319.5, 239.5, 0.1, -0.2, 0.001, 0.002, 0});
  expectProjectsAsOpencv(part.cameras[1].camera, {525.5, 524.5, 319, 239}, {0.1, -0.2, 0.001, 0.002});
  expectRigid(*part.cameras[1].camera_from_rig, {0.8, 0.6, 0, 0}, {-0.19, 0.0008, 0.007});
  // sensor_from_rig of camera 2, whose inverse takes depth (2) to colour (1).
  expectRigid(joinParts({part}, {}).color_from_depth, {0.8, -0.6, 0, 0},
              {0.19, -(0.28 * 0.0008 + 0.96 * 0.007), -(-0.96 * 0.0008 + 0.28 * 0.007)});
}

TEST(Colmap, ReadsEachModel) {
  struct Case {
    const char *line;
    sphc_camera_model model;
    std::vector<double> params;
  };
  const Case cases[] = {
      {"1 SIMPLE_PINHOLE 640 480 500 320 240", SPHC_CAMERA_PINHOLE, {500, 500, 320, 240}},
      {"1 PINHOLE 640 480 500 501 320 240", SPHC_CAMERA_PINHOLE, {500, 501, 320, 240}},
      {"1 RADIAL 640 480 500 320 240 0.1 0.2", SPHC_CAMERA_BROWN5, {500, 500, 320, 240, 0.1, 0.2, 0, 0, 0}},
      {"1 OPENCV 640 480 500 501 320 240 1 2 3 4", SPHC_CAMERA_BROWN5, {500, 501, 320, 240, 1, 2, 3, 4, 0}},
      {"1 FULL_OPENCV 640 480 500 501 320 240 1 2 3 4 5 6 7 8",
       SPHC_CAMERA_BROWN8,
       {500, 501, 320, 240, 1, 2, 3, 4, 5, 6, 7, 8}},
      {"1 SIMPLE_RADIAL_FISHEYE 640 480 500 320 240 1",
       SPHC_CAMERA_KANNALA_BRANDT4,
       {500, 500, 320, 240, 1, 0, 0, 0}},
      {"1 RADIAL_FISHEYE 640 480 500 320 240 1 2", SPHC_CAMERA_KANNALA_BRANDT4, {500, 500, 320, 240, 1, 2, 0, 0}},
      {"1 OPENCV_FISHEYE 640 480 500 501 320 240 1 2 3 4",
       SPHC_CAMERA_KANNALA_BRANDT4,
       {500, 501, 320, 240, 1, 2, 3, 4}}};
  for (const Case &c : cases) {
    SCOPED_TRACE(c.line);
    expectCamera(readColmap({"cameras.txt", c.line}, nullptr).cameras.at(0).camera, c.model, 640, 480, c.params);
  }
}

TEST(Colmap, SensorsOfOtherKindsAndWithoutPoseAreSteppedOver) {
  const CalibrationPart part =
      readRigged("2 1 CAMERA 9\n1 4 CAMERA 1 IMU 1 1 1 0 0 0 9 9 9 CAMERA 3 0 CAMERA 2 1 1 0 0 0 1 2 3\n");
  expectRigid(*part.cameras[1].camera_from_rig, {1, 0, 0, 0}, {1, 2, 3});
}

TEST(Colmap, SaysWhatIsWrong) {
  expectRefused(Format::kColmap, kColmapCamerasFile,
                {{"1 SIMPLE_RADIAL", "1 THIN_PRISM_FISHEYE", "line 4", "known here: SIMPLE_PINHOLE"},
                 {"1152 -0.0218531", "1152", "line 4", "has 3 parameters; SIMPLE_RADIAL takes 4"},
                 {"2559.69", "nan", "line 4", "word 5 is 'nan'; must be a finite number"},
                 {"2559.69", "25x", "line 4", "must be a finite number"},
                 {"3072", "99999", "line 4", "from 16 to 8192"},
                 {"2 OPENCV", "1 OPENCV", "line 5", "stands there twice"},
                 {"2 OPENCV 640 480 525.5 524.5 319.5 239.5 0.1 -0.2 0.001 0.002", "2 OPENCV", "line 5",
                  "must be CAMERA_ID MODEL WIDTH HEIGHT PARAMS"}});
  EXPECT_THROW(readColmap({"cameras.txt", "# nothing\n\n"}, nullptr), std::runtime_error);
}

TEST(Colmap, SaysWhatIsWrongWithTheRig) {
  for (const auto &[rig, says] : std::vector<std::pair<const char *, const char *>>{
           {"1 2 CAMERA", "rigs.txt: line 1: must be RIG_ID"},
           {"1 2 CAMERA 1 CAMERA 2", "must be RIG_ID"},
           {"1 2 CAMERA 1 CAMERA 2 1 1 0 0 0 1 2", "must be RIG_ID"},
           {"1 2 CAMERA 1 CAMERA 2 yes", "must be RIG_ID"},
           {"1 2 CAMERA 1 CAMERA 2 1 1 1 0 0 1 2 3", "not of unit length"},
           {"1 2 CAMERA 1 CAMERA 2 1 1 0 0 0 inf 2 3", "must be a finite number"},
           {"1 2 CAMERA 1 CAMERA 1 1 1 0 0 0 1 2 3", "camera '1' stands there twice"}}) {
    EXPECT_THAT(test::refusal([rig = rig] { readRigged(rig); }), testing::HasSubstr(says)) << rig;
  }
}

}  // namespace
}  // namespace sphc::host
