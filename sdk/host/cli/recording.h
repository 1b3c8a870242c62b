// The recording a subcommand reads: the options that choose it and its frames, and its handle.
#pragma once
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/replay/replay.h"

namespace sphc::host {

struct RecordingOptions {
  std::string folder, calibration;
  uint32_t first = 0, last = UINT32_MAX, step = 1;
};
// Gives --recording, which is required unless the caller says otherwise.
CLI::Option *addRecordingOptions(CLI::App *app, RecordingOptions *options);

struct ReplayCloser {
  void operator()(sphc_replay *replay) const { sphc_replay_close(&replay); }
};
using Replay = std::unique_ptr<sphc_replay, ReplayCloser>;

// Throws std::runtime_error with cause and cure, also when the selection holds no frame.
Replay openRecording(const RecordingOptions &options);
sphc_calibration calibrationOf(const sphc_replay *replay);
std::string describeSelection(const RecordingOptions &options);

}  // namespace sphc::host
