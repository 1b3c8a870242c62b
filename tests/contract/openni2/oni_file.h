// Recordings of the virtual camera, made by OpenNI2's own recorder.
#pragma once

#include <string>

namespace sphc::contract {

constexpr int kPairsAtLeast = 20;

// Writes depth frames, and colour frames from their beginning on or `color_begins_late`, the last ones
// kPairsAtLeast pairs.  The recorder loses some frames of its first moments; from then on it has every one.  The
// index of the last frame, below 256; 0 when OpenNI2 cannot.
int writeOniFile(const std::string &path, bool color_begins_late);

}  // namespace sphc::contract
