#include "frame_check.h"

#include "explain.h"
#include "streams.h"

namespace sphc::openni2 {

sphc_format formatOf(OniPixelFormat format) {
  switch (format) {
    case ONI_PIXEL_FORMAT_RGB888:
      return SPHC_FORMAT_RGB8;
    case ONI_PIXEL_FORMAT_GRAY8:
      return SPHC_FORMAT_GRAY8;
    case ONI_PIXEL_FORMAT_DEPTH_1_MM:
    case ONI_PIXEL_FORMAT_DEPTH_100_UM:
      return SPHC_FORMAT_DEPTH16;
    default:
      return 0;
  }
}

sphc_status checkFrame(const OniFrame &frame, int stream, const OniVideoMode &mode, sphc_message *message) {
  const OniVideoMode &its = frame.videoMode;
  if (frame.width != mode.resolutionX || frame.height != mode.resolutionY || its.pixelFormat != mode.pixelFormat)
    return explain(message, SPHC_E_IMAGE,
                   "a %s frame of %d x %d, format %d, came in a stream of %d x %d, format %d; it was thrown away",
                   kStreamNames[stream], frame.width, frame.height, static_cast<int>(its.pixelFormat),
                   mode.resolutionX, mode.resolutionY, static_cast<int>(mode.pixelFormat));
  const int64_t row_bytes = int64_t{frame.width} * sphc_format_bytes(formatOf(mode.pixelFormat));
  const int64_t needed_bytes = (int64_t{frame.height} - 1) * frame.stride + row_bytes;
  if (!frame.data || frame.stride < row_bytes || frame.dataSize < needed_bytes)
    return explain(
        message, SPHC_E_IMAGE,
        "a %s frame of %d x %d came with %d bytes in rows of %d; it needs %lld in rows of %lld at least; "
        "it was thrown away",
        kStreamNames[stream], frame.width, frame.height, frame.data ? frame.dataSize : 0, frame.stride,
        static_cast<long long>(needed_bytes), static_cast<long long>(row_bytes));
  return SPHC_OK;
}

}  // namespace sphc::openni2
