// OpenCV counts pixels from the centre of the first one: principal points differ by half a pixel.
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <vector>

#include "runtime/geometry/camera.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

std::vector<cv::Point2d> projectByOpenCv(const sphc_camera &camera, const std::vector<cv::Point3d> &points) {
  const double *p = camera.params;
  const cv::Matx33d k(p[0], 0, p[2] - 0.5, 0, p[1], p[3] - 0.5, 0, 0, 1);
  const std::vector<double> distortion(p + 4, p + camera.param_count);
  const cv::Vec3d zero(0, 0, 0);
  std::vector<cv::Point2d> pixels;
  if (camera.model == SPHC_CAMERA_KANNALA_BRANDT4)
    cv::fisheye::projectPoints(points, pixels, zero, zero, k, distortion);
  else
    cv::projectPoints(points, zero, zero, k, distortion, pixels);
  return pixels;
}

void compare(const sphc_camera &camera, double widest) {
  Random random(3);
  std::vector<cv::Point3d> points;
  for (int i = 0; i < 2000; ++i) {
    const double z = test::uniformIn(&random, 0.2, 5);
    const double x = test::uniformIn(&random, -widest, widest), y = test::uniformIn(&random, -widest, widest);
    points.emplace_back(x * z, y * z, z);
  }
  const std::vector<cv::Point2d> pixels = projectByOpenCv(camera, points);
  const Camera ours(camera);
  for (size_t i = 0; i < points.size(); ++i) {
    Vector2 pixel;
    ASSERT_TRUE(ours.project({points[i].x, points[i].y, points[i].z}, &pixel));
    EXPECT_NEAR(pixel.x(), pixels[i].x + 0.5, 1e-9);
    EXPECT_NEAR(pixel.y(), pixels[i].y + 0.5, 1e-9);
  }
}

TEST(CameraOpenCv, Pinhole) { compare({SPHC_CAMERA_PINHOLE, 640, 480, 4, {525, 520, 320.5, 238}}, 2); }
TEST(CameraOpenCv, Brown5) {
  compare({SPHC_CAMERA_BROWN5, 640, 480, 9, {517, 516, 318, 255, 0.26, -0.95, -0.005, 0.003, 1.16}}, 0.5);
}
TEST(CameraOpenCv, Brown8) {
  compare({SPHC_CAMERA_BROWN8,
           1280,
           720,
           12,
           {614, 613, 639, 366, 0.5, -2.6, 0.0008, -0.0003, 1.49, 0.38, -2.44, 1.42}},
          0.7);
}
TEST(CameraOpenCv, KannalaBrandt4) {
  compare({SPHC_CAMERA_KANNALA_BRANDT4, 640, 480, 8, {190, 190, 320, 240, 0.1, -0.05, 0.01, -0.001}}, 1.5);
}

}  // namespace
}  // namespace sphc
