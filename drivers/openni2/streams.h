// The two streams of a camera, as indices of small arrays.
#pragma once

#include <spherecloud/spherecloud_capture.h>

namespace sphc::openni2 {

enum StreamIndex { kColor = 0, kDepth = 1 };
constexpr int kStreams = 2;
constexpr const char *kStreamNames[kStreams] = {"colour", "depth"};

inline sphc_stream streamId(int stream) { return stream == kColor ? SPHC_STREAM_COLOR : SPHC_STREAM_DEPTH; }
inline int otherStream(int stream) { return stream == kColor ? kDepth : kColor; }

}  // namespace sphc::openni2
