// The library as a variant of the frame bench, by its C interface alone.
#pragma once
#include <spherecloud/spherecloud.hpp>

#include "lab/frame/variant.h"

namespace sphc::host {

struct OurFrames {
  sphc_localizer_config config = {};  // cameras set; its clock is replaced by the bench's
  const spherecloud::Map *map = nullptr;
  Vector3 centre_in_world_m = Vector3::Zero();  // the map's origin in the recording's world
  uint32_t repeats = 1;
};

// "ours, cold": every frame by a localizer that has seen nothing before.  "ours, tracking": frames in order of time
// by one localizer; "with odometry": it is told the odometry too.  Memory is made here; the map is borrowed. Throws
// std::runtime_error with cause and cure.
std::vector<FrameVariant> ourFrameVariants(const OurFrames &ours);

}  // namespace sphc::host
