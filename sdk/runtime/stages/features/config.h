// What the feature stage is told once; its memory follows from it.
#pragma once
#include <cstdint>

namespace sphc {

struct FeatureConfig {
  int32_t width = 640, height = 480;  // of the largest image; 16 to 8192 each
  uint32_t max_keypoints = 800;
  // Smallest |difference of Gaussians| at a refined extremum, grey levels in [0, 1].
  // Other libraries divide theirs by the 3 scales per octave: this 0.001 is their 0.003.
  float contrast_threshold = 0.001f;
  // Largest ratio of principal curvatures (Lowe 2004, section 4.1): discards points on straight edges.
  float edge_ratio = 12.0f;
  int32_t first_octave = 0;  // -1: start from the image at twice its size; four times the memory and time
  int32_t max_octaves = 8;   // fewer when the image is small
  // The image in 8 x 6 cells: at first a cell gets at most this many times its even share of the keypoints.
  float cell_quota = 3.0f;
  int32_t max_orientations = 1;  // 1 or 2 keypoints at one place
  uint32_t pieces = 1;           // that an octave is cut into at most; 1 to Parallel::kMostPieces
};

constexpr int32_t kMinImageSide = 16, kMaxImageSide = 8192;

}  // namespace sphc
