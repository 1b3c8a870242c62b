#include "runtime/stages/match/search_cone.h"

namespace sphc {

namespace {

// Unpacks as unpackDirection does, but compares without dividing by the length: x . axis > cosine |x|.
bool isInside(const PackedDirection &packed, const SearchCone &cone) {
  const float u = static_cast<float>(packed.u - 32768), v = static_cast<float>(packed.v - 32768);
  const float abs_u = absOf(u), abs_v = absOf(v), z = 32767.0f - abs_u - abs_v;
  const float x = z < 0.0f ? (32767.0f - abs_v) * (u < 0.0f ? -1.0f : 1.0f) : u,
              y = z < 0.0f ? (32767.0f - abs_u) * (v < 0.0f ? -1.0f : 1.0f) : v;
  const float along = x * cone.axis.x + y * cone.axis.y + z * cone.axis.z;
  return along > cone.cosine * sqrtOf(x * x + y * y + z * z);
}

}  // namespace

uint32_t findInsideScalar(const PackedDirection *directions, Span<const DirectionRun> runs, const SearchCone &cone,
                          uint32_t *inside) {
  uint32_t count = 0;
  for (const DirectionRun &run : runs)
    for (uint32_t i = run.begin; i < run.end; ++i)
      if (isInside(directions[i], cone)) inside[count++] = i;
  return count;
}

}  // namespace sphc
