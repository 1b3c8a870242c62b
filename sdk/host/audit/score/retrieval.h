// Which of the views of a place does an inverted picture show?  Whoever can tell has seen the place.
#pragma once
#include <opencv2/core.hpp>
#include <vector>

#include "host/audit/score/panorama.h"

namespace sphc::host {

struct Retrieval {
  std::vector<bool> hits;  // picture i is more like truth i than like any other
  double top1 = 0, standard_error = 0;
};

// Pictures and truths in the same order.  Alike is what correlates at 32 x 32 pixels and has the same edges in 8 x
// 8 cells; the sum of both finds more than either.
Retrieval retrieve(const std::vector<cv::Mat> &pictures, const std::vector<TruthView> &truths);

}  // namespace sphc::host
