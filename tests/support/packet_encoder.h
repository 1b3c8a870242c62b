// Video as a headset's encoder sends it: a packet for each image, by FFmpeg's libavcodec.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/opt.h>
}

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sphc::test {

struct EncoderSettings {
  const char *codec;  // libx264 or libx265
  int width, height;
  int image_count;
  int key_every = 250;
  int b_frames = 0;
  bool is_full_range = false;
};
// Of plane 0 (Y), 1 (U) or 2 (V) of an image; U and V have half of the columns and rows.
using PixelOf = std::function<uint8_t(int image, int plane, int column, int row)>;

inline bool hasEncoder(const char *codec) { return avcodec_find_encoder_by_name(codec) != nullptr; }

inline void fill(AVFrame *frame, int image, const PixelOf &pixel_of) {
  av_frame_make_writable(frame);
  for (const int plane : {0, 1, 2})
    for (int row = 0; row < frame->height / (plane == 0 ? 1 : 2); ++row)
      for (int column = 0; column < frame->width / (plane == 0 ? 1 : 2); ++column)
        frame->data[plane][row * frame->linesize[plane] + column] = pixel_of(image, plane, column, row);
  frame->pts = image;
}

using TakePacket = std::function<void(const AVCodecContext &, AVPacket *)>;

// In the order in which they are decoded.
inline void encode(const EncoderSettings &settings, const PixelOf &pixel_of, const TakePacket &take) {
  AVCodecContext *context = avcodec_alloc_context3(avcodec_find_encoder_by_name(settings.codec));
  context->width = settings.width;
  context->height = settings.height;
  context->pix_fmt = AV_PIX_FMT_YUV420P;
  context->color_range = settings.is_full_range ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
  context->time_base = {1, 30};
  context->gop_size = settings.key_every;
  context->max_b_frames = settings.b_frames;
  context->thread_count = 1;
  if (context->codec_id == AV_CODEC_ID_MPEG4) context->qmax = 2;  // it knows no crf
  context->log_level_offset = 100;                                // silent
  if (settings.b_frames == 0) av_opt_set(context->priv_data, "tune", "zerolatency", 0);
  av_opt_set(context->priv_data, "preset", "ultrafast", 0);
  av_opt_set(context->priv_data, "crf", "4", 0);
  av_opt_set(context->priv_data, "x264-params", "aud=1:repeat-headers=1:scenecut=0", 0);
  av_opt_set(context->priv_data, "x265-params",
             "log-level=none:repeat-headers=1:pools=none:frame-threads=1:scenecut=0", 0);
  if (avcodec_open2(context, nullptr, nullptr) < 0) throw std::runtime_error("the encoder does not open");
  AVFrame *frame = av_frame_alloc();
  frame->format = AV_PIX_FMT_YUV420P;
  frame->width = settings.width;
  frame->height = settings.height;
  av_frame_get_buffer(frame, 0);
  AVPacket *packet = av_packet_alloc();
  for (int i = 0; i <= settings.image_count; ++i) {
    if (i < settings.image_count) fill(frame, i, pixel_of);
    avcodec_send_frame(context, i < settings.image_count ? frame : nullptr);
    while (avcodec_receive_packet(context, packet) == 0) {
      take(*context, packet);
      av_packet_unref(packet);
    }
  }
  av_packet_free(&packet);
  av_frame_free(&frame);
  avcodec_free_context(&context);
}

inline std::vector<std::string> encodedPackets(const EncoderSettings &settings, const PixelOf &pixel_of) {
  std::vector<std::string> packets;
  encode(settings, pixel_of, [&](const AVCodecContext &, const AVPacket *packet) {
    packets.emplace_back(reinterpret_cast<const char *>(packet->data), static_cast<size_t>(packet->size));
  });
  return packets;
}

}  // namespace sphc::test
