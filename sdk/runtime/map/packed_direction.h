// Octahedral packing of unit directions.
#pragma once
#include "runtime/base/elementary.h"
#include "runtime/map/layout.h"

namespace sphc {

struct Direction {
  float x, y, z;
};

inline Direction unpackDirection(PackedDirection packed) {
  const float u = static_cast<float>(packed.u - 32768) / 32767.0f,
              v = static_cast<float>(packed.v - 32768) / 32767.0f;
  Direction d = {u, v, 1.0f - absOf(u) - absOf(v)};
  if (d.z < 0.0f) {  // the lower half is folded outwards
    d.x = (1.0f - absOf(v)) * (u < 0.0f ? -1.0f : 1.0f);
    d.y = (1.0f - absOf(u)) * (v < 0.0f ? -1.0f : 1.0f);
  }
  const float scale = 1.0f / sqrtOf(d.x * d.x + d.y * d.y + d.z * d.z);
  return {d.x * scale, d.y * scale, d.z * scale};
}

}  // namespace sphc
