// The layers of stacks, as only the owner can separate them: an upper bound for attackers who try.
#pragma once
#include <vector>

#include "host/audit/score/truth.h"

namespace sphc::host {

// A number an entry: of those of a stack that are real, or of fakes that came there with one patch.  `stacks` of
// stacksOf. Patches are told by where their points truly are, so a stack that was cut in two has two layers of
// each.
std::vector<uint32_t> layersOf(const std::vector<EntryTruth> &truth, const std::vector<uint32_t> &stacks);

// Each entry's score becomes the mean of its layer's.
std::vector<double> layerMeans(const std::vector<double> &scores, const std::vector<uint32_t> &layers);

}  // namespace sphc::host
