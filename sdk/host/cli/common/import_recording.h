// Point models of recordings, for subcommands without options of their own for it.
#pragma once
#include <vector>

#include "host/cli/common/recording_options.h"
#include "host/import/point_model.h"

namespace sphc::host {

// Of all its frames together.  `what` begins the progress bar.
PointModel importRecording(const RecordingOptions &recording, const char *what);

// Of at most `count` frames, evenly chosen, each by itself: what a client sees.  Says what of the recording is left
// out.
std::vector<PointModel> importFrames(const RecordingOptions &recording, uint32_t count, const char *what,
                                     const Console &console);

}  // namespace sphc::host
