// Which of the views of a place does an inverted picture show?  Whoever can tell has seen the place.
#pragma once
#include <opencv2/core.hpp>
#include <vector>

#include "host/audit/score/truth_view.h"

namespace sphc::host {

struct Retrieval {
  std::vector<bool> hits;  // picture i is more like truth i than like any other
  double top1 = 0, standard_error = 0;
};

// Of a share of so many; 0 of none.
double standardErrorOfShare(double share, size_t count);

// Cells of a picture, both ways, in which edges are compared.  Fine finds the most, given the very pose of the
// picture; coarse needs it to a few degrees only.
constexpr int kFineCells = 32, kCoarseCells = 8;

// Pictures and truths in the same order.  Alike are pictures whose edges, in each cell, have the same directions.
Retrieval retrieve(const std::vector<cv::Mat> &pictures, const std::vector<TruthView> &truths, int cells);

}  // namespace sphc::host
