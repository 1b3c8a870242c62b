// The inner loops of alignment.  Two sets of the same code: Highway's best for this machine, and one compiled for
// single lanes, the scalar twin.  No multiply-add, exact roots and divisions, sums in a fixed order: every
// instruction set gives the same bits.
#pragma once
#include <cstdint>

namespace sphc {

constexpr int kPatchRadius = 2, kPatchSide = 2 * kPatchRadius + 1;
constexpr int kPatchLanes = 8;  // a row of a patch, padded; sums run down each lane, then across

// Depth measurements around a pixel.
struct PatchView {
  const uint16_t *rows[kPatchSide];  // kPatchLanes readable in each, the first kPatchSide count
  float low, high;                   // measurements outside do not count
  float anchor;                      // a measurement of the surface looked for
  float dx, dy;                      // of the point asked for, from the middle of the patch
};
// Sums over the measurements on the anchor's surface; u, v: pixels from the middle; q: inverse depth relative to
// the anchor's, less 1.
struct PatchSums {
  float n, u, v, uu, uv, vv, q, qu, qv, qq;
};

struct AlignKernels {
  void (*patch_sums)(const PatchView &, PatchSums *);
  // nearest[i] = min(nearest[i], raw[i] - first), wrapping around; `count` is any.
  void (*nearest_row)(const uint16_t *raw, uint16_t first, int32_t count, uint16_t *nearest);
};
const AlignKernels &simdAlignKernels();
const AlignKernels &scalarAlignKernels();

}  // namespace sphc
