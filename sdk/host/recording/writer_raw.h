// Writes a raw recording: frames as they are in memory, for devices (docs/recording.md; drivers/raw reads it).
#pragma once

#include <filesystem>

#include "calibration.h"
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
  RawWriter(const std::filesystem::path &path, std::filesystem::path unfinished, const sphc_rig &calibration,
            sphc_format color_format);
  Bytes header() const;

  std::filesystem::path path_, unfinished_;
  sphc_rig calibration_;
  sphc_format color_format_;
  File file_;
  uint32_t frame_count_ = 0;
  bool is_finished_ = false;
  Bytes head_, depth_, color_;  // of one frame
};

}  // namespace sphc::recording
