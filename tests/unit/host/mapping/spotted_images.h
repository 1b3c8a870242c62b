// Images of a spotted wall, straight ahead.
#pragma once
#include <algorithm>
#include <cmath>
#include <spherecloud/spherecloud.hpp>
#include <vector>

#include "runtime/base/random.h"

namespace sphc::host {

constexpr uint32_t kSpottedWidth = 320, kSpottedHeight = 240;
constexpr double kSpottedFocalPx = 250;

inline sphc_rig spottedRig() {
  sphc_rig rig;
  sphc_rig_init(&rig);
  rig.color_camera =
      rig.depth_camera = {SPHC_CAMERA_PINHOLE,
                          kSpottedWidth,
                          kSpottedHeight,
                          4,
                          {kSpottedFocalPx, kSpottedFocalPx, kSpottedWidth / 2.0, kSpottedHeight / 2.0}};
  return rig;
}

class SpottedImages {
 public:
  // Blurred spots of a wall that is so far away, `shift_px` to the right of where they were.
  SpottedImages(int spots, int level, uint16_t depth_mm, int shift_px = 0)
      : color_(3 * kSpottedWidth * kSpottedHeight), depth_(kSpottedWidth * kSpottedHeight, depth_mm) {
    std::vector<double> gray(kSpottedWidth * kSpottedHeight, level);
    Random random(1);
    for (int i = 0; i < spots; ++i) {
      const int x = static_cast<int>(random.below(kSpottedWidth)),
                y = static_cast<int>(random.below(kSpottedHeight));
      addSpot(x + shift_px, y, 160 * random.uniform() - 80, &gray);
    }
    for (size_t i = 0; i < color_.size(); ++i)
      color_[i] = static_cast<uint8_t>(std::min(255.0, std::max(0.0, gray[i / 3])));
  }

  // Turns the wall about the vertical: its inverse depth grows by so much over a focal length to the right.
  void slant(double slope_per_m) {
    for (size_t i = 0; i < depth_.size(); ++i) {
      const double x = (static_cast<double>(i % kSpottedWidth) + 0.5 - kSpottedWidth / 2.0) / kSpottedFocalPx;
      depth_[i] = static_cast<uint16_t>(std::lround(1000 / (1000.0 / depth_[i] + slope_per_m * x)));
    }
  }

  // Borrows the images.
  sphc_localizer_frame frame(uint32_t sequence, int64_t time_ns) const {
    const sphc_image color = {color_.data(), kSpottedWidth, kSpottedHeight, kSpottedWidth * 3, SPHC_FORMAT_BGR8};
    const sphc_image depth = {depth_.data(), kSpottedWidth, kSpottedHeight, kSpottedWidth * 2, SPHC_FORMAT_DEPTH16};
    return spherecloud::frame(sequence, time_ns, color, time_ns, depth);
  }

 private:
  static void addSpot(int x0, int y0, double height, std::vector<double> *gray) {
    const int width = kSpottedWidth, rows = kSpottedHeight;
    for (int y = std::max(0, y0 - 6); y < std::min(rows, y0 + 7); ++y)
      for (int x = std::max(0, x0 - 6); x < std::min(width, x0 + 7); ++x)
        (*gray)[static_cast<size_t>(y * width + x)] +=
            height * std::exp(-((x - x0) * (x - x0) + (y - y0) * (y - y0)) / 8.0);
  }

  std::vector<uint8_t> color_;
  std::vector<uint16_t> depth_;
};

}  // namespace sphc::host
