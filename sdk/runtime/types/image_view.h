// Borrowed images.
#pragma once
#include <cstdint>

namespace sphc {

template <typename T>
struct ImageView {
  const T *data = nullptr;
  int32_t width = 0, height = 0;
  int32_t stride = 0;  // elements from a row to the next

  const T *row(int32_t y) const { return data + static_cast<int64_t>(y) * stride; }
};
using GrayView = ImageView<uint8_t>;
using ByteView = ImageView<uint8_t>;  // pixels as they came, of any layout; stride in bytes

// How the luma of a pixel lies in an image's bytes.
struct LumaLayout {
  enum Kind : uint8_t {
    kPlane,  // a byte a pixel
    kBytes,  // one byte a pixel of groups that have others too
    kWords,  // 16 bits a pixel, little-endian, of which `bits` count
    kRgb,    // three or four bytes a pixel, which are weighed
    kBgr
  };
  // Which pixels of a colour filter are green: those with an even sum of x and y, or an odd one.
  enum Green : uint8_t { kNoFilter, kGreenEven, kGreenOdd };

  Kind kind = kPlane;
  uint8_t group_pixels = 1, group_bytes = 1;
  uint8_t first = 0;  // kBytes: of a group's bytes, that of its first pixel; those of the others follow
  uint8_t bits = 8;
  Green green = kNoFilter;
};

struct ColorView {
  ByteView bytes;
  LumaLayout layout;
};

// How depth lies in an image's bytes.
struct DepthLayout {
  enum Kind : uint8_t {
    kUnits,     // uint16
    kPacked12,  // two pixels in three bytes, the low bits of both in the last
    kMetres     // float
  };
  Kind kind = kUnits;
  bool is_range = false;  // distance from the camera's centre, else z
};

// How much light came back to each pixel of a depth image; no data: that is not known.
struct AmplitudeView {
  ByteView bytes;
  int32_t pixel_bytes = 1;  // 2: little-endian
};

}  // namespace sphc
