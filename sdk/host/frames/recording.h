// The recording that a tool reads, and which of its frames.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "host/recording/recording_reader.h"

namespace sphc::host {

using recording::RecordingReader;

struct RecordingOptions {
  std::string folder;
  std::string calibration, poses;  // files; none: the recording's own
  uint32_t first = 0, last = UINT32_MAX, step = 1;
  uint32_t pose_gap_ms = 50;  // poses are interpolated between recorded ones at most so far apart

  bool isPart() const { return first > 0 || last < UINT32_MAX || step > 1; }
};

constexpr uint32_t kMostPoseGapMs = 1000;

// Of a frame without a pose that lies between two: how far these are apart.
std::optional<uint64_t> poseGapOf(const RecordingReader &reader, const recording::PoseTrack &poses, uint32_t index);
// How what is said of poses ends where no frame has one of them: the cause, and the cure.  The first is empty where
// no frame lies between two poses.
std::string tooFarApart(const RecordingReader &reader, const recording::PoseTrack &poses);
std::string ofOtherTimes(const RecordingReader &reader, const recording::PoseTrack &poses);

// Throws UsageError.
void checkSelection(const RecordingOptions &options);
// Throws UsageError, or std::runtime_error with cause and cure, also when the selection holds no frame.
std::unique_ptr<RecordingReader> openRecording(const RecordingOptions &options);
// Throws the std::runtime_error of a command that found not one frame it could read.
[[noreturn]] void refuseUnreadable();
// "frames 100 to 199, every 3rd".
std::string describeSelection(const RecordingOptions &options);

}  // namespace sphc::host
