// Video that a recording holds packet by packet, an image each: decoded by FFmpeg's libavcodec.
#pragma once

#include <functional>
#include <memory>
#include <opencv2/core.hpp>

#include "host/recording/mcap/bytes.h"

namespace sphc::recording {

enum class VideoCode { kH264, kH265 };

class PacketVideo {
 public:
  // `packet` gives the bytes of one, counted from 0, valid until it is called again; nothing where it is damaged.
  // Images are of up to `most_px` pixels.  Throws Failure (UNSUPPORTED) without a name in a build without
  // libavcodec.
  PacketVideo(VideoCode code, uint32_t packet_count, uint64_t most_px, std::function<ByteView(uint32_t)> packet);
  ~PacketVideo();

  // The image of a packet: three planes of 8 bits, Y above U above V (I420), of video range and of even sides.
  // Images are decoded one after the other; going back begins at the last one that stands by itself (a key image).
  // Throws Failure without a name: DEVICE before the first key image, and from damage that libavcodec notices up to
  // the next; UNSUPPORTED where pixels are of another kind.
  cv::Mat read(uint32_t index);

 private:
  struct Decoder;
  std::unique_ptr<Decoder> decoder_;
};

}  // namespace sphc::recording
