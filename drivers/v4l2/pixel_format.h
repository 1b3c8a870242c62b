// Which of Linux's pixel layouts this driver can take, and for what.
#pragma once

#include "drivers/pixels/raw_image.h"
#include "spherecloud/spherecloud_capture.h"

namespace sphc::v4l2 {

struct PixelFormat {
  uint32_t fourcc;
  sphc_stream stream;
  bool is_jpeg;  // then there is no layout
  pixels::Layout layout;
};

// Null when it is none of ours.
const PixelFormat *findPixelFormat(uint32_t fourcc);

// The fourccs for captures of `format`, the cheapest one first; 0 ends the list.
const uint32_t *preferredFourccs(sphc_format format);

struct FourccText {
  char text[5];
};
FourccText fourccText(uint32_t fourcc);  // '?' for what is not printable

}  // namespace sphc::v4l2
