// What the formats of the C interface mean.
#pragma once
#include "runtime/types/image_view.h"
#include "spherecloud/spherecloud.h"

namespace sphc {

struct PixelFormat {
  bool is_depth = false;
  uint8_t group_pixels = 1, group_bytes = 0;  // pixels that share bytes; 0: no such format
  uint8_t alignment = 1;                      // of rows, in bytes
  LumaLayout luma;                            // of those that are not of depth
  DepthLayout depth;                          // of those that are
};

PixelFormat pixelFormatOf(sphc_format format);
// Of a config, where 0 stands for DEPTH16.
constexpr sphc_format depthFormatOf(sphc_format configured) {
  return configured ? configured : sphc_format{SPHC_FORMAT_DEPTH16};
}

}  // namespace sphc
