#include "pixel_format.h"

#include <cstring>

namespace sphc::libcamera {

namespace {

constexpr uint32_t fourcc(const char *letters) {
  uint32_t code = 0;
  for (int i = 3; i >= 0; --i) code = code << 8 | static_cast<uint8_t>(letters[i]);
  return code;
}

}  // namespace

// DRM names the bytes of a pixel as those of a little-endian word, the last letter lowest: RG24 lies in memory as B
// G R.
const PixelFormat kPixelFormats[kPixelFormatCount] = {
    {"RG24", fourcc("RG24"), false, pixels::Layout::Bgr24},  {"BG24", fourcc("BG24"), false, pixels::Layout::Rgb24},
    {"XR24", fourcc("XR24"), false, pixels::Layout::Bgrx32}, {"YUYV", fourcc("YUYV"), false, pixels::Layout::Yuyv},
    {"UYVY", fourcc("UYVY"), false, pixels::Layout::Uyvy},   {"NV12", fourcc("NV12"), false, pixels::Layout::Nv12},
    {"R8", fourcc("R8  "), false, pixels::Layout::Grey},     {"MJPG", fourcc("MJPG"), true, pixels::Layout::Grey}};

const PixelFormat *findPixelFormat(const char *name) {
  for (const PixelFormat &format : kPixelFormats)
    if (std::strcmp(format.name, name) == 0) return &format;
  return nullptr;
}

}  // namespace sphc::libcamera
