// A small textured room, ray-cast for tests: grey image and exact depth of any camera without distortion.
#pragma once
#include <cstdint>
#include <vector>

#include "runtime/geometry/rigid.h"

namespace sphc::test {

struct SceneImages {
  std::vector<uint8_t> gray;       // of the colour camera
  std::vector<uint16_t> depth_mm;  // of the depth camera
};

// x right, y down, z forward; the room reaches from -1.8 to 1.8, -1.5 to 1.2, -1 to 3 metres.  Rooms of different
// numbers have other walls.
SceneImages renderScene(const sphc_camera &color, const sphc_camera &depth, const Rigid &color_from_world,
                        const Rigid &color_from_depth, uint32_t room = 0);

sphc_camera pinhole(uint32_t width, uint32_t height, double focal_px);
// The i-th of a row of nearby viewpoints; those between lie on the way.
Rigid sceneViewpoint(double i);

}  // namespace sphc::test
