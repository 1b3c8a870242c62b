// The recording a tool reads: which of its frames, a handle that closes itself, and the calibration.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "drivers/replay/replay.h"

namespace sphc::host {

struct RecordingOptions {
  std::string folder, calibration;  // no calibration: the recording's own
  uint32_t first = 0, last = UINT32_MAX, step = 1;
};

struct ReplayCloser {
  void operator()(sphc_replay *replay) const { sphc_replay_close(&replay); }
};
using Replay = std::unique_ptr<sphc_replay, ReplayCloser>;

// Throws UsageError, or std::runtime_error with cause and cure, also when the selection holds no frame.
Replay openRecording(const RecordingOptions &options);
// "frames 100 to 199, every 3rd".
std::string describeSelection(const RecordingOptions &options);
// Throws std::runtime_error with cause and cure.
sphc_calibration calibrationOf(const sphc_replay *replay);

}  // namespace sphc::host
