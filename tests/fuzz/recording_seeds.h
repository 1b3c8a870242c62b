// Seeds of fuzz_recording.cpp and fuzz_recording_raw.cpp.
#pragma once
#include "tests/fuzz/targets.h"

namespace sphc::fuzz {

std::vector<std::vector<uint8_t>> recordingSeeds();
std::vector<std::vector<uint8_t>> rawRecordingSeeds();
std::vector<std::vector<uint8_t>> messageSeeds();
std::vector<std::vector<uint8_t>> rvlSeeds();

}  // namespace sphc::fuzz
