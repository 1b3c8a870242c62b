// What a virtual camera would truly have seen, where that is known.
#pragma once
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "runtime/geometry/rotation.h"

namespace sphc::host {

struct TruthView {
  cv::Mat grey;  // VirtualCamera's side, CV_32F, 0 to 255
  cv::Mat seen;  // CV_8U: 255 where the truth is known
  double seenShare() const {
    return static_cast<double>(cv::countNonZero(seen)) / static_cast<double>(seen.total());
  }
};

// What the camera sees from the map's centre, turned like this.
struct InversionView {
  Matrix3 camera_from_map;
  TruthView truth;
};
std::vector<TruthView> truthsOf(const std::vector<InversionView> &views);

struct RaysOfPixel {
  int across;  // and down
  int enough;  // that must meet something, else the pixel is unknown
};

// `grey_at` gives the grey that a ray in the camera's axes meets; negative where it meets nothing that is known.
TruthView truthView(const RaysOfPixel &rays, const std::function<float(const Vector3 &ray)> &grey_at);

}  // namespace sphc::host
