// Video as a headset's encoder sends it: a packet for each image, by FFmpeg's libavcodec.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/opt.h>
}

#include <stdexcept>
#include <string>
#include <vector>

namespace sphc::test {

// `codec` is libx264 or libx265; images are of one grey each, given by `grey`.  The first stands by itself, the
// others do not.
inline std::vector<std::string> encodedGreys(const char *codec, int width, int height,
                                             const std::vector<uint8_t> &greys) {
  const AVCodec *found = avcodec_find_encoder_by_name(codec);
  if (!found) throw std::runtime_error(std::string("no encoder ") + codec);
  av_log_set_level(AV_LOG_FATAL);
  AVCodecContext *context = avcodec_alloc_context3(found);
  context->width = width;
  context->height = height;
  context->pix_fmt = AV_PIX_FMT_YUV420P;
  context->time_base = {1, 30};
  context->gop_size = 250;
  context->max_b_frames = 0;
  context->thread_count = 1;
  av_opt_set(context->priv_data, "tune", "zerolatency", 0);
  av_opt_set(context->priv_data, "preset", "ultrafast", 0);
  av_opt_set(context->priv_data, "x264-params", "aud=1:repeat-headers=1", 0);
  av_opt_set(context->priv_data, "x265-params", "log-level=none:repeat-headers=1:pools=none:frame-threads=1", 0);
  if (avcodec_open2(context, found, nullptr) < 0) throw std::runtime_error("the encoder does not open");
  AVFrame *frame = av_frame_alloc();
  frame->format = AV_PIX_FMT_YUV420P;
  frame->width = width;
  frame->height = height;
  av_frame_get_buffer(frame, 0);
  AVPacket *packet = av_packet_alloc();
  std::vector<std::string> packets;
  for (size_t i = 0; i <= greys.size(); ++i) {
    if (i < greys.size()) {
      av_frame_make_writable(frame);
      for (int row = 0; row < height; ++row)
        std::fill_n(frame->data[0] + row * frame->linesize[0], width, greys[i]);
      for (const int plane : {1, 2})
        for (int row = 0; row < height / 2; ++row)
          std::fill_n(frame->data[plane] + row * frame->linesize[plane], width / 2, uint8_t{128});
      frame->pts = static_cast<int64_t>(i);
    }
    avcodec_send_frame(context, i < greys.size() ? frame : nullptr);
    while (avcodec_receive_packet(context, packet) == 0) {
      packets.emplace_back(reinterpret_cast<const char *>(packet->data), static_cast<size_t>(packet->size));
      av_packet_unref(packet);
    }
  }
  av_packet_free(&packet);
  av_frame_free(&frame);
  avcodec_free_context(&context);
  return packets;
}

}  // namespace sphc::test
