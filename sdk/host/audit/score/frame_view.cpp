#include "host/audit/score/frame_view.h"

#include <cmath>

namespace sphc::host {
namespace {

constexpr RaysOfPixel kFrameRays = {4, 8};

// The grey that a ray meets; negative outside of the image.
float greyAt(const cv::Mat &grey, const Camera &camera, const Vector3 &ray) {
  Vector2 pixel;
  if (!camera.project(ray, &pixel)) return -1;
  const int x = static_cast<int>(std::floor(pixel.x())), y = static_cast<int>(std::floor(pixel.y()));
  return x < 0 || y < 0 || x >= grey.cols || y >= grey.rows ? -1.0f : static_cast<float>(grey.at<uint8_t>(y, x));
}

}  // namespace

TruthView frameView(const cv::Mat &grey, const Camera &camera) {
  return truthView(kFrameRays, [&](const Vector3 &ray) { return greyAt(grey, camera, ray); });
}

}  // namespace sphc::host
