// The packets of an MP4 file's video, by FFmpeg's libavformat.
#pragma once

extern "C" {
#include <libavformat/avformat.h>
}

#include <filesystem>
#include <memory>

#include "host/recording/foreign/ffmpeg.h"

namespace sphc::recording {

class Mp4Packets {
 public:
  // Throws Failure (DEVICE) with the file's name.  Images are of up to `most_px` pixels.
  Mp4Packets(const std::filesystem::path &file, uint64_t most_px);

  const AVCodecParameters &codec() const { return *stream_->codecpar; }
  // As the file tells it, or else by its duration; 0 where that is no number.
  uint32_t frameCount() const;

  // The next one in the order of decoding.  Nothing at the end, and from one on that cannot be read.
  ffmpeg::Packet read();
  // Of the next one, counted from 0.
  int64_t place() const { return place_; }
  bool areAllRead() const { return place_ == avformat_index_get_entries_count(stream_); }
  // To one that stands by itself.
  void seek(int64_t place);

 private:
  struct Closer {
    void operator()(AVFormatContext *owned) const { avformat_close_input(&owned); }
  };

  ffmpeg::Packet readAny();

  std::unique_ptr<AVFormatContext, Closer> context_;
  AVStream *stream_ = nullptr;
  ffmpeg::Packet found_;  // by seeking
  int64_t place_ = 0;
  bool is_over_ = false;
};

}  // namespace sphc::recording
