#include "host/recording/foreign/bgr_pixels.h"

extern "C" {
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include "host/recording/foreign/silent_ffmpeg.h"

namespace sphc::recording {

namespace {

bool isFullRange(const AVFrame &frame) { return frame.color_range == AVCOL_RANGE_JPEG; }

}  // namespace

void BgrPixels::Deleter::operator()(SwsContext *owned) const { sws_freeContext(owned); }

sphc_image BgrPixels::of(const AVFrame &frame) {
  const SilentFfmpeg silent;
  if (!scaler_ || frame.width != bgr_->width || frame.height != bgr_->height || frame.format != format_ ||
      isFullRange(frame) != is_full_range_)
    prepare(frame);
  sws_scale(scaler_.get(), frame.data, frame.linesize, 0, frame.height, bgr_->data, bgr_->linesize);
  return {bgr_->data[0], static_cast<uint32_t>(bgr_->width), static_cast<uint32_t>(bgr_->height),
          static_cast<uint32_t>(bgr_->linesize[0]), SPHC_FORMAT_BGR8};
}

void BgrPixels::prepare(const AVFrame &frame) {
  bgr_.reset(ffmpeg::made(av_frame_alloc()));
  bgr_->width = frame.width;
  bgr_->height = frame.height;
  bgr_->format = AV_PIX_FMT_BGR24;
  if (av_frame_get_buffer(bgr_.get(), 0) < 0) throw std::bad_alloc();  // with room behind rows for wide registers
  format_ = frame.format;
  is_full_range_ = isFullRange(frame);
  scaler_.reset(ffmpeg::made(sws_alloc_context()));
  const struct {
    const char *name;
    int64_t value;
  } options[] = {
      {"srcw", frame.width}, {"srch", frame.height}, {"src_format", format_},      {"src_range", is_full_range_},
      {"dstw", frame.width}, {"dsth", frame.height}, {"dst_format", bgr_->format}, {"sws_flags", SWS_BICUBIC},
  };
  for (const auto &option : options) av_opt_set_int(scaler_.get(), option.name, option.value, 0);
  if (sws_init_context(scaler_.get(), nullptr, nullptr) < 0) {
    scaler_ = nullptr;
    throw Failure(SPHC_E_UNSUPPORTED, "is video of pixels that libswscale does not convert; record it in 4:2:0");
  }
}

}  // namespace sphc::recording
