// A frame of a walk as the mapper sees it: the device's own keypoints, with depth where there is some.
#pragma once
#include <optional>
#include <vector>

#include "runtime/geometry/rigid.h"
#include "runtime/geometry/rotation.h"
#include "runtime/types/hint.h"
#include "runtime/types/keypoint.h"

namespace sphc::host {

struct SeenPoint {
  Vector2 ray = Vector2::Zero();      // (x, y, 1), camera frame
  double sigma = 0;                   // of the ray, 1 sigma of either coordinate
  double depth_m = 0;                 // z; 0: none
  double depth_sigma_m = 0;           // 1 sigma of it
  Vector3 bearing = Vector3::Zero();  // unit, along the ray
  // By how much the depth along the ray changes where the surface is moved: the dot product with the move.
  Vector3 depth_by_move = Vector3::UnitZ();

  bool hasDepth() const { return depth_m > 0; }
  Vector3 point_m() const { return Vector3(ray.x() * depth_m, ray.y() * depth_m, depth_m); }
};

// What was measured of a frame's images, whatever they show.
struct ImageEvidence {
  double level = 0;                // median grey level, of 255
  double keypoints = 0;            // how many
  double with_depth = 0;           // share of them
  double nearer = 0, farther = 0;  // shares of what the depth image measured that are out of the range of depths
};

struct WalkFrame {
  uint32_t recording = 0;  // of those that are mapped together
  uint32_t index = 0;      // in the recording
  int64_t time_ns = 0;     // of the colour image
  // As the recording tells it; for those alone who ask for it (pose_beliefs.h).
  std::optional<Rigid> told_world_from_camera;
  uint32_t told_piece = 0;              // of the told poses, the one that this is of (told_pieces.h)
  std::vector<SeenPoint> points;        // strongest keypoint first
  std::vector<Descriptor> descriptors;  // of the same
  Hints hints = 0;                      // why the frame may be worth little
  ImageEvidence evidence;               // likewise
  int64_t gap_ns = 0;                   // since the frame before it in the recording; 0: it is the first
};

}  // namespace sphc::host
