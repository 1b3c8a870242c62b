#include "golden.h"

#include <gmock/gmock.h>

#include <opencv2/calib3d.hpp>

namespace sphc::host {

std::string changed(const std::string &text, const std::string &what, const std::string &by) {
  const size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.substr(0, at) + by + text.substr(at + what.size());
}

void expectRefused(Format format, const std::string &good, const std::vector<BadFile> &bad) {
  for (const BadFile &file : bad) {
    SCOPED_TRACE(std::string(file.what) + " -> " + file.by);
    try {
      readCalibration(format, {"some.file", changed(good, file.what, file.by)}, nullptr);
      ADD_FAILURE() << "was not refused";
    } catch (const std::runtime_error &error) {
      EXPECT_THAT(error.what(), testing::StartsWith("some.file: "));
      EXPECT_THAT(error.what(), testing::HasSubstr(file.key));
      EXPECT_THAT(error.what(), testing::HasSubstr(file.says));
    }
  }
}

void expectCamera(const sphc_camera &camera, sphc_camera_model model, uint32_t width, uint32_t height,
                  const std::vector<double> &params) {
  EXPECT_EQ(camera.model, model);
  EXPECT_EQ(camera.width, width);
  EXPECT_EQ(camera.height, height);
  ASSERT_EQ(camera.param_count, params.size());
  for (size_t i = 0; i < params.size(); ++i) EXPECT_NEAR(camera.params[i], params[i], 1e-10) << i;
}

void expectRigid(const sphc_rigid &rigid, const std::array<double, 4> &q_wxyz, const std::array<double, 3> &t_m) {
  for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(rigid.q_wxyz[i], q_wxyz[i], 1e-12) << i;
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(rigid.t_m[i], t_m[i], 1e-12) << i;
}

void expectProjectsAsOpencv(const sphc_camera &camera, const std::array<double, 4> &fx_fy_cx_cy,
                            const std::vector<double> &coefficients) {
  const auto [fx, fy, cx, cy] = fx_fy_cx_cy;
  const cv::Matx33d k(fx, 0, cx, 0, fy, cy, 0, 0, 1);
  std::vector<cv::Point3d> points;
  for (double y = -0.3; y <= 0.3; y += 0.1)
    for (double x = -0.3; x <= 0.3; x += 0.1) points.emplace_back(2 * x, 2 * y, 2);
  std::vector<cv::Point2d> pixels;
  const cv::Vec3d zero(0, 0, 0);
  if (camera.model == SPHC_CAMERA_KANNALA_BRANDT4)
    cv::fisheye::projectPoints(points, pixels, zero, zero, k, coefficients);
  else
    cv::projectPoints(points, zero, zero, k, coefficients, pixels);
  for (size_t i = 0; i < points.size(); ++i) {
    const double point[3] = {points[i].x, points[i].y, points[i].z};
    double pixel[2];
    ASSERT_EQ(sphc_camera_project(&camera, point, pixel), SPHC_OK);
    EXPECT_NEAR(pixel[0], pixels[i].x + 0.5, 1e-9);
    EXPECT_NEAR(pixel[1], pixels[i].y + 0.5, 1e-9);
  }
}

}  // namespace sphc::host
