// While one lives, FFmpeg writes no log: its demuxers and libswscale know the level of the whole program alone.
#pragma once

namespace sphc::recording {

class SilentFfmpeg {
 public:
  SilentFfmpeg();
  ~SilentFfmpeg();
  SilentFfmpeg(const SilentFfmpeg &) = delete;
  SilentFfmpeg &operator=(const SilentFfmpeg &) = delete;
};

}  // namespace sphc::recording
