// Which of libcamera's pixel formats can be converted, in order of preference.
#pragma once

#include "drivers/pixels/raw_image.h"

namespace sphc::libcamera {

struct PixelFormat {
  char name[5];  // the four letters of DRM's code, without trailing blanks
  uint32_t fourcc;
  bool is_jpeg;
  pixels::Layout layout;  // unless is_jpeg
};

constexpr uint32_t kPixelFormatCount = 8;
extern const PixelFormat kPixelFormats[kPixelFormatCount];

// Null when none has this name.
const PixelFormat *findPixelFormat(const char *name);

}  // namespace sphc::libcamera
