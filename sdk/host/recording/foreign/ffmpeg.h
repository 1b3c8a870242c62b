// Objects of FFmpeg's libavcodec with owners, and what its decoders tell of damage.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
}

#include <cstdint>
#include <memory>
#include <new>
#include <set>

#include "host/recording/failure.h"

namespace sphc::recording::ffmpeg {

constexpr int kSilent = 100;  // beyond every level of the log: failures are told by us, with a cause

struct Deleter {
  void operator()(AVCodecContext *owned) const { avcodec_free_context(&owned); }
  void operator()(AVPacket *owned) const { av_packet_free(&owned); }
  void operator()(AVFrame *owned) const { av_frame_free(&owned); }
};
using CodecContext = std::unique_ptr<AVCodecContext, Deleter>;
using Packet = std::unique_ptr<AVPacket, Deleter>;
using Frame = std::unique_ptr<AVFrame, Deleter>;

template <typename Made>
Made *made(Made *pointer) {
  if (!pointer) throw std::bad_alloc();
  return pointer;
}

// `of_file` is what a file says of its video, if there is one.  Threads would delay images and what is told of
// damage, and from damaged MPEG-4 they end the program.  Throws Failure (UNSUPPORTED) without a name.
inline CodecContext openedDecoder(AVCodecID code, const AVCodecParameters *of_file, uint64_t most_px) {
  const AVCodec *codec = avcodec_find_decoder(code);
  if (!codec) throw Failure(SPHC_E_UNSUPPORTED, "this build's libavcodec decodes no such video; install another");
  CodecContext context(made(avcodec_alloc_context3(codec)));
  if (of_file && avcodec_parameters_to_context(context.get(), of_file) < 0) throw std::bad_alloc();
  context->thread_count = 1;
  context->max_pixels = static_cast<int64_t>(most_px);
  context->err_recognition |= AV_EF_EXPLODE;
  context->log_level_offset = kSilent;
  if (avcodec_open2(context.get(), codec, nullptr) < 0)
    throw Failure(SPHC_E_UNSUPPORTED, "libavcodec does not open its decoder; install another");
  return context;
}

inline bool isKey(const AVFrame &frame) {
#ifdef AV_FRAME_FLAG_KEY
  return frame.flags & AV_FRAME_FLAG_KEY;
#else
  return frame.key_frame;
#endif
}

// Packets that are damaged, by their places in the order of decoding.
class Damage {
 public:
  void add(int64_t place) { places_.insert(place); }

  // Whether the image that came of the packet at this place goes on from damage.  Images come in the order in which
  // they are shown, so what comes after a key image goes on from nothing before that.
  bool reaches(const AVFrame &frame, int64_t place) {
    if (isKey(frame)) places_.erase(places_.begin(), places_.lower_bound(place));
    if ((frame.flags & AV_FRAME_FLAG_CORRUPT) || frame.decode_error_flags != 0) add(place);
    return !places_.empty() && *places_.begin() <= place;
  }

 private:
  std::set<int64_t> places_;
};

}  // namespace sphc::recording::ffmpeg
