// The frames of an MP4 file, decoded by FFmpeg.
#pragma once

#include <spherecloud/spherecloud.h>

#include <filesystem>
#include <memory>

namespace sphc::recording {

class Video {
 public:
  // Throws Failure with the file's name: DEVICE when it is no MP4 or cannot be decoded, UNSUPPORTED in a build
  // without libavformat.
  explicit Video(const std::filesystem::path &file);
  ~Video();
  Video(Video &&) noexcept;

  // Of the frames as they were encoded: what the file says of turning them for a screen does not count.
  uint32_t width() const;
  uint32_t height() const;
  uint32_t frameCount() const;
  // By the order in which they are shown.  BGR8, valid until the next call.  Frames are decoded one after the
  // other; going back begins at the last one that stands by itself (a key image). Throws Failure without a name:
  // DEVICE where a frame is lost, and from damage that libavcodec notices up to the next key image; UNSUPPORTED
  // where no decoder is installed.
  sphc_image read(uint32_t index);

 private:
  struct Decoder;
  std::unique_ptr<Decoder> decoder_;
};

}  // namespace sphc::recording
