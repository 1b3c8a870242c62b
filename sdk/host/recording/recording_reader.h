// Plays a recording frame by frame: the C++ side's way to read one.
#pragma once

#include <memory>
#include <optional>

#include "image_reader.h"
#include "recording.h"

namespace sphc::recording {

struct ReaderOptions {
  std::filesystem::path calibration;  // empty: the recording's own
  std::filesystem::path poses;        // in TUM format; empty: the recording's own
  Selection selection;
  sphc_format color_format = SPHC_FORMAT_BGR8;
  int64_t pair_tolerance_ns = 20000000;  // between colour and depth of a frame
  int64_t pose_gap_ns = 50000000;        // poses are interpolated between recorded ones at most so far apart
};

// Frames are the chosen colour images that have a depth image near enough, in order of time; indices count from 0.
class RecordingReader {
 public:
  // Reads lists, poses and calibration, no image.  Throws Failure, as read() does, with file, cause and cure.
  explicit RecordingReader(const std::filesystem::path &path, const ReaderOptions &options = {});
  RecordingReader(const RecordingReader &) = delete;  // its parts borrow each other
  RecordingReader &operator=(const RecordingReader &) = delete;

  const Recording &recording() const { return recording_; }
  const sphc_rig &calibration() const { return calibration_; }

  int64_t poseGapNs() const { return pose_gap_ns_; }

  uint32_t frameCount() const { return static_cast<uint32_t>(frames_.size()); }
  const RecordedImage &colorOf(uint32_t index) const { return recording_.color[frames_.at(index).color]; }
  const RecordedImage &depthOf(uint32_t index) const { return recording_.depth[frames_.at(index).depth]; }
  // Decodes a frame into memory that is valid until the next read; with amplitudes, where it has them.
  sphc_localizer_frame read(uint32_t index);
  // The same where a bad frame is left out: none when it cannot be read, and why.
  std::optional<sphc_localizer_frame> tryRead(uint32_t index, std::string *why = nullptr);
  // Of the colour camera, at the colour time of a frame or at any; none where the recording has none.
  std::optional<sphc_rigid> worldFromCamera(uint32_t index) const {
    return worldFromCameraAt(colorOf(index).time_ns);
  }
  std::optional<sphc_rigid> worldFromCameraAt(int64_t time_ns) const;

 private:
  Recording recording_;
  sphc_rig calibration_;
  int64_t pose_gap_ns_;
  std::vector<FramePair> frames_;
  ImageReader images_;
  Bytes color_pixels_, depth_pixels_, amplitude_pixels_;
};

}  // namespace sphc::recording
