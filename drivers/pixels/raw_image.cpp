#include "raw_image.h"

#include "explain.h"

namespace sphc::pixels {

namespace {

bool isYuv(Layout layout) { return layout == Layout::Yuyv || layout == Layout::Uyvy || layout == Layout::Nv12; }

sphc_status checkSize(const char *what, uint32_t width, uint32_t height, sphc_message *message) {
  if (width >= 1 && height >= 1 && width <= SPHC_CAMERA_MAX_PX && height <= SPHC_CAMERA_MAX_PX) return SPHC_OK;
  return explain(message, SPHC_E_IMAGE, "%s is %u x %u pixels; must be 1 to %u a side", what, width, height,
                 SPHC_CAMERA_MAX_PX);
}

sphc_status checkPlane(const char *what, const void *data, size_t bytes, uint32_t stride_bytes, uint32_t row_bytes,
                       uint32_t rows, sphc_message *message) {
  if (!data) return explain(message, SPHC_E_IMAGE, "%s: data is null; give the pixels", what);
  if (stride_bytes < row_bytes || stride_bytes > SPHC_STRIDE_MAX_BYTES)
    return explain(message, SPHC_E_IMAGE, "%s: stride of %u bytes; must be %u, a row's, to %u", what, stride_bytes,
                   row_bytes, SPHC_STRIDE_MAX_BYTES);
  const uint64_t needed = imageBytes(row_bytes, stride_bytes, rows);
  if (bytes >= needed) return SPHC_OK;
  return explain(message, SPHC_E_IMAGE,
                 "%s: %zu bytes, but %u rows at a stride of %u take %llu; cut short in transfer?", what, bytes,
                 rows, stride_bytes, static_cast<unsigned long long>(needed));
}

}  // namespace

uint32_t rowBytes(Layout layout, uint32_t width) {
  switch (layout) {
    case Layout::Grey:
    case Layout::Nv12:
      return width;
    case Layout::Yuyv:
    case Layout::Uyvy:
    case Layout::Depth16:
      return 2 * width;
    case Layout::Rgb24:
    case Layout::Bgr24:
      return 3 * width;
    case Layout::Bgrx32:
      return 4 * width;
  }
  return 0;
}

uint64_t imageBytes(uint32_t row_bytes, uint32_t stride_bytes, uint32_t height) {
  return uint64_t{stride_bytes} * (height - 1) + row_bytes;
}

RawImage contiguous(Layout layout, YuvRange range, uint32_t width, uint32_t height, uint32_t stride_bytes,
                    const uint8_t *data, size_t bytes) {
  RawImage raw{layout, range, width, height, {{data, bytes, stride_bytes}, {}}};
  const uint64_t luma_bytes = uint64_t{stride_bytes} * height;
  if (layout == Layout::Nv12 && data && bytes > luma_bytes)
    raw.planes[1] = {data + luma_bytes, static_cast<size_t>(bytes - luma_bytes), stride_bytes};
  return raw;
}

sphc_status checkRaw(const RawImage &raw, sphc_message *message) {
  sphc_status status = checkSize("the camera's image", raw.width, raw.height, message);
  if (status < 0) return status;
  if (isYuv(raw.layout) && (raw.width % 2 != 0 || (raw.layout == Layout::Nv12 && raw.height % 2 != 0)))
    return explain(message, SPHC_E_IMAGE, "the camera's image is %u x %u pixels; pixels share their colour in twos",
                   raw.width, raw.height);
  const uint32_t row_bytes = rowBytes(raw.layout, raw.width);
  const Plane &first = raw.planes[0], &second = raw.planes[1];
  status =
      checkPlane("the camera's image", first.data, first.bytes, first.stride_bytes, row_bytes, raw.height, message);
  if (status < 0 || raw.layout != Layout::Nv12) return status;
  return checkPlane("the camera's chroma", second.data, second.bytes, second.stride_bytes, row_bytes,
                    raw.height / 2, message);
}

bool isDelivered(sphc_format format) {
  return format == SPHC_FORMAT_GRAY8 || format == SPHC_FORMAT_RGB8 || format == SPHC_FORMAT_BGR8 ||
         format == SPHC_FORMAT_DEPTH16;
}

sphc_status checkOut(const OutImage &out, sphc_message *message) {
  const uint32_t pixel_bytes = sphc_format_bytes(out.format);
  if (!isDelivered(out.format))
    return explain(message, SPHC_E_IMAGE, "the output's format is %d; it must be GRAY8, RGB8, BGR8 or DEPTH16",
                   out.format);
  const sphc_status status = checkSize("the output", out.width, out.height, message);
  if (status < 0) return status;
  return checkPlane("the output", out.data, out.bytes, out.stride_bytes, pixel_bytes * out.width, out.height,
                    message);
}

}  // namespace sphc::pixels
