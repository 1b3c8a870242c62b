// What a recording holds, folder or file: images by time, poses by time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration.h"
#include "host/recording/mcap/messages.h"
#include "host/recording/mcap/walk.h"
#include "pose_track.h"

namespace sphc::recording {

enum class Layout { kSevenScenes = 1, kTum = 2, kMcap = 3, kRaw = 4 };

// Frames are chosen by the number of their colour image: of first to last every step-th.
struct Selection {
  uint32_t first = 0, last = UINT32_MAX;
  uint32_t step = 1;
};

// Where an image is in an MCAP file; in a raw one `start` is the number of its frame.
struct MessagePlace {
  Kind kind;
  uint32_t chunk;  // index in Recording::chunks
  uint64_t start;  // of the message's data, in the file
  uint64_t bytes;
};

struct RecordedImage {
  int64_t time_ns;
  uint32_t sequence;
  std::string file;         // relative to the folder
  CaptureNote note = {};    // what else is known, in an MCAP file
  MessagePlace place = {};  // likewise
  // Of a depth image, whose amplitudes the file has; else of no kind.
  MessagePlace amplitude = {};
};

struct Recording {
  Layout layout = Layout::kTum;
  std::filesystem::path path;        // of the folder or the file
  std::vector<RecordedImage> color;  // times increase
  std::vector<RecordedImage> depth;  // times increase
  PoseTrack poses;
  uint32_t bad_pose_count = 0;

  std::optional<sphc_rig> calibration;  // of a file that holds one

  // Of an MCAP file.
  std::vector<ChunkPlace> chunks;
  uint64_t lost_count = 0;
  uint32_t bad_chunk_count = 0;
  bool is_cut = false;
};

struct FramePair {
  uint32_t color;  // index in Recording::color
  uint32_t depth;
};

// Finds the layout and reads lists and poses, no image; throws Failure.
Recording openRecording(const std::filesystem::path &path);

// Keeps the frames that are chosen; throws Failure when that is none.
void selectFrames(const Selection &selection, Recording &recording);

// Each colour image with the depth image nearest in time, where there is one within the tolerance.
std::vector<FramePair> pairFrames(const Recording &recording, int64_t tolerance_ns);

// The layouts.
bool is7Scenes(const std::filesystem::path &folder);
Recording open7Scenes(const std::filesystem::path &folder);
bool isTum(const std::filesystem::path &folder);
Recording openTum(const std::filesystem::path &folder);
bool isRaw(const std::filesystem::path &file);
Recording openRaw(const std::filesystem::path &file);
Recording openMcap(const std::filesystem::path &file);

}  // namespace sphc::recording
