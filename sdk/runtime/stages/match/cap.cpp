#include "runtime/stages/match/cap.h"

namespace sphc {

// Unpacks as unpackDirection does, but compares without dividing by the length: x . axis > cosine |x|.
uint32_t findInsideScalar(const PackedDirection *directions, DirectionRun run, const Cap &cap, uint32_t *inside) {
  uint32_t count = 0;
  for (uint32_t i = run.begin; i < run.end; ++i) {
    const float u = static_cast<float>(directions[i].u - 32768), v = static_cast<float>(directions[i].v - 32768);
    const float abs_u = absOf(u), abs_v = absOf(v), z = 32767.0f - abs_u - abs_v;
    const float x = z < 0.0f ? (32767.0f - abs_v) * (u < 0.0f ? -1.0f : 1.0f) : u,
                y = z < 0.0f ? (32767.0f - abs_u) * (v < 0.0f ? -1.0f : 1.0f) : v;
    const float along = x * cap.axis.x + y * cap.axis.y + z * cap.axis.z;
    if (along > cap.cosine * sqrtOf(x * x + y * y + z * z)) inside[count++] = i;
  }
  return count;
}

}  // namespace sphc
