// The loops in which the time goes.  Two sets of the same code: Highway's best for this machine, and one compiled
// for single lanes, the scalar version.  Pixels are 16-bit integers; where floats are used, no multiply-add, exact
// roots and divisions, and a fixed order of summation: every instruction set gives the same bytes.
#pragma once
#include <cstdint>

#include "runtime/stages/features/plane.h"
#include "runtime/types/keypoint.h"

namespace sphc {

constexpr int32_t kMaxBlurRadius = 7;
constexpr int32_t kDogLayers = 5, kSearchedLayers = 3;
constexpr int32_t kOneQ15 = 32768;

// One or two rows of a level: `rows` of the level below, from radius above the first to radius below the last;
// weights of distance 0 .. radius, which with those of the other side sum to kOneQ15.
constexpr int32_t kRowsAtOnce = 2;
struct BlurTask {
  const int16_t *rows[2 * kMaxBlurRadius + kRowsAtOnce];
  int16_t weights[kMaxBlurRadius + 1];
  int32_t radius, width, count;
  int16_t *padded;                   // room for kRowsAtOnce times paddedWidth(width) + 2 * kRowStep
  int16_t *out[kRowsAtOnce];         // of paddedWidth(width), as are all rows
  int16_t *difference[kRowsAtOnce];  // out less the same row of the level below; may be null
};

// Three consecutive rows of three neighbouring layers of differences of Gaussians: rows[layer][y - 1, y, y + 1].
struct DogRows {
  const int16_t *rows[3][3];
};

// Columns and rows of pixels around a keypoint, at most kWindowSide each.
constexpr int32_t kWindowSide = 15, kWindowLanes = 16;
constexpr int32_t kOrientationBins = 36;
struct OrientationWindow {
  const int16_t *pixels;  // the top left one; it has neighbours on all sides
  int32_t stride, columns, rows;
  float across[kWindowLanes], down[kWindowLanes];  // weight of a column and of a row
};

// 16 x 16 samples, turned and scaled to the keypoint: sample (i, j) lies at (x, y) + i (c, s) + j (-s, c), 65536 to
// the pixel.
constexpr int32_t kPatchSide = 16, kGradientSide = kPatchSide - 1;
struct PatchTask {
  const int16_t *pixels;
  int32_t stride, width, height;
  int32_t x, y, c, s;
};
// Weight of each gradient sample, of kOneQ15.
struct PatchWindow {
  int16_t weights[kGradientSide][kPatchSide];  // the last column is zero
};

struct FeatureKernels {
  // out = (in - 128) * 128
  void (*scale_row)(const uint8_t *in, int16_t *out, int32_t width);
  // Samples of a row of twice the width: at the pixels and half-way between (the last one repeats).
  void (*double_row)(const uint8_t *upper, const uint8_t *lower, int16_t *out, int32_t width);
  // out[x] = in[2 x]
  void (*halve_row)(const int16_t *in, int16_t *out, int32_t width);
  // Separable; borders repeat the edge pixel; every product is rounded to a sample.
  void (*blur_rows)(const BlurTask &);
  // Columns in [first, end) of the middle layer beyond the threshold and its 26 neighbours: strictly beyond those
  // that come before it, not below those after, so that one of equal samples remains.  Reads whole vectors past
  // `end`. `found` has room for end - first; returns how many.
  uint32_t (*find_extrema)(const DogRows &, int16_t threshold, int32_t first, int32_t end, uint16_t *found);
  // Sums of weighted gradient lengths by direction.
  void (*orientation_histogram)(const OrientationWindow &, float histogram[kOrientationBins]);
  // RootSIFT of the patch's gradients.
  void (*describe)(const PatchTask &, const PatchWindow &, Descriptor *);
  // (77 r + 150 g + 29 b + 128) / 256, the BT.601 weights; red_first tells RGB from BGR.  A pixel has three bytes,
  // or four.
  void (*gray_row)(const uint8_t *color, int32_t pixel_bytes, bool red_first, uint8_t *gray, int32_t width);
};
const FeatureKernels &simdFeatureKernels();
const FeatureKernels &scalarFeatureKernels();

}  // namespace sphc
