// One place to be measured: its recording, its private points, and what is to be seen of it.
#pragma once
#include <string>
#include <vector>

#include "host/audit/attack/inversion.h"
#include "host/audit/score/truth_view.h"
#include "host/import/point_model.h"
#include "host/publish/fakes/strategy.h"

namespace sphc::host {

struct MeasuredPlace {
  std::string name;
  std::vector<SpherePoint> points;  // all real, shuffled
  std::vector<InversionView> centre_views;
  // At the poses of frames: the frame, its own keypoints, and the unprotected points.
  std::vector<TruthView> frame_truths;
  std::vector<SeenPoints> own_keypoints, unprotected;
};

// "name=recording,calibration,first,last,step"; no calibration: the recording's own.
MeasuredPlace readPlace(const std::string &description, SecretRandom *random);

}  // namespace sphc::host
