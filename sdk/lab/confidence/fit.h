// Logistic regression by Newton's method, no weight below zero.
#pragma once
#include <vector>

#include "lab/confidence/run.h"

namespace sphc::host {

// A feature whose weight would be negative is left out (weight zero), the worst first.  Throws std::runtime_error
// when there are not both right and wrong poses.
ConfidenceModel fitConfidence(const std::vector<ConfidenceRun> &runs);
// As a line of C++ for confidence.cpp.
std::string modelText(const ConfidenceModel &model);

}  // namespace sphc::host
