#include "lab/align/case.h"

#include <stdexcept>

namespace sphc::host {
namespace {

constexpr uint32_t kWidth = 320, kHeight = 288, kSeenRows = 240, kTopView = (kHeight - kSeenRows) / 2;

}  // namespace

AlignCase tofCase(const AlignCase &full) {
  if (full.depth().width != 2 * kWidth || full.depth().height != 2 * kSeenRows)
    throw std::invalid_argument("a 320 x 288 sensor is made of depth images of 640 x 480 only");
  AlignCase tof = full;
  tof.name = "320x288";
  tof.rig.depth_camera.width = kWidth;
  tof.rig.depth_camera.height = kHeight;
  for (int i = 0; i < 4; ++i) tof.rig.depth_camera.params[i] *= 0.5;
  // Pixel 2u, whose centre lies at 2u + 0.5, becomes pixel u with its centre at u + 0.5.
  tof.rig.depth_camera.params[2] += 0.25;
  tof.rig.depth_camera.params[3] += 0.25 + kTopView;
  for (AlignFrame &frame : tof.frames) {
    std::vector<uint16_t> seen(kWidth * kHeight);
    for (uint32_t y = 0; y < kSeenRows; ++y)
      for (uint32_t x = 0; x < kWidth; ++x)
        seen[(y + kTopView) * kWidth + x] = frame.depth[2 * y * 2 * kWidth + 2 * x];
    frame.depth = std::move(seen);
  }
  return tof;
}

}  // namespace sphc::host
