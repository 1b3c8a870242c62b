#include "tests/unit/host/audit/score/truth_picture.h"

#include <opencv2/imgproc.hpp>

#include "host/audit/attack/virtual_camera.h"
#include "runtime/base/random.h"

namespace sphc::host {

TruthView truthPicture(uint64_t seed) {
  constexpr int kSide = VirtualCamera::kSide;
  Random random(seed);
  TruthView view = {cv::Mat(kSide, kSide, CV_32F, cv::Scalar(100)), cv::Mat(kSide, kSide, CV_8U, cv::Scalar(255))};
  const auto below = [&random](uint32_t bound) { return static_cast<int>(random.below(bound)); };
  for (int i = 0; i < 40; ++i) {
    const cv::Rect rectangle(below(kSide), below(kSide), 6 + below(30), 6 + below(30));
    cv::rectangle(view.grey, rectangle, cv::Scalar(below(256)), cv::FILLED);
  }
  const cv::Rect unknown(below(90), below(90), 20, 20);
  view.grey(unknown) = 0;
  view.seen(unknown) = 0;
  return view;
}

}  // namespace sphc::host
