// Consecutive frames of a recording in memory, to be broken in one way or another.
#pragma once
#include <optional>
#include <vector>

#include "host/recording/recording_reader.h"

namespace sphc::host {

struct Shot {
  std::vector<uint8_t> color;   // rows without gaps, in Sequence::color_format
  std::vector<uint16_t> depth;  // the same
  int64_t color_time_ns = 0, depth_time_ns = 0;
  std::optional<sphc_rigid> world_from_camera;  // of the colour camera
  sphc_localizer_prior prior = {};              // flags 0: nothing is known
};

struct Sequence {
  sphc_rig rig = {};
  sphc_format color_format = SPHC_FORMAT_BGR8;
  std::vector<Shot> shots;

  uint32_t channels() const { return color_format == SPHC_FORMAT_GRAY8 ? 1 : 3; }
  uint32_t colorWidth() const { return rig.color_camera.width; }
  uint32_t colorHeight() const { return rig.color_camera.height; }
  uint32_t depthWidth() const { return rig.depth_camera.width; }
  uint32_t depthHeight() const { return rig.depth_camera.height; }
};

constexpr uint32_t kSequenceFrames = 30;

// Frames in sequences of kSequenceFrames, `most` at most, spread evenly over the recording; frames that cannot be
// read are left out.  Throws std::runtime_error where none can, as readFrames does.
std::vector<Sequence> readSequences(recording::RecordingReader *reader, uint32_t most);
// All frames, or `most` of them, spread evenly over the recording.
Sequence readFrames(recording::RecordingReader *reader, uint32_t most = UINT32_MAX);
// Borrows.
sphc_localizer_frame frameOf(const Sequence &sequence, const Shot &shot, uint32_t number);

}  // namespace sphc::host
