// Agrees on a mode with the device, and notices when it silently takes another than was asked for.
#pragma once

#include "node.h"
#include "pixel_format.h"
#include "v4l2.h"

namespace sphc::v4l2 {

struct Mode {
  PixelFormat pixel_format;
  pixels::YuvRange range;
  uint32_t width, height;
  uint32_t stride_bytes;                          // 0 of JPEG
  uint32_t buffer_bytes;                          // that the device may write
  uint32_t period_numerator, period_denominator;  // 0 / 0: not told
  uint32_t adjusted;                              // SPHC_V4L2_ADJUSTED_ bits

  pixels::RawImage rawImage(const uint8_t *data, size_t bytes) const;  // not of JPEG
};

// `config` is checked already, its format and stream set.
sphc_status negotiate(const Node &node, const sphc_v4l2_config &config, Mode *mode, sphc_message *message);

}  // namespace sphc::v4l2
