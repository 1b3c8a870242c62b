// What a localizer answers.
#pragma once
#include <cstdint>

#include "runtime/types/cut.h"
#include "runtime/types/estimate.h"
#include "runtime/types/event.h"
#include "runtime/types/fault.h"
#include "runtime/types/hint.h"

namespace sphc {

enum class Outcome : uint8_t {
  kLocalized,
  kFewKeypoints,
  kFewDepths,
  kFewMatches,
  kNoConsensus,  // no pose agrees with clearly more matches than chance would
  kUncertain,    // a pose was found, but the matches pin it down too weakly
  kDeadline,
  kContradiction  // the frame contradicts itself; the faults say how
};

enum class TrackingState : uint8_t { kRelocalizing, kTracking, kLost };  // tracker.h draws the transitions

// What became of one keypoint.
struct Observation {
  float x_px, y_px;      // in the image of its camera
  float scale_px;        // standard deviation of the Gaussian it was found at
  float depth_m;         // z in that camera; 0 unless lifted
  uint32_t point_index;  // of the matched map point
  uint8_t camera;        // 0: the colour camera; i: further camera i - 1
  bool lifted, matched, inlier;
};

struct StageTimes {
  uint64_t features_ns = 0, align_ns = 0, match_ns = 0, pose_ns = 0;
};

// From where the camera was expected to where it was found.
struct Jump {
  Events events = 0;
  double shift_m = 0, turn_rad = 0;  // of the camera's centre, and of the camera; 0 where nothing was expected
};

struct LocalizerResult {
  Outcome outcome = Outcome::kFewMatches;
  Faults faults = 0;
  Hints hints = 0;                                     // where there is no pose
  TrackingState state = TrackingState::kRelocalizing;  // after this frame
  uint32_t keypoints = 0, lifted = 0, matches = 0, inliers = 0;
  uint32_t samples = 0;          // minimal samples drawn, in all searches
  Cuts cuts = 0;                 // what was left out for the time limit
  uint32_t map_id = UINT32_MAX;  // that the pose is in; without a pose the likeliest, or none
  uint32_t frames = 1;           // whose matches were put together
  bool guided = false;           // found where it was expected
  Jump jump;                     // where there is a pose
  // Where the outcome is kLocalized; covariance of (rotation rad, translation m), camera frame, T = exp(xi)
  // T_estimate.
  Rigid camera_from_map;
  Matrix6 covariance = Matrix6::Zero();
  double confidence = 0;   // probability that the pose is within 5 cm and 5 degrees
  DepthCalibration depth;  // that the frame was processed with
  StageTimes times;
};

}  // namespace sphc
