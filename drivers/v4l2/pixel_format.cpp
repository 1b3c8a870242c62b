#include "pixel_format.h"

#include <linux/videodev2.h>

namespace sphc::v4l2 {

namespace {

using pixels::Layout;

constexpr PixelFormat kPixelFormats[] = {
    {V4L2_PIX_FMT_GREY, SPHC_STREAM_COLOR, false, Layout::Grey},
    {V4L2_PIX_FMT_NV12, SPHC_STREAM_COLOR, false, Layout::Nv12},
    {V4L2_PIX_FMT_YUYV, SPHC_STREAM_COLOR, false, Layout::Yuyv},
    {V4L2_PIX_FMT_UYVY, SPHC_STREAM_COLOR, false, Layout::Uyvy},
    {V4L2_PIX_FMT_RGB24, SPHC_STREAM_COLOR, false, Layout::Rgb24},
    {V4L2_PIX_FMT_BGR24, SPHC_STREAM_COLOR, false, Layout::Bgr24},
    {V4L2_PIX_FMT_XBGR32, SPHC_STREAM_COLOR, false, Layout::Bgrx32},
    {V4L2_PIX_FMT_MJPEG, SPHC_STREAM_COLOR, true, Layout::Grey},
    {V4L2_PIX_FMT_JPEG, SPHC_STREAM_COLOR, true, Layout::Grey},
    {V4L2_PIX_FMT_Z16, SPHC_STREAM_DEPTH, false, Layout::Depth16},
    {V4L2_PIX_FMT_Y16, SPHC_STREAM_DEPTH, false, Layout::Depth16},
};

constexpr uint32_t kForGray[] = {
    V4L2_PIX_FMT_GREY,  V4L2_PIX_FMT_NV12,   V4L2_PIX_FMT_YUYV,  V4L2_PIX_FMT_UYVY, V4L2_PIX_FMT_RGB24,
    V4L2_PIX_FMT_BGR24, V4L2_PIX_FMT_XBGR32, V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_JPEG, 0};
// Without colour comes last.
constexpr uint32_t kForColor[] = {
    V4L2_PIX_FMT_RGB24, V4L2_PIX_FMT_BGR24, V4L2_PIX_FMT_XBGR32, V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_UYVY,
    V4L2_PIX_FMT_NV12,  V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_JPEG,   V4L2_PIX_FMT_GREY, 0};
constexpr uint32_t kForDepth[] = {V4L2_PIX_FMT_Z16, V4L2_PIX_FMT_Y16, 0};

}  // namespace

const PixelFormat *findPixelFormat(uint32_t fourcc) {
  for (const PixelFormat &format : kPixelFormats)
    if (format.fourcc == fourcc) return &format;
  return nullptr;
}

const uint32_t *preferredFourccs(sphc_format format) {
  return format == SPHC_FORMAT_DEPTH16 ? kForDepth : format == SPHC_FORMAT_GRAY8 ? kForGray : kForColor;
}

FourccText fourccText(uint32_t fourcc) {
  FourccText result = {};
  for (int i = 0; i < 4; ++i) {
    const char letter = static_cast<char>(fourcc >> 8 * i);
    result.text[i] = letter >= ' ' && letter <= '~' ? letter : '?';
  }
  return result;
}

}  // namespace sphc::v4l2
