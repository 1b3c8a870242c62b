#include "host/audit/score/frame_view.h"

#include <gtest/gtest.h>

#include "host/audit/attack/virtual_camera.h"

namespace sphc::host {
namespace {

// A ramp of grey: each column of a pinhole camera its number.
cv::Mat ramp() {
  cv::Mat image(120, 160, CV_8U);
  for (int x = 0; x < image.cols; ++x) image.col(x) = x;
  return image;
}

TEST(FrameView, RaysKeepTheirGrey) {
  const Camera camera({SPHC_CAMERA_PINHOLE, 160, 120, 4, {140, 140, 70, 60}});
  const TruthView view = frameView(ramp(), camera);
  EXPECT_NEAR(view.seenShare(), 120 / 140.0 * VirtualCamera::kFocalPx / 128, 0.02);  // its field is lower than ours
  for (int x : {20, 64, 100}) {
    const double ray = VirtualCamera::ray(Vector2(x + 0.5, 64)).x();
    EXPECT_NEAR(static_cast<double>(view.grey.at<float>(64, x)), 140 * ray + 70 - 0.5, 0.5);
  }
}

TEST(FrameView, BeyondTheImageIsUnknown) {
  const Camera camera({SPHC_CAMERA_PINHOLE, 160, 120, 4, {1000, 1000, 80, 60}});
  const TruthView view = frameView(ramp(), camera);
  EXPECT_EQ(view.seen.at<uint8_t>(64, 10), 0);
  EXPECT_EQ(view.seen.at<uint8_t>(64, 64), 255);
}

}  // namespace
}  // namespace sphc::host
