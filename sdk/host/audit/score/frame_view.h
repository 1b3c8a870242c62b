// A frame of a recording as the virtual camera at its place would see it.
#pragma once
#include "host/audit/score/truth_view.h"
#include "runtime/geometry/camera.h"

namespace sphc::host {

// `grey` is the camera's image, CV_8U.
TruthView frameView(const cv::Mat &grey, const Camera &camera);

}  // namespace sphc::host
