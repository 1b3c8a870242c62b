#include "modes.h"

#include <cstdio>
#include <cstring>

#include "frame_check.h"
#include "streams.h"

namespace sphc::openni2 {

namespace {

constexpr int kMinSize = SPHC_CAMERA_MIN_PX, kMaxSize = SPHC_CAMERA_MAX_PX, kMaxRate = 1000;

const char *formatName(OniPixelFormat format) {
  switch (format) {
    case ONI_PIXEL_FORMAT_DEPTH_1_MM:
      return "DEPTH_1_MM";
    case ONI_PIXEL_FORMAT_DEPTH_100_UM:
      return "DEPTH_100_UM";
    case ONI_PIXEL_FORMAT_SHIFT_9_2:
      return "SHIFT_9_2";
    case ONI_PIXEL_FORMAT_SHIFT_9_3:
      return "SHIFT_9_3";
    case ONI_PIXEL_FORMAT_RGB888:
      return "RGB888";
    case ONI_PIXEL_FORMAT_YUV422:
      return "YUV422";
    case ONI_PIXEL_FORMAT_GRAY8:
      return "GRAY8";
    case ONI_PIXEL_FORMAT_GRAY16:
      return "GRAY16";
    case ONI_PIXEL_FORMAT_JPEG:
      return "JPEG";
    case ONI_PIXEL_FORMAT_YUYV:
      return "YUYV";
    default:
      return "?";
  }
}

bool isOrZero(uint32_t wanted, int value) { return wanted == 0 || wanted == static_cast<uint32_t>(value); }

bool same(const OniVideoMode &a, const OniVideoMode &b) {
  return a.pixelFormat == b.pixelFormat && a.resolutionX == b.resolutionX && a.resolutionY == b.resolutionY &&
         a.fps == b.fps;
}

}  // namespace

bool modeFits(const OniVideoMode &mode, int stream, const sphc_openni2_mode &wanted) {
  const sphc_format format = formatOf(mode.pixelFormat);
  const bool in_range = mode.resolutionX >= kMinSize && mode.resolutionX <= kMaxSize &&
                        mode.resolutionY >= kMinSize && mode.resolutionY <= kMaxSize && mode.fps >= 1 &&
                        mode.fps <= kMaxRate;
  return in_range && format != 0 && (format == SPHC_FORMAT_DEPTH16) == (stream == kDepth) &&
         isOrZero(wanted.width, mode.resolutionX) && isOrZero(wanted.height, mode.resolutionY) &&
         isOrZero(wanted.frames_per_s, mode.fps);
}

const OniVideoMode *chooseMode(const OniSensorInfo &offered, int stream, const sphc_openni2_mode &wanted,
                               const OniVideoMode &present) {
  const OniVideoMode *best = nullptr;
  for (int i = 0; i < offered.numSupportedVideoModes; ++i) {
    const OniVideoMode &mode = offered.pSupportedVideoModes[i];
    if (!modeFits(mode, stream, wanted)) continue;
    if (same(mode, present)) return &mode;
    const bool better_format =
        best && best->pixelFormat == ONI_PIXEL_FORMAT_GRAY8 && mode.pixelFormat != best->pixelFormat;
    if (!best || better_format) best = &mode;
  }
  return best;
}

ModeList::ModeList(const OniVideoMode *modes, int count) : text{} {
  size_t length = 0;
  for (int i = 0; i < count; ++i) {
    char one[64];
    std::snprintf(one, sizeof one, "%s%dx%d@%d %s", i == 0 ? "" : ", ", modes[i].resolutionX, modes[i].resolutionY,
                  modes[i].fps, formatName(modes[i].pixelFormat));
    if (length + std::strlen(one) + sizeof " ..." > sizeof text) {
      std::strcpy(text + length, " ...");
      return;
    }
    std::strcpy(text + length, one);
    length += std::strlen(one);
  }
}

}  // namespace sphc::openni2
