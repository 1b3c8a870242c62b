// A walk: its keyframes, and frames that show what their keyframe does.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "host/mapping/frame_links.h"
#include "host/mapping/frame_reader.h"
#include "host/recording/recording_reader.h"

namespace sphc::host {

// A frame beside its keyframe.
struct Follower {
  uint32_t recording = 0;  // of those that are mapped together
  uint32_t index = 0;      // in the recording
  uint32_t keyframe = 0;   // its place among the keyframes
  Rigid keyframe_from_frame;
};

struct Walk {
  std::vector<WalkFrame> keyframes;  // in order of time
  std::vector<Follower> followers;   // the same
  uint32_t unreadable = 0;           // frames whose images cannot be read
  std::string first_fault;           // why the first of them cannot
  double middle_depth_m = 0;         // median over all keypoints with depth

  size_t frameCount() const { return keyframes.size() + followers.size(); }
};

// Walks one after another, each with its number as the recording of its frames.
Walk joinWalks(std::vector<Walk> walks);

// How far the view moved between the two frames of a link: median over their matches, as rays.
double shiftOf(const FrameLink &link, const std::vector<WalkFrame> &frames);

// How far the view moves from a keyframe to the next, in focal lengths, in a walk of so many frames: 1/50, and more
// where the frames are many.  Mapping takes more than in proportion to the keyframes, and near ones tell the same.
double keyframeShift(uint32_t frames);

// Told after each frame; may be empty.
using WalkProgress = std::function<void(uint32_t done, uint32_t total)>;

// A frame is a keyframe when it does not agree with the keyframe before it, or its view is shifted by
// keyframeShift. Poses of the recording are not read.  Throws std::runtime_error, with cause and cure, where there
// is nothing to map.
Walk readWalk(recording::RecordingReader *reader, const FrameReaderOptions &options, const WalkProgress &progress);
// The same as if the recording had this calibration.
Walk readWalk(recording::RecordingReader *reader, const sphc_rig &calibration, const FrameReaderOptions &options,
              const WalkProgress &progress);

}  // namespace sphc::host
