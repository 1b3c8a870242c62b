// What says that a recording is not what it claims to be: poses that are not of its frames, depth that is not of
// its images.
#pragma once
#include <string>
#include <vector>

#include "host/import/rgbd_import.h"

namespace sphc::host {

// Faults of some of the frames, a sentence each, with cause and cure.
std::vector<std::string> faultsOfFrames(const RgbdImportSummary &summary);
// Of the whole recording, so much that no map of it can be right.  Empty: none.
std::vector<std::string> contradictionsOf(const RgbdImportSummary &summary);
// Each on a line of its own, behind what introduces them.
std::string contradictionLines(const std::vector<std::string> &contradictions);
// Those of poses and depth alone, without faults of the images.
std::vector<std::string> contradictionsOfPoses(const RgbdImportSummary &summary);
// Why they may be wrong where no contradiction is found: they agree less than in sound recordings, or too few
// frames have a pose to tell.
std::vector<std::string> doubtsOfPoses(const RgbdImportSummary &summary);

}  // namespace sphc::host
