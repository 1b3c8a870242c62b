#include "host/recording/foreign/silent_ffmpeg.h"

extern "C" {
#include <libavutil/log.h>
}

#include <mutex>

namespace sphc::recording {

namespace {

std::mutex silence_mutex;
int silent_count = 0, level_before = 0;

}  // namespace

SilentFfmpeg::SilentFfmpeg() {
  const std::lock_guard lock(silence_mutex);
  if (silent_count++ > 0) return;
  level_before = av_log_get_level();
  av_log_set_level(AV_LOG_QUIET);
}

SilentFfmpeg::~SilentFfmpeg() {
  const std::lock_guard lock(silence_mutex);
  if (--silent_count == 0) av_log_set_level(level_before);
}

}  // namespace sphc::recording
