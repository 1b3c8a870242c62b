// Seeds of fuzz_recording.cpp, fuzz_recording_raw.cpp, fuzz_imports.cpp and fuzz_layouts.cpp.
#pragma once
#include "tests/fuzz/targets.h"

namespace sphc::fuzz {

std::vector<std::vector<uint8_t>> recordingSeeds();
std::vector<std::vector<uint8_t>> rawRecordingSeeds();
std::vector<std::vector<uint8_t>> messageSeeds();
std::vector<std::vector<uint8_t>> rvlSeeds();
std::vector<std::vector<uint8_t>> straySeeds();
std::vector<std::vector<uint8_t>> record3dSeeds();
std::vector<std::vector<uint8_t>> r3dSeeds();
std::vector<std::vector<uint8_t>> lzfseSeeds();
std::vector<std::vector<uint8_t>> hololensSeeds();
std::vector<std::vector<uint8_t>> hl2ssSeeds();
std::vector<std::vector<uint8_t>> hl2ssFolderSeeds();
std::vector<std::vector<uint8_t>> kinectSeeds();
std::vector<std::vector<uint8_t>> ros1Seeds();
std::vector<std::vector<uint8_t>> ros2Seeds();
std::vector<std::vector<uint8_t>> tumSeeds();
std::vector<std::vector<uint8_t>> sevenScenesSeeds();

}  // namespace sphc::fuzz
