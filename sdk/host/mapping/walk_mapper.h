// From a walk to a pose for each of its frames.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include "host/mapping/adjustment.h"
#include "host/mapping/walk.h"

namespace sphc::host {

// Told what is being done, and how far; may be empty.
using MappingProgress = std::function<void(const std::string &what, uint32_t done, uint32_t total)>;

struct MappingOptions {
  PoseTrust trust = {};                              // what to believe of the poses that the frames were told
  bool lens_is_free = false, mount_is_free = false;  // the calibration is adjusted too, in the end
  CalibrationChange change_so_far = {};              // as in AdjustmentOptions
  bool judges_told = false;                          // find what residuals the told poses leave, as they are
  uint32_t threads = 0;  // at most so many; 0: one for each core.  The result is the same
};

struct MappedWalk {
  // Of the keyframes.  The world is the first one that has a pose, or what the recording told.
  FramePoses world_from_camera;
  std::vector<uint32_t> parts;  // of each keyframe, 0 for the largest; those of part 0 have poses
  // Of each keyframe: told poses, or steps, alone join it to the largest stretch of part 0 that links connect.
  std::vector<bool> by_told_alone;
  size_t links = 0, loops = 0;  // between keyframes near in time, and between others
  size_t contradicting = 0;     // links that the others contradicted; left out
  AdjustmentSummary at_first;   // residuals before the second round of pairs, with the calibration held
  AdjustmentSummary residuals;
  // What the same sightings leave where the frames stand as they were told; where that was asked for.
  std::optional<AdjustmentSummary> residuals_of_told;
  DepthCalibration depth;    // as learnt
  CalibrationChange change;  // zero where it was not free
  // Poses (of odometry: steps) that were told, and how many of them the map contradicts.
  size_t told = 0, told_wrong = 0;
  bool is_in_told_world = false;
  bool has_told_axes = false;  // as was asked for
  // None of what was told was used: the links contradict it altogether or, where none is wrong, it is of frames
  // that have no pose here.
  bool is_unbelieved = false;
};

// Keyframes that have a pose, and their followers.
size_t mappedFrames(const Walk &walk, const FramePoses &world_from_camera);

class NothingAgrees : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws NothingAgrees where no two frames do, or all that do contradict each other, and std::runtime_error
// otherwise, with cause and cure.
MappedWalk mapWalk(const Walk &walk, const MappingOptions &options, const MappingProgress &progress);

}  // namespace sphc::host
