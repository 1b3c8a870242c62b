// A raw recording on the disk, through the reader of devices.
#pragma once

#include <filesystem>

#include "drivers/raw/raw.h"
#include "host/recording/mcap/file.h"

namespace sphc::recording {

class RawFile {
 public:
  // Throws Failure, as all of these do.
  explicit RawFile(const std::filesystem::path &path);
  RawFile(const RawFile &) = delete;  // the reader borrows the file
  RawFile &operator=(const RawFile &) = delete;

  const sphc_raw &raw() const { return raw_; }
  sphc_raw_frame head(uint32_t index) const;
  // Valid until another frame is loaded.
  const sphc_localizer_frame &load(uint32_t index);

 private:
  File file_;
  sphc_raw raw_ = {};
  Bytes memory_;
  sphc_raw_frame loaded_ = {};
  uint32_t loaded_index_ = UINT32_MAX;
};

}  // namespace sphc::recording
