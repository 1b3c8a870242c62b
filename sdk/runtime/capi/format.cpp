#include "runtime/capi/format.h"

namespace sphc {
namespace {

constexpr sphc_format kFirstBayer = SPHC_FORMAT_BAYER_RGGB8, kLastBayer = SPHC_FORMAT_BAYER_BGGR12P;

PixelFormat luma(LumaLayout::Kind kind, uint8_t group_bytes, uint8_t group_pixels = 1, uint8_t first = 0) {
  PixelFormat format;
  format.group_pixels = group_pixels;
  format.group_bytes = group_bytes;
  format.luma = {kind, group_pixels, group_bytes, first, 8, LumaLayout::kNoFilter};
  return format;
}

PixelFormat words(uint8_t bits) {
  PixelFormat format = luma(LumaLayout::kWords, 2);
  format.luma.bits = bits;
  return format;
}

PixelFormat depth(DepthLayout::Kind kind, bool is_range, uint8_t group_bytes, uint8_t group_pixels,
                  uint8_t alignment) {
  PixelFormat format;
  format.is_depth = true;
  format.group_pixels = group_pixels;
  format.group_bytes = group_bytes;
  format.alignment = alignment;
  format.depth = {kind, is_range};
  return format;
}

// Four orders of the filter for each packing of grey.
PixelFormat bayer(sphc_format format) {
  constexpr sphc_format kPackings[] = {SPHC_FORMAT_GRAY8,  SPHC_FORMAT_GRAY10,  SPHC_FORMAT_GRAY12,
                                       SPHC_FORMAT_GRAY16, SPHC_FORMAT_GRAY10P, SPHC_FORMAT_GRAY12P};
  const int32_t place = format - kFirstBayer, order = place % 4;
  PixelFormat found = pixelFormatOf(kPackings[place / 4]);
  const bool green_first = order == 1 || order == 2;
  found.luma.green = green_first ? LumaLayout::kGreenEven : LumaLayout::kGreenOdd;
  return found;
}

}  // namespace

PixelFormat pixelFormatOf(sphc_format format) {
  if (format >= kFirstBayer && format <= kLastBayer) return bayer(format);
  switch (format) {
    case SPHC_FORMAT_GRAY8:
    case SPHC_FORMAT_NV12:
    case SPHC_FORMAT_I420:
      return luma(LumaLayout::kPlane, 1);
    case SPHC_FORMAT_RGB8:
    case SPHC_FORMAT_RGBA8:
      return luma(LumaLayout::kRgb, format == SPHC_FORMAT_RGB8 ? 3 : 4);
    case SPHC_FORMAT_BGR8:
    case SPHC_FORMAT_BGRA8:
      return luma(LumaLayout::kBgr, format == SPHC_FORMAT_BGR8 ? 3 : 4);
    case SPHC_FORMAT_YUYV:
    case SPHC_FORMAT_UYVY:
      return luma(LumaLayout::kBytes, 2, 1, format == SPHC_FORMAT_YUYV ? 0 : 1);
    case SPHC_FORMAT_GRAY10:
      return words(10);
    case SPHC_FORMAT_GRAY12:
      return words(12);
    case SPHC_FORMAT_GRAY16:
      return words(16);
    case SPHC_FORMAT_GRAY10P:
      return luma(LumaLayout::kBytes, 5, 4);
    case SPHC_FORMAT_GRAY12P:
      return luma(LumaLayout::kBytes, 3, 2);
    case SPHC_FORMAT_DEPTH16:
    case SPHC_FORMAT_RANGE16:
      return depth(DepthLayout::kUnits, format == SPHC_FORMAT_RANGE16, 2, 1, 2);
    case SPHC_FORMAT_DEPTH12P:
    case SPHC_FORMAT_RANGE12P:
      return depth(DepthLayout::kPacked12, format == SPHC_FORMAT_RANGE12P, 3, 2, 1);
    case SPHC_FORMAT_DEPTH_F32:
    case SPHC_FORMAT_RANGE_F32:
      return depth(DepthLayout::kMetres, format == SPHC_FORMAT_RANGE_F32, 4, 1, 4);
    default:
      return {};
  }
}

}  // namespace sphc

uint32_t sphc_format_bytes(sphc_format format) {
  const sphc::PixelFormat known = sphc::pixelFormatOf(format);
  return known.group_pixels == 1 ? known.group_bytes : 0;
}

uint32_t sphc_format_row_bytes(sphc_format format, uint32_t width) {
  const sphc::PixelFormat known = sphc::pixelFormatOf(format);
  const uint64_t bytes = uint64_t{width / known.group_pixels} * known.group_bytes;
  return width % known.group_pixels || bytes > UINT32_MAX ? 0 : static_cast<uint32_t>(bytes);
}
