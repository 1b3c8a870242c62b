// Images as an Azure Kinect records them.
#pragma once

#include "host/cameras/join.h"
#include "host/recording/mcap/file.h"
#include "host/recording/recording.h"

namespace sphc::recording {

enum class KinectColor { kMjpg, kNv12, kYuy2, kBgra };

// Infrared images are the amplitudes of depth.
class KinectImages : public LayoutImages {
 public:
  KinectImages(const std::filesystem::path &path, KinectColor color, host::ImageSize color_size,
               host::ImageSize depth_size)
      : file_(path), color_(color), color_size_(color_size), depth_size_(depth_size) {}

  void read(sphc_stream stream, const RecordedImage &image, const sphc_camera &camera, sphc_format format,
            uint8_t *pixels) override;
  void readAmplitude(const RecordedImage &depth, const sphc_camera &camera, uint16_t *pixels) override;

 private:
  void load(const MessagePlace &place);

  File file_;
  KinectColor color_;
  host::ImageSize color_size_, depth_size_;
  Bytes stored_;  // of the last image
};

}  // namespace sphc::recording
