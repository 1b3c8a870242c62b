// How evenly directions spread over the sphere, and where there are none.
#pragma once
#include <array>
#include <vector>

namespace sphc::host {

struct Hole {
  double yaw_deg, pitch_deg;  // of its middle: around z from x towards y, and up
  double radius_deg;          // to the nearest direction
};

struct Coverage {
  double covered_share = 0;  // of the sphere, within 5 degrees of a direction
  // 1: as many directions everywhere; the share of the sphere that an even spread of the same entropy would fill.
  double evenness = 0;
  std::vector<Hole> holes;  // the widest, none in another
};

Coverage coverageOf(const std::vector<std::array<double, 3>> &directions, size_t most_holes);

}  // namespace sphc::host
