#include "host/recording/foreign/hl2ss_images.h"

#include <opencv2/imgproc.hpp>

#include "host/recording/encoded_image.h"
#include "host/recording/failure.h"

namespace sphc::recording {

namespace {

constexpr uint32_t kBlockPx = 64;                        // by which an encoder may make an image larger
constexpr uint64_t kMostHl2ssBytes = uint64_t{1} << 26;  // of a packet with an image

[[noreturn]] void failPacket(const char *what) {
  throw Failure(SPHC_E_DEVICE, std::string("is no image of this stream (") + what + "); copy the file again");
}

bool fits(const Hl2ssPacket &packet, uint64_t tail_bytes) {
  return packet.bytes > tail_bytes && packet.bytes <= kMostHl2ssBytes;
}

void requireLength(ByteView stored, uint64_t wanted) {
  if (stored.size != wanted) failPacket("it has more or fewer bytes");
}

}  // namespace

Hl2ssColorTail hl2ssColorTail(const File &file, const Hl2ssPacket &packet) {
  uint8_t bytes[kHl2ssColorTail];
  file.read(packet.start + packet.bytes - kHl2ssColorTail, bytes, sizeof bytes);
  Hl2ssColorTail tail;
  std::memcpy(tail.params, bytes, sizeof tail.params);
  tail.width = loadLittle<uint16_t>(bytes + 76);
  tail.height = loadLittle<uint16_t>(bytes + 78);
  return tail;
}

Hl2ssImages::Hl2ssImages(std::shared_ptr<const Hl2ssStream> color, ImageSize color_size,
                         std::shared_ptr<const Hl2ssStream> depth, std::shared_ptr<const DepthLut> lut)
    : color_(std::move(color)),
      depth_(std::move(depth)),
      color_size_(color_size),
      lut_(std::move(lut)),
      color_file_(color_->path),
      depth_file_(depth_->path) {}

void Hl2ssImages::read(sphc_stream stream, const RecordedImage &image, const sphc_camera &camera,
                       sphc_format format, uint8_t *pixels) {
  if (stream == SPHC_STREAM_COLOR)
    readColor(image.sequence, camera, format, pixels);
  else
    readDepth(image.sequence, camera, reinterpret_cast<uint16_t *>(pixels));
}

void Hl2ssImages::readColor(uint32_t number, const sphc_camera &camera, sphc_format format, uint8_t *pixels) {
  requireSize(color_size_.width, color_size_.height, camera, true);
  const cv::Mat bgr = color_->file.profile == kHl2ssUncoded ? bgrOfNv12(number) : bgrOfVideo(number);
  packPixels({bgr.data, camera.width, camera.height, static_cast<uint32_t>(bgr.step), SPHC_FORMAT_BGR8}, format,
             pixels);
}

cv::Mat Hl2ssImages::bgrOfVideo(uint32_t number) {
  const std::vector<Hl2ssPacket> &packets = color_->file.packets;
  const uint32_t most_width = color_size_.width + kBlockPx, most_height = color_size_.height + kBlockPx;
  if (!video_)
    video_.emplace(color_->file.profile == kHl2ssH265 ? VideoCode::kH265 : VideoCode::kH264,
                   static_cast<uint32_t>(packets.size()), uint64_t{most_width} * most_height, [this](uint32_t i) {
                     const Hl2ssPacket &packet = color_->file.packets[i];
                     return fits(packet, kHl2ssColorTail) ? load(color_file_, packet, kHl2ssColorTail) : ByteView{};
                   });
  cv::Mat bgr;
  cv::cvtColor(video_->read(number), bgr, cv::COLOR_YUV2BGR_I420);
  const auto width = static_cast<uint32_t>(bgr.cols), height = static_cast<uint32_t>(bgr.rows);
  if (width < color_size_.width || height < color_size_.height || width > most_width || height > most_height)
    failPacket("it has another size");
  return bgr;
}

// Rows begin at multiples of 64 bytes.
cv::Mat Hl2ssImages::bgrOfNv12(uint32_t number) {
  const auto [width, height] = color_size_;
  const uint32_t stride = (width + 63) / 64 * 64;
  const ByteView stored = load(color_file_, color_->file.packets[number], kHl2ssColorTail);
  if (width % 2 != 0 || height % 2 != 0) failPacket("its sides are odd");
  requireLength(stored, uint64_t{stride} * height * 3 / 2);
  const cv::Mat yuv(static_cast<int>(height * 3 / 2), static_cast<int>(width), CV_8UC1,
                    const_cast<uint8_t *>(stored.data), stride);
  cv::Mat bgr;
  cv::cvtColor(yuv, bgr, cv::COLOR_YUV2BGR_NV12);
  return bgr;
}

// Depth and behind it infrared, of two bytes a pixel: as they are, or as the four channels of a PNG image.
void Hl2ssImages::readDepth(uint32_t number, const sphc_camera &camera, uint16_t *depth_mm) {
  requireSize(kLongThrowSize.width, kLongThrowSize.height, camera, false);
  const ByteView stored = load(depth_file_, depth_->file.packets[number], kHl2ssDepthTail);
  range_mm_.resize(size_t{2} * kLongThrowSize.width * kLongThrowSize.height);
  auto *bytes = reinterpret_cast<uint8_t *>(range_mm_.data());
  if (depth_->file.profile == kHl2ssUncoded) {
    requireLength(stored, range_mm_.size() * sizeof(uint16_t));
    std::memcpy(bytes, stored.data, stored.size);
  } else {
    decodeFourChannels(stored, kLongThrowSize, bytes);
  }
  lut_->toPinhole(range_mm_, depth_mm);
}

ByteView Hl2ssImages::load(const File &file, const Hl2ssPacket &packet, uint64_t tail_bytes) {
  if (!fits(packet, tail_bytes)) failPacket("it is empty or over 64 MiB");
  stored_.resize(packet.bytes - tail_bytes);
  file.read(packet.start, stored_.data(), stored_.size());
  return viewOf(stored_);
}

}  // namespace sphc::recording
