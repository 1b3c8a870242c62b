// What the times of a recording say of its clocks.
#pragma once
#include <vector>

#include "host/recording/recording_reader.h"

namespace sphc::host {

struct Pause {
  double from_s = 0, to_s = 0;  // of colour images that follow each other, since the first
};

struct WalkTimes {
  uint32_t backward = 0;     // images whose time is not after that of the one before; they are left out
  double unpaired = 0;       // share of the rarer kind of image that found none of the other kind near enough
  double apart_s = 0;        // colour and depth of a frame, median
  double drift_s_per_s = 0;  // how fast the streams move past each other; 0 where that is not steady
  double drifted_s = 0;      // by how much, from the first frame to the last
  std::vector<Pause> pauses;
};

// Of a recording as it was selected; reads no image.
WalkTimes timesOf(const recording::RecordingReader &reader);

// A time without frames that is no pace of the camera.
inline bool isPause(double gap_s, double usual_gap_s) { return gap_s > 1 && gap_s > 5 * usual_gap_s; }

}  // namespace sphc::host
