// Which way is down, where a recording does not say, and worlds in which it is -z.
#pragma once
#include <vector>

#include "runtime/geometry/rotation.h"

namespace sphc::host {

// Down in a world whose cameras were held level, more or less: across it lie their x axes, along it their y axes.
// Unit vector.
Vector3 downByCameras(const std::vector<Matrix3> &camera_from_world);

// The shortest rotation that turns `down` to -z.
Matrix3 uprightAxes(const Vector3 &down);

}  // namespace sphc::host
