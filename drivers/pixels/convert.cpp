#include "convert.h"

#include <cstring>

#include "explain.h"

namespace sphc::pixels {

namespace {

// Products with 16 bits behind the point.
struct YuvMatrix {
  int32_t y_offset, y, r_from_v, g_from_u, g_from_v, b_from_u;
};
constexpr int32_t kBits = 16;
constexpr YuvMatrix kLimited = {16, 76309, 104597, -25675, -53279, 132201};
constexpr YuvMatrix kFull = {0, 65536, 91881, -22554, -46802, 116130};

// What U and V add to red, green and blue; two pixels share it.
struct Chroma {
  int32_t r, g, b;
};
Chroma chromaOf(const YuvMatrix &matrix, int32_t u, int32_t v) {
  return {matrix.r_from_v * (v - 128), matrix.g_from_u * (u - 128) + matrix.g_from_v * (v - 128),
          matrix.b_from_u * (u - 128)};
}

// Without a branch, which noise would make the processor guess wrong.
uint8_t clampToByte(int32_t value) {
  const int32_t whole = value >> kBits;
  const int32_t not_negative = whole & ~(whole >> 31);
  return static_cast<uint8_t>(not_negative | ((255 - not_negative) >> 31));
}

// Where Y, U and V of pixels 2 i and 2 i + 1 stand in their rows.
struct PairOffsets {
  uint32_t y0, y1, y_step, u, v, uv_step;
};
constexpr PairOffsets kYuyv = {0, 2, 4, 1, 3, 4}, kUyvy = {1, 3, 4, 0, 2, 4}, kNv12 = {0, 1, 2, 0, 1, 2};

PairOffsets offsetsOf(Layout layout) {
  return layout == Layout::Nv12 ? kNv12 : layout == Layout::Yuyv ? kYuyv : kUyvy;
}

template <uint32_t kRed>  // where red goes: 0 or 2
void storePixel(const YuvMatrix &matrix, int32_t y, Chroma chroma, uint8_t *pixel) {
  const int32_t luma = (y - matrix.y_offset) * matrix.y + (1 << (kBits - 1));
  pixel[kRed] = clampToByte(luma + chroma.r);
  pixel[1] = clampToByte(luma + chroma.g);
  pixel[2 - kRed] = clampToByte(luma + chroma.b);
}

template <uint32_t kRed>
void yuvRow(PairOffsets at, const YuvMatrix &matrix, const uint8_t *luma, const uint8_t *chroma, uint32_t width,
            uint8_t *out) {
  for (uint32_t i = 0; i < width / 2; ++i) {
    const Chroma pair = chromaOf(matrix, chroma[i * at.uv_step + at.u], chroma[i * at.uv_step + at.v]);
    storePixel<kRed>(matrix, luma[i * at.y_step + at.y0], pair, out + 6 * i);
    storePixel<kRed>(matrix, luma[i * at.y_step + at.y1], pair, out + 6 * i + 3);
  }
}

void lumaRow(PairOffsets at, const uint8_t *luma, uint32_t width, uint8_t *out) {
  for (uint32_t i = 0; i < width / 2; ++i) {
    out[2 * i] = luma[i * at.y_step + at.y0];
    out[2 * i + 1] = luma[i * at.y_step + at.y1];
  }
}

// Both start with the place of red: 0 or 2.
template <uint32_t kRawBytes>
void rgbRow(bool swap, const uint8_t *raw, uint32_t width, uint8_t *out) {
  const uint32_t first = swap ? 2 : 0;
  for (uint32_t x = 0; x < width; ++x, raw += kRawBytes, out += 3) {
    out[0] = raw[first];
    out[1] = raw[1];
    out[2] = raw[2 - first];
  }
}

template <uint32_t kRawBytes>
void weighRow(bool red_first, const uint8_t *raw, uint32_t width, uint8_t *out) {
  const uint32_t red = red_first ? 0 : 2;
  for (uint32_t x = 0; x < width; ++x, raw += kRawBytes)
    out[x] = static_cast<uint8_t>((77u * raw[red] + 150u * raw[1] + 29u * raw[2 - red] + 128u) >> 8);
}

void depthRow(const uint8_t *raw, uint32_t width, uint8_t *out) {
  for (uint32_t x = 0; x < width; ++x) {
    const uint16_t units = static_cast<uint16_t>(raw[2 * x] | raw[2 * x + 1] << 8);
    std::memcpy(out + 2 * x, &units, sizeof units);
  }
}

void yuvImageRow(const RawImage &raw, uint32_t y, sphc_format format, uint8_t *out) {
  const PairOffsets at = offsetsOf(raw.layout);
  const uint8_t *luma = raw.planes[0].data + size_t{y} * raw.planes[0].stride_bytes;
  const uint8_t *chroma =
      raw.layout == Layout::Nv12 ? raw.planes[1].data + size_t{y / 2} * raw.planes[1].stride_bytes : luma;
  const YuvMatrix &matrix = raw.range == YuvRange::Full ? kFull : kLimited;
  if (format == SPHC_FORMAT_GRAY8)
    lumaRow(at, luma, raw.width, out);
  else if (format == SPHC_FORMAT_RGB8)
    yuvRow<0>(at, matrix, luma, chroma, raw.width, out);
  else
    yuvRow<2>(at, matrix, luma, chroma, raw.width, out);
}

template <uint32_t kRawBytes>
void rgbImageRow(bool red_first, const uint8_t *raw, uint32_t width, sphc_format format, uint8_t *out) {
  if (format == SPHC_FORMAT_GRAY8)
    weighRow<kRawBytes>(red_first, raw, width, out);
  else
    rgbRow<kRawBytes>(red_first != (format == SPHC_FORMAT_RGB8), raw, width, out);
}

void greyRow(const uint8_t *raw, uint32_t width, sphc_format format, uint8_t *out) {
  if (format == SPHC_FORMAT_GRAY8)
    std::memcpy(out, raw, width);
  else
    for (uint32_t x = 0; x < width; ++x) std::memset(out + 3 * x, raw[x], 3);
}

void convertRow(const RawImage &raw, uint32_t y, sphc_format format, uint8_t *out) {
  const uint8_t *row = raw.planes[0].data + size_t{y} * raw.planes[0].stride_bytes;
  switch (raw.layout) {
    case Layout::Grey:
      return greyRow(row, raw.width, format, out);
    case Layout::Yuyv:
    case Layout::Uyvy:
    case Layout::Nv12:
      return yuvImageRow(raw, y, format, out);
    case Layout::Rgb24:
    case Layout::Bgr24:
      return rgbImageRow<3>(raw.layout == Layout::Rgb24, row, raw.width, format, out);
    case Layout::Bgrx32:
      return rgbImageRow<4>(false, row, raw.width, format, out);
    case Layout::Depth16:
      return depthRow(row, raw.width, out);
  }
}

}  // namespace

bool canConvert(Layout layout, sphc_format format) {
  return isDelivered(format) && (layout == Layout::Depth16) == (format == SPHC_FORMAT_DEPTH16);
}

sphc_status convert(const RawImage &raw, const OutImage &out, sphc_message *message) {
  sphc_status status = checkRaw(raw, message);
  if (status == SPHC_OK) status = checkOut(out, message);
  if (status < 0) return status;
  if (!canConvert(raw.layout, out.format))
    return explain(message, SPHC_E_UNSUPPORTED,
                   "depth becomes DEPTH16, everything else GRAY8, RGB8 or BGR8; not %d", out.format);
  if (raw.width != out.width || raw.height != out.height)
    return explain(message, SPHC_E_IMAGE, "the camera's image is %u x %u pixels, the output %u x %u; must be equal",
                   raw.width, raw.height, out.width, out.height);
  for (uint32_t y = 0; y < raw.height; ++y) convertRow(raw, y, out.format, out.data + size_t{y} * out.stride_bytes);
  return SPHC_OK;
}

}  // namespace sphc::pixels
