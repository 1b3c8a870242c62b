#include "runtime/stages/align/depth_blocks.h"

#include "runtime/stages/align/kernels.h"

namespace sphc {
namespace {

constexpr int32_t blocksOver(int32_t pixels) {
  return (pixels + DepthBlocks::kReachPx - 1) / DepthBlocks::kReachPx;
}

uint16_t smaller(uint16_t a, uint16_t b) { return a < b ? a : b; }

// First and last measurement in range; none are when first > last.
struct RawRange {
  uint16_t first, last;
};
RawRange rangeOf(const DepthSensor &sensor) {
  const double low = sensor.min_m / sensor.unit_m, high = sensor.max_m / sensor.unit_m;
  // A unit wider than need be, against rounding: nearer than true only costs a step.
  return {static_cast<uint16_t>(low < 2       ? 1
                                : low > 65534 ? 65534
                                              : low - 1),
          static_cast<uint16_t>(high > 65533 ? 65534 : high + 1)};
}

}  // namespace

void DepthBlocks::layout(int32_t width, int32_t height, Arena &scratch, DepthBlocks *blocks) {
  DepthBlocks discarded;
  DepthBlocks &b = blocks ? *blocks : discarded;
  b.columns_ = blocksOver(width);
  b.rows_ = blocksOver(height);
  const size_t count = static_cast<size_t>(b.columns_ * b.rows_);
  b.line_ = scratch.take<uint16_t>("align.line", static_cast<size_t>(b.columns_ * kReachPx));
  b.block_ = scratch.take<uint16_t>("align.blocks", count);
  b.nearest_ = scratch.take<uint16_t>("align.nearest", count);
}

void DepthBlocks::build(ImageView<uint16_t> depth, const DepthSensor &sensor) {
  const RawRange range = rangeOf(sensor);
  const AlignKernels &kernels = simdAlignKernels();
  for (int32_t row = 0; row < rows_; ++row) {
    for (uint16_t &nearest : line_) nearest = kNone;
    const int32_t end = (row + 1) * kReachPx < depth.height ? (row + 1) * kReachPx : depth.height;
    // Measurements count from the first in range; those out of range, 0 too, wrap around beyond the last.
    for (int32_t v = row * kReachPx; v < end; ++v)
      kernels.nearest_row(depth.row(v), range.first, depth.width, line_.data());
    for (int32_t column = 0; column < columns_; ++column) {
      uint16_t nearest = kNone;
      for (int32_t k = 0; k < kReachPx; ++k)
        nearest = smaller(nearest, line_[static_cast<size_t>(column * kReachPx + k)]);
      const bool any = nearest <= range.last - range.first;
      block_[static_cast<size_t>(row * columns_ + column)] =
          any ? static_cast<uint16_t>(nearest + range.first) : kNone;
    }
  }
  nearest_of_all_ = kNone;
  for (int32_t row = 0; row < rows_; ++row) {
    for (int32_t column = 0; column < columns_; ++column) {
      nearest_of_all_ = smaller(nearest_of_all_, block_[static_cast<size_t>(row * columns_ + column)]);
      uint16_t nearest = kNone;
      for (int32_t v = row > 0 ? row - 1 : 0; v <= row + 1 && v < rows_; ++v)
        for (int32_t u = column > 0 ? column - 1 : 0; u <= column + 1 && u < columns_; ++u)
          nearest = smaller(nearest, block_[static_cast<size_t>(v * columns_ + u)]);
      nearest_[static_cast<size_t>(row * columns_ + column)] = nearest;
    }
  }
}

}  // namespace sphc
