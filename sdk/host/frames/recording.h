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

  bool isPart() const { return first > 0 || last < UINT32_MAX || step > 1; }
};

// How what is said of poses ends where no frame has one of them.
constexpr char kIsOfOtherTimes[] =
    " is of the time of a frame that was chosen; are the times of poses and images in seconds of one clock?";

// Throws UsageError.
void checkSelection(const RecordingOptions &options);
// Throws UsageError, or std::runtime_error with cause and cure, also when the selection holds no frame.
std::unique_ptr<RecordingReader> openRecording(const RecordingOptions &options);
// Throws the std::runtime_error of a command that found not one frame it could read.
[[noreturn]] void refuseUnreadable();
// "frames 100 to 199, every 3rd".
std::string describeSelection(const RecordingOptions &options);

}  // namespace sphc::host
