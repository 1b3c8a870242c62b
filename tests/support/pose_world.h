// Correspondences as the pose stage gets them, with the true pose beside them.
#pragma once
#include <vector>

#include "runtime/base/random.h"
#include "runtime/types/correspondence.h"
#include "runtime/types/estimate.h"

namespace sphc::test {

struct PoseWorldOptions {
  uint64_t seed = 1;
  size_t count = 300;         // correspondences, true and false together
  double true_share = 1;      // of them whose direction is that of their point; the rest point anywhere
  double cone_rad = kPi;      // within so much of it
  double depth_sigma_m = 0;   // noise along the view that is really there
  double pixel_sigma_px = 0;  // noise across it
  double stated_depth_sigma_m = 0.01, stated_sideways_m = 0.005;  // what the correspondences say of their noise
  Vector3 centre_offset_m = Vector3::Zero();                      // of the sphere centre from the points' centroid
  double wall_m = 0;  // other than 0: all points lie on a wall this far ahead, which is seen straight on
};

struct PoseWorld {
  std::vector<Correspondence> correspondences;
  std::vector<bool> is_true;
  Rigid camera_from_map;
};

PoseWorld makePoseWorld(const PoseWorldOptions &options);
// Some point that the camera sees, camera frame.
Vector3 pointInView(Random *random);
struct ViewedPoints {
  std::vector<Vector3> points_m;  // camera frame
  Vector3 centroid_m = Vector3::Zero();
};
ViewedPoints pointsInView(size_t count, Random *random, double wall_m = 0);

// Rotation angle, and distance of the camera centres.
double rotationErrorRad(const Rigid &estimate, const Rigid &truth);
double translationErrorM(const Rigid &estimate, const Rigid &truth);

}  // namespace sphc::test
