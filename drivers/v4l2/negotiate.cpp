#include "negotiate.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <iterator>

#include "capability.h"
#include "drivers/pixels/explain.h"

namespace sphc::v4l2 {

namespace {

using pixels::explain;

constexpr uint32_t kMaxBufferBytes = 1u << 28;

struct Candidates {
  uint32_t count = 0;
  uint32_t fourccs[OfferedFourccs::kMax];
};

bool hasWish(const sphc_v4l2_config &config) {
  return std::any_of(std::begin(config.fourccs), std::end(config.fourccs), [](uint32_t wish) { return wish != 0; });
}

// The caller's wish, or ours when there is none, as far as the device has it.
Candidates findCandidates(const sphc_v4l2_config &config, const OfferedFourccs &offered) {
  Candidates candidates;
  const auto take = [&](uint32_t fourcc) {
    if (fourcc != 0 && offered.contains(fourcc)) candidates.fourccs[candidates.count++] = fourcc;
  };
  if (hasWish(config))
    std::for_each(std::begin(config.fourccs), std::end(config.fourccs), take);
  else
    for (const uint32_t *ours = preferredFourccs(config.format); *ours != 0; ++ours) take(*ours);
  return candidates;
}

sphc_status explainNoCandidate(const Node &node, const sphc_v4l2_config &config, const OfferedFourccs &offered,
                               sphc_message *message) {
  char list[64] = "nothing";
  size_t used = 0;
  for (uint32_t i = 0; i < offered.count && used + 6 < sizeof list; ++i)
    used += static_cast<size_t>(
        std::snprintf(list + used, sizeof list - used, "%s%s", i ? " " : "", fourccText(offered.fourccs[i]).text));
  return explain(message, SPHC_E_UNSUPPORTED, "%s offers %s, but no %s; another node of the camera may",
                 node.path(), list,
                 hasWish(config)                      ? "layout of config.fourccs"
                 : config.stream == SPHC_STREAM_DEPTH ? "depth (Z16, Y16)"
                                                      : "colour that this driver knows");
}

// The rate; leaves 0 / 0 when the device has no say in it.
sphc_status setPeriod(const Node &node, const sphc_v4l2_config &config, Mode *mode, sphc_message *message) {
  v4l2_streamparm parameters = {};
  parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  parameters.parm.capture.timeperframe = {1, config.fps};
  const int error = node.ioctl(config.fps ? VIDIOC_S_PARM : VIDIOC_G_PARM, &parameters);
  if (error == ENOTTY || error == EINVAL) return SPHC_OK;
  if (error) return node.explain(message, config.fps ? "VIDIOC_S_PARM" : "VIDIOC_G_PARM", error);
  const v4l2_fract period = parameters.parm.capture.timeperframe;
  if (!(parameters.parm.capture.capability & V4L2_CAP_TIMEPERFRAME) || period.numerator == 0 ||
      period.denominator == 0)
    return SPHC_OK;
  mode->period_numerator = period.numerator;
  mode->period_denominator = period.denominator;
  const double fps = double{1} * period.denominator / period.numerator;
  if (config.fps && (fps < 0.99 * config.fps || fps > 1.01 * config.fps)) mode->adjusted |= SPHC_V4L2_ADJUSTED_FPS;
  return SPHC_OK;
}

// The device is not believed: sizes that cannot be must not reach the buffers.
sphc_status checkFormat(const Node &node, const v4l2_pix_format &pix, const Mode *mode, sphc_message *message) {
  if (mode->width < SPHC_CAMERA_MIN_PX || mode->height < SPHC_CAMERA_MIN_PX || mode->width > SPHC_CAMERA_MAX_PX ||
      mode->height > SPHC_CAMERA_MAX_PX)
    return explain(message, SPHC_E_UNSUPPORTED, "%s gives %u x %u pixels; must be %u to %u a side", node.path(),
                   mode->width, mode->height, SPHC_CAMERA_MIN_PX, SPHC_CAMERA_MAX_PX);
  if (pix.field != V4L2_FIELD_NONE && pix.field != V4L2_FIELD_ANY)
    return explain(message, SPHC_E_UNSUPPORTED,
                   "%s gives interlaced pictures (field %u); only whole ones are taken", node.path(), pix.field);
  const uint8_t *somewhere = reinterpret_cast<const uint8_t *>(mode);  // sizes are looked at, not bytes
  sphc_message text = {};
  const bool fits = mode->pixel_format.is_jpeg
                        ? mode->buffer_bytes >= 1
                        : pixels::checkRaw(mode->rawImage(somewhere, mode->buffer_bytes), &text) == SPHC_OK;
  if (fits && mode->buffer_bytes <= kMaxBufferBytes) return SPHC_OK;
  return explain(message, SPHC_E_UNSUPPORTED, "%s offers a mode that cannot be: buffers of %u bytes. %s",
                 node.path(), mode->buffer_bytes, text.text);
}

// Where the device names no range, that of its colour space counts.
pixels::YuvRange rangeOf(const v4l2_pix_format &pix) {
  const bool is_default = pix.quantization == V4L2_QUANTIZATION_DEFAULT;
  const bool is_full =
      is_default ? pix.colorspace == V4L2_COLORSPACE_JPEG : pix.quantization == V4L2_QUANTIZATION_FULL_RANGE;
  return is_full ? pixels::YuvRange::Full : pixels::YuvRange::Limited;
}

sphc_status fillMode(const Node &node, const sphc_v4l2_config &config, uint32_t fourcc, const v4l2_pix_format &pix,
                     Mode *mode, sphc_message *message) {
  const PixelFormat *format = findPixelFormat(pix.pixelformat);
  if (!format || format->stream != config.stream)
    return explain(message, SPHC_E_UNSUPPORTED,
                   "%s silently took %s instead of %s, of no use for this stream; another node may have it",
                   node.path(), fourccText(pix.pixelformat).text, fourccText(fourcc).text);
  *mode = {};
  mode->pixel_format = *format;
  mode->range = rangeOf(pix);
  mode->width = pix.width;
  mode->height = pix.height;
  mode->buffer_bytes = pix.sizeimage;
  if (!format->is_jpeg)  // some drivers leave the stride out when there is no padding
    mode->stride_bytes = pix.bytesperline ? pix.bytesperline : pixels::rowBytes(format->layout, pix.width);
  if (pix.pixelformat != fourcc) mode->adjusted |= SPHC_V4L2_ADJUSTED_FOURCC;
  if (pix.width != config.width || pix.height != config.height) mode->adjusted |= SPHC_V4L2_ADJUSTED_SIZE;
  return checkFormat(node, pix, mode, message);
}

sphc_status setMode(const Node &node, const sphc_v4l2_config &config, uint32_t fourcc, Mode *mode,
                    sphc_message *message) {
  v4l2_format format = {};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  format.fmt.pix.width = config.width;
  format.fmt.pix.height = config.height;
  format.fmt.pix.pixelformat = fourcc;
  format.fmt.pix.field = V4L2_FIELD_NONE;
  if (const int error = node.ioctl(VIDIOC_S_FMT, &format)) return node.explain(message, "VIDIOC_S_FMT", error);
  const sphc_status status = fillMode(node, config, fourcc, format.fmt.pix, mode, message);
  return status < 0 ? status : setPeriod(node, config, mode, message);
}

sphc_status explainAdjusted(const Node &node, const sphc_v4l2_config &config, uint32_t fourcc, const Mode &mode,
                            sphc_message *message) {
  return explain(message, SPHC_E_UNSUPPORTED,
                 "%s: asked for %s %u x %u at %u fps, it takes %s %u x %u at %u/%u s a frame; ask for that, or set "
                 "config.allow_adjusting",
                 node.path(), fourccText(fourcc).text, config.width, config.height, config.fps,
                 fourccText(mode.pixel_format.fourcc).text, mode.width, mode.height, mode.period_numerator,
                 mode.period_denominator);
}

}  // namespace

pixels::RawImage Mode::rawImage(const uint8_t *data, size_t bytes) const {
  return pixels::contiguous(pixel_format.layout, range, width, height, stride_bytes, data, bytes);
}

sphc_status negotiate(const Node &node, const sphc_v4l2_config &config, Mode *mode, sphc_message *message) {
  OfferedFourccs offered;
  if (const int error = readOfferedFourccs(node, &offered)) return node.explain(message, "VIDIOC_ENUM_FMT", error);
  const Candidates candidates = findCandidates(config, offered);
  if (candidates.count == 0) return explainNoCandidate(node, config, offered, message);

  uint32_t nearest = 0;  // fourcc of the first that would do with adjusting
  Mode nearest_mode = {};
  sphc_status status = SPHC_OK;
  for (uint32_t i = 0; i < candidates.count; ++i) {
    status = setMode(node, config, candidates.fourccs[i], mode, message);
    if (status == SPHC_OK && mode->adjusted == 0) return SPHC_OK;
    if (status != SPHC_OK && status != SPHC_E_UNSUPPORTED) return status;
    if (status == SPHC_OK && nearest == 0) {
      nearest = candidates.fourccs[i];
      nearest_mode = *mode;
    }
  }
  if (nearest == 0) return status;
  if (!config.allow_adjusting) return explainAdjusted(node, config, nearest, nearest_mode, message);
  return setMode(node, config, nearest, mode, message);  // later tries have changed it
}

}  // namespace sphc::v4l2
