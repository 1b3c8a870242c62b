// In place of packet_video.cpp where libavcodec is not installed.
#include "host/recording/failure.h"
#include "host/recording/foreign/packet_video.h"

namespace sphc::recording {

struct PacketVideo::Decoder {};

PacketVideo::PacketVideo(VideoCode, uint32_t, uint64_t, std::function<ByteView(uint32_t)>) {
  throw Failure(
      SPHC_E_UNSUPPORTED,
      "is encoded video, which this build does not read; install libavcodec-dev and build again, or record "
      "it uncoded (VideoProfile.RAW)");
}

PacketVideo::~PacketVideo() = default;
cv::Mat PacketVideo::read(uint32_t) { return {}; }

}  // namespace sphc::recording
