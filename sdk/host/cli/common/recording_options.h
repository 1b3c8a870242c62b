// The recording a subcommand reads: the options that choose it and its frames.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "host/frames/recording.h"

namespace sphc::host {

// Gives --recording, which is required unless the caller says otherwise.
CLI::Option *addRecordingOptions(CLI::App *app, RecordingOptions *options);

}  // namespace sphc::host
