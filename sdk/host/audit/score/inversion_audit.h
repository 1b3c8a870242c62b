// Image inversion at the centre, of a map and of its controls: what no protection and the paper's fakes would show
// of the same points.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "host/audit/attack/inversion.h"
#include "host/audit/attack/published.h"
#include "host/audit/score/retrieval.h"
#include "host/audit/score/truth_view.h"

namespace sphc::host {

// One attacker's picture of each view, and how often it tells the view.
struct InversionResult {
  std::string name;
  std::vector<cv::Mat> pictures;
  Retrieval coarse, fine;
};

// What an attacker sees of each view, and its truth.
InversionResult invert(Inverter *inverter, const std::string &name, const std::vector<SeenPoints> &seen,
                       const std::vector<TruthView> &truths);
// Of directions from the centre.  What an attacker who prunes has: for each point how much to believe in it; empty:
// everything alike.
InversionResult invert(Inverter *inverter, const std::string &name, const std::vector<Vector3> &directions,
                       const std::vector<Descriptor> &descriptors, const std::vector<float> &weights,
                       const std::vector<InversionView> &views);

// 1 for the `share` of points that score highest, else 0.
std::vector<float> pruned(const std::vector<double> &scores, double share);

// Where no picture of the place is at hand: looks all around, and takes for the truth what the network paints of
// the true points (the paper's pseudo ground truth).  Views with few points are left out.
std::vector<InversionView> pseudoTruth(Inverter *inverter, const std::vector<Vector3> &directions,
                                       const std::vector<Descriptor> &descriptors);

}  // namespace sphc::host
