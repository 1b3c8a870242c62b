// The recording a subcommand reads: the options that choose it and its frames.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "host/frames/recording.h"

namespace sphc::host {

// Gives --recording, which is required unless the caller says otherwise.
CLI::Option *addRecordingOptions(CLI::App *app, RecordingOptions *options);

// Throws std::runtime_error with cause and cure, also when the selection holds no frame.
Replay openRecording(const RecordingOptions &options);
std::string describeSelection(const RecordingOptions &options);

}  // namespace sphc::host
