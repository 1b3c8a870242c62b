#include "host/calibration/nearest_camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sphc::host {
namespace {

const sphc_camera kBrown8 = {
    SPHC_CAMERA_BROWN8, 1280, 720, 12, {614, 613, 639, 366, 0.5, -2.6, 0.0008, -0.0003, 1.49, 0.38, -2.44, 1.42}};
const sphc_camera kFisheye = {
    SPHC_CAMERA_KANNALA_BRANDT4, 640, 480, 8, {290, 291, 322, 238, 0.05, -0.02, 0.004, -0.0005}};

TEST(NearestCamera, FindsTheOneThatFitsExactly) {
  sphc_camera start = kFisheye;
  start.params[0] += 20;
  start.params[4] = 0;
  const NearestCamera found = nearestCamera(sampleCamera(kFisheye), {SPHC_CAMERA_KANNALA_BRANDT4, 8}, start);
  EXPECT_LT(found.largest_px, 1e-6);
  EXPECT_NEAR(found.camera.params[0], 290, 1e-4);
}

double squares(const std::vector<RaySample> &samples, const sphc_camera &camera) {
  double sum = 0;
  for (const RaySample &sample : samples) {
    const double point[3] = {sample.ray.x(), sample.ray.y(), 1};
    double pixel[2];
    if (sphc_camera_project(&camera, point, pixel) != SPHC_OK) return HUGE_VAL;
    sum += (Vector2(pixel[0], pixel[1]) - sample.pixel_px).squaredNorm();
  }
  return sum;
}

TEST(NearestCamera, NoNeighbourIsNearer) {
  const std::vector<RaySample> samples = sampleCamera(kBrown8);
  ASSERT_EQ(samples.size(), 33u * 25u);
  const NearestCamera found = nearestCamera(samples, {SPHC_CAMERA_BROWN5, 8}, kBrown8);
  EXPECT_EQ(found.camera.params[8], 0);  // stays as Kalibr's radtan has it
  const double least = squares(samples, found.camera);
  EXPECT_NEAR(std::sqrt(least / 825), found.rms_px, 1e-9);
  EXPECT_GT(found.largest_px, found.rms_px);
  for (int i = 0; i < 8; ++i) {
    for (const double step : {-1e-3, 1e-3}) {
      sphc_camera neighbour = found.camera;
      neighbour.params[i] += step * std::max(1.0, std::fabs(neighbour.params[i]));
      EXPECT_GT(squares(samples, neighbour), least) << i;
    }
  }
}

TEST(NearestCamera, BridgesFisheyeAndRational) {
  const NearestCamera found = nearestCamera(sampleCamera(kFisheye), {SPHC_CAMERA_BROWN8, 12}, kFisheye);
  EXPECT_LT(found.largest_px, 0.5);
}

}  // namespace
}  // namespace sphc::host
