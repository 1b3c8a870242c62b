#include "host/audit/score/truth_view.h"

#include "host/audit/attack/virtual_camera.h"

namespace sphc::host {

std::vector<TruthView> truthsOf(const std::vector<InversionView> &views) {
  std::vector<TruthView> truths;
  for (const InversionView &view : views) truths.push_back(view.truth);
  return truths;
}

TruthView truthView(const RaysOfPixel &rays, const std::function<float(const Vector3 &ray)> &grey_at) {
  const int side = VirtualCamera::kSide;
  TruthView view = {cv::Mat(side, side, CV_32F, cv::Scalar(0)), cv::Mat(side, side, CV_8U, cv::Scalar(0))};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      float sum = 0;
      int met = 0;
      for (int i = 0; i < rays.across * rays.across; ++i) {
        const Vector2 within(i % rays.across + 0.5, i / rays.across + 0.5);
        const float grey = grey_at(VirtualCamera::ray(Vector2(x, y) + within / rays.across));
        if (grey < 0) continue;
        sum += grey;
        ++met;
      }
      if (met < rays.enough) continue;
      view.grey.at<float>(y, x) = sum / static_cast<float>(met);
      view.seen.at<uint8_t>(y, x) = 255;
    }
  }
  return view;
}

}  // namespace sphc::host
