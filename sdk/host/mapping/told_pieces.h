// Pieces of the poses that a recording tells, between pauses in them: a tracker that is lost tells none, and may
// begin anew elsewhere.
#pragma once
#include <vector>

#include "host/recording/pose_track.h"

namespace sphc::host {

class ToldPieces {
 public:
  explicit ToldPieces(const std::vector<recording::TimedPose> &poses);
  // Of a time at which there is a pose; counted from 0.
  uint32_t at(int64_t time_ns) const;

 private:
  std::vector<int64_t> pauses_ns_;  // a time amid each
};

}  // namespace sphc::host
