// What inversion shows beside the truth, as one picture.
#pragma once
#include <opencv2/core.hpp>
#include <vector>

#include "host/audit/score/inversion_audit.h"

namespace sphc::host {

// A row of views for the truth and for each result, CV_8U; empty without views.
cv::Mat inversionSheet(const std::vector<InversionView> &views, const std::vector<InversionResult> &results);

}  // namespace sphc::host
