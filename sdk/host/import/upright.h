// Which way is down, where a recording does not say.
#pragma once
#include <vector>

#include "runtime/geometry/rotation.h"

namespace sphc::host {

// Down in a world whose cameras were held level, more or less: across it lie their x axes, along it their y axes.
// Unit vector.
Vector3 downByCameras(const std::vector<Matrix3> &camera_from_world);

}  // namespace sphc::host
