// Dominant gradient directions around a keypoint (Lowe 2004, section 5).
#pragma once
#include <cstdint>

#include "runtime/stages/features/gaussian_table.h"
#include "runtime/stages/features/kernels.h"

namespace sphc {

// At (x, y) of a level of size width x height whose keypoint has the standard deviation `sigma`, all in the
// octave's pixels.  Writes at most `limit` <= 2 angles in (-pi, pi], the strongest first; returns their count.
int32_t findOrientations(const FeatureKernels &kernels, const Plane &level, int32_t width, int32_t height, float x,
                         float y, float sigma, const GaussianTable &gaussian, int32_t limit, float angles[2]);

}  // namespace sphc
