// lanes.h - four floats at a time, by the compilers' portable vectors.
#pragma once

#include <cstdint>

namespace sphc::simulated {

constexpr uint32_t kLanes = 4;
typedef float Float4 __attribute__((vector_size(16)));

inline Float4 all(float x) { return Float4{x, x, x, x}; }
inline Float4 lower(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 higher(Float4 a, Float4 b) { return a > b ? a : b; }

struct Vec4 {
  Float4 x, y, z;
};

}  // namespace sphc::simulated
