// Chunks that are compressed as a frame of LZ4.
#pragma once

#include "host/recording/mcap/bytes.h"

namespace sphc::recording {

// False in a build without liblz4.
bool readsLz4();

// Fills `out`.  False when the frame does not hold just so many bytes.
bool decodeLz4Frame(ByteView frame, Bytes &out);

}  // namespace sphc::recording
