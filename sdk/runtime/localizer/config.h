// What a localizer is told once.
#pragma once
#include "runtime/base/clock.h"
#include "runtime/geometry/camera.h"
#include "runtime/geometry/rigid.h"
#include "runtime/types/depth_calibration.h"
#include "runtime/types/depth_sensor.h"

namespace sphc {

constexpr uint32_t kMostMaps = 16;  // of one localizer

struct LocalizerConfig {
  uint32_t max_keypoints = 0;
  uint32_t max_iterations = 0;  // minimal samples of one search, at most
  float max_ratio = 0;          // Lowe's ratio test, on distances
  uint32_t probes = 0;          // cells of the map's index searched for each keypoint; 0: the whole map
  uint32_t min_inliers = 0;
  uint64_t seed = 0;
  bool tracks = false;  // do frames follow each other?

  Camera color_camera, depth_camera;
  Rigid color_from_depth;
  DepthSensor depth_sensor = {};
  DepthCalibration depth_prior;  // what is known of the sensor's bias before the first frame
  double pixel_sigma_px = 0;     // noise of a keypoint's position
  double map_sigma_m = 0;        // error of a map point across its direction

  Clock clock;
};

}  // namespace sphc
