// Poses at times ahead of frames, by sphc_localizer_predict, against the recording's own poses.
#pragma once
#include <array>
#include <vector>

#include "host/evaluate/map_file.h"
#include "host/recording/recording_reader.h"
#include "lab/common/readable_frames.h"

namespace sphc::host {

struct PredictInput {
  recording::RecordingReader *reader = nullptr;
  const std::vector<MapFile> *maps = nullptr;
  std::array<double, 3> centre_in_world_m = {};
  std::vector<int64_t> ahead_ns;
};

struct PredictRow {
  int64_t ahead_ns = 0;
  bool odometry = false;
  uint32_t predictions = 0;                  // while tracking, where the recording has a pose then
  double error_m = 0, error_deg = 0;         // median
  double still_m = 0, still_deg = 0;         // median, of the frame's pose in its place
  double shift_sigmas = 0, turn_sigmas = 0;  // 68 % of the errors, an axis, are within so many of the stated sigmas
  double shift_sigmas95 = 0, turn_sigmas95 = 0;  // 95 %
};

// A row for each time ahead.  The odometry is that of `localize --odometry`.  `unreadable` hears of the frames that
// are left out.
std::vector<PredictRow> runPredict(const PredictInput &input, bool odometry, const Unreadable &unreadable);

}  // namespace sphc::host
