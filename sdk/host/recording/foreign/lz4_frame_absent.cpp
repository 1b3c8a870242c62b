// In place of lz4_frame.cpp where liblz4 is not installed.
#include "host/recording/foreign/lz4_frame.h"

namespace sphc::recording {

bool readsLz4() { return false; }

bool decodeLz4Frame(ByteView, Bytes &) { return false; }

}  // namespace sphc::recording
