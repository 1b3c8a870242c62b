// Reads a recording's images, from files or messages, into memory that is there already.
#pragma once

#include <optional>

#include "message_image.h"
#include "pixels.h"
#include "raw_file.h"
#include "recording.h"
#include "spherecloud/spherecloud_capture.h"

namespace sphc::recording {

class ImageReader {
 public:
  // Borrows the recording.
  ImageReader(const Recording &recording, const sphc_rig &calibration, sphc_format color_format);

  size_t colorBytes() const { return bytesOf(SPHC_STREAM_COLOR); }
  size_t depthBytes() const { return bytesOf(SPHC_STREAM_DEPTH); }
  // Decodes into `pixels` (colorBytes or depthBytes of them) and gives a view of it.  Throws Failure: DEVICE for an
  // image that is missing or corrupt, IMAGE for one that does not fit the calibration.
  sphc_image read(sphc_stream stream, const RecordedImage &image, uint8_t *pixels);
  // The same of the amplitudes of a depth image, depthBytes of them; zero where the recording has none.
  sphc_image readAmplitude(const RecordedImage &depth, uint8_t *pixels);

 private:
  // The MCAP file, when the recording is one.
  struct Messages {
    explicit Messages(const std::filesystem::path &path) : file(path), chunks(file) {}
    File file;
    ChunkReader chunks;
    MessageDecoder decoder;
  };
  const sphc_camera &cameraOf(sphc_stream stream) const;
  sphc_format formatOf(sphc_stream stream) const;
  size_t bytesOf(sphc_stream stream) const;
  std::string nameOf(sphc_stream stream, const RecordedImage &image) const;
  ByteView load(const RecordedImage &image);
  void readRaw(sphc_stream stream, uint32_t index, uint8_t *pixels);
  ByteView loadMessage(const MessagePlace &place);

  const Recording &recording_;
  sphc_camera color_camera_;
  sphc_camera depth_camera_;
  sphc_format color_format_;
  std::optional<Messages> messages_;
  std::optional<RawFile> raw_;            // likewise
  std::unique_ptr<LayoutImages> images_;  // of a layout that reads its images itself
  Bytes encoded_;                         // of the last file; grows to the largest
};

}  // namespace sphc::recording
