// Bytes that are compressed by LZFSE, as Apple's systems do it.
#pragma once

#include "host/recording/mcap/bytes.h"

namespace sphc::recording {

// Fills `out`.  Throws Failure without a name: DEVICE where they are damaged, IMAGE where they are more than
// `most_bytes`.
void decodeLzfse(ByteView compressed, size_t most_bytes, Bytes &out);

}  // namespace sphc::recording
