#include "golden.h"
#include "host/cameras/join.h"

namespace sphc::host {
namespace {

TEST(Kalibr, ReadsAChain) {
  const CalibrationPart part = readKalibr({"camchain.yaml", kKalibrFile});
  ASSERT_EQ(part.cameras.size(), 2u);
  EXPECT_EQ(part.cameras[1].name, "cam1");
  expectCamera(part.cameras[0].camera, SPHC_CAMERA_BROWN5, 752, 480,
               {461.629, 460.152, 363.180, 246.549, -0.27695497, 0.06712482, 0.00087538, 0.00011556, 0});
  expectCamera(part.cameras[1].camera, SPHC_CAMERA_KANNALA_BRANDT4, 640, 480,
               {458.655, 457.296, 367.715, 248.875, -0.01353, 0.05274, -0.04979, 0.01355});
  expectProjectsAsOpencv(part.cameras[0].camera, {461.629, 460.152, 362.680, 246.049},
                         {-0.27695497, 0.06712482, 0.00087538, 0.00011556});
  expectProjectsAsOpencv(part.cameras[1].camera, {458.655, 457.296, 367.215, 248.375},
                         {-0.01353, 0.05274, -0.04979, 0.01355});
}

TEST(Kalibr, TheTransformTakesPointsOfTheCameraBefore) {
  const sphc_rig joined = joinParts({readKalibr({"camchain.yaml", kKalibrFile})}, {});
  // x_1 = R x_0 + t, so x_0 = R^T (x_1 - t): colour is cam0.
  const double s = std::sqrt(0.5);
  expectRigid(joined.color_from_depth, {s, 0, 0, -s}, {-0.02, -0.11, -0.003});
}

TEST(Kalibr, TransformsOfAChainMultiply) {
  const std::string third =
      changed(std::string(kKalibrFile).substr(std::string(kKalibrFile).find("cam1")), "cam1", "cam2");
  const CalibrationPart part = readKalibr({"camchain.yaml", kKalibrFile + third});
  ASSERT_EQ(part.cameras.size(), 3u);
  // A quarter turn about z twice: t = R (-0.11, 0.02, 0.003) + (-0.11, 0.02, 0.003).
  expectRigid(*part.cameras[2].camera_from_rig, {0, 0, 0, 1}, {-0.13, -0.09, 0.006});
}

TEST(Kalibr, NoDistortionIsAPinhole) {
  const std::string text = changed(changed(kKalibrFile, "radtan", "none"), "distortion_coeffs", "unused");
  EXPECT_EQ(readKalibr({"f", text}).cameras[0].camera.model, SPHC_CAMERA_PINHOLE);
}

TEST(Kalibr, SaysWhatIsWrong) {
  expectRefused(
      Format::kKalibr, kKalibrFile,
      {{"cam0", "cam7", "cam0", "missing"},
       {"camera_model: pinhole", "camera_model: omni", "cam0.camera_model", "is 'omni'; known here: pinhole"},
       {"  camera_model: pinhole\n", "", "cam0.camera_model", "missing; add it"},
       {"camera_model: pinhole", "camera_model: [pinhole]", "cam0.camera_model", "must be a word"},
       {"461.629,", "", "cam0.intrinsics", "has 3 numbers"},
       {"461.629", "wide", "cam0.intrinsics", "finite numbers"},
       {"461.629", ".inf", "cam0.intrinsics", "finite numbers"},
       {"[752, 480]", "[752, 4.8]", "cam0.resolution", "from 16 to 8192"},
       {"[752, 480]", "[752]", "cam0.resolution", "[width, height]"},
       {"radtan", "fov", "cam0.distortion_model", "is 'fov'; known here"},
       {"[-0.27695497, ", "[", "cam0.distortion_coeffs", "has 3 numbers; radtan takes 4"},
       {"T_cn_cnm1", "T_cam_imu", "cam1.T_cn_cnm1", "missing"},
       {"[0.0, -1.0, 0.0, -0.11]", "[0.0, -2.0, 0.0, -0.11]", "cam1.T_cn_cnm1", "is no rotation"},
       {"[0.0, 0.0, 0.0, 1.0]", "[0.0, 0.0, 1.0, 1.0]", "cam1.T_cn_cnm1", "the last 0 0 0 1"},
       {"  rostopic", "  camera_model: pinhole\n  rostopic", "cam0.'camera_model'", "given twice"},
       {"cam1:", "cam1: 5\nrest:", "cam1", "must be keys with values"},
       {"cam1:\n", "cam1: [\n", "line", "no valid YAML"}});
}

}  // namespace
}  // namespace sphc::host
