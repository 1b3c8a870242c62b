// Builds a point model from a recording of colour and depth, and poses: its own or others.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/frames/frame_consistency.h"
#include "host/import/point_model.h"
#include "host/recording/recording_reader.h"
#include "runtime/types/depth_calibration.h"

namespace sphc::host {

constexpr uint32_t kMostObservations = 24;  // of a point, the newest: those before are forgotten

struct RgbdImportOptions {
  uint32_t max_keypoints = 1200;  // of a frame
  // Frames that must agree on a point, kMostObservations at most; 2 halves the map and costs recall.
  uint32_t min_observations = 1;
  double depth_min_m = 0.3, depth_max_m = 6.0;
  double merge_pixels = 4;               // an observation joins a point that reprojects within this
  double max_descriptor_distance = 260;  // and whose descriptor is within this (L2 of bytes)
  int64_t row_time_ns = 0;   // of a rolling shutter: from a row's exposure to that of the row below; 0: at once
  bool keep_moving = false;  // points on people, hands, feet, what was moved and what is gone
};

// A recording, and what of it a model is made of.
struct RgbdSource {
  recording::RecordingReader *reader;
  std::function<bool(uint32_t index)> takes_part = {};  // of its frames; empty: all
  // world_from_camera of the colour camera at a time, none where it is not known; empty: the recording's own.
  std::function<std::optional<sphc_rigid>(int64_t time_ns)> poses = {};
  DepthCalibration depth = {};  // its mean is what is known of the sensor's bias; points are lifted without it
};

// Points on what moved while the frames were taken.
struct MovingSummary {
  uint32_t seen_through = 0;        // points that were dropped: views of the place see what lies behind it
  uint32_t within_reach = 0;        // dropped too: near the holder's body, and no view from elsewhere confirms them
  uint32_t gone = 0;                // dropped too: views of a later recording see through them again and again
  double disagreement = 0;          // of two views of one surface, median, as a share of depth
  std::vector<std::string> doubts;  // why points that look as if they moved were kept, with cause and cure
};

// How keypoints that were matched between frames agree with the poses, if the poses' shifts are multiplied.
struct PoseScale {
  uint32_t matches = 0, agree = 0;  // as the poses are
  uint32_t agree_most = 0;          // with the best multiple
  double multiple = 1;              // the best: shifts of poses times this are those that depth says
  uint32_t agree_corrected = 0;     // if poses had the mistake that most speaks for
  const char *mistake = "";         // which, with the cure
  uint32_t fixed_in_image = 0;      // of the matches: they go along with the camera, as a menu does

  uint32_t ofThePlace() const { return matches - fixed_in_image; }
};

// The same of a stretch of frames.
struct PoseScalePart {
  uint32_t recording;                      // from 0, in the order given
  uint32_t first_sequence, last_sequence;  // numbers of its frames
  PoseScale scale;
};

struct RgbdImportSummary {
  uint32_t frames_used = 0, frames_without_pose = 0, frames_unreadable = 0;
  std::vector<double> pose_gaps_ms;  // of those without a pose that lie between two: how far these are apart
  uint32_t frames_empty = 0;         // of those used, without a keypoint that has depth
  uint32_t frames_apart = 0;         // of those used, whose depth was taken elsewhere, nobody knows where
  uint32_t frames_bent = 0;          // of those used, whose rows stay as they are for lack of poses
  FaultCounts frames_with_fault;     // of those used
  std::string first_unreadable;      // which, and why
  uint64_t keypoints = 0, lifted = 0, merged = 0;  // merged: joined a point that was there already
  uint32_t points_kept = 0, points_dropped = 0;
  uint32_t fixed_in_image = 0;  // of the points that were dropped, those that went along with the camera
  MovingSummary moving;         // those that moved
  PoseScale scale;
  std::vector<PoseScalePart> scale_parts;
};

// What of the frames took no part, or not as it should, a sentence each.
std::vector<std::string> framesLeftOut(const RgbdImportSummary &summary);

// Told after each frame; may be empty.
using Progress = std::function<void(uint32_t done, uint32_t total)>;

// All frames that have a pose take part.  Depth that was taken at another time than colour is used from where its
// camera was then, if poses tell; else as if it had not moved; and so are rows of a rolling shutter.  Of several
// recordings in one world, the oldest comes first: what a later one sees through is gone.  Throws
// std::runtime_error, with cause and cure, when no map can come of it.
PointModel importRgbd(const std::vector<RgbdSource> &recordings, const RgbdImportOptions &options,
                      const Progress &progress, RgbdImportSummary *summary);

}  // namespace sphc::host
