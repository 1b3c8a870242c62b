// Pictures of single frames: what the localizer saw in the image and what became of it.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "host/report/run.h"

namespace sphc::host {

// A frame worth looking at, and why.
struct Highlight {
  std::string name;   // for the file: "best", "median", "worst", "not_localized_1"
  std::string title;  // for people
  size_t frame = 0;   // place in Run::frames
};
// Best, median and worst pose (by error, or by inliers where the truth is not known), others that are wrong, and up
// to two frames that were not localized.  Fewer when the run has fewer, and each once.
std::vector<Highlight> chooseHighlights(const Run &run);
// Is this the name that a report gives to the picture of one?
bool isOverlayFile(const std::string &file);

// `color` (8-bit BGR) enlarged twofold and muted, keypoints grey, matched ones orange, inliers green, legend below.
cv::Mat drawOverlay(const cv::Mat &color, const FrameRecord &frame);

// An image of the C interface as OpenCV's BGR; copies.  Throws std::runtime_error for a depth image.
cv::Mat bgrFromImage(const sphc_image &image);

}  // namespace sphc::host
