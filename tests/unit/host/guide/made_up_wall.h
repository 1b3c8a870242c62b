// A camera that moves along a long spotted wall, 2 m away.
#pragma once
#include <algorithm>
#include <cmath>
#include <spherecloud/spherecloud.hpp>
#include <vector>

#include "host/recording/calibration.h"
#include "runtime/base/random.h"

namespace sphc::host {

constexpr uint32_t kWallViewWidth = 320, kWallViewHeight = 240;
constexpr double kWallFocalPx = 250, kWallM = 2;

inline sphc_rig wallRig() {
  sphc_rig rig;
  sphc_rig_init(&rig);
  rig.color_camera = rig.depth_camera = {SPHC_CAMERA_PINHOLE,
                                         kWallViewWidth,
                                         kWallViewHeight,
                                         4,
                                         {kWallFocalPx, kWallFocalPx, kWallViewWidth / 2.0, kWallViewHeight / 2.0}};
  return rig;
}

class MadeUpWall {
 public:
  explicit MadeUpWall(uint64_t seed) : gray_(kWidth * kWallViewHeight, 128), depth_(kViewPixels) {
    Random random(seed);
    for (int spot = 0; spot < 4000; ++spot) {
      const int x = static_cast<int>(random.below(kWidth)), y = static_cast<int>(random.below(kWallViewHeight));
      addSpot(x, y, 160 * random.uniform() - 80);
    }
  }

  // With its left border at `x_px` of the wall.  `light`: 1, or less where it is dark.  Borrows, until the next.
  sphc_localizer_frame view(int x_px, int64_t time_ns, double light = 1, bool has_depth = true) {
    view_.clear();
    for (uint32_t y = 0; y < kWallViewHeight; ++y)
      for (uint32_t x = 0; x < kWallViewWidth; ++x)
        view_.push_back(static_cast<uint8_t>(
            std::clamp(light * gray_[y * kWidth + static_cast<uint32_t>(x_px) + x], 0.0, 255.0)));
    std::fill(depth_.begin(), depth_.end(), static_cast<uint16_t>(has_depth ? 1000 * kWallM : 0));
    const sphc_image color = {view_.data(), kWallViewWidth, kWallViewHeight, kWallViewWidth, SPHC_FORMAT_GRAY8};
    const sphc_image depth = {depth_.data(), kWallViewWidth, kWallViewHeight, kWallViewWidth * 2,
                              SPHC_FORMAT_DEPTH16};
    return spherecloud::frame(static_cast<uint32_t>(time_ns / 1000000), time_ns, color, time_ns, depth);
  }

 private:
  static constexpr uint32_t kWidth = 1600;
  static constexpr size_t kViewPixels = size_t{kWallViewWidth} * kWallViewHeight;

  void addSpot(int x0, int y0, double height) {
    const int width = kWidth, rows = kWallViewHeight;
    for (int y = std::max(0, y0 - 6); y < std::min(rows, y0 + 7); ++y)
      for (int x = std::max(0, x0 - 6); x < std::min(width, x0 + 7); ++x)
        gray_[static_cast<size_t>(y * width + x)] +=
            height * std::exp(-((x - x0) * (x - x0) + (y - y0) * (y - y0)) / 8.0);
  }

  std::vector<double> gray_;
  std::vector<uint8_t> view_;
  std::vector<uint16_t> depth_;
};

}  // namespace sphc::host
