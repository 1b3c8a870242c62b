// What a recording's folder holds: images by time, poses by time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pose_track.h"
#include "replay.h"

namespace sphc::replay {

struct RecordedImage {
  int64_t time_ns;
  uint32_t sequence;
  std::string file;  // relative to the folder
};

struct Recording {
  sphc_replay_layout layout = 0;
  std::filesystem::path folder;
  std::vector<RecordedImage> color;  // times increase
  std::vector<RecordedImage> depth;  // times increase
  PoseTrack poses;
  uint32_t bad_pose_count = 0;
};

struct FramePair {
  uint32_t color;  // index in Recording::color
  uint32_t depth;
};

// Finds the layout and reads lists and poses, no image; throws Failure.
Recording openRecording(const std::filesystem::path &folder);

// Keeps the frames that the config chooses; throws Failure when it chooses none.
void selectFrames(const sphc_replay_config &config, Recording &recording);

// Each colour image with the depth image nearest in time, where there is one within the tolerance.
std::vector<FramePair> pairFrames(const Recording &recording, int64_t tolerance_ns);

// The layouts.
bool is7Scenes(const std::filesystem::path &folder);
Recording open7Scenes(const std::filesystem::path &folder);
bool isTum(const std::filesystem::path &folder);
Recording openTum(const std::filesystem::path &folder);

}  // namespace sphc::replay
