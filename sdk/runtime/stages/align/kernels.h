// The inner loops of alignment.  Two sets of the same code: Highway's best for this machine, and one compiled for
// single lanes, the scalar version.  No multiply-add, exact roots and divisions, sums in a fixed order: every
// instruction set gives the same bits.
#pragma once
#include <cstdint>

#include "spherecloud/spherecloud.h"

namespace sphc {

constexpr int kFitRadius = 2, kFitSide = 2 * kFitRadius + 1;
constexpr int kFitLanes = 8;  // a row of a patch, padded; sums run down each lane, then across

// Depth measurements around a pixel.
struct PatchView {
  const uint16_t *rows[kFitSide];  // kFitLanes readable in each, the first kFitSide count
  float low, high;                 // measurements outside do not count
  float anchor;                    // a measurement of the surface looked for
  float dx, dy;                    // of the point asked for, from the middle of the patch
};
// Sums over the measurements on the anchor's surface; u, v: pixels from the middle; q: inverse depth relative to
// the anchor's, less 1.
struct PatchSums {
  float n, u, v, uu, uv, vv, q, qu, qv, qq;
};

// A pixel of the z-buffer: depth in 1/64 of the unit given out, then 255 - confidence.  The smaller of two is the
// nearer, and of equal depths the surer, in whatever order they come.
constexpr int32_t kDepthShift = 8, kSubUnits = 64, kSubUnitShift = 6;
constexpr int32_t kFilledBit = 1 << 30;       // its depth comes from a sample beside the pixel
constexpr int32_t kEmpty = 0x7FFFFFFF;        // no sample
constexpr int32_t kShadowed = 0x7FFFFFFE;     // none, and the depth camera cannot see what is there
constexpr int32_t kRowPadding = 16;           // pixels before and after the rows of tables and buffers
constexpr int32_t kOnePixel = 0x10001;        // the shape of a footprint
constexpr float kFootprintsPerPixel = 16.0f;  // half widths of footprints are bytes in 1/16 px
// A measurement is kept as raw - 1, so that no measurement, a raw 0, becomes the largest value.
constexpr uint16_t kNotSensed = 0xFFFF;
// A pixel's mask is the high byte of its state, its confidence the low one.
constexpr int32_t kKindShift = 8;

// How a colour pixel comes from a ray (x, y, 1); the centre of the first pixel is at (0, 0).
struct LensF {
  sphc_camera_model model;
  float fx, fy, cx, cy;
  float k[8];  // distortion, the C interface's order
  float max_radius2;
  float width, height;
};

// Depths in colour are in 1/64 of the unit given out: a raw measurement times its turned ray, plus t.
struct ProjectTask {
  float turn[9];  // rays of the depth camera to turned ones, row-major; a pinhole colour camera's matrix is in it
  float t[3];     // with the same matrix
  LensF color;
  float most_subunits;                  // of the z-buffer
  float sigma, sigma_per_raw2;          // of the depth sensor, in its raw units: sigma + sigma_per_raw2 * raw^2
  uint32_t plane_stride, plane_origin;  // elements: a row; index of the top-left pixel
  uint32_t plane_rest;                  // index of kRowPadding elements that are no pixels
  bool with_footprints;
  // Footprints are at least two pixels wide and high.  They are spread a pixel smaller to the right and below,
  // mostly into a single pixel, and grow by it when the z-buffers are combined.
  bool grown;
};

// Three rows of the depth image, as sense_row gave them.  kRowPadding elements before the first and after the last
// are kNotSensed.
struct SensedRows {
  const uint16_t *above, *here, *below;
  int32_t count;         // a multiple of kRowPadding: what is beyond the image is kNotSensed
  const uint8_t *sides;  // of every kRowPadding pixels: the neighbours towards the colour camera
};
constexpr uint8_t kLeftSide = 1, kRightSide = 2, kUpperSide = 4, kLowerSide = 8;

// What project_row needs of a row of the depth image, as many as were sensed.
struct RowToProject {
  const uint16_t *sensed, *slope;  // slope: the largest difference to a neighbour
  const float *turned[3];          // less offset; NaN where the camera model has no ray
  float offset[3];
  const uint8_t *half_x, *half_y;  // of a pixel's footprint in the colour image; 0: none
  int32_t count;
};

// Where the samples of a row fall.  Whole vectors without a measurement are left out.
struct ProjectedRow {
  int32_t count;
  uint32_t *index;  // of the colour pixel in the z-buffer
  int32_t *key;
  uint32_t *spread_index;  // of the top left pixel of the footprint
  int32_t *spread_key;
  int32_t *spread_shape;  // columns, and rows times 65536
};

// A row of both z-buffers.
struct BufferRow {
  int32_t *measured;                     // emptied for the next frame
  const int32_t *spread, *spread_above;  // null without footprints
  int32_t count;
  bool grown;
};

// A row of pixels as they are given out, but for what their neighbours change: depth, 0 for none, and state.
struct DecodedRow {
  uint16_t *depth, *state;
};

// Where a row of pixels goes; of all these `count`, a multiple of kRowPadding, are written.
struct ResolvedRow {
  DecodedRow above, here, below;
  int32_t count;
  uint16_t *depth;
  uint8_t *mask, *confidence;
};

struct AlignKernels {
  void (*patch_sums)(const PatchView &, PatchSums *);
  // nearest[i] = min(nearest[i], raw[i] - first), wrapping around; `count` is any.
  void (*nearest_row)(const uint16_t *raw, uint16_t first, int32_t count, uint16_t *nearest);
  // sensed[i] = raw[i] - 1 where raw[i] is in [low, high], else kNotSensed; `count` is any.
  void (*sense_row)(const uint16_t *raw, uint16_t low, uint16_t high, int32_t count, uint16_t *sensed);
  // Slopes where anything was sensed; columns where a neighbour on one of the sides is missing or clearly farther,
  // unless `edges` is null.  Returns the number of these.
  int32_t (*compare_row)(const SensedRows &, uint16_t *slope, int32_t *edges);
  // turned[i] = row i of the matrix times (ray_x, ray_y, 1).
  void (*turn_row)(const float *matrix, const float *ray_x, const float *ray_y, int32_t count,
                   float *const *turned);
  void (*project_row)(const ProjectTask &, const RowToProject &, ProjectedRow *);
  // Lowers the pixels of every footprint to its key.
  void (*spread_row)(const ProjectedRow &, int32_t stride, int32_t *plane);
  // The measured where nothing clearly nearer was spread over it.
  void (*decode_row)(const BufferRow &, const DecodedRow &);
  void (*resolve_row)(const ResolvedRow &);
};
const AlignKernels &simdAlignKernels();
const AlignKernels &scalarAlignKernels();

}  // namespace sphc
