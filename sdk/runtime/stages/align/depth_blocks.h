// The smallest depth around each block of a depth image: a ray that is nearer than that can skip the block.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/types/depth_sensor.h"
#include "runtime/types/image_view.h"

namespace sphc {

class DepthBlocks {
 public:
  // No measurement within so many pixels along either axis is nearer than nearest(u, v) says.
  static constexpr int32_t kReachPx = 16;
  static constexpr uint16_t kNone = 0xFFFF;

  // `blocks` is null while measuring.
  static void layout(int32_t width, int32_t height, Arena &scratch, DepthBlocks *blocks);
  // Reads every pixel of an image of the size in layout once.
  void build(ImageView<uint16_t> depth, const DepthSensor &sensor);
  bool hasMemory() const { return !nearest_.empty(); }

  // Smallest measurement around a pixel of the image, in sensor units; kNone where there is none in range.
  uint16_t nearest(int32_t u, int32_t v) const {
    return nearest_[static_cast<size_t>((v / kReachPx) * columns_ + u / kReachPx)];
  }
  // In the whole image.
  uint16_t nearest() const { return nearest_of_all_; }

 private:
  int32_t columns_ = 0, rows_ = 0;
  uint16_t nearest_of_all_ = kNone;
  Span<uint16_t> line_;     // smallest of each image column within a row of blocks
  Span<uint16_t> block_;    // of each block alone
  Span<uint16_t> nearest_;  // of each block and the eight around it
};

}  // namespace sphc
