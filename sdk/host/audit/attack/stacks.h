// Where fakes are laid on real patches, the sphere shows stacks of points with little between them.  Whoever looks
// at directions alone finds them; and what looks like a point in *other* stacks tells real from fake: the real
// place goes on from stack to stack, and fakes come from anywhere.
#pragma once
#include <vector>

#include "host/audit/attack/neighbours.h"

namespace sphc::host {

// The stack of each point, counted from 0: Gaussian mean shift from some of the directions (unit), and k-means
// about the modes.
std::vector<uint32_t> stacksOf(const std::vector<Vector3> &directions);

// Larger where those of `alike` (nearest descriptors) that lie in other stacks lie near: minus the mean logarithm
// of the angle, of the best six.
Eigen::ArrayXf lookalikesInOtherStacks(const std::vector<Vector3> &directions, const Neighbours &alike,
                                       const std::vector<uint32_t> &stacks);

}  // namespace sphc::host
