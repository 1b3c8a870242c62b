// What a recording holds, folder or file: images by time, poses by time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration.h"
#include "host/recording/foreign/layout_images.h"
#include "host/recording/mcap/messages.h"
#include "host/recording/mcap/walk.h"
#include "pose_track.h"

namespace sphc::recording {

enum class Layout {
  kSevenScenes = 1,
  kTum = 2,
  kMcap = 3,
  kRaw = 4,
  kStrayScanner = 5,
  kRos2 = 6,
  kRecord3d = 7,
  kRos1 = 8,
  kStreamRecorder = 9,
  kAzureKinect = 10,
  kHl2ss = 11
};

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
  std::string file;            // relative to the folder
  CaptureNote note = {};       // what else is known, in an MCAP file
  MessagePlace place = {};     // likewise
  int64_t depth_after_ns = 0;  // of a colour image, in a recording by frames: how much later its depth image is
  // Of a depth image, whose amplitudes the file has; else of no kind.  Of a layout that reads its images itself
  // kAmplitudeImage.
  MessagePlace amplitude = {};
};

struct Recording {
  Layout layout = Layout::kTum;
  std::filesystem::path path;        // of the folder or the file
  std::vector<RecordedImage> color;  // times increase
  std::vector<RecordedImage> depth;  // times increase
  PoseTrack poses;
  std::vector<TimedAcceleration> accelerations;  // times increase; empty where there is none
  uint32_t bad_pose_count = 0;
  std::string pose_fault;                 // why there are none, with the cure; empty where nothing is to be said
  std::vector<std::string> order_faults;  // of lists that were not in order of time, a sentence each
  uint32_t bad_acceleration_count = 0;    // no acceleration, or not later than the one before
  uint32_t backward_count = 0;            // of lost_count: images whose time is not after that of the image before

  std::optional<sphc_rig> calibration;  // of a recording that holds one, but for calibration.json in a folder
  std::string calibration_fault;        // why it holds none, with name and cure; empty where nothing is to be said
  // A depth image belongs to the colour images that say so alone, however near the next one is.
  bool is_by_frame = false;
  LayoutImagesMaker images;  // of a layout that reads its images itself

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

// Keeps the chosen frames, each with the depth image that it has among all, and depth images that are nearest to
// one of them; throws Failure when that is none.
void selectFrames(const Selection &selection, int64_t tolerance_ns, Recording &recording);

// Each colour image with the depth image nearest in time, where there is one within the tolerance; of a recording
// by frames, with its own.
std::vector<FramePair> pairFrames(const Recording &recording, int64_t tolerance_ns);

// Poses that stand by themselves, in the TUM format: a line "seconds tx ty tz qx qy qz qw" each.  Lines without a
// finite pose are counted, and so are those of a time that was.  Throws Failure.
PoseTrack readTumPoses(const std::filesystem::path &file, uint32_t *bad_count);

// The layouts.
bool is7Scenes(const std::filesystem::path &folder);
Recording open7Scenes(const std::filesystem::path &folder);
bool isTum(const std::filesystem::path &folder);
Recording openTum(const std::filesystem::path &folder);
bool isRaw(const std::filesystem::path &file);
Recording openRaw(const std::filesystem::path &file);
Recording openMcap(const std::filesystem::path &file);
// Of other programs (docs/imports.md).
bool isStrayScanner(const std::filesystem::path &folder);
Recording openStrayScanner(const std::filesystem::path &folder);
bool isRosBag(const std::filesystem::path &folder);
Recording openRosBag(const std::filesystem::path &path);  // a folder or an MCAP file
bool isRos1Bag(const std::filesystem::path &file);        // RealSense's too
Recording openRos1Bag(const std::filesystem::path &file);
bool isRecord3d(const std::filesystem::path &path);  // any zip is
Recording openRecord3d(const std::filesystem::path &path);
bool isStreamRecorder(const std::filesystem::path &folder);
Recording openStreamRecorder(const std::filesystem::path &folder);
bool isHl2ss(const std::filesystem::path &folder);
Recording openHl2ss(const std::filesystem::path &folder);
bool isMatroska(const std::filesystem::path &file);
Recording openAzureKinect(const std::filesystem::path &file);
// Throws Failure with the way out for a file that another program recorded and that is not read.
void refuseForeignFile(const std::filesystem::path &file);

}  // namespace sphc::recording
