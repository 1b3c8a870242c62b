// What a localizer is told once.
#pragma once
#include "runtime/base/clock.h"
#include "runtime/base/fixed_vector.h"
#include "runtime/base/parallel.h"
#include "runtime/geometry/camera.h"
#include "runtime/geometry/rigid.h"
#include "runtime/types/depth_calibration.h"
#include "runtime/types/depth_sensor.h"
#include "runtime/types/image_view.h"

namespace sphc {

// How the search goes; may be set between frames.
struct SearchParameters {
  double max_ratio = 0.85;          // Lowe's ratio test, on distances
  uint32_t probes = 8;              // cells of a map's index searched for each keypoint; 0: the whole map
  uint32_t max_iterations = 20000;  // minimal samples of one search, at most
  uint32_t min_inliers = 10;
};

constexpr uint32_t kMostCameras = 8;  // of a rig, the colour camera among them

// A camera of a rig beside the colour camera.
struct RigCamera {
  Camera camera;
  Rigid color_from_camera;
  double row_time_s = 0;  // from a row's exposure to that of the next
};
using FurtherCameras = FixedVector<RigCamera, kMostCameras - 1>;

constexpr uint32_t kMostDepthCameras = 2;  // of a rig

struct RigDepthCamera {
  Camera camera;
  Rigid color_from_depth;
  DepthSensor sensor = {};
  DepthLayout layout;
  uint32_t least_amplitude = 0;              // of a measurement that is believed; 0: amplitudes are not known
  Vector2 relation_sigma = Vector2::Zero();  // offset in m, slope: of how it is off against the first
};
using DepthCameras = FixedVector<RigDepthCamera, kMostDepthCameras>;

struct LocalizerConfig {
  uint32_t max_keypoints = 0;
  uint32_t max_maps = 1;
  uint64_t seed = 0;
  bool tracks = false;  // do frames follow each other?
  SearchParameters search;

  Camera color_camera;
  double color_row_time_s = 0;
  FurtherCameras further;
  DepthCameras depth;            // one at least
  DepthCalibration depth_prior;  // what is known of the first one's bias before the first frame
  double pixel_sigma_px = 0;     // noise of a keypoint's position
  double map_sigma_m = 0;        // error of a map point across its direction

  Clock clock;
  Parallel parallel;

  bool hasRollingShutter() const {
    bool has = color_row_time_s != 0;
    for (const RigCamera &camera : further) has = has || camera.row_time_s != 0;
    return has;
  }
};

}  // namespace sphc
