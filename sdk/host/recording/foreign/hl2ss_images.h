// Images as hl2ss records them, and what stands behind each in its packet.
#pragma once

#include <memory>
#include <optional>

#include "host/recording/foreign/depth_lut.h"
#include "host/recording/foreign/hl2ss_file.h"
#include "host/recording/foreign/packet_video.h"
#include "host/recording/mcap/file.h"
#include "host/recording/recording.h"

namespace sphc::recording {

constexpr ImageSize kLongThrowSize = {320, 288};
constexpr uint64_t kHl2ssColorTail = 80, kHl2ssDepthTail = 8;  // bytes behind an image

// A colour image's tail: its camera, and the size that it was sent in.
struct Hl2ssColorTail {
  float params[4];  // fx, fy, cx, cy
  uint16_t width, height;
};
Hl2ssColorTail hl2ssColorTail(const File &file, const Hl2ssPacket &packet);

struct Hl2ssStream {
  std::filesystem::path path;
  Hl2ssFile file;
};

// The number of an image is that of its packet.
class Hl2ssImages : public LayoutImages {
 public:
  Hl2ssImages(std::shared_ptr<const Hl2ssStream> color, ImageSize color_size,
              std::shared_ptr<const Hl2ssStream> depth, std::shared_ptr<const DepthLut> lut);

  void read(sphc_stream stream, const RecordedImage &image, const sphc_camera &camera, sphc_format format,
            uint8_t *pixels) override;

 private:
  void readColor(uint32_t number, const sphc_camera &camera, sphc_format format, uint8_t *pixels);
  void readDepth(uint32_t number, const sphc_camera &camera, uint16_t *depth_mm);
  cv::Mat bgrOfVideo(uint32_t number);
  cv::Mat bgrOfNv12(uint32_t number);
  ByteView load(const File &file, const Hl2ssPacket &packet, uint64_t tail_bytes);

  std::shared_ptr<const Hl2ssStream> color_, depth_;
  ImageSize color_size_;
  std::shared_ptr<const DepthLut> lut_;
  File color_file_, depth_file_;
  std::optional<PacketVideo> video_;  // from the first image on
  Bytes stored_;                      // of the last packet
  std::vector<uint16_t> range_mm_;    // and infrared behind it
};

}  // namespace sphc::recording
