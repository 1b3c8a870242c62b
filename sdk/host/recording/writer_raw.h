// Writes a raw recording into a file, through the writer of devices.
#pragma once

#include <filesystem>

#include "drivers/raw/raw_writer.h"
#include "host/recording/mcap/file.h"

namespace sphc::recording {

// All throw Failure.  The file has another name, ending in ".unfinished", until finish() gives it its own.
class RawWriter {
 public:
  // STATE when there is a file of this name.
  RawWriter(const std::filesystem::path &path, const sphc_rig &calibration, sphc_format color_format);
  // Removes what is not finished.
  ~RawWriter();
  RawWriter(const RawWriter &) = delete;
  RawWriter &operator=(const RawWriter &) = delete;

  // `world_from_camera` may be null.  Borrows.
  void add(const sphc_localizer_frame &frame, const sphc_rigid *world_from_camera);
  void finish();

 private:
  // Makes the file, empty.
  RawWriter(const std::filesystem::path &path, std::filesystem::path unfinished);

  std::filesystem::path path_, unfinished_;
  File file_;
  sphc_raw_writer writer_ = {};
  bool is_finished_ = false;
  Bytes bytes_;  // of a header or a frame
};

}  // namespace sphc::recording
