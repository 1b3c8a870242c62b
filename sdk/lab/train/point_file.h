// Points with descriptors, as the tools here hand them to each other.  Little-endian: uint32 count, of all points
// float32 x, y, z, of all 128 bytes of the descriptor.
#pragma once
#include <cstdint>
#include <vector>

#include "lab/train/plain_values.h"
#include "runtime/geometry/rotation.h"
#include "runtime/types/keypoint.h"

namespace sphc::host {

inline void writePoints(const std::vector<Vector3> &places, const std::vector<Descriptor> &descriptors,
                        std::ostream *out) {
  writePlain(static_cast<uint32_t>(places.size()), out);
  for (const Vector3 &place : places)
    for (int axis = 0; axis < 3; ++axis) writePlain(static_cast<float>(place[axis]), out);
  for (const Descriptor &descriptor : descriptors) writePlain(descriptor, out);
}

// `in` has failed afterwards where the file is cut off.
inline void readPoints(std::istream *in, std::vector<Vector3> *places, std::vector<Descriptor> *descriptors) {
  const auto count = readPlain<uint32_t>(in);
  for (uint32_t i = 0; i < count && *in; ++i) {
    const float x = readPlain<float>(in), y = readPlain<float>(in), z = readPlain<float>(in);
    places->push_back(Eigen::Vector3f(x, y, z).cast<double>());
  }
  for (uint32_t i = 0; i < count && *in; ++i) descriptors->push_back(readPlain<Descriptor>(in));
}

}  // namespace sphc::host
