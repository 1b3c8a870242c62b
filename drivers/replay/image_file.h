// Decodes image files into memory that is there already.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recording.h"

namespace sphc::replay {

uint32_t bytesPerPixel(sphc_format format);

class ImageReader {
 public:
  ImageReader(const Recording &recording, const sphc_calibration &calibration, sphc_format color_format);

  size_t colorBytes() const { return bytesOf(SPHC_STREAM_COLOR); }
  size_t depthBytes() const { return bytesOf(SPHC_STREAM_DEPTH); }
  // Decodes into `pixels` (colorBytes or depthBytes of them) and gives a view of it.  Throws Failure: DEVICE for a
  // file that is missing or corrupt, IMAGE for one that does not fit the calibration.
  sphc_image read(sphc_stream stream, const RecordedImage &image, uint8_t *pixels);

 private:
  size_t bytesOf(sphc_stream stream) const;
  void load(const RecordedImage &image);
  void decode(sphc_stream stream, const RecordedImage &image, uint8_t *pixels);

  std::filesystem::path folder_;
  sphc_camera color_camera_;
  sphc_camera depth_camera_;
  sphc_format color_format_;
  bool invalid_is_65535_;         // as in the original 7-Scenes
  std::vector<uint8_t> encoded_;  // of the last file; grows to the largest
};

}  // namespace sphc::replay
