#include "host/audit/score/frame_view.h"

#include <cmath>

#include "host/audit/attack/virtual_camera.h"

namespace sphc::host {
namespace {

constexpr int kSubsamples = 4;  // rays a pixel, both ways

// The grey that a ray meets; negative outside of the image.
float greyAt(const cv::Mat &grey, const Camera &camera, const Vector3 &ray) {
  Vector2 pixel;
  if (!camera.project(ray, &pixel)) return -1;
  const int x = static_cast<int>(std::floor(pixel.x())), y = static_cast<int>(std::floor(pixel.y()));
  return x < 0 || y < 0 || x >= grey.cols || y >= grey.rows ? -1.0f : static_cast<float>(grey.at<uint8_t>(y, x));
}

}  // namespace

TruthView frameView(const cv::Mat &grey, const Camera &camera) {
  const int side = VirtualCamera::kSide;
  TruthView view = {cv::Mat(side, side, CV_32F, cv::Scalar(0)), cv::Mat(side, side, CV_8U, cv::Scalar(0))};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      float sum = 0;
      int met = 0;
      for (int i = 0; i < kSubsamples * kSubsamples; ++i) {
        const Vector2 within(i % kSubsamples + 0.5, i / kSubsamples + 0.5);
        const float found = greyAt(grey, camera, VirtualCamera::ray(Vector2(x, y) + within / kSubsamples));
        if (found < 0) continue;
        sum += found;
        ++met;
      }
      if (2 * met < kSubsamples * kSubsamples) continue;
      view.grey.at<float>(y, x) = sum / static_cast<float>(met);
      view.seen.at<uint8_t>(y, x) = 255;
    }
  }
  return view;
}

}  // namespace sphc::host
