// Images of FFmpeg's decoders as BGR8, by its libswscale.
#pragma once

#include <spherecloud/spherecloud.h>

#include <memory>

#include "host/recording/foreign/ffmpeg.h"

struct SwsContext;

namespace sphc::recording {

class BgrPixels {
 public:
  // Valid until the next call.  Throws Failure without a name: UNSUPPORTED where libswscale does not know the
  // pixels.
  sphc_image of(const AVFrame &frame);

 private:
  struct Deleter {
    void operator()(SwsContext *owned) const;
  };

  void prepare(const AVFrame &frame);

  std::unique_ptr<SwsContext, Deleter> scaler_;
  ffmpeg::Frame bgr_;
  int format_ = AV_PIX_FMT_NONE;
  bool is_full_range_ = false;
};

}  // namespace sphc::recording
