// A walk: its keyframes, and frames that show what their keyframe does.
#pragma once
#include <functional>
#include <vector>

#include "host/mapping/frame_links.h"
#include "host/mapping/frame_reader.h"
#include "host/recording/recording_reader.h"

namespace sphc::host {

// A frame beside its keyframe.
struct Follower {
  uint32_t index = 0;     // in the recording
  uint32_t keyframe = 0;  // its place among the keyframes
  Rigid keyframe_from_frame;
};

struct Walk {
  std::vector<WalkFrame> keyframes;  // in order of time
  std::vector<Follower> followers;   // the same
  uint32_t unreadable = 0;           // frames whose images cannot be read
  double middle_depth_m = 0;         // median over all keypoints with depth

  size_t frameCount() const { return keyframes.size() + followers.size(); }
};

// Told after each frame; may be empty.
using WalkProgress = std::function<void(uint32_t done, uint32_t total)>;

// A frame is a keyframe when it does not agree with the keyframe before it, or shows a view that is shifted by 1/50
// of the focal length.  Poses of the recording are not read.  Throws std::runtime_error, with cause and cure, where
// there is nothing to map.
Walk readWalk(recording::RecordingReader *reader, const FrameReaderOptions &options, const WalkProgress &progress);

}  // namespace sphc::host
