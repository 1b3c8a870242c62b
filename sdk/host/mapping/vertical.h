// Up, by what accelerometers felt along a path.
#pragma once
#include <string>
#include <vector>

#include "host/recording/recording.h"
#include "runtime/geometry/rotation.h"

namespace sphc::host {

struct FeltPath {
  recording::PoseTrack world_from_camera;
  std::vector<recording::TimedAcceleration> felt;  // times increase
};

struct MeasuredVertical {
  Vector3 up_world = Vector3::Zero();  // unit vector; zero where nothing could be measured
  size_t accelerations = 0;            // that fell between two poses
  double seconds = 0;                  // that they span, all paths together
  double sigma_rad = 0;                // of up_world
  std::string doubt;                   // why it is not believed, with the cure; empty where it is

  bool isKnown() const { return accelerations > 0 && doubt.empty(); }
};

// The mean of what was felt, turned into the world: who walks speeds up as much as he slows down, and gravity
// stays. It is believed when it is as strong as gravity, and when stretches of a second agree with each other.
MeasuredVertical measureVertical(const std::vector<FeltPath> &paths);

}  // namespace sphc::host
