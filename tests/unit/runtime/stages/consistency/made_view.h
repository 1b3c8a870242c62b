// A made-up pair of images: a slanted wall behind boxes, whose edges both images show.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "runtime/stages/consistency/consistency.h"
#include "tests/support/arena_memory.h"

namespace sphc {

class MadeView {
 public:
  static constexpr int32_t kWidth = 320, kHeight = 240;
  static constexpr double kFocal = 250;

  // Boxes and texture are moved by `shift_px` in the image, and in depth by `depth_shift_px`.
  explicit MadeView(int32_t shift_px = 0, int32_t depth_shift_px = 0)
      : gray_(size_t{kWidth} * kHeight), depth_(size_t{kWidth} * kHeight) {
    for (int32_t y = 0; y < kHeight; ++y)
      for (int32_t x = 0; x < kWidth; ++x) {
        const size_t at = static_cast<size_t>(y * kWidth + x);
        gray_[at] =
            static_cast<uint8_t>(isBox(x - shift_px, y) ? 60 + (x - shift_px) / 40 % 2 * 10 : 160 + y / 32 % 2 * 8);
        depth_[at] = isBox(x - depth_shift_px, y) ? uint16_t{1200} : wallAt(x, y);
      }
  }

  static sphc_camera camera() { return {SPHC_CAMERA_PINHOLE, kWidth, kHeight, 4, {kFocal, kFocal, 160, 120}}; }
  static ConsistencyConfig config(bool follows) {
    const Camera made(camera());
    return {made, made, {0.001, 0.25, 6, 0.004, 0.002}, follows};
  }
  // Each measurement becomes the mean of those around it.
  void smoothDepth(int32_t radius_px) {
    const std::vector<uint16_t> sharp = depth_;
    for (int32_t y = 0; y < kHeight; ++y)
      for (int32_t x = 0; x < kWidth; ++x) {
        uint32_t sum = 0, count = 0;
        for (int32_t v = std::max(0, y - radius_px); v <= std::min(kHeight - 1, y + radius_px); ++v)
          for (int32_t u = std::max(0, x - radius_px); u <= std::min(kWidth - 1, x + radius_px); ++u, ++count)
            sum += sharp[static_cast<size_t>(v * kWidth + u)];
        depth_[static_cast<size_t>(y * kWidth + x)] = static_cast<uint16_t>(sum / count);
      }
  }
  std::vector<uint8_t> &gray() { return gray_; }
  std::vector<uint16_t> &depth() { return depth_; }
  ConsistencyView view(int64_t time_ns = 0) const {
    return {
        {gray_.data(), kWidth, kHeight, kWidth}, {depth_.data(), kWidth, kHeight, kWidth}, {}, time_ns, time_ns};
  }

 private:
  static bool isBox(int32_t x, int32_t y) {
    const int32_t u = (x % 80 + 80) % 80, v = y % 60;
    return u > 20 && u < 44 && v > 16 && v < 40;
  }
  // In millimetres; the inverse depth is linear in the image.
  static uint16_t wallAt(int32_t x, int32_t y) {
    return static_cast<uint16_t>(1e6 / (400 - 0.5 * (x - 160) + 0.1 * (y - 120)) + 0.5);
  }
  std::vector<uint8_t> gray_;
  std::vector<uint16_t> depth_;
};

// In memory of its own.
class HeldConsistency {
 public:
  explicit HeldConsistency(bool follows)
      : memory_([this](Arena &arena, bool has_memory) {
          Consistency::layout(arena, arena, has_memory ? &consistency : nullptr);
        }) {
    consistency.init(MadeView::config(follows));
  }
  Consistency consistency;

 private:
  test::ArenaMemory memory_;
};

}  // namespace sphc
