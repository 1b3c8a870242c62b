// What keeps a frame from a pose, each as a change of a healthy sequence, and the hint that tells it.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "lab/negative/sequence.h"

namespace sphc::host {

struct HintCondition {
  std::string name;
  std::function<void(Sequence *)> apply;
  uint32_t hint = 0;  // SPHC_HINT_ bit; 0: nothing is wrong
};

// Healthy frames first.
std::vector<HintCondition> hintConditions();

// How a colour image is exposed: how much of the light is left, and by how much it is amplified.
struct ExposureSetting {
  double light = 1, gain = 1;
};
// With the noise of photons and of reading; values are roots of the light.  A Gaussian stands for Poisson's law.
void expose(const ExposureSetting &exposure, uint64_t seed, std::vector<uint8_t> *values);
// Mixes the light along a line through each pixel, so many pixels long, in the direction of (x, y).
void blurAlong(double x, double y, double length_px, const Sequence &sequence, Shot *shot);

}  // namespace sphc::host
