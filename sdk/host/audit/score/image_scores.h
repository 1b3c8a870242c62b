// How much of a place an inverted picture shows.  Networks paint in no unit of brightness, so truth and picture are
// both brought to mean 0.5 and deviation 0.2 over what is known: PSNR, SSIM and MAE are of such pictures, of range
// 1, and not to be compared with figures of others.
#pragma once
#include <opencv2/core.hpp>

#include "host/audit/score/truth_view.h"

namespace sphc::host {

struct ImageScores {
  double psnr_db = 0, ssim = 0, mae = 0;
  double ncc = 0;          // normalised cross-correlation, -1 to 1
  double edge_recall = 0;  // share of the truth's edges with one of the picture's within 2 px
  double edge_chance = 0;  // the same for any pixel: what edges at random places would find
  double sift_found = 0;   // share of the truth's SIFT keypoints that the picture has too, within 4 px and alike
};

ImageScores scoreImage(const cv::Mat &picture, const TruthView &truth);

}  // namespace sphc::host
