#include "runtime/stages/pose/rows.h"

namespace sphc {

void PoseRows::layout(const char *name, uint32_t capacity, bool has_centres, Arena &scratch, PoseRows *rows) {
  const uint32_t padded = (capacity + kPoseChunk - 1) / kPoseChunk * kPoseChunk;
  for (uint32_t f = 0; f < (has_centres ? kPoseFieldCount : kCentreX); ++f) {
    const Span<float> span = scratch.take<float>(name, padded);
    if (rows) rows->field[f] = span.data();
  }
}

void PoseRows::pushBelow(const PoseRows &from, const float *value, float limit, uint32_t *index) {
  uint32_t kept = 0;
  for (uint32_t i = 0; i < from.count; ++i) {
    index[kept] = i;
    kept += value[i] < limit;
  }
  for (uint32_t f = 0; f < fieldCount(); ++f) {
    const float *source = from.field[f];
    float *target = field[f] + count;
    for (uint32_t i = 0; i < kept; ++i) target[i] = source[index[i]];
  }
  count += kept;
}

void PoseRows::pad() {
  padded = (count + kPoseChunk - 1) / kPoseChunk * kPoseChunk;
  for (uint32_t f = 0; f < fieldCount(); ++f)
    for (uint32_t i = count; i < padded; ++i)
      field[f][i] = f == kPointZ || f == kViewZ || f == kWeight || f == kStretch ? 1.0f : 0.0f;
}

}  // namespace sphc
