// Estimators of others, as packages offer them.  One that is not installed is told as absent, with the cure.
#pragma once
#include "lab/pose/variant.h"

namespace sphc::host {

// PoseLib's P3P with local optimisation, on true points; runs in `python` (a path or a name in PATH).
PoseVariant poseLibPeer(const std::string &python);
// cv::solvePnPRansac, on true points.
PoseVariant openCvPeer();
// OpenGV's central absolute pose with Kneip's P3P: on true points; and on our own input, with map directions as
// bearings and lifted keypoints as points.
std::vector<PoseVariant> openGvPeers();

std::vector<PoseVariant> posePeers(const std::string &python);

}  // namespace sphc::host
