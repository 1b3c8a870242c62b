// A map of the test room, made as the builder makes one but without it.
#pragma once
#include <cstdint>
#include <vector>

#include "runtime/geometry/rigid.h"

namespace sphc::test {

struct SceneMap {
  std::vector<uint8_t> file;
  Vector3 centre_in_world_m;
};

// Keypoints of viewpoints 0 to `views` - 1 with their exact directions, a share `eta` of them; the others get
// random ones.
SceneMap makeSceneMap(const sphc_camera &camera, uint32_t keypoints, uint32_t views, double eta, uint32_t room = 0);

}  // namespace sphc::test
