// What alignment is measured on: depth and grey images of a recording, and how their cameras stand.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "spherecloud/spherecloud.h"

namespace sphc::host {

struct AlignFrame {
  std::vector<uint8_t> gray;    // of the colour camera's size, row by row
  std::vector<uint16_t> depth;  // of the depth camera's size
};

struct AlignCase {
  std::string name;
  sphc_rig rig = {};
  std::vector<AlignFrame> frames;

  const sphc_camera &color() const { return rig.color_camera; }
  const sphc_camera &depth() const { return rig.depth_camera; }
};

// The same seen by a sensor of 320 x 288 pixels: every second pixel of every second row, 0 above and below.  Throws
// std::invalid_argument unless the depth images are 640 x 480.
AlignCase tofCase(const AlignCase &full);

}  // namespace sphc::host
