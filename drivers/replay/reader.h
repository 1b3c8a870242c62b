// What is behind a replay, for C++ that is built with it.
#pragma once

#include "host/recording/recording_reader.h"
#include "replay.h"

namespace sphc::replay {

// Frame by frame; the source does not disturb it.  Borrowed until the replay is closed.
recording::RecordingReader *readerOf(sphc_replay *replay);

}  // namespace sphc::replay
