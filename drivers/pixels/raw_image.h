// What a camera gives, and the caller's memory that it goes to.  Sizes and strides are checked before a byte is
// read.
#pragma once

#include <spherecloud/spherecloud.h>

#include <cstddef>
#include <cstdint>

namespace sphc::pixels {

// Bytes in the order of memory.
enum class Layout {
  Grey,     // Y
  Yuyv,     // Y0 U Y1 V
  Uyvy,     // U Y0 V Y1
  Nv12,     // a plane of Y, then one of U V at half the width and height
  Rgb24,    // R G B
  Bgr24,    // B G R
  Bgrx32,   // B G R and a byte without meaning: XRGB8888 of DRM, XR24 or BX24 of V4L2
  Depth16,  // two bytes, the lower one first: Z16, Y16
};

// Of the luma and chroma of Yuyv, Uyvy and Nv12, by the matrix of BT.601.
enum class YuvRange {
  Limited,  // Y 16 to 235, U and V 16 to 240: what UVC cameras send
  Full,     // 0 to 255
};

struct Plane {
  const uint8_t *data;
  size_t bytes;  // that may be read
  uint32_t stride_bytes;
};

struct RawImage {
  Layout layout;
  YuvRange range;
  uint32_t width, height;
  Plane planes[2];  // the second one of Nv12 alone
};

// An image to be written; `bytes` may be.
struct OutImage {
  uint8_t *data;
  size_t bytes;
  uint32_t width, height, stride_bytes;
  sphc_format format;
};

// Bytes of a row of the first plane without padding.
uint32_t rowBytes(Layout layout, uint32_t width);
// Bytes of a whole image, the last row without its padding: a buffer may end there.
uint64_t imageBytes(uint32_t row_bytes, uint32_t stride_bytes, uint32_t height);

// One buffer with all planes behind each other at one stride, as V4L2 gives them.
RawImage contiguous(Layout layout, YuvRange range, uint32_t width, uint32_t height, uint32_t stride_bytes,
                    const uint8_t *data, size_t bytes);

// Whether drivers make images of this format: GRAY8, RGB8, BGR8 and DEPTH16.
bool isDelivered(sphc_format format);

// E_IMAGE with the values seen when an image does not fit its own memory, or cannot exist.
sphc_status checkRaw(const RawImage &raw, sphc_message *message);
sphc_status checkOut(const OutImage &out, sphc_message *message);

}  // namespace sphc::pixels
