// Video in an MP4 file, as a phone records it, by FFmpeg's libavformat.
#pragma once

extern "C" {
#include <libavformat/avformat.h>
}

#include <stdexcept>
#include <string>

#include "tests/support/packet_encoder.h"

namespace sphc::test {

// The head of the file comes before its images (`is_head_first`), or behind them.
inline void writeMp4(const std::string &path, const EncoderSettings &settings, const PixelOf &pixel_of,
                     bool is_head_first = false) {
  AVFormatContext *file = nullptr;
  if (avformat_alloc_output_context2(&file, nullptr, "mp4", path.c_str()) < 0)
    throw std::runtime_error("FFmpeg writes no MP4 here");
  AVStream *stream = nullptr;
  encode(settings, pixel_of, [&](const AVCodecContext &context, AVPacket *packet) {
    if (!stream) {
      stream = avformat_new_stream(file, nullptr);
      avcodec_parameters_from_context(stream->codecpar, &context);
      AVDictionary *options = nullptr;
      if (is_head_first) av_dict_set(&options, "movflags", "faststart", 0);
      if (avio_open(&file->pb, path.c_str(), AVIO_FLAG_WRITE) < 0 || avformat_write_header(file, &options) < 0)
        throw std::runtime_error(path + " cannot be written");
      av_dict_free(&options);
    }
    packet->duration = 1;
    av_packet_rescale_ts(packet, context.time_base, stream->time_base);
    packet->stream_index = 0;
    av_write_frame(file, packet);
  });
  av_write_trailer(file);
  avio_closep(&file->pb);
  avformat_free_context(file);
}

}  // namespace sphc::test
