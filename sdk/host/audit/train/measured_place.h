// One place to be measured: its recording, its private points, and what is to be seen of it.
#pragma once
#include <string>
#include <vector>

#include "host/audit/attack/inversion.h"
#include "host/audit/score/panorama.h"
#include "host/build/fakes/strategy.h"
#include "host/import/point_model.h"

namespace sphc::host {

struct MeasuredPlace {
  std::string name;
  std::vector<SpherePoint> points;  // all real, shuffled
  // At the centre: rotations, camera_from_map, and the truth.
  std::vector<Matrix3> rotations;
  std::vector<TruthView> centre_truths;
  // At the poses of frames: the frame, its own keypoints, and the unprotected points.
  std::vector<TruthView> frame_truths;
  std::vector<SeenPoints> own_keypoints, unprotected;
};

// "name=recording,calibration,first,last,step"; no calibration: the recording's own.
MeasuredPlace readPlace(const std::string &description, SecretRandom *random);

}  // namespace sphc::host
