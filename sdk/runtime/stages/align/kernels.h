// The inner loops of alignment.  Two sets of the same code: Highway's best for this machine, and one compiled for
// single lanes, the scalar twin.  No multiply-add, exact roots and divisions, sums in a fixed order: every
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
constexpr int32_t kDepthShift = 8, kSubUnits = 64;
constexpr int32_t kFilledBit = 1 << 30;       // its depth comes from a sample beside the pixel
constexpr int32_t kEmpty = 0x7FFFFFFF;        // no sample
constexpr int32_t kShadowed = 0x7FFFFFFE;     // none, and the depth camera cannot see what is there
constexpr int32_t kRowPadding = 16;           // pixels before and after the rows of tables and buffers
constexpr float kObliquest = 0.25f;           // gaps open along an axis from this share of the other on
constexpr float kFootprintsPerPixel = 16.0f;  // half widths of footprints are bytes in 1/16 px

// How a colour pixel comes from a ray (x, y, 1).
struct LensF {
  sphc_camera_model model;
  float fx, fy, cx, cy;
  float k[8];  // distortion, the door's order
  float max_radius2;
  float width, height;
};

struct ProjectTask {
  float r[9], t[3];  // color_from_depth, row-major, m
  LensF color;
  float subunits_per_m, most_subunits;  // of the z-buffer
  float sigma_m, sigma_per_m2;          // of the depth sensor
  float center_m[3];                    // of the colour camera, depth frame
  float depth_focal_px;
  int32_t plane_stride, plane_origin;  // elements: a row; index of the top-left pixel
  bool with_footprints;
};

// Depths of three rows of the depth image, m, 0: none; rays and footprints of the middle one.  kRowPadding elements
// are readable before the first and after the last.
struct SensedRows {
  const float *above, *here, *below;
  const float *ray_x, *ray_y;      // NaN where the camera model has none
  const uint8_t *half_x, *half_y;  // of a pixel's footprint in the colour image
  int32_t count;                   // a multiple of kRowPadding: depths beyond the image are 0
};

// Where the pixels of a row fall; arrays of as many as were sensed.
struct ProjectedRow {
  int32_t *index;                        // of the colour pixel in the z-buffer; 0: none
  int32_t *key;                          // of a pixel that the sample falls into
  int32_t *fill_key;                     // of one beside it
  int32_t *left, *right, *top, *bottom;  // colour pixels of the footprint: [left, right) x [top, bottom)
  int32_t *edges;  // columns behind which the colour camera may see what the depth camera cannot
  int32_t edge_count;
};

// Three rows of the z-buffer, and where the middle one goes; `count` rounded up to whole kRowPadding.
struct ResolvedRow {
  const int32_t *above, *here, *below;
  int32_t count;
  uint16_t *depth;
  uint8_t *mask, *confidence;
};

struct AlignKernels {
  void (*patch_sums)(const PatchView &, PatchSums *);
  // nearest[i] = min(nearest[i], raw[i] - first), wrapping around; `count` is any.
  void (*nearest_row)(const uint16_t *raw, uint16_t first, int32_t count, uint16_t *nearest);
  // m[i] = raw[i] * unit_m where raw[i] is in [low, high], else 0.
  void (*sense_row)(const uint16_t *raw, float unit_m, float low, float high, int32_t count, float *m);
  void (*project_row)(const ProjectTask &, const SensedRows &, ProjectedRow *);
  // Lowers the pixels of every footprint to its key.
  void (*spread_row)(const ProjectedRow &, int32_t count, int32_t stride, int32_t *top_left);
  // The measured where nothing clearly nearer was spread over it.
  void (*combine_row)(const int32_t *measured, const int32_t *spread, int32_t count, int32_t *combined);
  void (*resolve_row)(const ResolvedRow &);
};
const AlignKernels &simdAlignKernels();
const AlignKernels &scalarAlignKernels();

}  // namespace sphc
