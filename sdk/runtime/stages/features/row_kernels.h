// The loops in which the time goes, each over one row.
//
// They are plain loops that compilers vectorise, compiled several times, for each instruction set one; the
// machine's is chosen at run time.  Every element is computed by the same IEEE operations in the same order in all
// of them, so the bytes do not depend on the choice.
#pragma once
#include <cstdint>

namespace sphc {

constexpr int32_t kMaxBlurRadius = 7;
constexpr int32_t kDogLayers = 5, kSearchedLayers = 3;

// Rows y - radius .. y + radius, the middle one at [radius]; weights of distance 0 .. radius.
struct BlurTaps {
  const float *rows[2 * kMaxBlurRadius + 1];
  float weights[kMaxBlurRadius + 1];
  int32_t radius;
};

// Three consecutive rows of each difference-of-Gaussians layer: rows[layer][y - 1, y, y + 1].
struct DogRows {
  const float *rows[kDogLayers][3];
};

// out = in / 255
void bytesToUnit(const uint8_t *in, float *out, int32_t width);
// Row of twice the width: samples at the pixels and half-way between (the last one repeats).
void doubleRow(const float *upper, const float *lower, float *out, int32_t width);
// Separable blur of one row.  `padded` has room for width + 2 * kMaxBlurRadius; borders repeat the edge pixel.
void blurRow(const BlurTaps &taps, float *padded, float *out, int32_t width);
// out = a - b
void subtractRow(const float *a, const float *b, float *out, int32_t width);
// flags[x] bit s-1: the pixel of layer s is beyond the threshold and no neighbour in 3 x 3 x 3 exceeds it.
// `scratch` has room for 6 rows of `stride`.  Border pixels get 0.
void flagExtrema(const DogRows &dog, float threshold, float *scratch, int32_t stride, uint8_t *flags,
                 int32_t width);
// Length times weight, and angle in [0, turn) with a full circle = turn, of each gradient (dx, dy).
// `magnitude` holds the weights on entry.
void polarGradients(const float *dx, const float *dy, float turn, float *magnitude, float *angle, int32_t count);
// (77 r + 150 g + 29 b + 128) / 256, the BT.601 weights; red_first tells RGB from BGR.
void grayRow(const uint8_t *rgb, bool red_first, uint8_t *gray, int32_t width);

}  // namespace sphc
